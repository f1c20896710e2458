/** Autosave in the browser's own database; where that is closed, the page says so and goes on. */
import { type IDBPDatabase, openDB } from "idb";
import { parseScene } from "../core/scene/schema.ts";
import type { Scene } from "../core/scene/types.ts";

const NAME = "stepwright";
const STORE = "scenes";
const CURRENT = "current";

let database: Promise<IDBPDatabase> | null = null;

function open(): Promise<IDBPDatabase> {
  database ??= openDB(NAME, 1, { upgrade: (db) => void db.createObjectStore(STORE) });
  return database;
}

/** The scene kept last, or null when there is none, it is broken, or storage is closed. */
export async function loadScene(): Promise<Scene | null> {
  try {
    const kept: unknown = await (await open()).get(STORE, CURRENT);
    return kept === undefined ? null : parseScene(kept);
  } catch (error) {
    console.warn("The kept scene could not be read:", error);
    return null;
  }
}

/** Keeps a scene. @returns false where storage is closed or full. */
export async function saveScene(scene: Scene): Promise<boolean> {
  try {
    await (await open()).put(STORE, scene, CURRENT);
    return true;
  } catch (error) {
    console.warn("The scene could not be kept:", error);
    return false;
  }
}
