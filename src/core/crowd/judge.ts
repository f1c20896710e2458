/**
 * What a step is worth among others: whether it is free, and what nearness adds to its cost. Everybody's poses are compared at
 * the same moments, a tenth of a second apart [Footsteps §3.3, space-time collision model].
 */
import { bodyGap, clearOfWalls, feetMeet, REACH } from "./bodies.ts";
import { evaluateStep, STOP_TIME } from "./locomotion.ts";
import type { Search } from "./planner.ts";
import { boundAt, type Sight, toldAt } from "./sight.ts";
import { KIND, P, POSE, S } from "./state.ts";
import { BODY_RADIUS, SHOULDER } from "./types.ts";

const SAMPLE = 0.1;
/** Ticks between samples. */
const STRIDE = 2;
/** Samples of what others say, over the horizon and the step that crosses it; and of what they are bound to do. */
const SAMPLES = 39;
const BOUND_SAMPLES = 14;
/** Others that are looked at: the nearest within the visual field. */
export const MOST_OTHERS = 18;
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
/** Samples in one window of a walker's boxes. */
const WINDOW = 5;
const WINDOWS = Math.ceil(SAMPLES / WINDOW);
/** Samples after a step's end within which all others have come to rest. */
const SETTLED = 8;

/** Others' poses over the samples, and boxes round where their middles go: x0, x1, z0, z1. */
export interface Others {
  count: number;
  bound: Float64Array;
  boundBox: Float64Array;
  told: Float64Array;
  toldBox: Float64Array;
  /** What nearness to each counts: more to those who go first. */
  weight: Float64Array;
  /** Nearest gap now, to tell who overlaps from the start. */
  now: Float64Array;
}

export const createOthers = (): Others => ({
  count: 0,
  bound: new Float64Array(MOST_OTHERS * BOUND_SAMPLES * POSE),
  boundBox: new Float64Array(MOST_OTHERS * 4),
  told: new Float64Array(MOST_OTHERS * SAMPLES * POSE),
  toldBox: new Float64Array(MOST_OTHERS * WINDOWS * 4),
  weight: new Float64Array(MOST_OTHERS).fill(1),
  now: new Float64Array(MOST_OTHERS),
});

const mine = new Float64Array((SAMPLES + BOUND_SAMPLES) * POSE);

/** Copies `count` poses `STRIDE` ticks apart and boxes them. */
function copyPoses(
  to: Float64Array,
  o: number,
  box: Float64Array,
  b: number,
  from: Float64Array,
  at: (k: number) => number,
  first: number,
  count: number,
): void {
  let x0 = Number.POSITIVE_INFINITY;
  let x1 = Number.NEGATIVE_INFINITY;
  let z0 = Number.POSITIVE_INFINITY;
  let z1 = Number.NEGATIVE_INFINITY;
  for (let k = first; k < first + count; k++) {
    const i = at(k);
    const q = o + (k - first) * POSE;
    const x = from[i];
    const z = from[i + 1];
    to[q] = x;
    to[q + 1] = z;
    to[q + 2] = from[i + 2];
    to[q + 3] = from[i + 3];
    to[q + 4] = from[i + 4];
    to[q + 5] = from[i + 5];
    if (x < x0) x0 = x;
    if (x > x1) x1 = x;
    if (z < z0) z0 = z;
    if (z > z1) z1 = z;
  }
  box[b] = x0;
  box[b + 1] = x1;
  box[b + 2] = z0;
  box[b + 3] = z1;
}

/** Takes down where the first `count` of those seen will be from `tick` on. */
export function seeOthers(
  others: Others,
  sight: Sight,
  seen: ArrayLike<number>,
  count: number,
  tick: number,
): void {
  others.count = Math.min(MOST_OTHERS, count);
  for (let i = 0; i < others.count; i++) {
    const w = seen[i];
    copyPoses(
      others.bound,
      i * BOUND_SAMPLES * POSE,
      others.boundBox,
      4 * i,
      sight.bound,
      (k) => boundAt(sight, w, tick + STRIDE * k),
      0,
      BOUND_SAMPLES,
    );
    for (let n = 0; n < WINDOWS; n++)
      copyPoses(
        others.told,
        (i * SAMPLES + n * WINDOW) * POSE,
        others.toldBox,
        4 * (i * WINDOWS + n),
        sight.told,
        (k) => toldAt(sight, w, tick + STRIDE * k),
        n * WINDOW,
        Math.min(WINDOW, SAMPLES - n * WINDOW),
      );
  }
}

