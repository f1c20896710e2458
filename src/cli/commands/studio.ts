/** `studio`: every capture that ships, as BVH with its sidecar. */
import { mkdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { writeBvh } from "../../core/capture/bvh-write.ts";
import { renderScore } from "../../studio/render.ts";
import { studioSet } from "../../studio/set.ts";
import { needed, one, readOptions } from "../args.ts";

export const studioCommand = {
  usage: "studio --out DIR [--only NAME]",
  run(args: string[]) {
    const o = readOptions(args, { out: "one", only: "one" });
    const out = needed(o, "out");
    const only = one(o, "only");
    const set = studioSet().filter((s) => only === undefined || s.name === only);
    if (set.length === 0) throw new Error(`--only: no capture is called ${JSON.stringify(only)}.`);
    mkdirSync(out, { recursive: true });
    return {
      captures: set.map(({ name, score }, i) => {
        console.error(`${i + 1}/${set.length} ${name}`);
        const { clip, sidecar } = renderScore(score);
        writeFileSync(join(out, `${name}.bvh`), writeBvh(clip));
        writeFileSync(join(out, `${name}.json`), `${JSON.stringify(sidecar)}\n`);
        return { name, seconds: clip.frames / clip.rate, tasks: sidecar.tasks.length };
      }),
    };
  },
};
