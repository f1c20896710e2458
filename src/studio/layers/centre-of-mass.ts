/**
 * The body over its feet: the pendulum equation x'' = w^2 (x - p) as a boundary-value problem, and the whole body's own
 * zero-moment point for correcting it [Kajita et al. 2003; Vukobratovic].
 */

import { CLIP_RATE } from "../../core/capture/clip.ts";
import { GRAVITY } from "../../core/math/gravity.ts";
import { solveTridiagonal } from "../../core/math/interpolate.ts";
import { MASSES } from "../../core/skeleton/masses.ts";

/** Frames whose place is given (seated): 1; their x, z in `place`. */
export interface Pins {
  pinned: Uint8Array;
  place: Float64Array;
}

/**
 * Way of the centre of mass over a planned zero-moment point: x, z a frame.
 *
 * @param point x, z a frame. @param height of the centre of mass, metres, a frame.
 * @param load upward acceleration over gravity a frame (1 at rest, 0 in flight); null: 1.
 */
export function pendulum(
  point: Float64Array,
  height: Float64Array,
  pins: Pins | null,
  load: Float64Array | null = null,
): Float64Array {
  const n = height.length;
  const out = new Float64Array(2 * n);
  const a = new Float64Array(n);
  const b = new Float64Array(n);
  const c = new Float64Array(n);
  const d = new Float64Array(n);
  const h2 = CLIP_RATE * CLIP_RATE;
  for (let axis = 0; axis < 2; axis++) {
    for (let f = 0; f < n; f++) {
      const p = point[2 * f + axis];
      if (f === 0 || f === n - 1 || pins?.pinned[f]) {
        a[f] = 0;
        b[f] = 1;
        c[f] = 0;
        d[f] = pins?.pinned[f] ? pins.place[2 * f + axis] : p;
        continue;
      }
      const w2 = ((load ? load[f] : 1) * GRAVITY) / Math.max(0.3, height[f]);
      // x'' - w^2 x = -w^2 p
      a[f] = h2;
      c[f] = h2;
      b[f] = -2 * h2 - w2;
      d[f] = -w2 * p;
    }
    solveTridiagonal(a, b, c, d);
    for (let f = 0; f < n; f++) out[2 * f + axis] = d[f];
  }
  return out;
}

/** A mass beside the body: its share of the body's mass and its place a frame; share 0 where it is not held. */
export interface Load {
  share: Float64Array;
  place: Float64Array;
}

/**
 * Zero-moment point of the whole body, x, z a frame, from the joints' places (frames x joints x 3), with the load.
 * Also writes the centre of mass (x, y, z a frame) to `centre`.
 */
export function zeroMomentPoint(
  positions: Float64Array,
  joints: number,
  frames: number,
  centre: Float64Array,
  load: Load | null,
): Float64Array {
  const count = MASSES.length + (load ? 1 : 0);
  const at = new Float64Array(count * 3 * frames);
  for (let f = 0; f < frames; f++) {
    const base = f * joints * 3;
    centre[3 * f] = centre[3 * f + 1] = centre[3 * f + 2] = 0;
    let total = 0;
    for (let m = 0; m < MASSES.length; m++) {
      const [share, from, to, u] = MASSES[m];
      total += share;
      for (let k = 0; k < 3; k++) {
        const v = positions[base + 3 * from + k] * (1 - u) + positions[base + 3 * to + k] * u;
        at[(f * count + m) * 3 + k] = v;
        centre[3 * f + k] += share * v;
      }
    }
    if (load) for (let k = 0; k < 3; k++) at[(f * count + count - 1) * 3 + k] = load.place[3 * f + k];
    for (let k = 0; k < 3; k++) centre[3 * f + k] /= total;
  }
  const out = new Float64Array(2 * frames);
  const h2 = CLIP_RATE * CLIP_RATE;
  const row = count * 3;
  for (let f = 0; f < frames; f++) {
    const i = Math.max(1, Math.min(frames - 2, f));
    let nx = 0;
    let nz = 0;
    let weight = 0;
    for (let m = 0; m < count; m++) {
      const share = m < MASSES.length ? MASSES[m][0] : (load?.share[f] ?? 0);
      if (share === 0) continue;
      const o = i * row + 3 * m;
      const ax = (at[o + row] - 2 * at[o] + at[o - row]) * h2;
      const ay = (at[o + row + 1] - 2 * at[o + 1] + at[o - row + 1]) * h2;
      const az = (at[o + row + 2] - 2 * at[o + 2] + at[o - row + 2]) * h2;
      const here = f * row + 3 * m;
      const g = share * (ay + GRAVITY);
      weight += g;
      nx += g * at[here] - share * at[here + 1] * ax;
      nz += g * at[here + 2] - share * at[here + 1] * az;
    }
    out[2 * f] = nx / weight;
    out[2 * f + 1] = nz / weight;
  }
  return out;
}
