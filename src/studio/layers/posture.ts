/**
 * The body posed from its tracks: pelvis, trunk, head and arms as rotations; the hips over the way of the mass; legs closed
 * onto the feet.
 */
import type { Clip } from "../../core/capture/clip.ts";
import { solveLeg } from "../../core/ik/leg.ts";
import { wrapAngle } from "../../core/math/angle.ts";
import { softEnvelope } from "../../core/math/interpolate.ts";
import {
  quatFromAxisAngle,
  quatFromYawPitchRoll,
  quatInverseMultiply,
  quatMultiply,
  quatRotate,
  quatSlerp,
} from "../../core/math/quaternion.ts";
import { forwardKinematics } from "../../core/skeleton/forward-kinematics.ts";
import { J, JOINT_COUNT } from "../../core/skeleton/joints.ts";
import type { Skeleton } from "../../core/skeleton/skeleton.ts";
import type { BodyAngles } from "./body.ts";
import type { FootTrack } from "./feet.ts";
import type { Legs } from "./knees.ts";
import { carryBox, reach } from "./reach.ts";
import { handsOnBox, type TaskLayer } from "./tasks.ts";

const LEAST_KNEE = (3.5 * Math.PI) / 180;
const Q = 4 * JOINT_COUNT;

/** Pelvis, spine, head and arms as local rotations. */
export function trunkRotations(clip: Clip, body: BodyAngles): void {
  const q = new Float64Array(48);
  for (let f = 0; f < clip.frames; f++) {
    const o = Q * f;
    const r = clip.rotations;
    quatFromYawPitchRoll(q, 0, body.pelvisYaw[f], body.pelvisPitch[f], body.pelvisRoll[f]);
    quatFromYawPitchRoll(q, 4, body.chestYaw[f], body.chestPitch[f], body.chestRoll[f]);
    quatFromYawPitchRoll(
      q,
      8,
      body.headYaw[f],
      body.headPitch[f] * 0.4 + body.chestPitch[f] * 0.35,
      body.headRoll[f],
    );
    quatSlerp(q, 12, q, 0, q, 4, 0.3);
    quatSlerp(q, 16, q, 0, q, 4, 0.65);
    quatSlerp(q, 20, q, 4, q, 8, 0.45);
    for (let k = 0; k < 4; k++) r[o + k] = q[k];
    quatInverseMultiply(r, o + 4 * J.spine, q, 0, q, 12);
    quatInverseMultiply(r, o + 4 * J.chest, q, 12, q, 16);
    quatInverseMultiply(r, o + 4 * J.upperChest, q, 16, q, 4);
    quatInverseMultiply(r, o + 4 * J.neck, q, 4, q, 20);
    quatInverseMultiply(r, o + 4 * J.head, q, 20, q, 8);
    // Arms hang: they follow the chest's turn and a quarter of its lean.
    quatFromYawPitchRoll(q, 24, body.chestYaw[f], 0.25 * body.chestPitch[f], 0.5 * body.chestRoll[f]);
    for (let side = 0; side < 2; side++) {
      const arm = body.arms[side];
      const sign = side === 0 ? 1 : -1;
      const shoulder = side === 0 ? J.leftShoulder : J.rightShoulder;
      quatFromAxisAngle(q, 28, 1, 0, 0, -arm.swing[f]);
      quatFromAxisAngle(q, 32, 0, 0, 1, -sign * (Math.PI / 2 - arm.out[f]));
      quatFromAxisAngle(q, 36, 1, 0, 0, arm.turn[f]);
      quatMultiply(q, 40, q, 24, q, 28);
      quatMultiply(q, 40, q, 40, q, 32);
      quatMultiply(q, 40, q, 40, q, 36);
      for (let k = 0; k < 4; k++) r[o + 4 * shoulder + k] = k === 3 ? 1 : 0;
      quatInverseMultiply(r, o + 4 * (shoulder + 1), q, 4, q, 40);
      quatFromAxisAngle(r, o + 4 * (shoulder + 2), 0, 1, 0, -sign * arm.elbow[f]);
      quatFromAxisAngle(r, o + 4 * (shoulder + 3), 0, 1, 0, -sign * 0.12);
    }
  }
}

/** The hips joint over the middle of the hip joints, metres. */
export function hipsOver(body: BodyAngles, skeleton: Skeleton, f: number): number {
  return -skeleton.offsets[3 * J.leftUpperLeg + 1] * Math.cos(body.pelvisPitch[f]);
}

