import { describe, expect, it } from "vitest";
import { wholeChunk } from "../../src/core/motion/chunk.ts";
import { beginSynthesis, synthesiseClip } from "../../src/core/motion/synthesise.ts";
import { measureMotion } from "../../src/core/quality/measure.ts";
import { createSkeleton } from "../../src/core/skeleton/skeleton.ts";
import { goalsOf, planScene } from "../../src/core/tasks/plan-scene.ts";
import { retargetLibrary } from "../../src/core/templates/retarget-library.ts";
import { studio } from "../support/library.ts";
import { randomScene } from "../support/random-scene.ts";

/** Goals of the motion-quality figures, and the share of scenes that must meet each. */
const GOALS: [string, (q: ReturnType<typeof measureMotion>) => boolean][] = [
  ["skate <= 4 mm", (q) => (q.skate ?? 0) <= 4],
  ["flat <= 2 mm", (q) => (q.skateFlat ?? 0) <= 2],
  ["penetration <= 3 mm", (q) => (q.penetration ?? 0) <= 3],
  ["float <= 5 mm", (q) => (q.float ?? 0) <= 5],
  ["reach <= 5 mm", (q) => (q.reach ?? 0) <= 5],
  ["footsteps <= 1 mm", (q) => (q.footstepError?.position ?? 0) <= 1],
  ["joints within limits", (q) => q.limitViolations === 0],
  ["popping <= 1.5", (q) => (q.popping ?? 0) <= 1.5],
  ["popping per joint <= 1.75", (q) => (q.poppingOwn ?? 0) <= 1.75],
  ["no missed plants", (q) => q.missedPlants === 0],
  ["jerk 0.7 to 1.4", (q) => q.jerk !== null && q.jerk >= 0.7 && q.jerk <= 1.4],
  ["balance within 5 cm >= 0.69", (q) => (q.balanceWithin50mm ?? 1) >= 0.69],
];
const SHARE = 0.95;

describe("two hundred random scenes", () => {
  it("all give a plan and a motion without NaN; each quality goal is met on 95 %", () => {
    const skeleton = createSkeleton(1.75);
    const library = retargetLibrary(studio().library, skeleton);
    const met = GOALS.map(() => 0);
    for (let seed = 1; seed <= 200; seed++) {
      const scene = randomScene(seed);
      const plan = planScene(scene, library, skeleton);
      const goals = goalsOf(scene);
      const synthesis = beginSynthesis(library, skeleton, plan, goals, new Map());
      const clip = synthesiseClip(synthesis, "long");
      expect(clip.root.every(Number.isFinite) && clip.rotations.every(Number.isFinite), `seed ${seed}`).toBe(
        true,
      );
      expect(plan.tasks.length, `seed ${seed}`).toBe(scene.tasks.length);
      const chunk = wholeChunk(clip, synthesis.track.contacts);
      const quality = measureMotion(skeleton, [chunk], clip.frames, plan, goals);
      GOALS.forEach(([, ok], i) => {
        if (ok(quality)) met[i]++;
      });
    }
    GOALS.forEach(([name], i) => {
      console.log(`${name}: ${(met[i] / 2).toFixed(1)} %`);
    });
    GOALS.forEach(([name], i) => {
      expect(met[i] / 200, name).toBeGreaterThanOrEqual(SHARE);
    });
  });
});
