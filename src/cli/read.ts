/** Reading inputs, with errors that name the file. */
import { closeSync, fstatSync, openSync, readFileSync, readSync } from "node:fs";
import { StringDecoder } from "node:string_decoder";
import { type BvhFile, createBvhReader } from "../core/capture/bvh-parse.ts";
import { type ImportResult, importBvhFile } from "../core/capture/import.ts";
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

const PIECE = 1 << 20;

/** A BVH file, read a megabyte at a time. @throws BvhError, or Error "F: could not be read: ..." */
export function readBvhFile(path: string): BvhFile {
  let file: number;
  try {
    file = openSync(path, "r");
  } catch (error) {
    throw new Error(`${path}: could not be read: ${error instanceof Error ? error.message : String(error)}`);
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
