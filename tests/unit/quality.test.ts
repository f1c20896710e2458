import { beforeAll, describe, expect, it } from "vitest";
import { lowPass, thirdDerivative } from "../../src/core/math/low-pass.ts";
import { quatFromAxisAngle, quatMultiply } from "../../src/core/math/quaternion.ts";
import { wholeChunk } from "../../src/core/motion/chunk.ts";
import { beginSynthesis, synthesiseClip } from "../../src/core/motion/synthesise.ts";
import type { MotionChunk } from "../../src/core/motion/types.ts";
import { checkClaims } from "../../src/core/quality/claims.ts";
import { paceOf, steadyFrames } from "../../src/core/quality/kind.ts";
import { measureMotion, motionPoints } from "../../src/core/quality/measure.ts";
import { REAL_ACCELERATION, REAL_JERK } from "../../src/core/quality/real-reference.ts";
import { jerkRatio, largestAccelerations } from "../../src/core/quality/smoothness.ts";
import { defaultScene } from "../../src/core/scene/default-scene.ts";
import { J, JOINT_COUNT } from "../../src/core/skeleton/joints.ts";
import { createSkeleton } from "../../src/core/skeleton/skeleton.ts";
import { goalsOf, planScene } from "../../src/core/tasks/plan-scene.ts";
import type { Plan } from "../../src/core/tasks/plan-types.ts";
import { studio } from "../support/library.ts";

const Q = 4 * JOINT_COUNT;
const skeleton = createSkeleton();
const scene = defaultScene();
const goals = goalsOf(scene);
let plan: Plan;
let whole: MotionChunk;

beforeAll(() => {
  const { library } = studio();
  plan = planScene(scene, library, skeleton);
  const synthesis = beginSynthesis(library, skeleton, plan, goals, new Map());
  const clip = synthesiseClip(synthesis, "default");
  whole = wholeChunk(clip, synthesis.track.contacts);
});

const changed = (change: (chunk: MotionChunk) => void): MotionChunk => {
  const copy = {
    ...whole,
    root: whole.root.slice(),
    rotations: whole.rotations.slice(),
    contacts: whole.contacts.slice(),
  };
  change(copy);
  return copy;
};
const figures = (chunk: MotionChunk) => measureMotion(skeleton, [chunk], chunk.frames, plan, goals);

/** Turns a joint by an angle about an axis in one frame. */
function bend(
  chunk: MotionChunk,
  frame: number,
  joint: number,
  axis: [number, number, number],
  angle: number,
) {
  const turn = new Float64Array(4);
  quatFromAxisAngle(turn, 0, axis[0], axis[1], axis[2], angle);
  const at = Q * frame + 4 * joint;
  const old = Float64Array.from(chunk.rotations.subarray(at, at + 4));
  const out = new Float64Array(4);
  quatMultiply(out, 0, old, 0, turn, 0);
  chunk.rotations.set(out, at);
}

describe("filters", () => {
  it("a third derivative is true up to a third of the rate", () => {
    const n = 240;
    for (const hz of [1, 5, 10, 15]) {
      const w = 2 * Math.PI * hz;
      const x = Float64Array.from({ length: n }, (_, i) => Math.sin((w * i) / 60));
      const out = new Float64Array(n);
      thirdDerivative(out, x, 0, 1, n, 60);
      for (let i = 20; i < n - 20; i++)
        expect(Math.abs(out[i] / w ** 3 + Math.cos((w * i) / 60))).toBeLessThan(0.04);
    }
  });

  it("a low-pass halves at its cutoff, without phase, and keeps what is slow", () => {
    const n = 400;
    const of = (hz: number): number => {
      const x = Float64Array.from({ length: n }, (_, i) => Math.cos((2 * Math.PI * hz * (i - 200)) / 60));
      lowPass(x, 0, 1, n, 60, 6);
      return x[200];
    };
    expect(of(0.5)).toBeCloseTo(1, 3);
    expect(of(6)).toBeCloseTo(0.5, 2);
    expect(of(20)).toBeLessThan(0.01);
  });
});

