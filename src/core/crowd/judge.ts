/**
 * What a step is worth among others: whether it is free, and what nearness adds to its cost. Everybody's poses are compared at
 * the same moments, a tenth of a second apart [Footsteps §3.3, space-time collision model].
 */
import { bodyGap, clearOfWalls, feetMeet, leastSquare, REACH } from "./bodies.ts";
import { type Ground, ROAM, roamsFree } from "./ground.ts";
import { evaluateMoments, MOMENT, STOP_TIME } from "./locomotion.ts";
import type { Search } from "./planner.ts";
import { boundAt, type Sight, toldAt } from "./sight.ts";
import { KIND, P, POSE, S } from "./state.ts";
import { BODY_RADIUS, type Gait } from "./types.ts";

/** Ticks between samples. */
const STRIDE = 2;
/** Samples of what others are bound to do; and of what they say, over the horizon and the step that crosses it. */
const BOUND_SAMPLES = 14;
/** Of what they say every other one is enough for a cost: so many, of x, z, facing x, z. */
const TOLD_SAMPLES = 20;
const TOLD_POSE = 4;
/** Others that are looked at: the nearest within the visual field. */
export const MOST_OTHERS = 26;
/** Of these, whose nearness costs. */
const MOST_NEAR = 12;
/** Gap kept between bodies, metres. */
const MARGIN = 0.03;
/** Gap within which another's nearness costs, and what a predicted touch costs, J/kg each 0.2 s. */
const SPACE = 0.3;
const SPACE_COST = 0.24;
const TOUCH_COST = 5;
const HOPELESS = 12;
/** What others say is less and less sure: the share of the cost lost each second. */
const UNSURE = 0.2;
/** Distance of middles within which bodies may be as near as that, and of the nearest circles' middles. */
const NEAR = REACH + SPACE;
const COSTS = SPACE + 2 * BODY_RADIUS;
/** Of `nearness`: nobody is left to look at. */
export const ALL = 255;
/** Samples after a step's end within which all others have come to rest. */
const SETTLED = 8;

/** Others' poses over the samples, and boxes round where their middles are bound to go: x0, x1, z0, z1. */
export interface Others {
  count: number;
  bound: Float64Array;
  boundBox: Float64Array;
  /** What the nearest say. */
  told: Float64Array;
  /** What nearness to each counts: more to those who go first. */
  weight: Float64Array;
  /** Nearest gap now, to tell who overlaps from the start. */
  now: Float64Array;
  /** Time from which samples are counted. */
  clock: Float64Array;
  /** Of `nearness`: the cost so far, and the cost at which it may stop. */
  sum: Float64Array;
}

export const createOthers = (): Others => ({
  count: 0,
  bound: new Float64Array(MOST_OTHERS * BOUND_SAMPLES * POSE),
  boundBox: new Float64Array(MOST_OTHERS * 4),
  told: new Float64Array(MOST_NEAR * TOLD_SAMPLES * TOLD_POSE),
  weight: new Float64Array(MOST_OTHERS).fill(1),
  now: new Float64Array(MOST_OTHERS),
  clock: new Float64Array(1),
  sum: new Float64Array(2),
});

const mine = new Float64Array(3 * BOUND_SAMPLES * POSE);

/** Takes down where the first `count` of those seen will be from `tick` on. */
export function seeOthers(
  others: Others,
  sight: Sight,
  seen: ArrayLike<number>,
  count: number,
  tick: number,
): void {
  others.count = Math.min(MOST_OTHERS, count);
  const { told } = others;
  for (let i = 0; i < others.count; i++) {
    noteBound(others, i, sight, seen[i], tick);
    if (i >= MOST_NEAR) continue;
    for (let k = 0; k < TOLD_SAMPLES; k++) {
      const from = toldAt(sight, seen[i], tick + 2 * STRIDE * k);
      const o = (i * TOLD_SAMPLES + k) * TOLD_POSE;
      for (let m = 0; m < TOLD_POSE; m++) told[o + m] = sight.told[from + m];
    }
  }
}

