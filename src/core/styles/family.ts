/**
 * The family of a loop with progressively shorter strides [Express §7.2], built ahead and sampled by curvature.
 *
 * A member keeps the loop's timing and its upper body. Distances between foot-plants and the feet's vertical range shrink,
 * the roll of the foot with them; the hips rise or sink so that the bearing leg stays as bent as it was on the mean, and go up and
 * down in proportion to the stride.
 */
import { quatRotate } from "../math/quaternion.ts";
import { plantedAnkle } from "../motion/sole.ts";
import { J } from "../skeleton/joints.ts";
import type { Skeleton } from "../skeleton/skeleton.ts";
import type { LoopSequence } from "./loop.ts";
import { LEG_STRIDE, LEGS, QUATS, ROW } from "./rows.ts";

/** Hips' forward and height, then two legs. */
export const MEMBER_ROW = 2 + 2 * LEG_STRIDE;
/** Members at most: 1 % each, down to half the stride [Express §7.2]. */
export const MOST_MEMBERS = 50;
/** Heading change between points 0.1 m apart that takes 1 % off the stride, radians [Express §7.2: 0.2 degrees]. */
const TURN_PER_PERCENT = (0.2 * Math.PI) / 180;

export interface StrideFamily {
  loop: LoopSequence;
  /** Members beside the loop itself: member m has strides of 1 - m / 100. */
  members: number;
  /** (members + 1) x frames x MEMBER_ROW. */
  rows: Float64Array;
}

/** Stride scale of [Express §7.2] where the path turns by `curvature` radians a metre: 1 down to 0.5. */
export function strideScale(curvature: number): number {
  const turn = Math.abs(curvature) * 0.1;
  return 1 - Math.min(MOST_MEMBERS, turn / TURN_PER_PERCENT) / 100;
}

/** Members that a path of this largest curvature needs. */
export function membersFor(curvature: number): number {
  return Math.min(MOST_MEMBERS, Math.ceil(100 * (1 - strideScale(curvature)) - 1e-9));
}

/**
 * Builds a family.
 *
 * @param skeleton the body that the loop was fitted to.
 * @param members 0 to 50.
 * @param onMember called after each member, for progress.
 */
