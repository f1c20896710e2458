/**
 * The middle of mass for animation: the pendulum's hyperbola [Footsteps eq. 3, §4.1] in place of the parabola that is planned with. It
 * leaves and reaches the same places at the same times, and lingers at the apex as a walker does.
 */

import { GRAVITY } from "../math/gravity.ts";
import { exponential } from "./elementary.ts";
import { evaluateStep } from "./locomotion.ts";
import { KIND, P, POSE } from "./state.ts";
import type { Gait } from "./types.ts";

const pose = new Float64Array(POSE);

/**
 * Place and velocity of the middle of mass at a time in a step: x, z, metres a second along x, z into `out`.
 *
 * Between two places a, b relative to the foot, eqs. 1-2 have the one solution
 * x(t) = (a sinh(k (T - t)) + b sinh(k t)) / sinh(k T), k = sqrt(g / l), which is eq. 3 with the initial velocity that leads from
 * a to b. Steps that are no walking pendulum (stops, starts, shifts) are as planned.
 */
export function centreOfMass(
  out: Float64Array,
  steps: Float64Array,
  p: number,
  time: number,
  gait: Gait,
): void {
  if (steps[p + P.kind] !== KIND.walk) {
    const h = 1e-3;
    evaluateStep(pose, 0, steps, p, time + h, gait.footAside);
    const x = pose[0];
    const z = pose[1];
    evaluateStep(pose, 0, steps, p, time, gait.footAside);
    out[0] = pose[0];
    out[1] = pose[1];
    out[2] = (x - pose[0]) / h;
    out[3] = (z - pose[1]) / h;
    return;
  }
  const duration = steps[p + P.duration];
  const t = Math.max(0, Math.min(duration, time - steps[p + P.start]));
  const k = Math.sqrt(GRAVITY / gait.leg);
  const left = exponential(k * (duration - t));
  const gone = exponential(k * t);
  const whole = exponential(k * duration);
  const sinh = whole - 1 / whole;
  const a = (left - 1 / left) / sinh;
  const b = (gone - 1 / gone) / sinh;
  const da = (-k * (left + 1 / left)) / sinh;
  const db = (k * (gone + 1 / gone)) / sinh;
  for (let axis = 0; axis < 2; axis++) {
    const foot = steps[p + P.footX + axis];
    const from = steps[p + P.x + axis] - foot;
    const to = from + steps[p + P.px + axis] * steps[p + P.along] * duration;
    out[axis] = foot + a * from + b * to;
    out[2 + axis] = da * from + db * to;
  }
}
