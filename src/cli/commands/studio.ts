/** `studio`: every capture that ships, as BVH with its sidecar. */
import { mkdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { writeBvh } from "../../core/capture/bvh-write.ts";
import { wearClip } from "../../studio/realism.ts";
import { renderScore } from "../../studio/render.ts";
import { everyScore } from "../../studio/set.ts";
import { needed, one, readOptions } from "../args.ts";

export const studioCommand = {
  usage: "studio --out DIR [--only NAME] [--worn SEED]",
  run(args: string[]) {
    const o = readOptions(args, { out: "one", only: "one", worn: "one" });
    const out = needed(o, "out");
    const only = one(o, "only");
    const set = everyScore().filter((s) => only === undefined || s.name === only);
    if (set.length === 0) throw new Error(`--only: no capture is called ${JSON.stringify(only)}.`);
    const worn = one(o, "worn");
    const seed = worn === undefined ? null : Number(worn);
    if (seed !== null && !Number.isInteger(seed))
      throw new Error(`--worn: an integer is needed, found ${JSON.stringify(worn)}.`);
    mkdirSync(out, { recursive: true });
    return {
      captures: set.map(({ name, score }, i) => {
        console.error(`${i + 1}/${set.length} ${name}`);
        const { clip, sidecar } = renderScore(score);
        const shown = seed === null ? clip : wearClip(clip, seed + i);
        writeFileSync(join(out, `${name}.bvh`), writeBvh(shown));
        writeFileSync(join(out, `${name}.json`), `${JSON.stringify(sidecar)}\n`);
        return { name, seconds: clip.frames / clip.rate, tasks: sidecar.tasks.length };
      }),
    };
  },
};
