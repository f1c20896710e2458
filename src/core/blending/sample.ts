/** Rows of the library at a phase, blended by a mix. Hot path: no allocation. */
import { J, JOINT_COUNT } from "../skeleton/joints.ts";
import { type Batch, OFFSET } from "./batch.ts";
import {
  BODY_ROW,
  BODY_ROWS,
  BODY_SPAN,
  HIPS_AT,
  STANCE_ROW,
  STANCE_ROWS,
  SWING_ROW,
  SWING_ROWS,
} from "./library.ts";
import { blendRows } from "./mean-rotation.ts";
import { MIX } from "./mix.ts";

/** Joints of the feet are laid by the footsteps, not by the blend: 16 and 17, 20 and 21. */
const isFoot = (joint: number): boolean => joint >= J.leftFoot && (joint & 2) === 0;
/** Where the rotations before the left foot, and those of the right leg, begin and end. */
const LEFT_FOOT = 4 * J.leftFoot;
const RIGHT_LEG = 4 * J.rightUpperLeg;
const RIGHT_FOOT = 4 * J.rightFoot;

/**
 * The body at phase u of a mix's steps: rotations and the hips' place in the root's frame. Feet are straight: their own pass lays
 * them.
 *
 * @param mix index of the mix (three a character). @param side of the step: 0 left, 1 right.
 */
export function sampleBody(out: Float64Array, b: Batch, mix: number, side: number, u: number): void {
  const { rows } = b.scratch;
  const { body } = b.library;
  const count = b.mixCount[mix];
  const at = u <= 0 ? 0 : u >= BODY_SPAN ? BODY_ROWS - 1 : u * ((BODY_ROWS - 1) / BODY_SPAN);
  const r = at >= BODY_ROWS - 1 ? BODY_ROWS - 2 : at | 0;
  const f = at - r;
  let hx = 0;
  let hy = 0;
  let hz = 0;
  for (let k = 0; k < count; k++) {
    const from = ((2 * b.mixClips[mix * MIX + k] + side) * BODY_ROWS + r) * BODY_ROW;
    const to = k * BODY_ROW;
    for (let c = 0; c < LEFT_FOOT; c++) {
      const v = body[from + c];
      rows[to + c] = v + f * (body[from + BODY_ROW + c] - v);
    }
    for (let c = RIGHT_LEG; c < RIGHT_FOOT; c++) {
      const v = body[from + c];
      rows[to + c] = v + f * (body[from + BODY_ROW + c] - v);
    }
    for (let c = HIPS_AT; c < HIPS_AT + 3; c++) {
      const v = body[from + c];
      rows[to + c] = v + f * (body[from + BODY_ROW + c] - v);
    }
    const w = b.mixWeights[mix * MIX + k];
    hx += w * rows[to + HIPS_AT];
    hy += w * rows[to + HIPS_AT + 1];
    hz += w * rows[to + HIPS_AT + 2];
  }
  for (let k = 0; k < count; k++) weights[k] = b.mixWeights[mix * MIX + k];
  blendRows(out, rows, BODY_ROW, weights, count, 0, J.leftFoot);
  blendRows(out, rows, BODY_ROW, weights, count, J.rightUpperLeg, J.rightFoot);
  for (let j = J.leftFoot; j < JOINT_COUNT; j++) {
    if (!isFoot(j)) continue;
    out[4 * j] = out[4 * j + 1] = out[4 * j + 2] = 0;
    out[4 * j + 3] = 1;
  }
  out[HIPS_AT] = hx;
  out[HIPS_AT + 1] = hy;
  out[HIPS_AT + 2] = hz;
}

const weights = new Float64Array(MIX);

/** What a swinging ankle does beside its eased way, its pitch and toe bend, at share s of the swing. */
export function sampleSwing(out: Float64Array, b: Batch, mix: number, side: number, s: number): void {
  const { swing } = b.library;
  const at = s <= 0 ? 0 : s >= 1 ? SWING_ROWS - 1 : s * (SWING_ROWS - 1);
  const r = at >= SWING_ROWS - 1 ? SWING_ROWS - 2 : at | 0;
  const f = at - r;
  for (let c = 0; c < SWING_ROW; c++) out[c] = 0;
  for (let k = 0; k < b.mixCount[mix]; k++) {
    const w = b.mixWeights[mix * MIX + k];
    const o = ((2 * b.mixClips[mix * MIX + k] + side) * SWING_ROWS + r) * SWING_ROW;
    for (let c = 0; c < SWING_ROW; c++)
      out[c] += w * (swing[o + c] + f * (swing[o + SWING_ROW + c] - swing[o + c]));
  }
}

/** Pitch of a planted foot: part 0 while it settles, part 1 while it leaves, at share s of its stance. */
export function sampleStance(b: Batch, mix: number, side: number, part: number, s: number): number {
  const { stance } = b.library;
  const at = s <= 0 ? 0 : s >= 1 ? STANCE_ROWS - 1 : s * (STANCE_ROWS - 1);
  const r = at >= STANCE_ROWS - 1 ? STANCE_ROWS - 2 : at | 0;
  const f = at - r;
  let out = 0;
  for (let k = 0; k < b.mixCount[mix]; k++) {
    const o = ((2 * b.mixClips[mix * MIX + k] + side) * STANCE_ROWS + r) * STANCE_ROW + part;
    out += b.mixWeights[mix * MIX + k] * (stance[o] + f * (stance[o + STANCE_ROW] - stance[o]));
  }
  return out;
}

