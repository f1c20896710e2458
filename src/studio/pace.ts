/** How people walk and run at a speed, at the reference leg of 0.93 m. */
import type { Pace } from "./score.ts";

/** Comfortable pace at a speed, metres a second: length and time share the change, stance shortens [Grieve and Gear 1966]. */
export function paceAt(speed: number): Pick<Pace, "length" | "time" | "stance"> {
  const length = 0.635 * (speed / 1.15) ** 0.42;
  return { length, time: length / speed, stance: 0.655 - 0.06 * (speed - 1.15) };
}

/** Pace of a run at a speed: the cadence hardly changes, steps lengthen, the foot is down for less and less of the cycle. */
export function runAt(speed: number): Pick<Pace, "length" | "time" | "stance"> {
  const time = 0.384 - 0.006 * (speed - 1.9);
  return { length: speed * time, time, stance: Math.max(0.3, Math.min(0.48, 0.477 - 0.08 * (speed - 1.9))) };
}
