/** `library`: captures into the library of templates; without `--clips`, the studio's set. */
import { mkdirSync, readdirSync, readFileSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { buildLibrary, type Capture, mergeLibraries } from "../../core/templates/build-library.ts";
import { decodeLibrary, encodeLibrary } from "../../core/templates/library-file.ts";
import type { Library } from "../../core/templates/types.ts";
import { renderScore } from "../../studio/render.ts";
import { studioSet } from "../../studio/set.ts";
import { baseName, needed, one, readOptions, UsageError } from "../args.ts";
import { readCapture, readSidecar } from "../read.ts";
import { type Detector, stepDetector } from "./contact-model.ts";

/** Every N-th of a sorted list from the I-th on: `--shard I/N`. */
const shardOf = <T>(all: readonly T[], [i, n]: readonly [number, number]): T[] =>
  all.filter((_, k) => k % n === i - 1);

/** The studio's captures as the library reads them: motion and tasks, never the exact contacts. */
export function studioCaptures(
  progress: (text: string) => void,
  shard: [number, number] = [1, 1],
): Capture[] {
  const set = shardOf(
    [...studioSet()].sort((a, b) => (a.name < b.name ? -1 : 1)),
    shard,
  );
  return set.map(({ name, score }, i) => {
    progress(`${i + 1}/${set.length} ${name}`);
    const { clip, sidecar } = renderScore(score);
    return { name, clip, tasks: sidecar.tasks };
  });
}

function folderCaptures(folder: string, shard: [number, number], detect: Detector): Capture[] {
  // In order of their names, as merging sorts them: the library is the same however it was divided.
  const names = readdirSync(folder)
    .filter((f) => f.toLowerCase().endsWith(".bvh"))
    .sort((a, b) => (baseName(a) < baseName(b) ? -1 : 1));
  const files = shardOf(names, shard);
  return files.map((f, i) => {
    console.error(`${i + 1}/${files.length} ${f}`);
    const path = join(folder, f);
    const { clip } = readCapture(path);
    return {
      name: baseName(f),
      // Without the folder: templates are called the same wherever the captures lie.
      clip: { ...clip, name: baseName(f) },
      contacts: detect(clip),
      tasks: readSidecar(path.replace(/\.bvh$/i, ".json"))?.tasks ?? [],
    };
  });
}

function readLibrary(path: string): Library {
  let bytes: Uint8Array;
  try {
    bytes = readFileSync(path);
  } catch (error) {
    throw new Error(`${path}: could not be read: ${error instanceof Error ? error.message : String(error)}`);
  }
  try {
    return decodeLibrary(bytes);
  } catch (error) {
    throw new Error(`${path}: ${error instanceof Error ? error.message : String(error)}`);
  }
}

function write(library: Library, out: string): object {
  mkdirSync(dirname(out), { recursive: true });
  const bytes = encodeLibrary(library);
  writeFileSync(out, bytes);
  return {
    file: out,
    bytes: bytes.length,
    clips: library.clips.length,
    templates: library.templates.length,
    walks: library.walks.length,
  };
}

export const libraryCommand = {
  usage:
    "library [--clips DIR] --out F [--shard I/N] [--method oracle|height|speed|both] [--model F] | library merge A B ... --out F",
  run(args: string[]) {
    const o = readOptions(args, { clips: "one", out: "one", shard: "one", method: "one", model: "one" });
    const out = needed(o, "out");
    if (o.words[0] === "merge") {
      if (o.words.length < 2) throw new UsageError("merge: files are needed.");
      return write(mergeLibraries(o.words.slice(1).map(readLibrary)), out);
    }
    const shard = (one(o, "shard") ?? "1/1").split("/").map(Number) as [number, number];
    if (!(shard.length === 2 && shard.every(Number.isInteger) && shard[0] >= 1 && shard[0] <= shard[1]))
      throw new UsageError("--shard: I/N with 1 <= I <= N is needed.");
    const clips = one(o, "clips");
    const captures = clips
      ? folderCaptures(clips, shard, stepDetector(one(o, "method") ?? "oracle", one(o, "model")))
      : studioCaptures((t) => console.error(t), shard);
    return write(buildLibrary(captures), out);
  },
};
