/** The zero-moment point of the body's masses [Vukobratovic; Winter's segment masses]. */
import { GRAVITY } from "../math/gravity.ts";
import { JOINT_COUNT } from "./joints.ts";
import { MASSES } from "./masses.ts";

const ROW = 3 * MASSES.length;
const TOTAL = MASSES.reduce((sum, [share]) => sum + share, 0);

/**
 * Zero-moment point on the ground of each frame, x, z by turns.
 *
 * @param joints world places, frames x JOINT_COUNT x 3, metres.
 * @param rate frames a second.
 * @param spread frames to each side over which acceleration is taken: a parabola through three points, so 3 at 60 Hz
 *   leaves what is under about 6 Hz.
 * @param load where wanted, filled with each frame's vertical force over the body's weight: 1 standing, 0 falling freely.
 */
export function zeroMomentPoint(
  joints: Float64Array,
  frames: number,
  rate: number,
  spread: number,
  load: Float64Array | null = null,
): Float64Array {
  const at = new Float64Array(ROW * frames);
  for (let f = 0; f < frames; f++) {
    for (let m = 0; m < MASSES.length; m++) {
      const [, from, to, u] = MASSES[m];
      const a = 3 * (JOINT_COUNT * f + from);
      const b = 3 * (JOINT_COUNT * f + to);
      for (let k = 0; k < 3; k++) at[ROW * f + 3 * m + k] = joints[a + k] * (1 - u) + joints[b + k] * u;
    }
  }
  const out = new Float64Array(2 * frames);
  const h = Math.max(1, Math.min(spread, (frames - 1) >> 1));
  const square = (rate / h) ** 2;
  const reach = h * ROW;
  for (let f = 0; f < frames; f++) {
    const i = Math.max(h, Math.min(frames - 1 - h, f));
    let nx = 0;
    let nz = 0;
    let weight = 0;
    for (let m = 0; m < MASSES.length; m++) {
      const o = i * ROW + 3 * m;
      const here = f * ROW + 3 * m;
      const share = MASSES[m][0];
      const g = share * (GRAVITY + (at[o + reach + 1] - 2 * at[o + 1] + at[o - reach + 1]) * square);
      const pull = share * at[here + 1] * square;
      weight += g;
      nx += g * at[here] - pull * (at[o + reach] - 2 * at[o] + at[o - reach]);
      nz += g * at[here + 2] - pull * (at[o + reach + 2] - 2 * at[o + 2] + at[o - reach + 2]);
    }
    if (load) load[f] = weight / (TOTAL * GRAVITY);
    out[2 * f] = nx / weight;
    out[2 * f + 1] = nz / weight;
  }
  return out;
}
