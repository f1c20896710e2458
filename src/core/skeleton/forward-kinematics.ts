/**
 * Forward kinematics: local rotations and the hips' place to world rotations and places.
 *
 * Hot path: flat arrays, no allocation. `pose` holds JOINT_COUNT quaternions xyzw, local to the parent.
 */
import { JOINT_COUNT, PARENTS } from "./joints.ts";
import type { Skeleton } from "./skeleton.ts";

type Numbers = Float64Array | Float32Array;

/**
 * World places and rotations of every joint.
 *
 * @param outPositions JOINT_COUNT x 3, written.
 * @param outRotations JOINT_COUNT x 4, written.
 * @param root the hips' world place, read at `rootOffset`.
 * @param rotations local quaternions, read at `rotationOffset`.
 */
export function forwardKinematics(
  outPositions: Float64Array,
  outRotations: Float64Array,
  skeleton: Skeleton,
  root: Numbers,
  rootOffset: number,
  rotations: Numbers,
  rotationOffset: number,
): void {
  const offsets = skeleton.offsets;
  outPositions[0] = root[rootOffset];
  outPositions[1] = root[rootOffset + 1];
  outPositions[2] = root[rootOffset + 2];
  for (let k = 0; k < 4; k++) outRotations[k] = rotations[rotationOffset + k];
  for (let j = 1; j < JOINT_COUNT; j++) {
    const p = PARENTS[j];
    const ax = outRotations[4 * p];
    const ay = outRotations[4 * p + 1];
    const az = outRotations[4 * p + 2];
    const aw = outRotations[4 * p + 3];
    const ox = offsets[3 * j];
    const oy = offsets[3 * j + 1];
    const oz = offsets[3 * j + 2];
    // v + 2 w (a x v) + 2 a x (a x v)
    const tx = 2 * (ay * oz - az * oy);
    const ty = 2 * (az * ox - ax * oz);
    const tz = 2 * (ax * oy - ay * ox);
    outPositions[3 * j] = outPositions[3 * p] + ox + aw * tx + (ay * tz - az * ty);
    outPositions[3 * j + 1] = outPositions[3 * p + 1] + oy + aw * ty + (az * tx - ax * tz);
    outPositions[3 * j + 2] = outPositions[3 * p + 2] + oz + aw * tz + (ax * ty - ay * tx);
    const b = rotationOffset + 4 * j;
    const bx = rotations[b];
    const by = rotations[b + 1];
    const bz = rotations[b + 2];
    const bw = rotations[b + 3];
    outRotations[4 * j] = aw * bx + ax * bw + ay * bz - az * by;
    outRotations[4 * j + 1] = aw * by - ax * bz + ay * bw + az * bx;
    outRotations[4 * j + 2] = aw * bz + ax * by - ay * bx + az * bw;
    outRotations[4 * j + 3] = aw * bw - ax * bx - ay * by - az * bz;
  }
}
