import { describe, expect, it } from "vitest";
import { FOOT_STRIDE, pitchOf } from "../../src/core/motion/foot-pose.ts";
import { beginSynthesis } from "../../src/core/motion/synthesise.ts";
import { createSkeleton } from "../../src/core/skeleton/skeleton.ts";
import { pivotEnd } from "../../src/core/tasks/pivots.ts";
import { goalsOf, planScene } from "../../src/core/tasks/plan-scene.ts";
import { retargetLibrary } from "../../src/core/templates/retarget-library.ts";
import { studio } from "../support/library.ts";
import { randomScene } from "../support/random-scene.ts";

const DEG = 180 / Math.PI;
/** Frames after a landing that are looked at: a foot has come down by then, and no heel is on its way up yet. */
const AFTER = 9;

describe("feet that land", () => {
  // In the first four a capture that strikes harder, or on the toes, takes over as a foot lands.
  it("come down and stay down: no heel bounces where another capture takes over", () => {
    const skeleton = createSkeleton(1.75);
    const library = retargetLibrary(studio().library, skeleton);
    let landings = 0;
    for (const seed of [8, 36, 107, 113, 1, 2, 3, 4]) {
      const scene = randomScene(seed);
      const plan = planScene(scene, library, skeleton);
      const { track } = beginSynthesis(library, skeleton, plan, goalsOf(scene), new Map());
      for (const foot of ["left", "right"] as const) {
        const side = foot === "left" ? 0 : 1;
        const pitch = (f: number) => DEG * pitchOf(track.feet, (2 * f + side) * FOOT_STRIDE + 3);
        plan.steps.forEach((step, i) => {
          const again = plan.steps.slice(i + 1).find((s) => s.foot === foot);
          // A foot that pivots at once rolls on over its ball.
          if (step.foot !== foot || pivotEnd(step.category) || (again && again.lift < step.land + 0.3))
            return;
          landings++;
          const landed = Math.round(60 * step.land);
          let lowest = Math.min(0, pitch(landed - 1), pitch(landed));
          for (let f = landed; f <= landed + AFTER && f < track.frames; f++) {
            expect(pitch(f), `scene ${seed}, ${foot} foot, frame ${f}, landed at ${landed}`).toBeGreaterThan(
              lowest - 4,
            );
            lowest = Math.min(0, pitch(f));
          }
        });
      }
    }
    expect(landings).toBeGreaterThan(200);
  });
});
