/** Retrieval with all optimisation of one transition, and full-body synthesis, on the studio's library. */
import { beginSynthesis, type SwingCache, synthesiseClip } from "../../src/core/motion/synthesise.ts";
import { createSkeleton } from "../../src/core/skeleton/skeleton.ts";
import { goalsOf, planScene } from "../../src/core/tasks/plan-scene.ts";
import { retargetLibrary } from "../../src/core/templates/retarget-library.ts";
import { studio } from "../support/library.ts";
import { randomScene } from "../support/random-scene.ts";
import { figure } from "./measure.ts";
import type { BenchModule } from "./types.ts";

const bench: BenchModule = {
  name: "planning",
  async run(options) {
    options.progress("planning: making the library ...");
    const skeleton = createSkeleton(1.75);
    const library = retargetLibrary(studio().library, skeleton);
    const perTransition: number[] = [];
    const rates: number[] = [];
    const cache: SwingCache = new Map();
    for (let round = 0; round < 2; round++) {
      for (let seed = 1; seed <= 100; seed++) {
        const scene = randomScene(seed);
        let t = performance.now();
        const plan = planScene(scene, library, skeleton);
        const planMs = performance.now() - t;
        t = performance.now();
        const synthesis = beginSynthesis(library, skeleton, plan, goalsOf(scene), cache);
        const clip = synthesiseClip(synthesis, "bench");
        const s = (performance.now() - t) / 1000;
        if (round === 0) continue;
        perTransition.push(planMs / scene.tasks.length);
        rates.push(clip.frames / s);
      }
    }
    const sorted = [...perTransition].sort((a, b) => a - b);
    const p95 = sorted[Math.floor(0.95 * sorted.length)];
    return [
      figure("planning, one transition", "ms", perTransition, "median <= 2 ms", (v) => v <= 2),
      figure("planning, one transition, p95", "ms", [p95], "<= 8 ms", (v) => v <= 8),
      figure("full-body synthesis", "frames/s", rates, ">= 10000", (v) => v >= 10000),
    ];
  },
};

export default bench;
