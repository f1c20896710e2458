/**
 * Lean into turns from the zero-moment point [Express §7.2]: the whole body tilts so far that gravity and the centripetal
 * force act along it, and its zero-moment point stays over the feet.
 */
import { GRAVITY } from "../math/gravity.ts";
import { type MotionPath, placeOnPath, readPath } from "./path.ts";

const RATE = 60;
/** Sampling distance of the acceleration, seconds [Express §7.2: a fourth-order central difference with 0.5 s]. */
const STEP = 0.5;
/** Largest lean, radians: beyond it feet do not hold. */
const MOST = (25 * Math.PI) / 180;

/**
 * Lean a frame, radians, positive towards the path's left.
 *
 * @param at way along the path a frame, metres at 60 Hz; before the first and after the last the body stands or goes on as
 *   it did.
 */
export function leanAlong(path: MotionPath, at: Float64Array): Float64Array {
  const n = at.length;
  const h = Math.round(STEP * RATE);
  const places = new Float64Array(2 * n);
  const p = new Float64Array(2);
  for (let f = 0; f < n; f++) {
    placeOnPath(p, path, at[f]);
    places[2 * f] = p[0];
    places[2 * f + 1] = p[1];
  }
  const read = (f: number, k: number): number => {
    if (f >= 0 && f < n) return places[2 * f + k];
    // Beyond the ends: on at the speed there.
    const end = f < 0 ? 0 : n - 1;
    const next = f < 0 ? Math.min(n - 1, 1) : Math.max(0, n - 2);
    return places[2 * end + k] + Math.abs(f - end) * (places[2 * end + k] - places[2 * next + k]);
  };
  const out = new Float64Array(n);
  const scale = 1 / (12 * STEP * STEP);
  for (let f = 0; f < n; f++) {
    const yaw = readPath(path, path.heading, at[f]);
    let left = 0;
    for (let k = 0; k < 2; k++) {
      const a =
        (-read(f + 2 * h, k) +
          16 * read(f + h, k) -
          30 * read(f, k) +
          16 * read(f - h, k) -
          read(f - 2 * h, k)) *
        scale;
      left += a * (k === 0 ? Math.cos(yaw) : -Math.sin(yaw));
    }
    out[f] = Math.max(-MOST, Math.min(MOST, Math.atan2(left, GRAVITY)));
  }
  return out;
}
