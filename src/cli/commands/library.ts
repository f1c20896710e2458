/** `library`: captures into the library of templates; without `--clips`, the studio's set. */
import { readdirSync } from "node:fs";
import { join } from "node:path";
import { buildLibrary, type Capture, mergeLibraries } from "../../core/templates/build-library.ts";
import { decodeLibrary, encodeLibrary } from "../../core/templates/library-file.ts";
import type { Library } from "../../core/templates/types.ts";
import { renderScore } from "../../studio/render.ts";
import { studioSet } from "../../studio/set.ts";
import { baseName, needed, one, readOptions, UsageError } from "../args.ts";
import { readBytes, readCapture, readSidecar, why } from "../read.ts";
import { writeOutput } from "../write.ts";
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

function filesIn(folder: string): string[] {
  try {
    return readdirSync(folder);
  } catch (error) {
    throw new Error(`${folder}: could not be read: ${why(error)}.`);
  }
}

/** @param detector makes what finds the contacts, once there is something to find them in. */
function folderCaptures(folder: string, shard: [number, number], detector: () => Detector): Capture[] {
  // In order of their names, as merging sorts them: the library is the same however it was divided.
  const names = filesIn(folder)
    .filter((f) => f.toLowerCase().endsWith(".bvh"))
    .sort((a, b) => (baseName(a) < baseName(b) ? -1 : 1));
  // A piece may be empty, the whole may not: a folder mistyped would be a library of nothing.
  if (names.length === 0) throw new Error(`${folder}: no BVH file is in it.`);
  const files = shardOf(names, shard);
  if (files.length === 0) return [];
  const detect = detector();
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

/** A library file. @throws Error that begins with its path. */
export function readLibrary(path: string): Library {
  const bytes = readBytes(path);
  try {
    return decodeLibrary(bytes);
  } catch (error) {
    throw new Error(`${path}: ${error instanceof Error ? error.message : String(error)}`);
  }
}

function write(library: Library, out: string): object {
  const bytes = encodeLibrary(library);
  writeOutput(out, bytes);
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
    const merge = args[0] === "merge";
    const known = { clips: "one", out: "one", shard: "one", method: "one", model: "one" } as const;
    const o = readOptions(args, merge ? { out: "one" } : known, merge);
    const out = needed(o, "out");
    if (merge) {
      if (o.words.length < 2) throw new UsageError("merge: files are needed.");
      return write(mergeLibraries(o.words.slice(1).map(readLibrary)), out);
    }
    const shard = (one(o, "shard") ?? "1/1").split("/").map(Number) as [number, number];
    if (!(shard.length === 2 && shard.every(Number.isInteger) && shard[0] >= 1 && shard[0] <= shard[1]))
      throw new UsageError("--shard: I/N with 1 <= I <= N is needed.");
    const clips = one(o, "clips");
    const captures = clips
      ? folderCaptures(clips, shard, () => stepDetector(one(o, "method") ?? "oracle", one(o, "model")))
      : studioCaptures((t) => console.error(t), shard);
    return write(buildLibrary(captures), out);
  },
};
