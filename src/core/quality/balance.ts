/** Balance: the zero-moment point of the body's masses against the planted soles [DESIGN of motion quality; Winter's masses]. */
import { JOINT_COUNT } from "../skeleton/joints.ts";
import { MASSES } from "../skeleton/masses.ts";
import type { Skeleton } from "../skeleton/skeleton.ts";
import type { Plan } from "../tasks/plan-types.ts";
import type { TaskGoal } from "../tasks/transition.ts";
import type { MotionPoints } from "./measure.ts";

const G = 9.81;
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
  const zmp = zeroMoment(joints, frames);
  let near = 0;
  let wide = 0;
  let count = 0;
  const hull: number[] = [];
  for (let f = 3; f < frames - 3; f++) {
    count++;
    if (seated[f]) {
      near++;
      wide++;
      continue;
    }
    supportPoints(hull, points, skeleton, f);
    if (hull.length === 0) continue;
    const d = distanceToHull(hull, zmp[2 * f], zmp[2 * f + 1]);
    if (d <= 0.01) near++;
    if (d <= 0.05) wide++;
  }
  return { near: near / count, wide: wide / count };
}

function zeroMoment(joints: Float64Array, frames: number): Float64Array {
  const n = MASSES.length;
  const at = new Float64Array(3 * n * frames);
  for (let f = 0; f < frames; f++) {
    for (let m = 0; m < n; m++) {
      const [, from, to, u] = MASSES[m];
      for (let k = 0; k < 3; k++)
        at[3 * (f * n + m) + k] =
          joints[3 * (JOINT_COUNT * f + from) + k] * (1 - u) + joints[3 * (JOINT_COUNT * f + to) + k] * u;
    }
  }
  const out = new Float64Array(2 * frames);
  const row = 3 * n;
  // Acceleration over +-3 frames: a parabola's, which leaves what is under about 6 Hz.
  const h = 3;
  const rate = (60 / h) ** 2;
  for (let f = 0; f < frames; f++) {
    const i = Math.max(h, Math.min(frames - 1 - h, f));
    let nx = 0;
    let nz = 0;
    let weight = 0;
    for (let m = 0; m < n; m++) {
      const o = i * row + 3 * m;
      const a = (k: number) => (at[o + h * row + k] - 2 * at[o + k] + at[o - h * row + k]) * rate;
      const share = MASSES[m][0];
      const g = share * (G + a(1));
      const here = f * row + 3 * m;
      weight += g;
      nx += g * at[here] - share * at[here + 1] * a(0);
      nz += g * at[here + 2] - share * at[here + 1] * a(2);
    }
    out[2 * f] = nx / weight;
    out[2 * f + 1] = nz / weight;
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

/** Distance from a point to the convex hull of some points; 0 inside. */
function distanceToHull(flat: readonly number[], x: number, z: number): number {
  const points: [number, number][] = [];
  for (let i = 0; i < flat.length; i += 2) points.push([flat[i], flat[i + 1]]);
  points.sort((a, b) => a[0] - b[0] || a[1] - b[1]);
  const cross = (o: [number, number], a: [number, number], b: [number, number]) =>
    (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0]);
  const half = (list: [number, number][]) => {
    const h: [number, number][] = [];
    for (const p of list) {
      while (h.length >= 2 && cross(h[h.length - 2], h[h.length - 1], p) <= 0) h.pop();
      h.push(p);
    }
    h.pop();
    return h;
  };
  const hull = [...half(points), ...half([...points].reverse())];
  let inside = hull.length > 2;
  let best = Number.POSITIVE_INFINITY;
  for (let i = 0; i < hull.length; i++) {
    const a = hull[i];
    const b = hull[(i + 1) % hull.length];
    if (cross(a, b, [x, z]) < 0) inside = false;
    const ex = b[0] - a[0];
    const ez = b[1] - a[1];
    const l = ex * ex + ez * ez || 1e-12;
    const t = Math.max(0, Math.min(1, ((x - a[0]) * ex + (z - a[1]) * ez) / l));
    best = Math.min(best, Math.hypot(x - a[0] - t * ex, z - a[1] - t * ez));
  }
  return inside ? 0 : best;
}
