/** Reading inputs, with errors that name the file. */
import { closeSync, existsSync, fstatSync, openSync, readFileSync, readSync } from "node:fs";
import { StringDecoder } from "node:string_decoder";
import { type BvhFile, createBvhReader } from "../core/capture/bvh-parse.ts";
import { type ImportResult, importBvhFile } from "../core/capture/import.ts";
import type { Sidecar } from "../core/capture/sidecar.ts";
import { parseSidecar } from "../core/capture/sidecar-file.ts";

/** What the system says of a failure, without its code and the path that the sentence begins with: "no such file or directory". */
export function why(error: unknown): string {
  const said = error instanceof Error ? error.message : String(error);
  return said.replace(/^[A-Z]+: /, "").replace(/, [a-z]+( '.*')?$/, "");
}

/** A file's bytes. @throws Error "F: could not be read: ..." */
export function readBytes(path: string): Uint8Array {
  try {
    return new Uint8Array(readFileSync(path));
  } catch (error) {
    throw new Error(`${path}: could not be read: ${why(error)}.`);
  }
}

/** A file's text. @throws Error "F: could not be read: ..." */
export function readText(path: string): string {
  try {
    return readFileSync(path, "utf8");
  } catch (error) {
    throw new Error(`${path}: could not be read: ${why(error)}.`);
  }
}

// Strings of about a megabyte and more are kept by Node outside its heap, where they are freed late.
const PIECE = 1 << 18;

/** A BVH file, read a quarter of a megabyte at a time. @throws BvhError, or Error "F: could not be read: ..." */
export function readBvhFile(path: string): BvhFile {
  let file: number;
  try {
    file = openSync(path, "r");
  } catch (error) {
    throw new Error(`${path}: could not be read: ${why(error)}.`);
  }
  try {
    const stats = fstatSync(file);
    if (!stats.isFile()) throw new Error(`${path}: could not be read: this is no file.`);
    const reader = createBvhReader(path, stats.size);
    const decoder = new StringDecoder("utf8");
    const bytes = Buffer.alloc(PIECE);
    for (let n = readSync(file, bytes); n > 0; n = readSync(file, bytes))
      reader.push(decoder.write(bytes.subarray(0, n)));
    reader.push(decoder.end());
    return reader.end();
  } finally {
    closeSync(file);
  }
}

/** A BVH file as a clip on our skeleton. */
export const readCapture = (path: string): ImportResult => importBvhFile(readBvhFile(path));

/** A sidecar, or null when there is no such file. @throws Error for one that cannot be read, or is none. */
export function readSidecar(path: string): Sidecar | null {
  return existsSync(path) ? parseSidecar(readText(path), path) : null;
}
