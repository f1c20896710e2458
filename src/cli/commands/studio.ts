/** `studio`: every capture that ships, as BVH with its sidecar; or one that a score tells. */
import { join } from "node:path";
import { writeBvh } from "../../core/capture/bvh-write.ts";
import { wearClip } from "../../studio/realism.ts";
import { renderScore } from "../../studio/render.ts";
import { LAYERS, type Layer, type Score } from "../../studio/score.ts";
import { readScore, writeScore } from "../../studio/score-file.ts";
import { everyScore } from "../../studio/set.ts";
import { needed, one, readOptions, UsageError } from "../args.ts";
import { readText } from "../read.ts";
import { makeFolder, writeOutput } from "../write.ts";

export const studioCommand = {
  usage: "studio --out DIR [--only NAME | --score F.json] [--without LAYER,...] [--worn SEED] [--scores]",
  run(args: string[]) {
    const o = readOptions(args, {
      out: "one",
      only: "one",
      score: "one",
      without: "one",
      worn: "one",
      scores: "flag",
    });
    const out = needed(o, "out");
    const set = chosen(one(o, "only"), one(o, "score"));
    const without = layersNamed(one(o, "without"));
    const worn = one(o, "worn");
    const seed = worn === undefined ? null : Number(worn);
    if (seed !== null && !Number.isInteger(seed))
      throw new UsageError(`--worn: an integer is needed, found ${JSON.stringify(worn)}.`);
    makeFolder(out);
    return {
      captures: set.map((plain, i) => {
        const score = without.length > 0 ? { ...plain, without } : plain;
        const { name } = score;
        console.error(`${i + 1}/${set.length} ${name}`);
        const { clip, sidecar } = renderScore(score);
        const shown = seed === null ? clip : wearClip(clip, seed + i);
        writeOutput(join(out, `${name}.bvh`), writeBvh(shown));
        writeOutput(join(out, `${name}.json`), `${JSON.stringify(sidecar)}\n`);
        if (o.values.has("scores")) writeOutput(join(out, `${name}.score.json`), writeScore(score));
        return { name, seconds: clip.frames / clip.rate, tasks: sidecar.tasks.length };
      }),
    };
  },
};

function chosen(only: string | undefined, file: string | undefined): Score[] {
  if (file !== undefined) {
    if (only !== undefined) throw new UsageError("--only and --score: one of the two.");
    const text = readText(file);
    try {
      return [readScore(text)];
    } catch (error) {
      throw new Error(`${file}: ${error instanceof Error ? error.message : String(error)}`);
    }
  }
  const set = everyScore()
    .filter((s) => only === undefined || s.name === only)
    .map((s) => s.score);
  if (set.length === 0) throw new UsageError(`--only: no capture is called ${JSON.stringify(only)}.`);
  return set;
}

function layersNamed(text: string | undefined): Layer[] {
  if (text === undefined) return [];
  return text.split(",").map((name) => {
    const layer = LAYERS.find((l) => l === name.trim());
    if (!layer)
      throw new UsageError(
        `--without: one of ${LAYERS.join(", ")} is needed, found ${JSON.stringify(name)}.`,
      );
    return layer;
  });
}
