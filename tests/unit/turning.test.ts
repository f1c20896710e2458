import { readFileSync } from "node:fs";
import { basename } from "node:path";
import { describe, expect, it } from "vitest";
import { importBvh } from "../../src/core/capture/import.ts";
import { wrapAngle } from "../../src/core/math/angle.ts";
import { wholeChunk } from "../../src/core/motion/chunk.ts";
import { beginSynthesis, synthesiseClip } from "../../src/core/motion/synthesise.ts";
import { measureMotion } from "../../src/core/quality/measure.ts";
import { parseScene } from "../../src/core/scene/schema.ts";
import { createSkeleton } from "../../src/core/skeleton/skeleton.ts";
import { goalsOf, planScene } from "../../src/core/tasks/plan-scene.ts";
import { buildLibrary } from "../../src/core/templates/build-library.ts";
import { retargetLibrary } from "../../src/core/templates/retarget-library.ts";
import type { Library } from "../../src/core/templates/types.ts";
import { studio } from "../support/library.ts";
import { randomScene } from "../support/random-scene.ts";
import { captures, hasShared } from "../support/shared.ts";
import { turnTask } from "../support/turning.ts";

describe.skipIf(!hasShared)("captures of people who turn", () => {
  it("imported as turn templates, drive a character through turn tasks", () => {
    const files = captures().filter((f) => basename(f).includes("walk-turn-"));
    expect(files.length).toBeGreaterThan(10);
    const real = files.map((f) => {
      const { clip } = importBvh(readFileSync(f, "utf8"), basename(f));
      return { name: basename(f, ".bvh"), clip, tasks: [turnTask(clip)] };
    });
    const skeleton = createSkeleton(1.75);
    const library = retargetLibrary(buildLibrary(real), skeleton);
    expect(library.templates.some((t) => t.phase === "enter")).toBe(true);
    for (const yaw of [Math.PI / 2, Math.PI, -Math.PI / 2]) {
      const scene = parseScene({
        version: 1,
        tasks: [{ id: "turn", category: "turn", position: [0, 0, 3], yaw }],
      });
      const goals = goalsOf(scene);
      const plan = planScene(scene, library, skeleton);
      expect(plan.steps.length).toBeGreaterThan(3);
      const last = plan.steps[plan.steps.length - 1];
      expect(Math.abs(wrapAngle(last.yaw - yaw))).toBeLessThan(0.6);
      expect(Math.hypot(last.x, last.z - 3)).toBeLessThan(0.6);
      const synthesis = beginSynthesis(library, skeleton, plan, goals, new Map());
      const clip = synthesiseClip(synthesis, "turn");
      const quality = measureMotion(
        skeleton,
        [wholeChunk(clip, synthesis.track.contacts)],
        clip.frames,
        plan,
        goals,
      );
      expect(quality.skate ?? 0).toBeLessThan(4);
      expect(quality.footstepError?.position ?? 0).toBeLessThan(1);
      expect(clip.rotations.every(Number.isFinite)).toBe(true);
    }
  });
});

describe("templates", () => {
  it("half of them leave the optimiser more to do [TaskLoco §7]", () => {
    const skeleton = createSkeleton(1.75);
    const library = retargetLibrary(studio().library, skeleton);
    // Every second transition of a capture, both its templates.
    const half: Library = {
      ...library,
      templates: library.templates.filter((t) => t.task % 2 === 0),
    };
    const residual = (l: Library): number => {
      let sum = 0;
      for (let seed = 1; seed <= 60; seed++)
        for (const t of planScene(randomScene(seed), l, skeleton, { playing: null, trace: true }).traces)
          sum += t.terms[t.terms.length - 1]?.[0] ?? 0;
      return sum;
    };
    const all = residual(library);
    const fewer = residual(half);
    console.log(
      `residual with all ${library.templates.length} templates ${all.toFixed(2)}, with ${half.templates.length} ${fewer.toFixed(2)}`,
    );
    expect(fewer).toBeGreaterThan(all);
  });
});