/**
 * Begins a blend: what is shown goes on from `old` and its motion, and fades to the new pose.
 *
 * Offsets are Rodrigues vectors (tangent of half the angle), which a product with (g, 1) gives back exactly.
 *
 * @param old, oldBefore what was shown now and `dt` ago; @param fresh, freshAfter the new pose now and `dt` on.
 * @returns the largest offset, as tangent of half the angle.
 */
export function beginOffset(
  b: Batch,
  i: number,
  old: Float64Array,
  oldBefore: Float64Array,
  fresh: Float64Array,
  freshAfter: Float64Array,
  dt: number,
): number {
  const g = b.offset;
  const o = OFFSET * i;
  let most = 0;
  for (let j = 0; j < JOINT_COUNT; j++) {
    if (isFoot(j)) continue;
    rodrigues(g, o + 6 * j, fresh, old, 4 * j);
    rodrigues(rate, 0, oldBefore, old, 4 * j);
    rodrigues(rate, 3, fresh, freshAfter, 4 * j);
    for (let k = 0; k < 3; k++) {
      g[o + 6 * j + 3 + k] = (rate[k] - rate[3 + k]) / dt;
      const v = Math.abs(g[o + 6 * j + k]);
      if (v > most) most = v;
    }
  }
  const h = o + 6 * JOINT_COUNT;
  for (let k = 0; k < 3; k++) {
    const a = HIPS_AT + k;
    g[h + k] = old[a] - fresh[a];
    g[h + 3 + k] = (old[a] - oldBefore[a] - (freshAfter[a] - fresh[a])) / dt;
  }
  return most;
}

const rate = new Float64Array(6);

/** Vector of conjugate(a) b over its scalar, at 4 j in both. */
function rodrigues(out: Float64Array, o: number, a: Float64Array, b: Float64Array, q: number): void {
  const ax = -a[q];
  const ay = -a[q + 1];
  const az = -a[q + 2];
  const aw = a[q + 3];
  const bx = b[q];
  const by = b[q + 1];
  const bz = b[q + 2];
  const bw = b[q + 3];
  const w = aw * bw - ax * bx - ay * by - az * bz;
  const f = 1 / (Math.abs(w) < 0.05 ? (w < 0 ? -0.05 : 0.05) : w);
  out[o] = f * (aw * bx + ax * bw + ay * bz - az * by);
  out[o + 1] = f * (aw * by - ax * bz + ay * bw + az * bx);
  out[o + 2] = f * (aw * bz + ax * by - ay * bx + az * bw);
}

/** Lays what is left of the hips' part of the blend over a pose. @param time seconds since it began, under `length`. */
export function applyHipsOffset(pose: Float64Array, b: Batch, i: number, time: number, length: number): void {
  const g = b.offset;
  const h = OFFSET * i + 6 * JOINT_COUNT;
  const s = time / length;
  const s2 = s * s;
  const s3 = s2 * s;
  const h0 = 1 - s3 * (10 - 15 * s + 6 * s2);
  const h1 = length * (s - s3 * (6 - 8 * s + 3 * s2));
  for (let k = 0; k < 3; k++) pose[HIPS_AT + k] += h0 * g[h + k] + h1 * g[h + 3 + k];
}

/** Seconds over which arms go over at least: they hang free, and what is quick at the shoulder is a jerk at the hand. */
const ARM_BLEND = 0.55;
/** Arms are joints 6 to 13; after them come the legs. */
const ARMS = J.leftShoulder;
const LEGS = J.leftUpperLeg;

/**
 * Lays what is left of the joints' part of the blend over a pose.
 *
 * @param time seconds since it began; @param length seconds that it takes, arms ARM_BLEND at least.
 */
export function applyOffset(pose: Float64Array, b: Batch, i: number, time: number, length: number): void {
  const arms = length > ARM_BLEND ? length : ARM_BLEND;
  if (time < length) {
    layOffset(pose, b, i, time / length, length, 0, ARMS);
    layOffset(pose, b, i, time / length, length, LEGS, LEGS + 2);
    layOffset(pose, b, i, time / length, length, J.rightUpperLeg, J.rightUpperLeg + 2);
  }
  if (time < arms) layOffset(pose, b, i, time / arms, arms, ARMS, LEGS);
}

/** Of joints `from` to before `to`. @param s share of its time that is past, 0..1. */
function layOffset(
  pose: Float64Array,
  b: Batch,
  i: number,
  s: number,
  length: number,
  from: number,
  to: number,
): void {
  const g = b.offset;
  const s2 = s * s;
  const s3 = s2 * s;
  // Quintic from value and rate to rest, without acceleration at both ends.
  const h0 = 1 - s3 * (10 - 15 * s + 6 * s2);
  const h1 = length * (s - s3 * (6 - 8 * s + 3 * s2));
  const end = 4 * to;
  for (let q = 4 * from, a = OFFSET * i + 6 * from; q < end; q += 4, a += 6) {
    const gx = h0 * g[a] + h1 * g[a + 3];
    const gy = h0 * g[a + 1] + h1 * g[a + 4];
    const gz = h0 * g[a + 2] + h1 * g[a + 5];
    const x = pose[q];
    const y = pose[q + 1];
    const z = pose[q + 2];
    const w = pose[q + 3];
    const nx = x + w * gx + y * gz - z * gy;
    const ny = y + w * gy + z * gx - x * gz;
    const nz = z + w * gz + x * gy - y * gx;
    const nw = w - x * gx - y * gy - z * gz;
    const n = 1 / Math.sqrt(nx * nx + ny * ny + nz * nz + nw * nw);
    pose[q] = n * nx;
    pose[q + 1] = n * ny;
    pose[q + 2] = n * nz;
    pose[q + 3] = n * nw;
  }
}
