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

/** The name kept with the scene. */
const NAMED = "current name";
/** Where a scene is put that could not be read: another version's, or damaged. Nothing is thrown away. */
const ASIDE = "unreadable";
const VERSION = "version ";
/** Versions kept by name; the oldest go first. */
const MOST_VERSIONS = 40;

/** The scene kept last, or null when there is none, it is broken, or storage is closed. */
export async function loadScene(): Promise<Scene | null> {
  let kept: unknown;
  try {
    kept = await use((db) => db.get(STORE, CURRENT));
    return kept === undefined ? null : parseScene(kept);
  } catch (error) {
    console.warn("The kept scene could not be read:", error);
    if (kept !== undefined) await keep(kept, ASIDE);
    return null;
  }
}

/** The name of the scene kept last; null when there is none. */
export async function loadName(): Promise<string | null> {
  try {
    const name: unknown = await use((db) => db.get(STORE, NAMED));
    return typeof name === "string" ? name : null;
  } catch (error) {
    console.warn("The kept scene's name could not be read:", error);
    return null;
  }
}

async function keep(value: unknown, key: string): Promise<boolean> {
  try {
    await use((db) => db.put(STORE, value, key));
    return true;
  } catch (error) {
    console.warn("The scene could not be kept:", error);
    return false;
  }
}

/** Keeps a scene. @returns false where storage is closed or full. */
export async function saveScene(scene: Scene, name: string | null = null): Promise<boolean> {
  const ok = await keep(scene, CURRENT);
  return ok && (name === null || (await keep(name, NAMED)));
}

/** A scene kept by name. */
export interface Version {
  key: string;
  name: string;
  /** Milliseconds since 1970. */
  at: number;
  scene: Scene;
}

/** Keeps a scene under a name of its own. @returns false where storage is closed or full. */
export async function keepVersion(name: string, scene: Scene, at: number): Promise<boolean> {
  const ok = await keep({ name, at, scene }, `${VERSION}${String(at).padStart(14, "0")}`);
  const all = await listVersions();
  for (const old of all.slice(MOST_VERSIONS)) await dropVersion(old.key);
  return ok;
}

/** Every version that can be read, newest first; none where storage is closed. */
export async function listVersions(): Promise<Version[]> {
  try {
    const range = IDBKeyRange.bound(VERSION, `${VERSION}\uffff`);
    const keys = await use((db) => db.getAllKeys(STORE, range));
    const values: unknown[] = await use((db) => db.getAll(STORE, range));
    const out: Version[] = [];
    values.forEach((value, i) => {
      const v = value as { name?: unknown; at?: unknown; scene?: unknown };
      try {
        out.push({
          key: String(keys[i]),
          name: String(v.name ?? "Version"),
          at: Number(v.at ?? 0),
          scene: parseScene(v.scene),
        });
      } catch (error) {
        console.warn(`${String(keys[i])} could not be read:`, error);
      }
    });
    return out.reverse();
  } catch (error) {
    console.warn("Versions could not be read:", error);
    return [];
  }
}

export async function dropVersion(key: string): Promise<void> {
  try {
    await use((db) => db.delete(STORE, key));
  } catch (error) {
    console.warn("A version could not be removed:", error);
  }
}

const MODEL = "model ";

/** Keeps a character's file under its name. @returns false where storage is closed or full. */
export function keepModel(name: string, bytes: ArrayBuffer): Promise<boolean> {
  return keep(bytes, MODEL + name);
}

/** A character's file kept before; null when there is none. */
export async function loadModel(name: string): Promise<ArrayBuffer | null> {
  try {
    const bytes: unknown = await use((db) => db.get(STORE, MODEL + name));
    return bytes instanceof ArrayBuffer ? bytes : null;
  } catch (error) {
    console.warn("A character could not be read:", error);
    return null;
  }
}