/** Notes who is too near already: they may part, not come nearer. */
export function startJudging(others: Others, state: Float64Array, o: number): void {
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
  const { time, ground } = search;
  const begin = Math.round((steps[p + P.start] - time) / SAMPLE);
  const end = Math.round((steps[p + P.start] + steps[p + P.duration] - time) / SAMPLE);
  const kind = steps[p + P.kind];
  const moves = kind === KIND.walk || kind === KIND.start;
  const rest = first && moves ? Math.ceil(STOP_TIME / SAMPLE) : 0;
  const { footAside } = search.gait;
  let x0 = Number.POSITIVE_INFINITY;
  let x1 = Number.NEGATIVE_INFINITY;
  let z0 = Number.POSITIVE_INFINITY;
  let z1 = Number.NEGATIVE_INFINITY;
  const last = end + rest;
  for (let k = begin + 1; k <= last; k++) {
    const o = (k - begin - 1) * POSE;
    evaluateStep(mine, o, steps, p, time + k * SAMPLE, footAside);
    if (!search.inWall && !clearOfWalls(ground, mine, o)) return -1;
    const x = mine[o];
    const z = mine[o + 1];
    if (x < x0) x0 = x;
    if (x > x1) x1 = x;
    if (z < z0) z0 = z;
    if (z > z1) z1 = z;
  }
  if (first && !freeOfOthers(others, begin, last, end + SETTLED, x0, x1, z0, z1)) return -1;
  return nearness(others, begin, Math.min(end, SAMPLES - 1), x0, x1, z0, z1);
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

/** Cost of nearness to where others say that they will be. */
function nearness(
  others: Others,
  begin: number,
  end: number,
  x0: number,
  x1: number,
  z0: number,
  z1: number,
): number {
  const near = REACH + SPACE;
  const { told, toldBox } = others;
  const w0 = Math.floor((begin + 1) / WINDOW);
  const w1 = Math.floor(end / WINDOW);
  let cost = 0;
  const count = others.count < MOST_NEAR ? others.count : MOST_NEAR;
  for (let i = 0; i < count; i++) {
    for (let w = w0; w <= w1; w++) {
      const b = 4 * (i * WINDOWS + w);
      if (
        toldBox[b] > x1 + near ||
        toldBox[b + 1] < x0 - near ||
        toldBox[b + 2] > z1 + near ||
        toldBox[b + 3] < z0 - near
      )
        continue;
      // Every other moment is enough for a cost.
      const from = w * WINDOW > begin ? w * WINDOW : begin + 1;
      const k0 = from + (from & 1);
      const k1 = (w + 1) * WINDOW - 1 < end ? (w + 1) * WINDOW - 1 : end;
      for (let k = k0; k <= k1; k += 2) {
        const m = (k - begin - 1) * POSE;
        const o = (i * SAMPLES + k) * POSE;
        const dx = told[o] - mine[m];
        const dz = told[o + 1] - mine[m + 1];
        const d2 = dx * dx + dz * dz;
        if (d2 > near * near) continue;
        // Both bodies' extents along the line between them: the gap is never less than what they leave.
        const across =
          Math.abs(dx * mine[m + 3] - dz * mine[m + 2]) + Math.abs(dx * told[o + 3] - dz * told[o + 2]);
        if (d2 - SHOULDER * across >= (SPACE + 2 * BODY_RADIUS) * Math.sqrt(d2)) continue;
        const gap = bodyGap(mine, m, told, o, SPACE);
        if (gap >= SPACE) continue;
        if (gap >= MARGIN) cost += SPACE_COST * others.weight[i] * (1 - gap / SPACE);
        else {
          const sure = 1 - UNSURE * k * SAMPLE;
          cost += TOUCH_COST * (sure > 0.2 ? sure : 0.2);
          // Nobody goes on through that: how much worse it gets does not matter.
          if (cost > HOPELESS) return cost;
        }
      }
    }
  }
  return cost;
}