function noteBound(others: Others, i: number, sight: Sight, walker: number, tick: number): void {
  const { bound, boundBox } = others;
  let x0 = Number.POSITIVE_INFINITY;
  let x1 = Number.NEGATIVE_INFINITY;
  let z0 = Number.POSITIVE_INFINITY;
  let z1 = Number.NEGATIVE_INFINITY;
  for (let k = 0; k < BOUND_SAMPLES; k++) {
    const from = boundAt(sight, walker, tick + STRIDE * k);
    const o = (i * BOUND_SAMPLES + k) * POSE;
    for (let m = 0; m < POSE; m++) bound[o + m] = sight.bound[from + m];
    const x = bound[o];
    const z = bound[o + 1];
    if (x < x0) x0 = x;
    if (x > x1) x1 = x;
    if (z < z0) z0 = z;
    if (z > z1) z1 = z;
  }
  boundBox[4 * i] = x0;
  boundBox[4 * i + 1] = x1;
  boundBox[4 * i + 2] = z0;
  boundBox[4 * i + 3] = z1;
}

/** Notes from when and where all is judged, and who is too near already: they may part, not come nearer. */
export function startJudging(others: Others, state: Float64Array, o: number): void {
  others.clock[0] = state[o + S.time];
  mine[0] = state[o + S.x];
  mine[1] = state[o + S.z];
  mine[2] = state[o + S.faceX];
  mine[3] = state[o + S.faceZ];
  for (let i = 0; i < others.count; i++)
    others.now[i] = bodyGap(mine, 0, others.bound, i * BOUND_SAMPLES * POSE, 0.5);
}

/**
 * What nearness to others adds to a step's cost, J/kg; -1 when it is not free: a wall is in the way or, for the first step, somebody
 * is or could not be avoided by stopping after it.
 */
export function costOfStep(
  others: Others,
  steps: Float64Array,
  p: number,
  first: boolean,
  search: Search,
): number {
  if (!isFree(others, steps, p, first, search)) return -1;
  others.sum[0] = 0;
  others.sum[1] = Number.POSITIVE_INFINITY;
  nearness(others, steps, p, search.gait, 0);
  return others.sum[0];
}

/** Whether a step meets no wall and, where it is the first one, nobody; nor would stopping after that. */
export function isFree(
  others: Others,
  steps: Float64Array,
  p: number,
  first: boolean,
  search: Search,
): boolean {
  const { ground, gait } = search;
  if (!first && (search.inWall || strollsFree(ground, steps, p))) return true;
  const time = others.clock[0];
  const begin = Math.round((steps[p + P.start] - time) / MOMENT);
  const end = Math.round((steps[p + P.start] + steps[p + P.duration] - time) / MOMENT);
  const kind = steps[p + P.kind];
  const moves = kind === KIND.walk || kind === KIND.start;
  const rest = first && moves ? Math.ceil(STOP_TIME / MOMENT) : 0;
  if (first && kind === KIND.walk && !footfallFree(others, steps, p)) return false;
  let x0 = Number.POSITIVE_INFINITY;
  let x1 = Number.NEGATIVE_INFINITY;
  let z0 = Number.POSITIVE_INFINITY;
  let z1 = Number.NEGATIVE_INFINITY;
  const last = end + rest;
  evaluateMoments(mine, 0, steps, p, others.clock, begin + 1, last, 1, gait);
  for (let k = begin + 1; k <= last; k++) {
    const o = (k - begin - 1) * POSE;
    if (!search.inWall && !clearOfWalls(ground, mine, o)) return false;
    const x = mine[o];
    const z = mine[o + 1];
    if (x < x0) x0 = x;
    if (x > x1) x1 = x;
    if (z < z0) z0 = z;
    if (z > z1) z1 = z;
  }
  return !first || freeOfOthers(others, begin, last, end + SETTLED, x0, x1, z0, z1);
}

/** Whether a step is so short and walls so far that there is nothing to look at. */
function strollsFree(ground: Ground, steps: Float64Array, p: number): boolean {
  if (!roamsFree(ground, steps[p + P.x], steps[p + P.z])) return false;
  const along = steps[p + P.along];
  // A parabola goes a quarter of its time and speed to the side; what stops goes less far than it would go on.
  const far =
    steps[p + P.kind] === KIND.shift ? along : (along + steps[p + P.toFoot] / 4) * steps[p + P.duration];
  return far <= ROAM;
}

/**
 * Whether the foot that lands as a first step begins meets none that stands there still: by the first moment that is looked at otherwise
 * that one may have gone.
 */
