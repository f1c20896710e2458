import { describe, expect, it } from "vitest";
import { wholeChunk } from "../../src/core/motion/chunk.ts";
import {
  beginSynthesis,
  handResults,
  synthesiseChunk,
  synthesiseClip,
} from "../../src/core/motion/synthesise.ts";
import type { BoxTrack } from "../../src/core/motion/types.ts";
import { measureMotion } from "../../src/core/quality/measure.ts";
import * as commands from "../../src/core/scene/commands.ts";
import { defaultScene } from "../../src/core/scene/default-scene.ts";
import { parseScene } from "../../src/core/scene/schema.ts";
import type { Scene } from "../../src/core/scene/types.ts";
import { forwardKinematics } from "../../src/core/skeleton/forward-kinematics.ts";
import { J, JOINT_COUNT } from "../../src/core/skeleton/joints.ts";
import { createSkeleton } from "../../src/core/skeleton/skeleton.ts";
import { goalsOf, planScene } from "../../src/core/tasks/plan-scene.ts";
import { findRoute, obstacleDistance } from "../../src/core/tasks/route.ts";
import { retargetLibrary } from "../../src/core/templates/retarget-library.ts";
import { studio } from "../support/library.ts";
import { randomScene } from "../support/random-scene.ts";

const { library } = studio();
const skeleton = createSkeleton(1.75);
const fitted = retargetLibrary(library, skeleton);

function run(scene: Scene) {
  const plan = planScene(scene, fitted, skeleton);
  const goals = goalsOf(scene);
  const synthesis = beginSynthesis(fitted, skeleton, plan, goals, new Map());
  const clip = synthesiseClip(synthesis, "x");
  const chunk = wholeChunk(clip, synthesis.track.contacts);
  return {
    plan,
    clip,
    quality: measureMotion(skeleton, [chunk], clip.frames, plan, goals),
    hands: handResults(synthesis),
  };
}

