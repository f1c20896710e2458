/**
 * A frame of a style as a row of numbers relative to its path: what displacement mapping [Express §6.3] lays on another one.
 *
 * The row's frame has its origin on the ground at the path's point, +Z along the path, +X to the left. Legs are kept as
 * what their feet do (print on the ground, yaw, pitch) and where their knees point, and closed by inverse kinematics when
 * the row is laid on a path; all else is kept as it was captured. Metres, radians, quaternions xyzw.
 */
import type { Clip } from "../capture/clip.ts";
import { smoothstep } from "../math/interpolate.ts";
import {
  quatCopy,
  quatFromYawPitchRoll,
  quatInverseMultiply,
  quatRotate,
  quatToRotationVector,
} from "../math/quaternion.ts";
import { pitchOf, toeBendOf } from "../motion/foot-pose.ts";
import { plantedAnkle } from "../motion/sole.ts";
import { forwardKinematics } from "../skeleton/forward-kinematics.ts";
import { J, JOINT_COUNT } from "../skeleton/joints.ts";

/** Forward, lateral (left positive) and height of the hips. */
export const ROOT = 0;
/** The hips' rotation, then those of the trunk, head and arms, local to their parents. */
export const QUATS = 3;
/** Joints 0 to 13 of the pose order: hips to right hand. */
export const QUAT_COUNT = 14;
/** Two legs: left, right. */
export const LEGS = QUATS + 4 * QUAT_COUNT;
/**
 * A leg: print (lateral, up, forward), yaw, pitch (toe up positive), toe bend (up positive), way of the knee (3), and what of
 * the foot's rotation yaw and pitch leave out, as a rotation vector in the foot's own frame (3).
 */
export const LEG_STRIDE = 12;
/** Where in a leg the rest of the foot's rotation is. */
export const LEG_TILT = 9;
/** End effectors for the blend length: head, hands, feet; x, y, z each, hips' place and path's heading removed. */
export const EFFECTORS = LEGS + 2 * LEG_STRIDE;
export const EFFECTOR_COUNT = 5;
export const ROW = EFFECTORS + 3 * EFFECTOR_COUNT;

export const EFFECTOR_JOINTS = [J.head, J.leftHand, J.rightHand, J.leftFoot, J.rightFoot] as const;

/** A straight line that a sample moves along evenly: where it is at frame `at`, its heading, metres a frame. */
export interface ReferenceLine {
  at: number;
  x: number;
  z: number;
  yaw: number;
  speed: number;
}

const place = new Float64Array(3 * JOINT_COUNT);
const world = new Float64Array(4 * JOINT_COUNT);
const q = new Float64Array(4);
const v = new Float64Array(3);
const ankle = new Float64Array(3);

/** Writes frame `frame` of a clip, seen from its reference line, to `out` at `o`. */
export function rowOf(out: Float64Array, o: number, clip: Clip, frame: number, line: ReferenceLine): void {
  const { skeleton } = clip;
  forwardKinematics(place, world, skeleton, clip.root, 3 * frame, clip.rotations, 4 * JOINT_COUNT * frame);
  const s = Math.sin(line.yaw);
  const c = Math.cos(line.yaw);
  const along = line.speed * (frame - line.at);
  const lateral = (x: number, z: number) => c * (x - line.x) - s * (z - line.z);
  const forward = (x: number, z: number) => s * (x - line.x) + c * (z - line.z) - along;
  out[o] = forward(place[0], place[2]);
  out[o + 1] = lateral(place[0], place[2]);
  out[o + 2] = place[1];
  quatFromYawPitchRoll(q, 0, line.yaw, 0, 0);
  quatInverseMultiply(out, o + QUATS, q, 0, world, 0);
  for (let j = 1; j < QUAT_COUNT; j++)
    quatCopy(out, o + QUATS + 4 * j, clip.rotations, 4 * (JOINT_COUNT * frame + j));
  for (let side = 0; side < 2; side++) {
    const upper = side === 0 ? J.leftUpperLeg : J.rightUpperLeg;
    const foot = upper + 2;
    const l = o + LEGS + LEG_STRIDE * side;
    // Without roll the foot's sideways axis is level, and gives its yaw however steep it is.
    quatRotate(v, 0, world, 4 * foot, 1, 0, 0);
    const yaw = Math.atan2(-v[2], v[0]);
    const pitch = pitchOf(world, 4 * foot);
    quatRotate(v, 0, world, 4 * foot, 0, 0, 1);
    const ahead = Math.sin(yaw) * v[0] + Math.cos(yaw) * v[2];
    const steep = ahead >= 0 ? pitch : (pitch < 0 ? -Math.PI : Math.PI) - pitch;
    plantedAnkle(ankle, skeleton.foot, Math.max(-1.5, Math.min(0.8, steep)));
    const f = 3 * foot;
    const px = place[f] - Math.sin(yaw) * ankle[0];
    const pz = place[f + 2] - Math.cos(yaw) * ankle[0];
    out[l] = lateral(px, pz);
    out[l + 1] = place[f + 1] - ankle[1];
    out[l + 2] = forward(px, pz);
    quatFromYawPitchRoll(q, 0, yaw, -steep, 0);
    quatInverseMultiply(q, 0, q, 0, world, 4 * foot);
    quatToRotationVector(out, l + LEG_TILT, q, 0);
    const turned = yaw - line.yaw;
    out[l + 3] = Math.atan2(Math.sin(turned), Math.cos(turned));
    out[l + 4] = steep;
    out[l + 5] = toeBendOf(clip.rotations, 4 * (JOINT_COUNT * frame + foot + 1));
    // Where the knee points: out of the line from hip to ankle; near straight, where that line says little, ahead of the thigh.
    const h = 3 * upper;
    const k = h + 3;
    let kx = place[k] - (place[h] + place[f]) / 2;
    let ky = place[k + 1] - (place[h + 1] + place[f + 1]) / 2;
    let kz = place[k + 2] - (place[h + 2] + place[f + 2]) / 2;
    const out3 = Math.sqrt(kx * kx + ky * ky + kz * kz);
    const trust = smoothstep(out3 / (0.05 * skeleton.legLength));
    const g = out3 > 1e-9 ? trust / out3 : 0;
    quatRotate(v, 0, world, 4 * upper, 0, 0, 1);
    kx = kx * g + (1 - trust) * v[0];
    ky = ky * g + (1 - trust) * v[1];
    kz = kz * g + (1 - trust) * v[2];
    out[l + 6] = c * kx - s * kz;
    out[l + 7] = ky;
    out[l + 8] = s * kx + c * kz;
  }
  EFFECTOR_JOINTS.forEach((joint, i) => {
    const dx = place[3 * joint] - place[0];
    const dz = place[3 * joint + 2] - place[2];
    const e = o + EFFECTORS + 3 * i;
    out[e] = c * dx - s * dz;
    out[e + 1] = place[3 * joint + 1] - place[1];
    out[e + 2] = s * dx + c * dz;
  });
}

