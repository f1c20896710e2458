/** The whole set of captures, made as `studio --out DIR` makes it: how long it takes, and that it is the same every time. */
import { createHash } from "node:crypto";
import { writeBvh } from "../../src/core/capture/bvh-write.ts";
import { renderScore } from "../../src/studio/render.ts";
import { everyScore } from "../../src/studio/set.ts";
import { figure } from "./measure.ts";
import type { BenchModule } from "./types.ts";

const TIMES = 3;

const bench: BenchModule = {
  name: "studio",
  async run(options) {
    const seconds: number[] = [];
    const digests = new Set<string>();
    let bytes = 0;
    for (let k = 0; k < TIMES; k++) {
      options.progress(`studio: the whole set, ${k + 1} of ${TIMES}`);
      const digest = createHash("sha256");
      const start = performance.now();
      bytes = 0;
      for (const { score } of everyScore()) {
        const { clip, sidecar } = renderScore(score);
        const text = writeBvh(clip);
        bytes += text.length;
        digest.update(text).update(JSON.stringify(sidecar));
      }
      seconds.push((performance.now() - start) / 1000);
      digests.add(digest.digest("hex"));
    }
    return [
      figure("studio, the whole set", "s", seconds, "<= 60 s", (m) => m <= 60),
      figure("studio, different sets made of the same scores", "sets", [digests.size], "1", (m) => m === 1),
      figure("studio, the whole set as BVH", "MB", [bytes / 1e6], null, () => true),
    ];
  },
};

export default bench;
