/**
 * The root's way: made from the footsteps where none is given [Barycentric §4.2], and smooth across steps.
 *
 * At a landing the root is over the midpoint of the last two footsteps and turned to their mean yaw. Between choices it
 * runs on a cubic that starts with the pose and velocity it has, so it never jumps.
 */
import { wrapAngle } from "../math/angle.ts";
import { FROM, FROM_V, NOW, T0, T1, TO, TO_V } from "./batch.ts";

/** Puts the root at time t into the block at o (NOW..NOW + 3). */
export function rootAt(s: Float64Array, o: number, t: number): void {
  const length = s[o + T1] - s[o + T0];
  if (!(length > 1e-9) || t >= s[o + T1]) {
    // Goes on as it arrived, for the moment until the next step says more.
    const more = Math.max(0, Math.min(0.25, t - s[o + T1]));
    for (let k = 0; k < 4; k++) s[o + NOW + k] = s[o + TO + k] + more * s[o + TO_V + k];
    return;
  }
  const u = Math.max(0, (t - s[o + T0]) / length);
  const u2 = u * u;
  const u3 = u2 * u;
  const b = 3 * u2 - 2 * u3;
  const c = length * (u3 - 2 * u2 + u);
  const d = length * (u3 - u2);
  for (let k = 0; k < 4; k++) {
    const a = o + k;
    s[a + NOW] = s[a + FROM] + b * (s[a + TO] - s[a + FROM]) + c * s[a + FROM_V] + d * s[a + TO_V];
  }
}

/** Starts a new way at t from where the root is and as fast as it goes; the end (TO, TO_V) is for the caller to set. */
export function rootFrom(s: Float64Array, o: number, t: number): void {
  const h = 1 / 240;
  rootAt(s, o, t - h);
  const x = s[o + NOW];
  const z = s[o + NOW + 1];
  const yaw = s[o + NOW + 2];
  const y = s[o + NOW + 3];
  rootAt(s, o, t);
  s[o + FROM_V] = (s[o + NOW] - x) / h;
  s[o + FROM_V + 1] = (s[o + NOW + 1] - z) / h;
  s[o + FROM_V + 2] = (s[o + NOW + 2] - yaw) / h;
  s[o + FROM_V + 3] = (s[o + NOW + 3] - y) / h;
  s[o + NOW + 2] = wrapAngle(s[o + NOW + 2]);
  for (let k = 0; k < 4; k++) s[o + FROM + k] = s[o + NOW + k];
  s[o + T0] = t;
}

/** A footstep with its time, as a track gives it. */
export interface TrackStep {
  x: number;
  z: number;
  yaw: number;
  /** Seconds of the landing. */
  land: number;
}

/**
 * The root's poses at the landings of a footstep track [§4.2]: midpoints and mean yaws of consecutive footsteps.
 *
 * @returns x, z, yaw, seconds, one row for every footstep but the first.
 */
export function rootTrack(steps: readonly TrackStep[]): Float64Array {
  const out = new Float64Array(4 * Math.max(0, steps.length - 1));
  for (let k = 1; k < steps.length; k++) {
    const a = steps[k - 1];
    const b = steps[k];
    out.set(
      [(a.x + b.x) / 2, (a.z + b.z) / 2, wrapAngle(a.yaw + wrapAngle(b.yaw - a.yaw) / 2), b.land],
      4 * (k - 1),
    );
  }
  return out;
}