describe("planner", () => {
  it("does the first scene: every task in order, feet where they were planned, hands and seat at their places", () => {
    const { plan, quality, hands } = run(defaultScene());
    expect(plan.tasks.map((t) => t.id)).toEqual(["write", "lift", "place", "sit"]);
    for (let i = 1; i < plan.tasks.length; i++)
      expect(plan.tasks[i].start).toBeGreaterThan(plan.tasks[i - 1].contact);
    for (const s of plan.steps) expect(s.land).toBeGreaterThan(s.lift);
    expect(quality.skate).toBeLessThan(4);
    expect(quality.penetration).toBeLessThan(3);
    expect(quality.footstepError?.position).toBeLessThan(1);
    expect(quality.reach).toBeLessThan(15);
    expect(quality.limitViolations).toBe(0);
    expect(hands.boxes).toHaveLength(1);
    expect(hands.ink.length).toBeGreaterThan(0);
  });

  it("gives the same plan twice", () => {
    expect(planScene(defaultScene(), fitted, skeleton)).toEqual(planScene(defaultScene(), fitted, skeleton));
  });

  it("plans 60 random scenes without NaN, skating or sinking feet", { timeout: 120_000 }, () => {
    const used = new Set<string>();
    for (let seed = 1; seed <= 60; seed++) {
      const scene = randomScene(seed);
      const { plan, clip, quality } = run(scene);
      expect(plan.tasks, `seed ${seed}`).toHaveLength(scene.tasks.length);
      expect(clip.root.every(Number.isFinite) && clip.rotations.every(Number.isFinite), `seed ${seed}`).toBe(
        true,
      );
      expect(quality.skate ?? 0, `seed ${seed}`).toBeLessThan(4);
      expect(quality.penetration ?? 0, `seed ${seed}`).toBeLessThan(3);
      expect(quality.footstepError?.position ?? 0, `seed ${seed}`).toBeLessThan(1);
      for (const s of plan.steps) used.add(s.category);
    }
    expect(used.size).toBe(7);
  });

  it("keeps the steps begun when a task is dragged in mid-stride: earlier frames stay as they were", () => {
    const scene = defaultScene();
    const goals = goalsOf(scene);
    const plan = planScene(scene, fitted, skeleton);
    const before = beginSynthesis(fitted, skeleton, plan, goals, new Map());
    const now = plan.tasks[0].end + 1.6;
    const moved = commands.placeTask(scene, "lift", [-1.2, 0.88, -1.4], -2);
    const again = planScene(moved, fitted, skeleton, { playing: { plan, goals, now } });
    const begun = plan.steps.filter((s) => s.lift <= now);
    expect(again.steps.slice(0, begun.length)).toEqual(begun);
    expect(again.tasks[0]).toEqual(plan.tasks[0]);
    const after = beginSynthesis(fitted, skeleton, again, goalsOf(moved), new Map(), {
      shift: before.track.shift,
      drop: before.track.drop,
      heels: before.track.heels,
      until: Math.floor(now * 60),
    });
    const frame = Math.floor(now * 60) - 10;
    const a = synthesiseChunk(before, 0, frame);
    const b = synthesiseChunk(after, 0, frame);
    let worst = 0;
    for (let i = 0; i < a.root.length; i++) worst = Math.max(worst, Math.abs(a.root[i] - b.root[i]));
    expect(worst).toBeLessThan(0.002);
    // The feet on the ground at that moment do not move.
    const f = Math.floor(now * 60);
    for (let k = 0; k < 2; k++)
      if ((before.track.contacts[f] >> (2 * k)) & 3)
        for (let c = 0; c < 3; c++)
          expect(after.track.feet[(2 * f + k) * 8 + c]).toBeCloseTo(
            before.track.feet[(2 * f + k) * 8 + c],
            6,
          );
  });

  it("a task farther away than steps are planned has a warning, a near one has none", () => {
    const far = (z: number): readonly string[] =>
      planScene(
        parseScene({ version: 1, tasks: [{ id: "t", category: "turn", position: [0, 0, z], yaw: 1 }] }),
        fitted,
        skeleton,
      ).warnings;
    expect(far(40)).toEqual([]);
    expect(far(900)).toEqual(["tasks[0]: 320 steps do not lead there; it is done where they end."]);
  });

  it("the box task uses no pivots where the writing task does [TaskLoco Figure 17]", () => {
    const scene = (category: string) =>
      parseScene({
        version: 1,
        start: { position: [2.6, 0.5], yaw: 0 },
        tasks: [{ id: "a", category, position: [0, category === "write" ? 1.35 : 0.87, 1.2], yaw: 0 }],
      });
    const pivots = (category: string) =>
      planScene(scene(category), fitted, skeleton).steps.filter(
        (s) => s.phase === "enter" && s.category.endsWith("Pivot"),
      ).length;
    expect(pivots("write")).toBeGreaterThan(0);
    expect(pivots("lift")).toBe(0);
  });

  it("heights from 1.50 m to 2.00 m change a step category in a fifth of transitions [TaskLoco Figure 16]", () => {
    const small = createSkeleton(1.5);
    const tall = createSkeleton(2);
    const a = retargetLibrary(library, small);
    const b = retargetLibrary(library, tall);
    let changed = 0;
    let all = 0;
    for (let seed = 1; seed <= 20; seed++) {
      const scene = randomScene(seed);
      const p = planScene(scene, a, small);
      const q = planScene(scene, b, tall);
      scene.tasks.forEach((_, i) => {
        all++;
        const kinds = (plan: typeof p) =>
          [...new Set(plan.steps.filter((s) => s.task === i).map((s) => s.category))].sort().join();
        if (kinds(p) !== kinds(q)) changed++;
      });
    }
    expect(changed / all).toBeGreaterThan(0.2);
  });

  it("a box that is let go for another falls to the floor and lies there; the body comes back from it without a jerk", () => {
    const scene = parseScene({
      version: 1,
      tasks: [
        { id: "first", category: "lift", position: [0, 0.9, 2], yaw: 0 },
        { id: "second", category: "lift", position: [3, 0.9, 2], yaw: 0 },
      ],
    });
    const { clip, hands } = run(scene);
    const [first, second] = hands.boxes;
    const height = (b: BoxTrack, k: number) => b.transforms[7 * k + 1];
    const last = first.frames - 1;
    expect(first.first + first.frames).toBeLessThan(second.first);
    expect(height(first, last)).toBeCloseTo(0.13, 2);
    // It falls as things fall: by gravity from where it was let go, until it lies.
    const pull = (k: number) => 3600 * (height(first, k - 1) - 2 * height(first, k) + height(first, k + 1));
    let letGo = last - 1;
    while (Math.abs(pull(letGo - 1) + 9.81) < 0.2) letGo--;
    expect(height(first, letGo)).toBeGreaterThan(0.7);
    const seconds = Math.sqrt((2 * (height(first, letGo) - height(first, last))) / 9.81);
    expect(Math.abs((last - letGo) / 60 - seconds)).toBeLessThan(2 / 60);
    // The head is carried: no frame in which it is thrown.
    const positions = new Float64Array(3 * JOINT_COUNT);
    const world = new Float64Array(4 * JOINT_COUNT);
    const head = Array.from({ length: 90 }, (_, k) => {
      const f = first.first + letGo - 15 + k;
      forwardKinematics(positions, world, skeleton, clip.root, 3 * f, clip.rotations, 4 * JOINT_COUNT * f);
      return [...positions.subarray(3 * J.head, 3 * J.head + 3)];
    });
    for (let k = 1; k + 1 < head.length; k++) {
      const a = [0, 1, 2].map((c) => (head[k + 1][c] - 2 * head[k][c] + head[k - 1][c]) * 3600);
      expect(Math.hypot(...a), `frame ${k}`).toBeLessThan(20);
    }
  });

  it("who writes with a box under way holds it in the other arm: it neither swings nor leaves the belly", () => {
    const { clip, plan, hands, quality } = run(randomScene(78));
    const write = plan.tasks[2];
    const [box] = hands.boxes;
    const positions = new Float64Array(3 * JOINT_COUNT);
    const world = new Float64Array(4 * JOINT_COUNT);
    for (let f = Math.round(60 * write.start); f < 60 * write.end; f++) {
      const k = 7 * (f - box.first);
      const [x, y, z] = box.transforms.subarray(k, k + 3);
      const [bx, by, bz] = box.transforms.subarray(k - 7, k - 4);
      expect(60 * Math.hypot(x - bx, y - by, z - bz), `speed at ${f}`).toBeLessThan(1);
      forwardKinematics(positions, world, skeleton, clip.root, 3 * f, clip.rotations, 4 * JOINT_COUNT * f);
      expect(Math.hypot(x - positions[0], z - positions[2]), `from the hips at ${f}`).toBeLessThan(0.5);
    }
    expect(quality.poppingOwn).toBeLessThan(1.75);
  });

  it("a point out of reach is planned for and named", () => {
    const scene = parseScene({
      version: 1,
      tasks: [{ id: "a", category: "write", position: [0, 3.4, 2], yaw: 0 }],
    });
    const { plan, clip } = run(scene);
    expect(plan.warnings[0]).toContain("tasks[0].position: too high to reach: 3.40 m");
    expect(clip.rotations.every(Number.isFinite)).toBe(true);
  });
});

describe("routes", () => {
  it("go round a table and keep their distance", () => {
    const table = { kind: "box", id: "t", x: 0, z: 0, yaw: 0.3, halfWidth: 0.6, halfDepth: 0.3 } as const;
    const { points, blocked } = findRoute({ x: 0, z: -2 }, { x: 0.1, z: 2 }, [table], 0.4);
    expect(blocked).toBe(false);
    expect(points.length).toBeGreaterThan(1);
    let from = { x: 0, z: -2 };
    for (const p of points) {
      for (let u = 0; u <= 1; u += 0.02)
        expect(
          obstacleDistance(table, from.x + u * (p.x - from.x), from.z + u * (p.z - from.z)),
        ).toBeGreaterThan(0.39);
      from = p;
    }
  });
});
