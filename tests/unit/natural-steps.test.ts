import { describe, expect, it } from "vitest";
import { bendTrunk } from "../../src/core/ik/trunk.ts";
import { wrapAngle } from "../../src/core/math/angle.ts";
import { forwardKinematics } from "../../src/core/skeleton/forward-kinematics.ts";
import { J, JOINT_COUNT } from "../../src/core/skeleton/joints.ts";
import { createSkeleton } from "../../src/core/skeleton/skeleton.ts";
import { planScene } from "../../src/core/tasks/plan-scene.ts";
import { retargetLibrary } from "../../src/core/templates/retarget-library.ts";
import { studio } from "../support/library.ts";
import { randomScene } from "../support/random-scene.ts";

const skeleton = createSkeleton(1.75);

describe("steps that a body can make", () => {
  it("no planned foot is turned farther against the other than hips bear", () => {
    const library = retargetLibrary(studio().library, skeleton);
    for (let seed = 1; seed <= 20; seed++) {
      const plan = planScene(randomScene(seed), library, skeleton);
      const yaw = { left: plan.start[0].yaw, right: plan.start[1].yaw };
      for (const s of plan.steps) {
        yaw[s.foot] = s.yaw;
        const out = wrapAngle(yaw.left - yaw.right);
        expect(out, `seed ${seed}`).toBeLessThan(1.66);
        expect(out, `seed ${seed}`).toBeGreaterThan(-1.36);
      }
    }
  });

  it("the trunk follows the weight of a reach from hanging arms without a jump", () => {
    let last = 0;
    for (let k = 0; k <= 200; k++) {
      const weight = k / 200;
      const pose = new Float64Array(4 * JOINT_COUNT);
      for (let j = 0; j < JOINT_COUNT; j++) pose[4 * j + 3] = 1;
      for (const [joint, sign] of [
        [J.leftUpperArm, -1],
        [J.rightUpperArm, 1],
      ]) {
        pose[4 * joint + 2] = sign * Math.SQRT1_2;
        pose[4 * joint + 3] = Math.SQRT1_2;
      }
      const root = Float64Array.of(0, skeleton.legLength, 0);
      const positions = new Float64Array(3 * JOINT_COUNT);
      const world = new Float64Array(4 * JOINT_COUNT);
      forwardKinematics(positions, world, skeleton, root, 0, pose, 0);
      const place = new Float64Array(6);
      for (const [side, hand] of [J.leftHand, J.rightHand].entries()) {
        const to = [positions[3 * hand], 0.75, 0.62];
        for (let i = 0; i < 3; i++)
          place[3 * side + i] = positions[3 * hand + i] + weight * (to[i] - positions[3 * hand + i]);
      }
      bendTrunk(pose, positions, world, root, skeleton, [weight, weight], place);
      const bend = 2 * Math.asin(pose[4 * J.upperChest]);
      expect(Math.abs(bend - last), `weight ${weight}`).toBeLessThan(0.02);
      last = bend;
    }
    expect(last).toBeGreaterThan(0.05);
  });
});
