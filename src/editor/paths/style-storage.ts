/** The visitor's own styles, kept in the browser's database as the files they came from. */
import { type IDBPDatabase, openDB } from "idb";

const NAME = "stepwright-styles";
const STORE = "styles";

export interface KeptStyle {
  name: string;
  /** File name and text of the BVH. */
  file: string;
  text: string;
}

let database: Promise<IDBPDatabase> | null = null;

function open(): Promise<IDBPDatabase> {
  database ??= openDB(NAME, 1, { upgrade: (db) => void db.createObjectStore(STORE, { keyPath: "name" }) });
  return database;
}

/** What was kept, oldest first; nothing where storage is closed. */
export async function keptStyles(): Promise<KeptStyle[]> {
  try {
    return await (await open()).getAll(STORE);
  } catch (error) {
    console.warn("The kept styles could not be read:", error);
    database = null;
    return [];
  }
}

/** Keeps a style for later visits. @returns false where storage is closed or full. */
export async function keepStyle(style: KeptStyle): Promise<boolean> {
  try {
    await (await open()).put(STORE, style);
    return true;
  } catch (error) {
    console.warn("The style could not be kept:", error);
    database = null;
    return false;
  }
}

export async function dropStyle(name: string): Promise<void> {
  try {
    await (await open()).delete(STORE, name);
  } catch (error) {
    console.warn("The style could not be dropped:", error);
    database = null;
  }
}
