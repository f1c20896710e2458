/**
 * Flight: while no foot is down the centre of mass falls freely; while one is, it follows the gait's own rise and fall.
 *
 * The height that the posed body has is the wish; the height answered is the nearest one, in the least-squares sense,
 * whose acceleration is -g wherever the body is unsupported, that of a push on the ground between two flights (its size from the
 * momentum that the flights take), and as smooth as the wish elsewhere. The push is half a sine that comes early: runners brake
 * harder than they push off, and so land lower, on a bent knee, than they leave the ground [Cavagna 2006, the landing-take-off
 * asymmetry in human running].
 */

import { CLIP_RATE } from "../../core/capture/clip.ts";
import { GRAVITY } from "../../core/math/gravity.ts";
import { unit } from "../../core/math/interpolate.ts";
import { factorBand, solveBand } from "../../core/optimize/banded-cholesky.ts";
import type { FootTrack } from "./feet.ts";

/** Weights of following the wish, of its second difference, of falling freely in flight, of the push between two flights. */
const FOLLOW = 1;
const SMOOTH = 60;
const FALL = 4e4;
const PUSH = 1500;
/** Frames of flight that make the push sure. */
const LONG_FLIGHT = 7;

/** Frames in which neither foot touches: 1; null when there is none. */
export function flightFrames(feet: readonly [FootTrack, FootTrack], frames: number): Uint8Array | null {
  const out = new Uint8Array(frames);
  let any = false;
  for (let f = 0; f < frames; f++) {
    if (feet[0].contacts[f] !== 0 || feet[1].contacts[f] !== 0) continue;
    if (feet[0].swing[f] === 0 || feet[1].swing[f] === 0) continue;
    out[f] = 1;
    any = true;
  }
  return any ? out : null;
}

/**
 * Height of the centre of mass that falls freely in flight and stays near the wish.
 *
 * @param wish height a frame, metres. @param flight from `flightFrames`.
 * @param early power of time within a stance whose half sine the push is: 1 even, less early.
 * @returns height a frame, metres.
 */
export function ballisticHeight(wish: Float64Array, flight: Uint8Array, early: number): Float64Array {
  const n = wish.length;
  const fall = -GRAVITY / (CLIP_RATE * CLIP_RATE);
  // Normal equations of a pentadiagonal least-squares problem: rows d2 y = target, weight w.
  const band = new Float64Array(3 * n);
  const right = new Float64Array(n);
  const push = pushes(flight, early);
  for (let f = 0; f < n; f++) {
    const w = flight[f] ? 0 : FOLLOW;
    band[3 * f] += w + 1e-6;
    right[f] += (w + 1e-6) * wish[f];
    if (f === 0 || f === n - 1) continue;
    const own = wish[f - 1] - 2 * wish[f] + wish[f + 1];
    const blend = (push.weight[f] - SMOOTH) / (PUSH - SMOOTH);
    const weight = flight[f] ? FALL : push.weight[f] || SMOOTH;
    const target = flight[f]
      ? fall
      : push.weight[f] > 0
        ? blend * fall * (1 - push.force[f]) + (1 - blend) * own
        : own;
    const c = [1, -2, 1];
    for (let a = 0; a < 3; a++) {
      const i = f - 1 + a;
      right[i] += weight * c[a] * target;
      for (let b = 0; b <= a; b++) band[3 * i + (a - b)] += weight * c[a] * c[b];
    }
  }
  factorBand(band, n, 3, 1e-9);
  solveBand(band, n, 3, right);
  return right;
}

/** Force on the ground over the body's weight in each stance between two flights, a half sine, and how surely; 0 elsewhere. */
function pushes(flight: Uint8Array, early: number): { force: Float64Array; weight: Float64Array } {
  const n = flight.length;
  const out = { force: new Float64Array(n), weight: new Float64Array(n) };
  const lengthFrom = (f: number, by: 1 | -1): number => {
    let k = f;
    while (k >= 0 && k < n && flight[k]) k += by;
    return Math.abs(k - f);
  };
  for (let f = 1; f < n; f++) {
    if (flight[f] || !flight[f - 1]) continue;
    let e = f;
    while (e < n && !flight[e]) e++;
    const stance = e - f;
    // Longer than a runner's stance: he has stopped.
    if (e < n && stance < 0.6 * CLIP_RATE) {
      const carried = stance + (lengthFrom(f - 1, -1) + lengthFrom(e, 1)) / 2;
      // A short hop says little about the push; a flight says it all.
      const sure = unit((carried - stance) / LONG_FLIGHT);
      let sum = 0;
      for (let k = f; k < e; k++) {
        out.force[k] = Math.sin(Math.PI * ((k - f + 0.5) / stance) ** early);
        out.weight[k] = SMOOTH + sure * sure * (PUSH - SMOOTH);
        sum += out.force[k];
      }
      for (let k = f; k < e; k++) out.force[k] *= carried / sum;
    }
    f = e - 1;
  }
  return out;
}

/** Upward acceleration over gravity of a height track: 1 at rest, 0 in free fall. */
export function loadFactor(height: Float64Array): Float64Array {
  const n = height.length;
  const out = new Float64Array(n).fill(1);
  for (let f = 1; f < n - 1; f++) {
    const a = (height[f - 1] - 2 * height[f] + height[f + 1]) * CLIP_RATE * CLIP_RATE;
    out[f] = Math.max(0, Math.min(4, 1 + a / GRAVITY));
  }
  return out;
}
