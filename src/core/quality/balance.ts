/** Balance: the zero-moment point of the body's masses against the planted soles [DESIGN of motion quality; Winter's masses]. */
import { convexHull, createHull, nearestInHull } from "../math/hull.ts";
import { lowPass } from "../math/low-pass.ts";
import type { Skeleton } from "../skeleton/skeleton.ts";
import { zeroMomentPoint } from "../skeleton/zero-moment.ts";
import type { Plan } from "../tasks/plan-types.ts";
import type { TaskGoal } from "../tasks/transition.ts";
import type { MotionPoints } from "./measure.ts";

/** Frames at either end that the low-pass spoils. */
const EDGE = 6;

/** Under this share of the weight there is no zero-moment point to speak of: a run's push into flight. */
const LIGHT = 0.3;

/** Half width of the support under heel, ball and tip, shares of the ankle-to-ball distance. */
const WIDTH = [0.2, 0.32, 0.25];

/**
 * Shares of the frames with a foot down in which the zero-moment point is within 1 cm and 5 cm of the support; seated
 * frames count as supported.
 *
 * @param ground height of the ground under left and right foot, frames each.
 */
export function balanceShares(
  points: MotionPoints,
  skeleton: Skeleton,
  plan: Plan,
  goals: readonly TaskGoal[],
  ground: readonly [Float64Array, Float64Array],
): { near: number | null; wide: number | null } {
  const { frames } = points;
  if (frames < 12) return { near: null, wide: null };
  const seated = new Uint8Array(frames);
  for (const t of plan.tasks) {
    if (goals.find((g) => g.id === t.id)?.category !== "sit") continue;
    seated.fill(1, Math.max(0, Math.round(t.contact * 60)), Math.min(frames, Math.round(t.end * 60)));
  }
  const load = new Float64Array(frames);
  const zmp = zeroMomentPoint(smoothed(points, ground), frames, 60, 1, load);
  const hull = createHull(16);
  const nearest = new Float64Array(2);
  let near = 0;
  let wide = 0;
  let count = 0;
  const corners: number[] = [];
  for (let f = EDGE; f < frames - EDGE; f++) {
    if (seated[f]) {
      count++;
      near++;
      wide++;
      continue;
    }
    supportPoints(corners, points, skeleton, f);
    if (corners.length === 0 || load[f] < LIGHT) continue;
    count++;
    convexHull(hull, corners, corners.length / 2);
    const d = nearestInHull(nearest, hull, zmp[2 * f], zmp[2 * f + 1]);
    if (d <= 0.01) near++;
    if (d <= 0.05) wide++;
  }
  if (count === 0) return { near: null, wide: null };
  return { near: near / count, wide: wide / count };
}

/** What gait laboratories keep of a marker's way, Hz. */
const CUTOFF = 6;

/** Joints after a low-pass, with their heights over the ground of the feet that are down. */
function smoothed(points: MotionPoints, ground: readonly [Float64Array, Float64Array]): Float64Array {
  const [left, right] = ground;
  const out = Float64Array.from(points.joints);
  const row = out.length / points.frames;
  for (let k = 0; k < row; k++) lowPass(out, k, row, points.frames, 60, CUTOFF);
  for (let f = 0; f < points.frames; f++) {
    const l = (points.contacts[f] & 3) !== 0;
    const r = (points.contacts[f] & 12) !== 0;
    const y = l === r ? (left[f] + right[f]) / 2 : l ? left[f] : right[f];
    if (y !== 0) for (let k = 1; k < row; k += 3) out[f * row + k] -= y;
  }
  return out;
}

/** Ground points of the planted patches with their width: x, z pairs. */
function supportPoints(out: number[], points: MotionPoints, skeleton: Skeleton, f: number): void {
  out.length = 0;
  const base = skeleton.foot.ballForward;
  for (let side = 0; side < 2; side++) {
    const bits = (points.contacts[f] >> (2 * side)) & 3;
    if (bits === 0) continue;
    const o = (2 * f + side) * 9;
    const s = points.soles;
    let dx = s[o + 3] - s[o];
    let dz = s[o + 5] - s[o + 2];
    const n = Math.hypot(dx, dz) || 1;
    dx /= n;
    dz /= n;
    for (let k = 0; k < 3; k++) {
      if (k === 0 ? !(bits & 1) : !(bits & 2)) continue;
      const w = WIDTH[k] * base;
      out.push(
        s[o + 3 * k] + dz * w,
        s[o + 3 * k + 2] - dx * w,
        s[o + 3 * k] - dz * w,
        s[o + 3 * k + 2] + dx * w,
      );
    }
  }
}
