/** Writing results, with errors that name the file; and what is made once for each build and kept beside it. */
import { existsSync, mkdirSync, readFileSync, statSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { why } from "./read.ts";

/**
 * Makes a folder and those above it.
 *
 * @throws Error "DIR: could not be made: ..."
 */
export function makeFolder(folder: string): void {
  const missing: string[] = [];
  // One by one from the first that is there: `recursive` never returns where the system refuses a folder as if its parent were missing.
  for (let at = folder; !existsSync(at); at = dirname(at)) missing.unshift(at);
  try {
    for (const f of missing) mkdirSync(f);
    if (!statSync(folder).isDirectory()) throw new Error("a file of that name is there");
  } catch (error) {
    throw new Error(`${folder}: could not be made: ${why(error)}.`);
  }
}

/** Writes a file, its folder made where there is none. @throws Error "F: could not be written: ..." */
export function writeOutput(path: string, content: string | Uint8Array): void {
  makeFolder(dirname(path));
  try {
    writeFileSync(path, content);
  } catch (error) {
    throw new Error(`${path}: could not be written: ${why(error)}.`);
  }
}

/**
 * Bytes that follow from the project's sources alone: made once for each build of the command line and kept beside it.
 *
 * @param built file of the code that asks: the build's own, or a source that is run as it is, for which nothing is kept.
 */
export function keptBeside(built: string, name: string, make: () => Uint8Array): Uint8Array {
  const kept = join(dirname(built), name);
  const keeps = built.endsWith(".mjs");
  if (keeps && existsSync(kept) && statSync(kept).mtimeMs >= statSync(built).mtimeMs)
    return new Uint8Array(readFileSync(kept));
  const bytes = make();
  if (keeps) writeFileSync(kept, bytes);
  return bytes;
}