describe("motion quality", () => {
  it("every figure of a plan with tasks is measured, and the first scene's are within their goals", () => {
    const q = figures(whole);
    for (const [name, value] of Object.entries(q)) expect(value, name).not.toBeNull();
    expect(q.limitViolations).toBe(0);
    expect(q.missedPlants).toBe(0);
    expect(q.popping).toBeLessThan(1.5);
    expect(q.skate).toBeLessThan(4);
  });

  it("a pop in one frame shows, and grows with the pop", () => {
    const before = figures(whole);
    const small = figures(changed((c) => bend(c, 300, J.leftLowerArm, [0, 1, 0], -0.1)));
    const large = figures(changed((c) => bend(c, 300, J.leftLowerArm, [0, 1, 0], -0.4)));
    expect(large.popping).toBeGreaterThan(before.popping ?? 9);
    expect(large.poppingOwn).toBeGreaterThan(small.poppingOwn ?? 9);
    // 0.4 rad in a sixtieth and back: 2 x 0.4 x 3600 at 60 Hz.
    const a = largestAccelerations(
      Float64Array.from(changed((c) => bend(c, 300, J.leftLowerArm, [0, 1, 0], -0.4)).rotations),
      whole.frames,
      60,
      1,
    );
    expect(a[J.leftLowerArm]).toBeGreaterThan(0.9 * 2 * 0.4 * 3600);
  });

  it("steady turning has no angular acceleration; a known swing has its own", () => {
    const n = 120;
    const rotations = new Float64Array(Q * n);
    for (let f = 0; f < n; f++) {
      for (let j = 0; j < JOINT_COUNT; j++) rotations[Q * f + 4 * j + 3] = 1;
      quatFromAxisAngle(rotations, Q * f, 0, 1, 0, 0.02 * f);
      quatFromAxisAngle(
        rotations,
        Q * f + 4 * J.leftUpperArm,
        0,
        0,
        1,
        0.5 * Math.sin((2 * Math.PI * f) / 60),
      );
    }
    const a = largestAccelerations(rotations, n, 60, 1);
    expect(a[J.hips]).toBeLessThan(1e-6);
    expect(a[J.leftUpperArm]).toBeCloseTo(0.5 * (2 * Math.PI) ** 2, 1);
  });

  it("plants that are not claimed are found; a foot claimed in the air too", () => {
    const silent = figures(changed((c) => c.contacts.fill(0)));
    expect(silent.missedPlants).toBeGreaterThan(20);
    const points = motionPoints(skeleton, [whole], whole.frames);
    const level: [Float64Array, Float64Array] = [
      new Float64Array(whole.frames),
      new Float64Array(whole.frames),
    ];
    const judge = (contacts: Uint8Array) =>
      checkClaims(points.soles, contacts, level, whole.frames, 60, skeleton.legLength - 0.09);
    const honest = judge(points.contacts);
    expect(honest.missed).toBe(0);
    expect(honest.tooHigh).toBe(0);
    // The point that a pivoting foot turns about lies between those that are followed.
    expect(honest.tooFast).toBeLessThan(0.01);
    const boastful = judge(points.contacts.slice().fill(15));
    expect(boastful.missed).toBe(0);
    expect(boastful.tooHigh).toBeGreaterThan(0.05);
    expect(boastful.tooFast).toBeGreaterThan(0.05);
  });

  it("a knee bent backwards, an elbow bent backwards and a head turned round are out of range", () => {
    for (const [joint, axis, angle] of [
      [J.leftLowerLeg, [1, 0, 0], -1.2],
      [J.rightLowerArm, [0, 1, 0], -1.4],
      [J.head, [0, 1, 0], 2.2],
    ] as const)
      expect(
        figures(changed((c) => bend(c, 10, joint, [axis[0], axis[1], axis[2]], angle))).limitViolations,
        `joint ${joint}`,
      ).toBe(1);
  });

  it("feet that are carried along slide, and sunken ones sink", () => {
    const drifting = figures(
      changed((c) => {
        for (let f = 0; f < c.frames; f++) c.root[3 * f] += 0.02 * Math.sin(f / 20);
      }),
    );
    expect(drifting.skate).toBeGreaterThan(10);
    const sunk = figures(
      changed((c) => {
        for (let f = 0; f < c.frames; f++) c.root[3 * f + 1] -= 0.01;
      }),
    );
    expect(sunk.penetration).toBeGreaterThan(9.9);
    expect(sunk.penetration).toBeLessThan(12);
  });

  it("balance: a body moved off its feet is out of balance, whatever the height of the ground", () => {
    const before = figures(whole);
    const points = motionPoints(skeleton, [whole], whole.frames);
    expect(points.outOfRange).toBe(0);
    const aside = figures(
      changed((c) => {
        for (let f = 0; f < c.frames; f++) bend(c, f, J.hips, [0, 0, 1], 0.35);
      }),
    );
    expect(aside.balance).toBeLessThan((before.balance ?? 0) - 0.3);
    // The same motion on a plateau of half a metre.
    const raised = changed((c) => {
      for (let f = 0; f < c.frames; f++) c.root[3 * f + 1] += 0.5;
    });
    const [left, right] = plan.start;
    const plateau = {
      ...plan,
      start: [
        { ...left, y: 0.5 },
        { ...right, y: 0.5 },
      ] as Plan["start"],
      steps: plan.steps.map((s) => ({ ...s, y: 0.5 })),
    };
    const on = measureMotion(skeleton, [raised], raised.frames, plateau, goals);
    expect(on.balance).toBeCloseTo(before.balance ?? 0, 2);
    expect(on.penetration).toBeLessThan(0.1);
    expect(on.missedPlants).toBe(0);
  });

  it("kinds: standing, walking, running, side steps, turning", () => {
    const n = 240;
    const kind = (vx: number, vz: number, turn: number) => {
      const root = Float64Array.from({ length: 3 * n }, (_, i) =>
        i % 3 === 0 ? (vx * i) / 180 : i % 3 === 2 ? (vz * i) / 180 : 0.9,
      );
      const yaw = Float64Array.from({ length: n }, (_, f) => (turn * f) / 60);
      return paceOf(root, yaw, n, 60).kind;
    };
    expect(kind(0, 0, 0)).toBe("stand");
    expect(kind(0, 1.2, 0)).toBe("walk");
    expect(kind(0, 3, 0)).toBe("run");
    expect(kind(0.6, 0.1, 0)).toBe("sidestep");
    expect(kind(0, 0.1, 1)).toBe("turn");
  });

  it("standing before and after says nothing of the kind: who steps aside for two of ten seconds steps aside", () => {
    const n = 600;
    const root = new Float64Array(3 * n);
    for (let f = 0; f < n; f++) root[3 * f] = 0.4 * Math.max(0, Math.min(2, f / 60 - 4));
    const { kind, first, last, speed } = paceOf(root, new Float64Array(n), n, 60);
    expect(kind).toBe("sidestep");
    expect(first).toBeGreaterThan(200);
    expect(last).toBeLessThan(400);
    expect(speed).toBeGreaterThan(0.25);
    expect(paceOf(new Float64Array(3 * n), new Float64Array(n), n, 60)).toMatchObject({
      kind: "stand",
      first: 0,
      last: n - 1,
    });
  });

  it("who climbs goes as fast as along the stair; rise and fall of steps is no climb", () => {
    const n = 600;
    const root = new Float64Array(3 * n);
    for (let f = 0; f < n; f++) {
      root[3 * f + 1] = 0.9 + (0.3 * f) / 60 + 0.02 * Math.sin((2 * Math.PI * 2 * f) / 60);
      root[3 * f + 2] = (0.4 * f) / 60;
    }
    const { speeds, alongWay } = paceOf(root, new Float64Array(n), n, 60);
    expect(speeds[300]).toBeCloseTo(0.4, 3);
    expect(alongWay[300]).toBeCloseTo(0.5, 2);
  });

  it("jerk of a walk like the reference's is 1; steady frames leave out starts and stops", () => {
    const n = 600;
    const joints = new Float64Array(3 * JOINT_COUNT * n);
    // Each effector swings so that its root-mean-square jerk over the leg is the real median.
    const names = ["leftHand", "rightHand", "leftFoot", "rightFoot", "head", "hips"] as const;
    names.forEach((name, e) => {
      const w = 2 * Math.PI * 2;
      const amplitude = (REAL_JERK.walk.median[e] * Math.SQRT2 * 0.84) / w ** 3;
      for (let f = 0; f < n; f++)
        joints[3 * (JOINT_COUNT * f + J[name]) + 1] = amplitude * Math.sin((w * f) / 60);
    });
    const speed = Math.exp(0.0651 / 1.3089);
    expect(jerkRatio(joints, n, 60, 0.84, "walk", speed)).toBeCloseTo(1, 1);
    const speeds = Float64Array.from({ length: n }, (_, f) => (f > 100 && f < 500 ? 1 : 0));
    const pace = { kind: "walk" as const, first: 0, last: n - 1, speed: 1, speeds, alongWay: speeds };
    const going = steadyFrames(pace, 60);
    expect(going[110]).toBe(0);
    expect(going[300]).toBe(1);
    expect(going[490]).toBe(0);
    // Less than a stride of it is not steady.
    const brief = speeds.map((v, f) => (f < 200 ? v : 0));
    expect(steadyFrames({ ...pace, speeds: brief }, 60).some((on) => on === 1)).toBe(false);
    expect(REAL_ACCELERATION.walk.joints).toHaveLength(JOINT_COUNT);
  });
});
