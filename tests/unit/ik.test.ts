import { describe, expect, it } from "vitest";
import { createFabrik, EFFECTORS, solveFabrik } from "../../src/core/ik/fabrik.ts";
import { createRandom } from "../../src/core/math/random.ts";
import { forwardKinematics } from "../../src/core/skeleton/forward-kinematics.ts";
import { J, JOINT_COUNT } from "../../src/core/skeleton/joints.ts";
import { ELBOW_RANGE, holdToLimits, KNEE_RANGE } from "../../src/core/skeleton/limits.ts";
import { createSkeleton } from "../../src/core/skeleton/skeleton.ts";
import { randomPose } from "../support/random-pose.ts";

const skeleton = createSkeleton(1.75);
const positions = new Float64Array(3 * JOINT_COUNT);
const world = new Float64Array(4 * JOINT_COUNT);

const restPose = (): Float64Array => {
  const pose = new Float64Array(4 * JOINT_COUNT);
  for (let j = 0; j < JOINT_COUNT; j++) pose[4 * j + 3] = 1;
  return pose;
};

const targetsOf = (root: Float64Array, pose: Float64Array): Float64Array => {
  forwardKinematics(positions, world, skeleton, root, 0, pose, 0);
  const out = new Float64Array(3 * EFFECTORS.length);
  EFFECTORS.forEach((joint, e) => {
    out.set(positions.subarray(3 * joint, 3 * joint + 3), 3 * e);
  });
  return out;
};

/** Angle of a hinge joint's rotation, radians. */
const flexion = (pose: Float64Array, joint: number): number => {
  const [x, y, z, w] = pose.subarray(4 * joint, 4 * joint + 4);
  return 2 * Math.atan2(Math.hypot(x, y, z), Math.abs(w));
};

describe("full-body FABRIK", () => {
  it("reaches 1 mm on 1,000 of 1,000 random reachable targets from the rest pose, within the joints' limits (seed 5)", () => {
    const r = createRandom(5);
    const w = createFabrik(skeleton);
    let reached = 0;
    let outside = 0;
    for (let i = 0; i < 1000; i++) {
      const goal = randomPose(r, 0.9);
      const targets = targetsOf(
        Float64Array.of(0.1 * r.normal(), 0.8 + 0.1 * r.normal(), 0.1 * r.normal()),
        goal,
      );
      const pose = restPose();
      const root = Float64Array.of(0, 0.93, 0);
      const left = solveFabrik(w, root, pose, targets, [1, 1, 1, 1, 1], {
        tolerance: 1e-3,
        rounds: 400,
        freeHips: true,
      });
      if (left <= 1e-3) reached++;
      // What it says of itself must hold of the pose that it gives.
      const found = targetsOf(root, pose);
      for (let e = 0; e < EFFECTORS.length; e++)
        expect(
          Math.hypot(
            found[3 * e] - targets[3 * e],
            found[3 * e + 1] - targets[3 * e + 1],
            found[3 * e + 2] - targets[3 * e + 2],
          ),
        ).toBeLessThanOrEqual(left + 1e-9);
      for (let j = 1; j < JOINT_COUNT; j++)
        if (holdToLimits(pose.slice(4 * j, 4 * j + 4), 0, j) > 1e-6) outside++;
      for (const j of [J.leftLowerArm, J.rightLowerArm])
        if (flexion(pose, j) > ELBOW_RANGE[1] + 1e-6) outside++;
      for (const j of [J.leftLowerLeg, J.rightLowerLeg])
        if (flexion(pose, j) > KNEE_RANGE[1] + 1e-6) outside++;
    }
    expect(reached).toBe(1000);
    expect(outside).toBe(0);
  });

  it("leaves a pose that is already there as it is, and free effectors to themselves", () => {
    const r = createRandom(3);
    const w = createFabrik(skeleton);
    const pose = randomPose(r, 0.6);
    const root = Float64Array.of(0, 0.9, 0);
    const targets = targetsOf(root, pose);
    const before = pose.slice();
    const options = { tolerance: 1e-3, rounds: 50, freeHips: true };
    expect(solveFabrik(w, root, pose, targets, [1, 1, 1, 1, 1], options)).toBeLessThan(1e-9);
    for (let k = 0; k < 4 * JOINT_COUNT; k += 4) {
      const dot = Math.abs(
        pose[k] * before[k] +
          pose[k + 1] * before[k + 1] +
          pose[k + 2] * before[k + 2] +
          pose[k + 3] * before[k + 3],
      );
      expect(dot).toBeGreaterThan(1 - 1e-9);
    }
    targets[0] += 100;
    expect(solveFabrik(w, root, pose, targets, [0, 1, 1, 1, 1], options)).toBeLessThan(1e-3);
  });

  it("comes as near as it can to a target out of reach, and says how far it is", () => {
    const w = createFabrik(skeleton);
    const pose = restPose();
    const root = Float64Array.of(0, 0.93, 0);
    const targets = targetsOf(root, pose);
    targets[3] = -3;
    const left = solveFabrik(w, root, pose, targets, [0, 1, 1, 1, 0], {
      tolerance: 1e-3,
      rounds: 60,
      freeHips: true,
    });
    expect(left).toBeGreaterThan(0.5);
    expect(Number.isFinite(pose.reduce((a, b) => a + b, 0))).toBe(true);
  });
});
