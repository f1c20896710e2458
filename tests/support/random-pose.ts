/** Random poses within the joints' limits. */
import { quatFromAxisAngle, quatMultiply } from "../../src/core/math/quaternion.ts";
import type { Random } from "../../src/core/math/random.ts";
import { J, JOINT_COUNT } from "../../src/core/skeleton/joints.ts";
import { ELBOW_RANGE, KNEE_RANGE, LIMIT_STRIDE, LIMITS } from "../../src/core/skeleton/limits.ts";

const q = new Float64Array(8);

/** JOINT_COUNT x xyzw, local; `share` of each range is used. */
export function randomPose(r: Random, share: number): Float64Array {
  const pose = new Float64Array(4 * JOINT_COUNT);
  for (let j = 0; j < JOINT_COUNT; j++) pose[4 * j + 3] = 1;
  for (let j = 1; j < JOINT_COUNT; j++) {
    const l = j * LIMIT_STRIDE;
    if (LIMITS[l + 3] >= Math.PI) continue;
    const [ax, ay, az] = LIMITS.subarray(l, l + 3);
    // An axis square to the bone.
    const a = 2 * Math.PI * r.next();
    const e = Math.abs(ax) > 0.5 ? [0, Math.cos(a), Math.sin(a)] : [Math.cos(a), 0, Math.sin(a)];
    quatFromAxisAngle(q, 0, e[0], e[1], e[2], share * LIMITS[l + 3] * r.next());
    const twist = share * (LIMITS[l + 4] + (LIMITS[l + 5] - LIMITS[l + 4]) * r.next());
    quatFromAxisAngle(q, 4, ax, ay, az, twist);
    quatMultiply(pose, 4 * j, q, 0, q, 4);
  }
  const hinge = (j: number, x: number, y: number, range: readonly [number, number]) =>
    quatFromAxisAngle(pose, 4 * j, x, y, 0, range[0] + share * (range[1] - range[0]) * r.next());
  hinge(J.leftLowerArm, 0, -1, ELBOW_RANGE);
  hinge(J.rightLowerArm, 0, 1, ELBOW_RANGE);
  hinge(J.leftLowerLeg, 1, 0, KNEE_RANGE);
  hinge(J.rightLowerLeg, 1, 0, KNEE_RANGE);
  return pose;
}
