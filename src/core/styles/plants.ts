/**
 * Foot-plants of an unlabelled sample [Express §5.1]: ankle and ball smoothed, then low and slow, then a neighbours' vote.
 *
 * The paper looks at the ankle alone and lets the new ankle path replace the toe-off. Here the ball counts too, so that a
 * plant lasts until the toes leave; our planted foot rolls in closed form (core/motion/sole.ts).
 */
import type { Clip } from "../capture/clip.ts";
import { savitzkyGolay } from "../math/savitzky-golay.ts";
import { forwardKinematics } from "../skeleton/forward-kinematics.ts";
import { J, JOINT_COUNT } from "../skeleton/joints.ts";

/** A plant: first frame and one past the last. */
export interface Plant {
  from: number;
  to: number;
}

/** Share of the vertical range under which a point is low [Express §5.1: 10 to 20 %]. */
const LOW = 0.2;
/** Share of the body's mean speed under which a point is slow, and its bounds in metres a second. */
const SLOW = 0.33;
const SLOWEST = 0.2;
const FASTEST = 1.1;
/** Half window of the smoothing, frames at 60 Hz: about 0.1 s as in the paper. */
const HALF = 2;
/** Shortest plant and shortest gap between plants of one foot, seconds. */
const SHORTEST = 0.08;

/** Foot-plants of both feet, left first, in order of time. A clip of fewer than five frames has none. */
export function detectPlants(clip: Clip): [Plant[], Plant[]] {
  const n = clip.frames;
  if (n < 5) return [[], []];
  const raw = new Float64Array(12 * n);
  const p = new Float64Array(3 * JOINT_COUNT);
  const w = new Float64Array(4 * JOINT_COUNT);
  for (let f = 0; f < n; f++) {
    forwardKinematics(p, w, clip.skeleton, clip.root, 3 * f, clip.rotations, 4 * JOINT_COUNT * f);
    [J.leftFoot, J.leftToes, J.rightFoot, J.rightToes].forEach((joint, k) => {
      for (let c = 0; c < 3; c++) raw[12 * f + 3 * k + c] = p[3 * joint + c];
    });
  }
  const points = savitzkyGolay(raw, 12, HALF);
  const way = Math.hypot(clip.root[3 * n - 3] - clip.root[0], clip.root[3 * n - 1] - clip.root[2]);
  const speed = (way / (n - 1)) * clip.rate;
  const slow = Math.max(SLOWEST, Math.min(FASTEST, SLOW * speed));
  const shortest = Math.max(2, Math.round(SHORTEST * clip.rate));
  return [0, 1].map((side) => {
    const bits = new Uint8Array(n);
    for (const k of [2 * side, 2 * side + 1]) {
      let low = Number.POSITIVE_INFINITY;
      let high = Number.NEGATIVE_INFINITY;
      for (let f = 0; f < n; f++) {
        low = Math.min(low, points[12 * f + 3 * k + 1]);
        high = Math.max(high, points[12 * f + 3 * k + 1]);
      }
      const limit = low + LOW * (high - low) + 0.008;
      for (let f = 0; f < n; f++) {
        const a = 12 * Math.max(0, f - 1) + 3 * k;
        const b = 12 * Math.min(n - 1, f + 1) + 3 * k;
        const span = Math.min(n - 1, f + 1) - Math.max(0, f - 1);
        const v =
          (Math.hypot(points[b] - points[a], points[b + 1] - points[a + 1], points[b + 2] - points[a + 2]) *
            clip.rate) /
          span;
        if (points[12 * f + 3 * k + 1] <= limit && v <= slow) bits[f] = 1;
      }
    }
    vote(bits);
    return plantsOf(bits, shortest);
  }) as [Plant[], Plant[]];
}

/**
 * Noisy frames join a plant when most of their neighbours are in one; N_f is a quarter of the plants' mean length
 * [Express §5.1].
 */
function vote(bits: Uint8Array): void {
  const runs = plantsOf(bits, 1);
  if (runs.length === 0) return;
  const mean = runs.reduce((s, r) => s + r.to - r.from, 0) / runs.length;
  const half = Math.max(1, Math.min(6, Math.round(mean / 4)));
  const copy = bits.slice();
  for (let f = 0; f < bits.length; f++) {
    if (copy[f]) continue;
    let sum = 0;
    for (let k = -half; k <= half; k++) {
      const g = f + k;
      if (g >= 0 && g < bits.length && copy[g]) sum++;
    }
    if (sum / (2 * half + 1) > 0.5) bits[f] = 1;
  }
}

function plantsOf(bits: Uint8Array, shortest: number): Plant[] {
  const out: Plant[] = [];
  for (let f = 0; f < bits.length; f++) {
    if (!bits[f]) continue;
    let to = f;
    while (to < bits.length && bits[to]) to++;
    const last = out[out.length - 1];
    if (last && f - last.to < shortest) last.to = to;
    else out.push({ from: f, to });
    f = to;
  }
  return out.filter((p) => p.to - p.from >= shortest);
}