/** The hips' place: over the way of the mass, at the walk's height, lowered softly where a leg would not reach. */
export function placeHips(
  clip: Clip,
  way: Float64Array,
  body: BodyAngles,
  feet: readonly [FootTrack, FootTrack],
  skeleton: Skeleton,
): void {
  const o = skeleton.offsets;
  const thigh = -o[3 * J.leftLowerLeg + 1];
  const shank = -o[3 * J.leftFoot + 1];
  const longest = Math.sqrt(thigh * thigh + shank * shank + 2 * thigh * shank * Math.cos(LEAST_KNEE));
  const need = new Float64Array(clip.frames);
  const v = new Float64Array(3);
  for (let f = 0; f < clip.frames; f++) {
    clip.root[3 * f] = way[2 * f];
    clip.root[3 * f + 1] = body.hipHeight[f] + hipsOver(body, skeleton, f);
    clip.root[3 * f + 2] = way[2 * f + 1];
    for (let side = 0; side < 2; side++) {
      // An airborne foot gives way itself.
      if (feet[side].swing[f] > 0 && !feet[side].turning[f]) continue;
      const hip = side === 0 ? J.leftUpperLeg : J.rightUpperLeg;
      quatRotate(v, 0, clip.rotations, Q * f, o[3 * hip], o[3 * hip + 1], o[3 * hip + 2]);
      const dx = clip.root[3 * f] + v[0] - feet[side].ankle[3 * f];
      const dy = clip.root[3 * f + 1] + v[1] - feet[side].ankle[3 * f + 1];
      const dz = clip.root[3 * f + 2] + v[2] - feet[side].ankle[3 * f + 2];
      need[f] = Math.max(need[f], dy - Math.sqrt(Math.max(0.01, longest * longest - dx * dx - dz * dz)));
    }
  }
  const lower = softEnvelope(need, 5);
  for (let f = 0; f < clip.frames; f++) clip.root[3 * f + 1] -= lower[f];
}

/** Both hip joints over the frames, for the knees' layer. */
export function legsOf(clip: Clip, skeleton: Skeleton, flight: Uint8Array | null): Legs {
  const o = skeleton.offsets;
  const v = new Float64Array(3);
  const hips: [Float64Array, Float64Array] = [
    new Float64Array(3 * clip.frames),
    new Float64Array(3 * clip.frames),
  ];
  for (let f = 0; f < clip.frames; f++)
    for (let side = 0; side < 2; side++) {
      const hip = side === 0 ? J.leftUpperLeg : J.rightUpperLeg;
      quatRotate(v, 0, clip.rotations, Q * f, o[3 * hip], o[3 * hip + 1], o[3 * hip + 2]);
      for (let k = 0; k < 3; k++) hips[side][3 * f + k] = clip.root[3 * f + k] + v[k];
    }
  return {
    hips,
    thigh: -o[3 * J.leftLowerLeg + 1],
    shank: -o[3 * J.leftFoot + 1],
    shape: skeleton.foot,
    flight,
  };
}

/** Legs onto the feet, hands to their places; joints' places for the zero-moment point. */
export function closeBody(
  clip: Clip,
  feet: readonly [FootTrack, FootTrack],
  body: BodyAngles,
  tasks: TaskLayer,
  skeleton: Skeleton,
  all: Float64Array,
  last: boolean,
): void {
  carryBox(clip, body, tasks, skeleton);
  handsOnBox(tasks, clip.frames);
  const positions = new Float64Array(3 * JOINT_COUNT);
  const world = new Float64Array(Q);
  const pose = new Float64Array(Q);
  const root = new Float64Array(3);
  const v = new Float64Array(12);
  const q = new Float64Array(12);
  const place = new Float64Array(6);
  for (let f = 0; f < clip.frames; f++) {
    for (let k = 0; k < Q; k++) pose[k] = clip.rotations[Q * f + k];
    for (let k = 0; k < 3; k++) root[k] = clip.root[3 * f + k];
    forwardKinematics(positions, world, skeleton, root, 0, pose, 0);
    for (let side = 0; side < 2; side++) {
      const t = feet[side];
      const upper = side === 0 ? J.leftUpperLeg : J.rightUpperLeg;
      const foot = upper + 2;
      // The knee points with the foot, half with the pelvis; a little outwards.
      const out = (side === 0 ? 1 : -1) * 0.05;
      const yaw = t.yaw[f] + out + wrapAngle(body.pelvisYaw[f] - t.yaw[f]) * 0.4;
      solveLeg(
        pose,
        positions,
        world,
        J.hips,
        upper,
        skeleton.offsets,
        t.ankle[3 * f],
        t.ankle[3 * f + 1],
        t.ankle[3 * f + 2],
        Math.sin(yaw),
        0.15,
        Math.cos(yaw),
      );
      quatFromYawPitchRoll(world, 4 * foot, t.yaw[f], -t.pitch[f], 0);
      quatInverseMultiply(pose, 4 * foot, world, 4 * (upper + 1), world, 4 * foot);
      quatFromAxisAngle(pose, 4 * (foot + 1), 1, 0, 0, -t.toeBend[f]);
      quatMultiply(world, 4 * (foot + 1), world, 4 * foot, pose, 4 * (foot + 1));
      quatRotate(
        v,
        0,
        world,
        4 * foot,
        skeleton.offsets[3 * (foot + 1)],
        skeleton.offsets[3 * (foot + 1) + 1],
        skeleton.offsets[3 * (foot + 1) + 2],
      );
      for (let k = 0; k < 3; k++) positions[3 * (foot + 1) + k] = positions[3 * foot + k] + v[k];
    }
    reach(f, pose, positions, world, root, tasks, skeleton, v, q, place);
    all.set(positions, 3 * JOINT_COUNT * f);
    if (last) for (let k = 0; k < Q; k++) clip.rotations[Q * f + k] = pose[k];
  }
}
