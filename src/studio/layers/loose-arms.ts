/**
 * Arms that hang: outside the walk's own swing each is a damped pendulum under a shoulder that is carried along, so that
 * hands stay behind when the body sets off, swing on when it stops, and forearms follow upper arms.
 */

import { CLIP_RATE } from "../../core/capture/clip.ts";
import { GRAVITY } from "../../core/math/gravity.ts";
import { gaussian, smoothstep } from "../../core/math/interpolate.ts";
import type { BodyAngles } from "./body.ts";
import type { Gait } from "./gait.ts";

const DEG = Math.PI / 180;
/** Radians a second of a hanging arm (0.8 Hz: a compound pendulum of 0.4 m), and its damping by muscles and skin. */
const RATE = 5;
const DAMPING = 0.5;
/** Share of a passive pendulum's swing that relaxed muscles let through. */
const LOOSE = 0.85;
/** The hips' sides keep an arm from swinging in, the elbow from opening beyond. */
const LEAST_OUT = 4 * DEG;
const LEAST_ELBOW = 7 * DEG;
/** Frames by which the forearm follows. */
const ELBOW_LAG = 7;

/** What of a change is taken: all of it outwards; inwards less and less, never beyond the least value. */
function swingIn(value: number, change: number, least: number): number {
  if (change >= 0) return change;
  const room = Math.max(0, value - least);
  return room > 0 ? -room * (1 - Math.exp(change / room)) : 0;
}

/** Swings the arms by the way of the body, x, z a frame. Mutates the angles. */
export function loosenArms(body: BodyAngles, gait: Gait, way: Float64Array): void {
  const frames = gait.amount.length;
  const push = new Float64Array(2 * frames);
  for (let f = 1; f + 1 < frames; f++)
    for (let k = 0; k < 2; k++)
      push[2 * f + k] =
        (way[2 * f + 2 + k] - 2 * way[2 * f + k] + way[2 * f - 2 + k]) * CLIP_RATE * CLIP_RATE;
  gaussian(push, 2, 3);
  body.arms.forEach((arm, side) => {
    const sign = side === 0 ? 1 : -1;
    // No two arms are alike.
    const rate = RATE * (1 + 0.04 * sign);
    const angle = [0, 0];
    const speed = [0, 0];
    const forward = new Float64Array(frames);
    const across = new Float64Array(frames);
    for (let f = 0; f < frames; f++) {
      const s = Math.sin(body.chestYaw[f]);
      const c = Math.cos(body.chestYaw[f]);
      const x = push[2 * f];
      const z = push[2 * f + 1];
      const pushes = [x * c - z * s, x * s + z * c];
      for (let k = 0; k < 2; k++) {
        const turn =
          -rate * rate * (angle[k] + (LOOSE * pushes[k]) / GRAVITY) - 2 * DAMPING * rate * speed[k];
        speed[k] += turn / CLIP_RATE;
        angle[k] += speed[k] / CLIP_RATE;
      }
      // A walk swings its arms itself.
      const free = 1 - 0.9 * smoothstep(gait.amount[f] * 1.3);
      across[f] = free * angle[0];
      forward[f] = free * angle[1];
    }
    for (let f = 0; f < frames; f++) {
      arm.out[f] += swingIn(arm.out[f], sign * across[f], LEAST_OUT);
      arm.swing[f] += forward[f];
      const late = Math.max(0, f - ELBOW_LAG);
      arm.elbow[f] += swingIn(arm.elbow[f], 0.7 * forward[late] + 0.25 * Math.abs(across[late]), LEAST_ELBOW);
    }
  });
}
