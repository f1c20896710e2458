/**
 * The trunk's share of a reach: where a hand's target lies beyond its arm, the spine turns towards it.
 *
 * FABRIK's forward step over the spine: the shoulder is drawn to where the arm just reaches, and the spine's joints
 * share the turn that takes it there, each within a limit [Aristidou and Lasenby 2011, §4].
 */
import {
  quatBetween,
  quatInverseMultiply,
  quatMultiply,
  quatNormalize,
  quatSlerp,
} from "../math/quaternion.ts";
import { forwardKinematics } from "../skeleton/forward-kinematics.ts";
import { J } from "../skeleton/joints.ts";
import type { Skeleton } from "../skeleton/skeleton.ts";

const SPINE = [J.spine, J.chest, J.upperChest] as const;
/** An arm is asked for at most this share of its length before the trunk helps. */
const COMFORT = 0.96;
const ROUNDS = 20;
/** Most that one joint turns in one round, radians. */
const MOST_TURN = 0.12;

const q = new Float64Array(16);
const identity = Float64Array.of(0, 0, 0, 1);

/** Bends the spine of `pose` so that both shoulders come within an arm of their targets, by each target's weight; kinematics are updated. */
export function bendTrunk(
  pose: Float64Array,
  positions: Float64Array,
  world: Float64Array,
  root: Float64Array,
  skeleton: Skeleton,
  weight: readonly [number, number],
  place: Float64Array,
): void {
  const o = skeleton.offsets;
  const arm = Math.abs(o[3 * J.leftLowerArm]) + Math.abs(o[3 * J.leftHand]);
  for (let round = 0; round < ROUNDS; round++) {
    // What the shoulders lack, as one pull of their middle.
    let px = 0;
    let py = 0;
    let pz = 0;
    let count = 0;
    let sx = 0;
    let sy = 0;
    let sz = 0;
    for (let side = 0; side < 2; side++) {
      if (weight[side] <= 0) continue;
      const s = side === 0 ? J.leftUpperArm : J.rightUpperArm;
      const dx = place[3 * side] - positions[3 * s];
      const dy = place[3 * side + 1] - positions[3 * s + 1];
      const dz = place[3 * side + 2] - positions[3 * s + 2];
      const d = Math.sqrt(dx * dx + dy * dy + dz * dz);
      const lack = weight[side] * (d - COMFORT * arm);
      if (lack <= 1e-4) continue;
      px += (dx / d) * lack;
      py += (dy / d) * lack;
      pz += (dz / d) * lack;
      sx += positions[3 * s];
      sy += positions[3 * s + 1];
      sz += positions[3 * s + 2];
      count++;
    }
    if (count === 0) return;
    for (const joint of SPINE) {
      const jx = positions[3 * joint];
      const jy = positions[3 * joint + 1];
      const jz = positions[3 * joint + 2];
      let ax = sx / count - jx;
      let ay = sy / count - jy;
      let az = sz / count - jz;
      let bx = ax + px / count;
      let by = ay + py / count;
      let bz = az + pz / count;
      const a = Math.sqrt(ax * ax + ay * ay + az * az);
      const b = Math.sqrt(bx * bx + by * by + bz * bz);
      if (a < 1e-6 || b < 1e-6) continue;
      ax /= a;
      ay /= a;
      az /= a;
      bx /= b;
      by /= b;
      bz /= b;
      quatBetween(q, 0, ax, ay, az, bx, by, bz);
      const angle = Math.acos(Math.max(-1, Math.min(1, ax * bx + ay * by + az * bz)));
      const share = angle > 1e-9 ? Math.min(0.6, MOST_TURN / angle) : 0;
      quatSlerp(q, 4, identity, 0, q, 0, share);
      quatMultiply(q, 8, q, 4, world, 4 * joint);
      quatInverseMultiply(pose, 4 * joint, world, 4 * (joint - 1), q, 8);
      quatNormalize(pose, 4 * joint);
      forwardKinematics(positions, world, skeleton, root, 0, pose, 0);
    }
  }
}
