/**
 * Lower minima near one found [TaskLoco §5].
 *
 * The objective has more than one basin, for two reasons that can be read off a minimum:
 *
 * - **Winding.** Yaws count modulo a turn, so footsteps may reach the goal's yaw the long way round; somewhere on the way
 *   the yaw's offset from the goal passes a half turn. Turning the other way is another basin.
 * - **Mirrored steps.** Equal step lengths (eq. 13) hold on either side of a foot, so a short step may lie mirrored, with
 *   legs crossed or not.
 *
 * Starts are laid in those basins, the likeliest first. They follow from the minimum alone: no random number decides.
 */
import { wrapAngle } from "../math/angle.ts";
import type { FootstepProblem } from "./footstep-objective.ts";
import { type FootstepWorkspace, optimizeFootsteps } from "./optimize-footsteps.ts";

/** A yaw further off the goal's than this may have turned the wrong way, rad. */
const WOUND = 1.2;
/** First offset of a start that turns one way or the other, rad; halved from footstep to footstep. */
const TURN = 1.4;
/** Where footsteps are on their way to the goal's yaw, they start at most this far off it, rad. */
const NEARLY = 0.5;
/** Only steps shorter than this are tried mirrored, m. */
const SHORT = 0.35;
/** A minimum lower by less is the same one. */
const LOWER = 1e-7;

export interface BasinSearch {
  /** Value at `x` now. */
  f: number;
  /** Starts tried. */
  starts: number;
}

/**
 * Lowers a minimum by starts in other basins; `x` is written where one is lower, and the search goes on from there.
 *
 * @param x 3 n, a minimum (`optimizeFootsteps`) of value `f`; the lowest found is written.
 * @param proceed asked before every start, with the number tried so far; false ends the search. It ends by itself where no
 * start is left.
 */
export function searchOtherBasins(
  problem: FootstepProblem,
  x: Float64Array,
  f: number,
  workspace: FootstepWorkspace,
  proceed: (starts: number) => boolean,
): BasinSearch {
  let best = f;
  let starts = 0;
  for (let improved = true; improved; ) {
    improved = false;
    for (const lay of startsAround(problem, x)) {
      if (!proceed(starts)) return { f: best, starts };
      const at = lay();
      starts++;
      const found = optimizeFootsteps(problem, at, workspace).f;
      if (found < best - LOWER) {
        best = found;
        x.set(at.subarray(0, 3 * problem.n));
        improved = true;
        break;
      }
    }
  }
  return { f: best, starts };
}

/** Starts around a minimum, each laid when it is called. Pinned footsteps keep their place. */
function startsAround(p: FootstepProblem, x: Float64Array): (() => Float64Array)[] {
  const n = p.n;
  const offsets: number[] = [];
  /** The footstep at which the offset passes a half turn, the last one; 0: none does. */
  let crossing = 0;
  let far = 0;
  for (let i = 0; i < n; i++) {
    offsets.push(wrapAngle(x[3 * i + 2] - p.goalYaw));
    if (i > 0 && Math.abs(offsets[i] - offsets[i - 1]) > Math.PI) crossing = i;
    far = Math.max(far, Math.abs(offsets[i]));
  }
  const starts: (() => Float64Array)[] = [];
  // Eq. 14 is what the winding is about: without its weight there is nothing to gain.
  if (p.weights[2] > 0 && far > WOUND) {
    const way = Math.sign(offsets[0]) || 1;
    if (crossing > 0) starts.push(() => rollOut(p, x, withoutCrossing(offsets, crossing, way)));
    for (const turn of [-way, way]) starts.push(() => rollOut(p, x, turning(offsets, turn)));
  }
  const step = new Float64Array(2);
  const short: { i: number; crossed: boolean; lateral: number }[] = [];
  for (let i = 0; i < n; i++) {
    localStep(p, x, i, step);
    if (Math.hypot(step[0], step[1]) < SHORT && !p.pinned?.[i])
      short.push({ i, crossed: step[0] * p.desired[3 * i] < 0, lateral: Math.abs(step[0]) });
  }
  // Steps that cross what the template has first; then the narrowest.
  short.sort((a, b) => Number(b.crossed) - Number(a.crossed) || a.lateral - b.lateral || a.i - b.i);
  for (const { i } of short) starts.push(() => mirrored(p, x, i));
  return starts;
}

/** Offsets that come to the goal's yaw on the side where they begin, up to just after where they used to cross. */
function withoutCrossing(offsets: number[], crossing: number, way: number): number[] {
  return offsets.map((v, i) => {
    if (i > crossing + 1) return v;
    if (i < crossing - 1 && Math.abs(v) > NEARLY) return way * Math.min(Math.abs(v), TURN * 0.5 ** i);
    return Math.max(-NEARLY, Math.min(NEARLY, v));
  });
}

/** Offsets that begin on the given side and decay. */
function turning(offsets: number[], way: number): number[] {
  return offsets.map((v, i) => (Math.abs(v) > 1 || i < 3 ? way * TURN * 0.5 ** i : v));
}

/** The template's steps walked from footstep 0 with yaws at the given offsets from the goal's. */
function rollOut(p: FootstepProblem, x: Float64Array, offsets: number[]): Float64Array {
  const out = new Float64Array(3 * p.n);
  let ax = p.current[0];
  let az = p.current[1];
  let yaw = p.current[2];
  for (let i = 0; i < p.n; i++) {
    const o = 3 * i;
    if (p.pinned?.[i]) {
      ax = x[o];
      az = x[o + 1];
      yaw = x[o + 2];
    } else {
      const s = Math.sin(yaw);
      const c = Math.cos(yaw);
      ax += c * p.desired[o] + s * p.desired[o + 1];
      az += -s * p.desired[o] + c * p.desired[o + 1];
      yaw = p.goalYaw + offsets[i];
    }
    out[o] = ax;
    out[o + 1] = az;
    out[o + 2] = yaw;
  }
  return out;
}

/** Step `k` on the other side of the foot before it; the footsteps after it follow, less and less. */
function mirrored(p: FootstepProblem, x: Float64Array, k: number): Float64Array {
  const out = x.slice(0, 3 * p.n);
  const step = new Float64Array(2);
  localStep(p, x, k, step);
  const yaw = k > 0 ? x[3 * k - 1] : p.current[2];
  const dx = -2 * step[0] * Math.cos(yaw);
  const dz = 2 * step[0] * Math.sin(yaw);
  for (let i = k; i < p.n; i++) {
    if (p.pinned?.[i]) continue;
    const share = 1 - (i - k) / (p.n - k);
    out[3 * i] += share * dx;
    out[3 * i + 1] += share * dz;
  }
  return out;
}

/** Step `i` (from 0) of `x` seen from the footstep before it: lateral and forward (eq. 12). */
function localStep(p: FootstepProblem, x: Float64Array, i: number, out: Float64Array): void {
  const o = 3 * i;
  const yaw = i > 0 ? x[o - 1] : p.current[2];
  const dx = x[o] - (i > 0 ? x[o - 3] : p.current[0]);
  const dz = x[o + 1] - (i > 0 ? x[o - 2] : p.current[1]);
  const s = Math.sin(yaw);
  const c = Math.cos(yaw);
  out[0] = c * dx - s * dz;
  out[1] = s * dx + c * dz;
}
