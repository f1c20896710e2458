/**
 * One motion taken over from another: it begins in the pose that the other has ended in, and the difference dies out. Both
 * begin and end standing, on the same footsteps; legs stay closed on the motion's own feet.
 */
import type { Clip } from "../capture/clip.ts";
import { solveLeg } from "../ik/leg.ts";
import {
  quatConjugate,
  quatFromRotationVector,
  quatInverseMultiply,
  quatMultiply,
  quatNormalize,
  quatRotate,
  quatToRotationVector,
} from "../math/quaternion.ts";
import { forwardKinematics } from "../skeleton/forward-kinematics.ts";
import { J, JOINT_COUNT } from "../skeleton/joints.ts";
import { decay } from "./inertia.ts";

const Q = 4 * JOINT_COUNT;
/** Seconds until nothing of the pose before is left. */
const TIME = 0.6;

/**
 * Changes the first frames of a clip so that it goes on from a pose at rest.
 *
 * @param root the hips' place before, 3; @param rotations local rotations before, JOINT_COUNT x xyzw. The clip is written.
 */
export function blendIn(clip: Clip, root: ArrayLike<number>, rotations: ArrayLike<number>): void {
  const { skeleton, rate } = clip;
  const frames = Math.min(clip.frames, Math.ceil(TIME * rate));
  const offset = new Float64Array(3 * JOINT_COUNT);
  const shift = new Float64Array(3);
  const q = new Float64Array(12);
  for (let k = 0; k < 3; k++) shift[k] = root[k] - clip.root[k];
  for (let j = 0; j < JOINT_COUNT; j++) {
    for (let k = 0; k < 4; k++) q[k] = rotations[4 * j + k];
    quatConjugate(q, 4, clip.rotations, 4 * j);
    quatMultiply(q, 8, q, 0, q, 4);
    quatToRotationVector(offset, 3 * j, q, 8);
  }
  const places = new Float64Array(3 * JOINT_COUNT);
  const world = new Float64Array(4 * JOINT_COUNT);
  const pose = new Float64Array(Q);
  const at = new Float64Array(3);
  const feet = new Float64Array(14);
  const knee = new Float64Array(3);
  for (let f = 0; f < frames; f++) {
    const age = (f + 1) / rate;
    for (let k = 0; k < 3; k++) at[k] = clip.root[3 * f + k];
    pose.set(clip.rotations.subarray(Q * f, Q * (f + 1)));
    forwardKinematics(places, world, skeleton, at, 0, pose, 0);
    for (let side = 0; side < 2; side++) {
      const foot = side === 0 ? J.leftFoot : J.rightFoot;
      for (let k = 0; k < 3; k++) feet[7 * side + k] = places[3 * foot + k];
      for (let k = 0; k < 4; k++) feet[7 * side + 3 + k] = world[4 * foot + k];
    }
    for (let k = 0; k < 3; k++) at[k] += decay(shift[k], 0, age, TIME);
    for (let j = 0; j < JOINT_COUNT; j++) {
      quatFromRotationVector(
        q,
        0,
        decay(offset[3 * j], 0, age, TIME),
        decay(offset[3 * j + 1], 0, age, TIME),
        decay(offset[3 * j + 2], 0, age, TIME),
      );
      quatMultiply(pose, 4 * j, q, 0, pose, 4 * j);
      quatNormalize(pose, 4 * j);
    }
    forwardKinematics(places, world, skeleton, at, 0, pose, 0);
    for (let side = 0; side < 2; side++) {
      const upper = side === 0 ? J.leftUpperLeg : J.rightUpperLeg;
      const foot = upper + 2;
      quatRotate(knee, 0, world, 4 * upper, 0, 0, 1);
      const o = 7 * side;
      solveLeg(
        pose,
        places,
        world,
        J.hips,
        upper,
        skeleton.offsets,
        feet[o],
        feet[o + 1],
        feet[o + 2],
        knee[0],
        knee[1],
        knee[2],
      );
      for (let k = 0; k < 4; k++) world[4 * foot + k] = feet[o + 3 + k];
      quatInverseMultiply(pose, 4 * foot, world, 4 * (upper + 1), world, 4 * foot);
      quatNormalize(pose, 4 * foot);
      // Toes are the motion's own.
      for (let k = 0; k < 4; k++) pose[4 * (foot + 1) + k] = clip.rotations[Q * f + 4 * (foot + 1) + k];
    }
    for (let k = 0; k < 3; k++) clip.root[3 * f + k] = at[k];
    clip.rotations.set(pose, Q * f);
  }
}