function footfallFree(others: Others, steps: Float64Array, p: number): boolean {
  const { bound, now } = others;
  mine[0] = steps[p + P.x];
  mine[1] = steps[p + P.z];
  mine[4] = steps[p + P.footX];
  mine[5] = steps[p + P.footZ];
  for (let i = 0; i < others.count; i++)
    if (now[i] > 0 && feetMeet(mine, 0, bound, i * BOUND_SAMPLES * POSE)) return false;
  return true;
}

/** Whether a first step and the rest after it touch nobody's step and rest. */
function freeOfOthers(
  others: Others,
  begin: number,
  last: number,
  settled: number,
  x0: number,
  x1: number,
  z0: number,
  z1: number,
): boolean {
  const near = REACH + MARGIN;
  // A planted foot is in front of its body.
  const far = near + 0.2;
  const { bound, boundBox } = others;
  for (let i = 0; i < others.count; i++) {
    const b = 4 * i;
    if (
      boundBox[b] > x1 + far ||
      boundBox[b + 1] < x0 - far ||
      boundBox[b + 2] > z1 + far ||
      boundBox[b + 3] < z0 - far
    )
      continue;
    for (let k = begin + 1; k <= settled; k++) {
      const m = ((k < last ? k : last) - begin - 1) * POSE;
      const o = (i * BOUND_SAMPLES + (k < BOUND_SAMPLES ? k : BOUND_SAMPLES - 1)) * POSE;
      const dx = bound[o] - mine[m];
      const dz = bound[o + 1] - mine[m + 1];
      const d2 = dx * dx + dz * dz;
      if (d2 > far * far) continue;
      if (d2 < near * near) {
        const gap = bodyGap(mine, m, bound, o, MARGIN);
        if (gap < MARGIN && gap < others.now[i] + 0.002) return false;
      }
      if (others.now[i] > 0 && feetMeet(mine, m, bound, o)) return false;
    }
  }
  return true;
}

/**
 * Cost of nearness to where others say that they will be, the nearest others first.
 *
 * It only grows from one to the next, so whoever needs no more than a bound can stop early, and go on from there later: the sum is
 * the same, bit for bit. It is added to `others.sum[0]` until that is over `others.sum[1]`.
 *
 * @param from the first other to look at. @returns the first that was not looked at, or ALL.
 */
export function nearness(others: Others, steps: Float64Array, p: number, gait: Gait, from: number): number {
  const { told, weight, clock } = others;
  const count = others.count < MOST_NEAR ? others.count : MOST_NEAR;
  if (from >= count) return ALL;
  const time = clock[0];
  const begin = Math.round((steps[p + P.start] - time) / MOMENT);
  const end = Math.round((steps[p + P.start] + steps[p + P.duration] - time) / MOMENT);
  // Samples k are moments 2 k: those after the beginning up to the end.
  const k0 = (begin + 1 + ((begin + 1) & 1)) >> 1;
  const k1 = end >> 1 < TOLD_SAMPLES ? end >> 1 : TOLD_SAMPLES - 1;
  evaluateMoments(mine, 0, steps, p, clock, 2 * k0, 2 * k1, 2, gait);
  const enough = others.sum[1];
  let sum = others.sum[0];
  for (let i = from; i < count; i++) {
    let o = (i * TOLD_SAMPLES + k0) * TOLD_POSE;
    for (let k = k0, m = 0; k <= k1; k++, m += POSE, o += TOLD_POSE) {
      const dx = told[o] - mine[m];
      const dz = told[o + 1] - mine[m + 1];
      const d2 = dx * dx + dz * dz;
      if (d2 > NEAR * NEAR) continue;
      const least = leastSquare(dx, dz, d2, mine[m + 2], mine[m + 3], told[o + 2], told[o + 3]);
      if (least >= COSTS * COSTS) continue;
      const gap = Math.sqrt(least > 0 ? least : 0) - 2 * BODY_RADIUS;
      if (gap >= MARGIN) sum += SPACE_COST * weight[i] * (1 - gap / SPACE);
      else {
        const sure = 1 - 2 * UNSURE * k * MOMENT;
        sum += TOUCH_COST * (sure > 0.2 ? sure : 0.2);
        // Nobody goes on through that: how much worse it gets does not matter.
        if (sum > HOPELESS) {
          others.sum[0] = sum;
          return ALL;
        }
      }
    }
    if (sum > enough && i + 1 < count) {
      others.sum[0] = sum;
      return i + 1;
    }
  }
  others.sum[0] = sum;
  return ALL;
}
