/**
 * Where everybody is and will be. Each walker's poses are noted once, when it takes a step, on the ticks to come: `bound` with the
 * step under way and the stop that would follow, `told` with the plan. Others look them up.
 */
import { evaluateStep } from "./locomotion.ts";
import { P, POSE, STEP } from "./state.ts";
import { TICK } from "./types.ts";

/** Ticks noted of what is bound to come: the longest step and a stop; and of what is told. */
export const BOUND = 30;
export const TOLD = 76;
/** Steps of a plan that are told. */
export const PLAN = 8;

export interface Sight {
  bound: Float64Array;
  told: Float64Array;
  /** Tick of each walker's first pose. */
  since: Int32Array;
}

export const createSight = (walkers: number): Sight => ({
  bound: new Float64Array(walkers * BOUND * POSE),
  told: new Float64Array(walkers * TOLD * POSE),
  since: new Int32Array(walkers),
});

/** Offset of a walker's pose on a tick, as it is bound to be. */
export function boundAt(sight: Sight, walker: number, tick: number): number {
  const k = tick - sight.since[walker];
  return (walker * BOUND + (k < BOUND ? k : BOUND - 1)) * POSE;
}

/** Offset of a walker's pose on a tick, as it has said it will be. */
export function toldAt(sight: Sight, walker: number, tick: number): number {
  const k = tick - sight.since[walker];
  return (walker * TOLD + (k < TOLD ? k : TOLD - 1)) * POSE;
}

/**
 * Notes a walker's step and what is planned after it.
 *
 * @param steps the step under way first, then `planned` more, STEP numbers each, from `at` on.
 */
export function noteSteps(
  sight: Sight,
  walker: number,
  steps: Float64Array,
  at: number,
  planned: number,
  tick: number,
  footAside: number,
): void {
  sight.since[walker] = tick;
  for (let k = 0; k < BOUND; k++)
    evaluateStep(sight.bound, (walker * BOUND + k) * POSE, steps, at, (tick + k) * TICK, footAside);
  let next = 0;
  for (let k = 0; k < TOLD; k++) {
    const time = (tick + k) * TICK;
    while (next < planned && time >= steps[at + (next + 1) * STEP + P.start] - 1e-9) next++;
    evaluateStep(sight.told, (walker * TOLD + k) * POSE, steps, at + next * STEP, time, footAside);
  }
}
