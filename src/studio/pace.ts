/** How people walk and run at a speed, at the reference leg of 0.93 m. */
import type { Pace } from "./score.ts";

/** Comfortable pace at a speed, metres a second: length and time share the change, stance shortens [Grieve and Gear 1966]. */
export function paceAt(speed: number): Pick<Pace, "length" | "time" | "stance"> {
  const length = 0.635 * (speed / 1.15) ** 0.42;
  return { length, time: length / speed, stance: 0.655 - 0.06 * (speed - 1.15) };
}

/** Comfortable steps of the walkers in rooms: metres and seconds. */
const LENGTH = 0.635;
const TIME = 0.54;

/**
 * Time of a step that has to be short, as walks of a few steps between two places have them: less than a free walk of that
 * step length would take, which is a stroll, and more than a comfortable step. Three real slow walkers take 0.38 to 0.43 m in
 * 0.53, 0.60 and 0.88 s. The stance grows as in `paceAt`.
 *
 * @param length of the step, metres at the reference leg.
 */
export function shortStep(length: number): Pick<Pace, "time" | "stance"> {
  const time = TIME * Math.min(1.35, Math.max(1, LENGTH / Math.max(length, 0.01)) ** 0.45);
  return { time, stance: 0.625 - 0.06 * (Math.max(length, 0) / time - LENGTH / TIME) };
}

/** Pace of a run at a speed: the cadence hardly changes, steps lengthen, the foot is down for less and less of the cycle. */
export function runAt(speed: number): Pick<Pace, "length" | "time" | "stance"> {
  const time = 0.384 - 0.006 * (speed - 1.9);
  return { length: speed * time, time, stance: Math.max(0.3, Math.min(0.48, 0.477 - 0.08 * (speed - 1.9))) };
}