export function buildFamily(
  loop: LoopSequence,
  skeleton: Skeleton,
  members: number,
  onMember: (done: number, of: number) => void = () => undefined,
): StrideFamily {
  const n = loop.frames;
  const family: StrideFamily = { loop, members, rows: new Float64Array((members + 1) * n * MEMBER_ROW) };
  // The loop's own legs: distance from hip joint to ankle, and how much each bears.
  const hips = new Float64Array(6 * n);
  const reach = new Float64Array(2 * n);
  const bears = new Float64Array(2 * n);
  const ankle = new Float64Array(3);
  const v = new Float64Array(3);
  const footAt = (out: Float64Array, rows: Float64Array, o: number) => {
    plantedAnkle(ankle, skeleton.foot, Math.max(-1.5, Math.min(0.8, rows[o + 4])));
    out[0] = rows[o] + Math.sin(rows[o + 3]) * ankle[0];
    out[1] = rows[o + 1] + ankle[1];
    out[2] = rows[o + 2] + Math.cos(rows[o + 3]) * ankle[0];
  };
  for (let f = 0; f < n; f++) {
    const o = ROW * f;
    for (let side = 0; side < 2; side++) {
      const joint = 3 * (side === 0 ? J.leftUpperLeg : J.rightUpperLeg);
      const off = skeleton.offsets;
      quatRotate(v, 0, loop.rows, o + QUATS, off[joint], off[joint + 1], off[joint + 2]);
      for (let k = 0; k < 3; k++) hips[6 * f + 3 * side + k] = v[k];
      const leg = o + LEGS + LEG_STRIDE * side;
      footAt(v, loop.rows, leg);
      const dx = loop.rows[o + 1] + hips[6 * f + 3 * side] - v[0];
      const dy = loop.rows[o + 2] + hips[6 * f + 3 * side + 1] - v[1];
      const dz = loop.rows[o] + hips[6 * f + 3 * side + 2] - v[2];
      reach[2 * f + side] = dx * dx + dy * dy + dz * dz;
      const up = loop.rows[leg + 1] / (0.02 * loop.legLength);
      bears[2 * f + side] = 1e-3 + Math.exp(-up * up);
    }
  }
  const rise = new Float64Array(n);
  const height = new Float64Array(n);
  for (let m = 0; m <= members; m++) {
    const c = 1 - m / 100;
    const roll = 0.3 + 0.7 * c;
    for (let f = 0; f < n; f++) {
      const o = ROW * f;
      const r = (m * n + f) * MEMBER_ROW;
      family.rows[r] = c * loop.rows[o];
      let sum = 0;
      let weight = 0;
      for (let side = 0; side < 2; side++) {
        const from = o + LEGS + LEG_STRIDE * side;
        const to = r + 2 + LEG_STRIDE * side;
        for (let k = 0; k < LEG_STRIDE; k++) family.rows[to + k] = loop.rows[from + k];
        family.rows[to + 1] *= c;
        family.rows[to + 2] *= c;
        family.rows[to + 4] *= roll;
        family.rows[to + 5] *= roll;
        footAt(v, family.rows, to);
        const dx = loop.rows[o + 1] + hips[6 * f + 3 * side] - v[0];
        const dz = family.rows[r] + hips[6 * f + 3 * side + 2] - v[2];
        const left = reach[2 * f + side] - dx * dx - dz * dz;
        const y = v[1] + Math.sqrt(Math.max(0.04 * reach[2 * f + side], left)) - hips[6 * f + 3 * side + 1];
        sum += bears[2 * f + side] * (y - loop.rows[o + 2]);
        weight += bears[2 * f + side];
      }
      rise[f] = sum / weight;
    }
    softenCircle(rise, n, 4);
    // Who takes shorter steps in the same time also bounces less. The loop itself has nothing to make up for.
    for (let f = 0; f < n; f++) height[f] = loop.rows[ROW * f + 2] + (m === 0 ? 0 : rise[f]);
    const mean = height.reduce((a, b) => a + b, 0) / n;
    for (let f = 0; f < n; f++) family.rows[(m * n + f) * MEMBER_ROW + 1] = mean + c * (height[f] - mean);
    onMember(m, members);
  }
  return family;
}

/** Gaussian mean round a closed track, in place. */
function softenCircle(track: Float64Array, n: number, sigma: number): void {
  const copy = track.slice(0, n);
  const r = Math.min(n >> 1, Math.ceil(2.5 * sigma));
  let total = 0;
  for (let k = -r; k <= r; k++) total += Math.exp(-0.5 * (k / sigma) ** 2);
  for (let f = 0; f < n; f++) {
    let s = 0;
    for (let k = -r; k <= r; k++) s += Math.exp(-0.5 * (k / sigma) ** 2) * copy[(f + k + n) % n];
    track[f] = s / total;
  }
}

/** Hips' forward and height and both legs at a fractional frame and stride scale, between neighbours, to out[0..19]. */
export function readFamily(out: Float64Array, family: StrideFamily, frame: number, scale: number): void {
  const n = family.loop.frames;
  const g = frame - Math.floor(frame / n) * n;
  const i = Math.min(n - 1, Math.floor(g));
  const j = i + 1 < n ? i + 1 : 0;
  const u = g - i;
  const m = Math.max(0, Math.min(family.members, 100 * (1 - scale)));
  const k = Math.min(Math.max(0, family.members - 1), Math.floor(m));
  const t = m - k;
  const rows = family.rows;
  const a = (k * n + i) * MEMBER_ROW;
  const b = (k * n + j) * MEMBER_ROW;
  const up = family.members > 0 ? n * MEMBER_ROW : 0;
  for (let c = 0; c < MEMBER_ROW; c++) {
    const p = rows[a + c] + u * (rows[b + c] - rows[a + c]);
    const q = rows[a + up + c] + u * (rows[b + up + c] - rows[a + up + c]);
    out[c] = p + t * (q - p);
  }
}
