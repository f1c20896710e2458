/** Autosave in the browser's own database; where that is closed, the page says so and goes on. */
import { type IDBPDatabase, openDB } from "idb";
import { parseScene } from "../../core/scene/schema.ts";
import type { Scene } from "../../core/scene/types.ts";

const NAME = "stepwright";
const STORE = "scenes";
const CURRENT = "current";

/** Milliseconds after which a database that does not answer counts as closed. */
const PATIENCE = 3000;

let database: Promise<IDBPDatabase> | null = null;

/** The promise's value, or an error when it takes too long: another tab may hold the database for ever. */
function soon<T>(promise: Promise<T>): Promise<T> {
  return new Promise((resolve, reject) => {
    const timer = setTimeout(() => reject(new Error("the database does not answer")), PATIENCE);
    promise.then(resolve, reject).finally(() => clearTimeout(timer));
  });
}

function open(): Promise<IDBPDatabase> {
  database ??= openDB(NAME, 1, {
    upgrade: (db) => void db.createObjectStore(STORE),
    // Closed by the browser (storage cleared, disk gone): opened anew next time.
    terminated: () => {
      database = null;
    },
  });
  return database;
}

/** Does something with the database; what fails to open is opened anew the next time. */
async function use<T>(act: (db: IDBPDatabase) => Promise<T>): Promise<T> {
  try {
    return await soon(open().then(act));
  } catch (error) {
    database = null;
    throw error;
  }
}

/** The scene kept last, or null when there is none, it is broken, or storage is closed. */
export async function loadScene(): Promise<Scene | null> {
  try {
    const kept: unknown = await use((db) => db.get(STORE, CURRENT));
    return kept === undefined ? null : parseScene(kept);
  } catch (error) {
    console.warn("The kept scene could not be read:", error);
    return null;
  }
}

/** Keeps a scene. @returns false where storage is closed or full. */
export async function saveScene(scene: Scene): Promise<boolean> {
  try {
    await use((db) => db.put(STORE, scene, CURRENT));
    return true;
  } catch (error) {
    console.warn("The scene could not be kept:", error);
    return false;
  }
}