/** out = row at `a` towards row at `b` by `u`, shorter arcs for rotations; `out` may be either. */
export function mixRows(
  out: Float64Array,
  o: number,
  a: Float64Array,
  ai: number,
  b: Float64Array,
  bi: number,
  u: number,
): void {
  for (let k = 0; k < QUATS; k++) out[o + k] = a[ai + k] + u * (b[bi + k] - a[ai + k]);
  for (let j = 0; j < QUAT_COUNT; j++)
    mixQuat(out, o + QUATS + 4 * j, a, ai + QUATS + 4 * j, b, bi + QUATS + 4 * j, u);
  for (let k = LEGS; k < ROW; k++) out[o + k] = a[ai + k] + u * (b[bi + k] - a[ai + k]);
}

/**
 * Spherical interpolation for hot loops: between near rotations the straight way, normalised (they differ from the arc by
 * less than 1e-5 of it under 4 degrees).
 */
export function mixQuat(
  out: Float64Array,
  o: number,
  a: Float64Array,
  ai: number,
  b: Float64Array,
  bi: number,
  u: number,
): void {
  const d = a[ai] * b[bi] + a[ai + 1] * b[bi + 1] + a[ai + 2] * b[bi + 2] + a[ai + 3] * b[bi + 3];
  const sign = d < 0 ? -1 : 1;
  const c = Math.abs(d);
  let wa = 1 - u;
  let wb = u;
  if (c < 0.9995) {
    const angle = Math.acos(c);
    const f = 1 / Math.sin(angle);
    wa = Math.sin((1 - u) * angle) * f;
    wb = Math.sin(u * angle) * f;
  }
  wb *= sign;
  const x = wa * a[ai] + wb * b[bi];
  const y = wa * a[ai + 1] + wb * b[bi + 1];
  const z = wa * a[ai + 2] + wb * b[bi + 2];
  const w = wa * a[ai + 3] + wb * b[bi + 3];
  const n = 1 / Math.sqrt(x * x + y * y + z * z + w * w);
  out[o] = x * n;
  out[o + 1] = y * n;
  out[o + 2] = z * n;
  out[o + 3] = w * n;
}

/** Mean of rows, rotations by the normalised sum in one hemisphere (near enough for a style's mean pose). */
export function meanRow(rows: Float64Array, frames: number): Float64Array {
  const out = new Float64Array(ROW);
  for (let f = 0; f < frames; f++) {
    const o = ROW * f;
    for (let k = 0; k < ROW; k++) {
      if (k >= QUATS && k < LEGS) continue;
      out[k] += rows[o + k] / frames;
    }
    for (let j = 0; j < QUAT_COUNT; j++) {
      const i = QUATS + 4 * j;
      let d = 0;
      for (let k = 0; k < 4; k++) d += rows[o + i + k] * rows[i + k];
      for (let k = 0; k < 4; k++) out[i + k] += d < 0 ? -rows[o + i + k] : rows[o + i + k];
    }
  }
  for (let j = 0; j < QUAT_COUNT; j++) {
    const i = QUATS + 4 * j;
    const n = Math.hypot(out[i], out[i + 1], out[i + 2], out[i + 3]);
    for (let k = 0; k < 4; k++) out[i + k] /= n;
  }
  return out;
}

/** Multiplies every length of a row in place, for a body of another size. */
export function scaleRow(rows: Float64Array, o: number, factor: number): void {
  for (let k = 0; k < QUATS; k++) rows[o + k] *= factor;
  for (let side = 0; side < 2; side++)
    for (let k = 0; k < 3; k++) rows[o + LEGS + LEG_STRIDE * side + k] *= factor;
  for (let k = EFFECTORS; k < ROW; k++) rows[o + k] *= factor;
}
