/** Planner and crowds on scenes that nobody would draw: no crash, no hang, no number that is none. */
import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { crowdOfScene } from "../../src/core/crowd/from-scene.ts";
import { simulateCrowd } from "../../src/core/crowd/simulate.ts";
import { trajectoryOf } from "../../src/core/crowd/trajectory.ts";
import { beginSynthesis, synthesiseClip } from "../../src/core/motion/synthesise.ts";
import { parseScene } from "../../src/core/scene/schema.ts";
import { TASK_CATEGORIES } from "../../src/core/scene/task-types.ts";
import { PROP_KINDS, type Scene } from "../../src/core/scene/types.ts";
import { createSkeleton } from "../../src/core/skeleton/skeleton.ts";
import { goalsOf, planScene } from "../../src/core/tasks/plan-scene.ts";
import { retargetLibrary } from "../../src/core/templates/retarget-library.ts";
import { budget, expectFinite, limit } from "../support/fuzz.ts";
import { studio } from "../support/library.ts";
import { randomScene } from "../support/random-scene.ts";

const skeleton = createSkeleton(1.75);
const base = studio().library;
const library = retargetLibrary(base, skeleton);

const metre = (most: number) =>
  fc.oneof(
    { weight: 4, arbitrary: fc.double({ min: -most, max: most, noNaN: true }) },
    { weight: 1, arbitrary: fc.constantFrom(0, 1e-12, -1e-12, most, -most) },
  );
const yaw = fc.oneof(
  fc.double({ min: -1000, max: 1000, noNaN: true }),
  fc.constantFrom(0, Math.PI, -Math.PI, Math.PI / 2),
);

/** Tasks on top of each other, furniture over everything, tasks in walls and under the floor. */
const hostileScene: fc.Arbitrary<Scene> = fc
  .record({
    start: fc.record({ position: fc.tuple(metre(3), metre(3)), yaw }),
    tasks: fc.array(
      fc.record({
        category: fc.constantFrom(...TASK_CATEGORIES),
        effort: fc.constantFrom(0, 1),
        position: fc.tuple(metre(6), fc.double({ min: -1, max: 3, noNaN: true }), metre(6)),
        yaw,
        duration: fc.constantFrom(null, 0, 0.01, 5),
        hand: fc.constantFrom("left", "right"),
      }),
      { maxLength: 6 },
    ),
    props: fc.array(
      fc.record({
        kind: fc.constantFrom(...PROP_KINDS),
        position: fc.tuple(metre(6), fc.constant(0), metre(6)),
        yaw,
        size: fc.option(
          fc.tuple(
            fc.double({ min: 0.001, max: 20, noNaN: true }),
            fc.double({ min: 0.001, max: 5, noNaN: true }),
            fc.double({ min: 0.001, max: 20, noNaN: true }),
          ),
        ),
      }),
      { maxLength: 8 },
    ),
  })
  .map((s) =>
    parseScene({
      version: 1,
      ...s,
      tasks: s.tasks.map((t, i) => ({ id: `t${i}`, ...t })),
      props: s.props.map((p, i) => ({ id: `p${i}`, ...p })),
    }),
  );

/** Plan, motion and the time it took. */
function check(scene: Scene): void {
  const begun = performance.now();
  const plan = planScene(scene, library, skeleton, { trace: true });
  expectFinite({ steps: plan.steps, tasks: plan.tasks, duration: plan.duration, traces: plan.traces });
  for (let i = 0; i < plan.steps.length; i++)
    expect(plan.steps[i].land).toBeGreaterThanOrEqual(plan.steps[i].lift);
  const synthesis = beginSynthesis(library, skeleton, plan, goalsOf(scene), new Map());
  const clip = synthesiseClip(synthesis, "fuzz");
  expectFinite({ root: clip.root, rotations: clip.rotations });
  // Fractions of a second as a rule: this is about hanging.
  expect(performance.now() - begun).toBeLessThan(20_000);
}

describe("planner", () => {
  it(
    "random scenes (seed 7)",
    () => {
      fc.assert(
        fc.property(fc.nat(1_000_000), (seed) => check(randomScene(seed))),
        budget(12),
      );
    },
    limit(20_000),
  );

  it(
    "hostile scenes (seed 7)",
    () => {
      fc.assert(fc.property(hostileScene, check), budget(25));
    },
    limit(30_000),
  );

  it("tasks at the ends of the world", () => {
    check(
      parseScene({
        version: 1,
        start: { position: [-100, -100] },
        tasks: [{ id: "a", category: "write", position: [100, 1.3, 100], yaw: 1 }],
      }),
    );
  });
});

/** Walkers in walls, on each other, with goals in walls and none at all. */
const hostileCrowd: fc.Arbitrary<Scene> = fc
  .record({
    seed: fc.nat(1000),
    agents: fc.array(
      fc.record({
        position: fc.tuple(metre(8), metre(8)),
        yaw,
        goals: fc.array(fc.tuple(metre(8), metre(8)), { maxLength: 3 }),
        speed: fc.double({ min: 0.05, max: 5, noNaN: true }),
      }),
      { maxLength: 10 },
    ),
    region: fc.record({
      bounds: fc.tuple(metre(8), metre(8), metre(8), metre(8)),
      count: fc.nat(8),
      goals: fc.array(fc.tuple(metre(8), metre(8)), { maxLength: 2 }),
    }),
    props: fc.array(
      fc.record({
        kind: fc.constantFrom(...PROP_KINDS),
        position: fc.tuple(metre(8), fc.constant(0), metre(8)),
        yaw,
      }),
      { maxLength: 8 },
    ),
  })
  .map((s) =>
    parseScene({
      version: 1,
      seed: s.seed,
      crowd: { agents: s.agents, regions: [s.region] },
      props: s.props.map((p, i) => ({ id: `p${i}`, ...p })),
    }),
  );

describe("crowds", () => {
  it(
    "random layouts (seed 7)",
    () => {
      fc.assert(
        fc.property(hostileCrowd, (scene) => {
          const begun = performance.now();
          const track = simulateCrowd(crowdOfScene(scene, "fuzz"), 6);
          expectFinite(track);
          expectFinite(JSON.parse(JSON.stringify(trajectoryOf(track, null))));
          expect(performance.now() - begun).toBeLessThan(30_000);
        }),
        budget(15),
      );
    },
    limit(40_000),
  );
});
