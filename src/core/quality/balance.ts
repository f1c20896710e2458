/** Balance: the zero-moment point of the body's masses against the planted soles [DESIGN of motion quality; Winter's masses]. */
import { convexHull, createHull, nearestInHull } from "../math/hull.ts";
import type { Skeleton } from "../skeleton/skeleton.ts";
import { zeroMomentPoint } from "../skeleton/zero-moment.ts";
import type { Plan } from "../tasks/plan-types.ts";
import type { TaskGoal } from "../tasks/transition.ts";
import type { MotionPoints } from "./measure.ts";

/** Half width of the support under heel, ball and tip, shares of the ankle-to-ball distance. */
const WIDTH = [0.2, 0.32, 0.25];

/** Shares of frames with the zero-moment point within 1 cm and 5 cm of the support; seated frames count as supported. */
export function balanceShares(
  points: MotionPoints,
  skeleton: Skeleton,
  plan: Plan,
  goals: readonly TaskGoal[],
): { near: number | null; wide: number | null } {
  const { frames, joints } = points;
  if (frames < 12) return { near: null, wide: null };
  const seated = new Uint8Array(frames);
  for (const t of plan.tasks) {
    if (goals.find((g) => g.id === t.id)?.category !== "sit") continue;
    seated.fill(1, Math.max(0, Math.round(t.contact * 60)), Math.min(frames, Math.round(t.end * 60)));
  }
  const zmp = zeroMomentPoint(joints, frames, 60, 3);
  const hull = createHull(16);
  const nearest = new Float64Array(2);
  let near = 0;
  let wide = 0;
  let count = 0;
  const corners: number[] = [];
  for (let f = 3; f < frames - 3; f++) {
    count++;
    if (seated[f]) {
      near++;
      wide++;
      continue;
    }
    supportPoints(corners, points, skeleton, f);
    if (corners.length === 0) continue;
    convexHull(hull, corners, corners.length / 2);
    const d = nearestInHull(nearest, hull, zmp[2 * f], zmp[2 * f + 1]);
    if (d <= 0.01) near++;
    if (d <= 0.05) wide++;
  }
  return { near: near / count, wide: wide / count };
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
