/** Captures, their labels and what was made of them, kept in the browser's own database. */
import { type IDBPDatabase, openDB } from "idb";
import type { SidecarTask } from "../../core/capture/sidecar.ts";
import type { Step } from "../../core/steps/types.ts";

/** A capture as it is kept. */
export interface KeptCapture {
  key: string;
  name: string;
  file: Blob;
  mapping: Record<string, string> | null;
  /** One byte a frame of the clip at 60 Hz. */
  labels: Uint8Array;
  confirmed: Uint8Array;
  /** Labels painted by hand, a bit for each track; left out by earlier versions. */
  touched?: Uint8Array;
  tasks: SidecarTask[];
  steps: Step[] | null;
  inLibrary: boolean;
  /** Left out by earlier versions. */
  cycle?: string | null;
}

const NAME = "stepwright-captures";
const CLIPS = "clips";
const THINGS = "things";
const LIBRARY = "library";

let database: Promise<IDBPDatabase> | null = null;

function open(): Promise<IDBPDatabase> {
  database ??= openDB(NAME, 1, {
    upgrade(db) {
      db.createObjectStore(CLIPS, { keyPath: "key" });
      db.createObjectStore(THINGS);
    },
    terminated: () => {
      database = null;
    },
  });
  return database;
}

/** @returns null where storage is closed; the reason is on the console. */
async function use<T>(act: (db: IDBPDatabase) => Promise<T>): Promise<T | null> {
  try {
    return await act(await open());
  } catch (error) {
    database = null;
    console.warn("The captures' storage is closed:", error);
    return null;
  }
}

export const loadCaptures = async (): Promise<KeptCapture[]> =>
  (await use((db) => db.getAll(CLIPS) as Promise<KeptCapture[]>)) ?? [];

/** @returns false where it could not be kept. */
export const keepCapture = async (c: KeptCapture): Promise<boolean> =>
  (await use((db) => db.put(CLIPS, c))) !== null;

export const forgetCapture = (key: string): Promise<unknown> => use((db) => db.delete(CLIPS, key));

/** The user's own library, as bytes; null when there is none. */
export const loadLibrary = async (): Promise<Uint8Array | null> =>
  (await use((db) => db.get(THINGS, LIBRARY) as Promise<Uint8Array | undefined>)) ?? null;

export const keepLibrary = (bytes: Uint8Array | null): Promise<unknown> =>
  use<unknown>((db) => (bytes ? db.put(THINGS, bytes, LIBRARY) : db.delete(THINGS, LIBRARY)));
