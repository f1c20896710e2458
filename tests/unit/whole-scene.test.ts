import { describe, expect, it } from "vitest";
import { bakeLibrary } from "../../src/core/blending/library.ts";
import { wholeChunk } from "../../src/core/motion/chunk.ts";
import { planWhole, runsOf } from "../../src/core/motion/whole-scene.ts";
import { measureMotion } from "../../src/core/quality/measure.ts";
import { parseScene } from "../../src/core/scene/schema.ts";
import { createSkeleton } from "../../src/core/skeleton/skeleton.ts";
import { joinStories } from "../../src/core/styles/story.ts";
import { goalsOf } from "../../src/core/tasks/plan-scene.ts";
import { retargetLibrary } from "../../src/core/templates/retarget-library.ts";
import { cyclicSources } from "../../src/studio/blend-library.ts";
import { styleFamilies } from "../../src/studio/style-families.ts";
import { studio } from "../support/library.ts";

const skeleton = createSkeleton(1.75);
const library = retargetLibrary(studio().library, skeleton);
const sources = {
  library: () => library,
  families: (styles: string[]) => styleFamilies(styles, skeleton),
  blends: () => bakeLibrary(cyclicSources(), skeleton),
  cache: new Map(),
};

const scene = (order: string[]) =>
  parseScene({
    version: 1,
    start: { position: [0, -1.5], yaw: 0 },
    tasks: [
      { id: "write", category: "write", position: [0, 1.35, 0], yaw: 0 },
      { id: "sit", category: "sit", position: [-2, 0.46, -2], yaw: 1 },
    ],
    paths: [
      {
        id: "path",
        points: [
          [1.5, -2],
          [2.5, -1],
          [3.5, -1.5],
        ],
      },
    ],
    stones: [
      { id: "a", position: [1.75, 0, -1.6], yaw: 0 },
      { id: "b", position: [2.0, 0, -1.1], yaw: 0 },
    ].slice(0, order.includes("a") ? 2 : 0),
    order,
  });

describe("a scene of tasks and paths", () => {
  it("is cut where the kind changes", () => {
    expect(runsOf(scene(["write", "path", "sit"]))).toEqual([
      { kind: "tasks", ids: ["write"] },
      { kind: "paths", ids: ["path"] },
      { kind: "tasks", ids: ["sit"] },
    ]);
  });

  it("tells where along its paths it is, in time with the whole", () => {
    const { clip, walks } = planWhole(scene(["write", "path", "sit"]), skeleton, sources);
    const story = joinStories(walks, clip.frames);
    if (!story) throw new Error("a story is there");
    const [{ first, walk }] = walks;
    expect(story.frames).toBe(clip.frames);
    expect(first).toBeGreaterThan(60);
    expect(first + walk.motion.clip.frames).toBeLessThan(clip.frames);
    expect(story.spans).toEqual([{ id: "path", from: 0, to: story.length }]);
    for (let f = 0; f < clip.frames; f++) {
      if (f < first) expect(story.at[f]).toBeLessThan(0);
      if (f > 0) expect(story.at[f]).toBeGreaterThanOrEqual(story.at[f - 1] - 1e-6);
    }
    expect(story.at[clip.frames - 1]).toBeCloseTo(story.length, 3);
    expect(story.speed[first + Math.round(walk.motion.clip.frames / 2)]).toBeGreaterThan(0.5);
    expect(joinStories([], 100)).toBeNull();
  });

  it("is done in its order, and nothing jumps where one ends and the next begins", () => {
    const whole = scene(["write", "path", "sit"]);
    const { plan, clip, contacts } = planWhole(whole, skeleton, sources);
    expect(plan.tasks.map((t) => t.id)).toEqual(["write", "sit"]);
    expect(clip.frames).toBe(Math.round(plan.duration * 60));
    expect(contacts).toHaveLength(clip.frames);
    // The path lies between: someone stood at its middle between the tasks.
    const between = Array.from({ length: clip.frames }, (_, f) => f).filter(
      (f) => f > plan.tasks[0].end * 60 && f < plan.tasks[1].start * 60,
    );
    const nearest = Math.min(
      ...between.map((f) => Math.hypot(clip.root[3 * f] - 2.5, clip.root[3 * f + 2] + 1)),
    );
    expect(nearest).toBeLessThan(0.35);
    const lands = plan.steps.map((s) => s.land);
    expect([...lands].sort((a, b) => a - b)).toEqual(lands);
    const chunk = wholeChunk(clip, contacts);
    const quality = measureMotion(skeleton, [chunk], clip.frames, plan, goalsOf(whole));
    expect(quality.skate).toBeLessThan(4);
    expect(quality.reach).toBeLessThan(5);
    expect(quality.popping).toBeLessThan(1.5);
    expect(quality.footstepError?.position).toBeLessThan(1);
  });

  it("with stones too: they are stepped on from where the character stands, and left from there", () => {
    const whole = scene(["write", "a", "b", "path", "sit"]);
    const { plan, clip } = planWhole(whole, skeleton, sources);
    expect(plan.tasks.map((t) => t.id)).toEqual(["write", "sit"]);
    expect(plan.blend?.choices).toHaveLength(2);
    // The hips never move farther in a frame than a run does.
    for (let f = 1; f < clip.frames; f++)
      expect(
        Math.hypot(
          clip.root[3 * f] - clip.root[3 * f - 3],
          clip.root[3 * f + 1] - clip.root[3 * f - 2],
          clip.root[3 * f + 2] - clip.root[3 * f - 1],
        ),
      ).toBeLessThan(0.08);
  });

  it("who sits rises before a path", () => {
    const { plan } = planWhole(scene(["write", "sit", "path"]), skeleton, sources);
    expect(plan.tasks.map((t) => t.id)).toEqual(["write", "sit", "sit/rise"]);
    expect(plan.steps[plan.steps.length - 1].land).toBeGreaterThan(plan.tasks[1].end);
  });
});
