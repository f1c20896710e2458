/** Cost of paths with style: frames synthesised a second, a whole path after a drag, families built ahead. */

import { createSkeleton } from "../../src/core/skeleton/skeleton.ts";
import { createPath, type PathPoint } from "../../src/core/styles/path.ts";
import { synthesisePath } from "../../src/core/styles/synthesise-path.ts";
import { styleFamilies } from "../../src/studio/style-families.ts";
import { STYLES } from "../../src/studio/styles.ts";
import { figure } from "./measure.ts";
import type { BenchModule } from "./types.ts";

/** A winding way of some forty seconds. */
const POINTS: PathPoint[] = Array.from({ length: 70 }, (_, i) => [1.2 * Math.sin(i / 4.5), i / 2]);
const ROUNDS = 15;

const bench: BenchModule = {
  name: "styles",
  async run(options) {
    options.progress("styles: families ...");
    const skeleton = createSkeleton(1.75);
    const begun = performance.now();
    const families = [...styleFamilies(STYLES, skeleton).values()];
    const ahead = (performance.now() - begun) / 1000;
    options.progress("styles: a path of forty seconds ...");
    const changes = (length: number) => [
      { at: 0, style: 0 },
      { at: 0.35 * length, style: STYLES.indexOf("energetic") },
      { at: 0.7 * length, style: STYLES.indexOf("tired") },
    ];
    const rates: number[] = [];
    const whole: number[] = [];
    for (let k = 0; k < ROUNDS; k++) {
      const t = performance.now();
      const path = createPath(POINTS, true);
      const motion = synthesisePath(path, families, changes(path.length), skeleton);
      const ms = performance.now() - t;
      if (k < 3) continue;
      whole.push(ms);
      rates.push((1000 * motion.clip.frames) / ms);
    }
    return [
      figure("styles, frames synthesised on one core", "frames/s", rates, ">= 30,000", (v) => v >= 30_000),
      figure("styles, a path of forty seconds after a drag", "ms", whole, "<= 100 ms", (v) => v <= 100),
      figure("styles, seven captures and their families", "s", [ahead], "<= 5 s", (v) => v <= 5),
    ];
  },
};

export default bench;
