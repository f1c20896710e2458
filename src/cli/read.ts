/** Reading inputs, with errors that name the file. */
import { readFileSync } from "node:fs";
import { type ImportResult, importBvh } from "../core/capture/import.ts";
import type { Sidecar } from "../core/capture/sidecar.ts";
import { parseSidecar } from "../core/capture/sidecar-file.ts";

/** A file's text. @throws Error "F: could not be read: ..." */
export function readText(path: string): string {
  try {
    return readFileSync(path, "utf8");
  } catch (error) {
    throw new Error(`${path}: could not be read: ${error instanceof Error ? error.message : String(error)}`);
  }
}

/** A BVH file as a clip on our skeleton. */
export const readCapture = (path: string): ImportResult => importBvh(readText(path), path);

/** A sidecar, or null when there is no such file. */
export function readSidecar(path: string): Sidecar | null {
  let text: string;
  try {
    text = readFileSync(path, "utf8");
  } catch {
    return null;
  }
  return parseSidecar(text, path);
}
