/**
 * Weighted means of rotations: what "SLERP over several poses" has to be [Barycentric §4.4].
 *
 * The mean is the rotation from which the weighted logarithms of all others sum to nothing; for two it is slerp exactly, it
 * depends neither on the order nor on the signs of the quaternions. `meanRotation` iterates to it; `blendRows`, for the
 * batch, takes the normalised sum and one Newton step, which is exact to about 1e-4 radians for poses within a right angle.
 */
import type { Numbers } from "../math/quaternion.ts";

/**
 * arccos(c) / sqrt(1 - c c), the length of the logarithm over the sine: series in x = 1 - c, within 1e-4 up to 75 degrees
 * between quaternions (150 between rotations).
 */
export function arcOverSine(x: number): number {
  return 1 + x * (1 / 3 + x * (2 / 15 + x * (2 / 35 + x * (8 / 315 + x * (8 / 693 + x * 0.0084)))));
}

/**
 * The weighted mean of `count` unit quaternions, xyzw, at 4 k in `q`.
 *
 * @param out written at o. @param weights none negative, sum 1.
 */
export function meanRotation(
  out: Numbers,
  o: number,
  q: Numbers,
  weights: Numbers,
  count: number,
  rounds = 20,
): void {
  // Start at the heaviest: every other is then turned into its hemisphere.
  let heavy = 0;
  for (let k = 1; k < count; k++) if (weights[k] > weights[heavy]) heavy = k;
  let x = q[4 * heavy];
  let y = q[4 * heavy + 1];
  let z = q[4 * heavy + 2];
  let w = q[4 * heavy + 3];
  for (let round = 0; round < rounds; round++) {
    let sx = 0;
    let sy = 0;
    let sz = 0;
    let sw = 0;
    for (let k = 0; k < count; k++) {
      const a = 4 * k;
      let c = x * q[a] + y * q[a + 1] + z * q[a + 2] + w * q[a + 3];
      const sign = c < 0 ? -1 : 1;
      c *= sign;
      const sine = Math.sqrt(Math.max(0, 1 - c * c));
      const f = (sine < 1e-8 ? 1 : Math.atan2(sine, c) / sine) * weights[k];
      sx += f * (sign * q[a] - c * x);
      sy += f * (sign * q[a + 1] - c * y);
      sz += f * (sign * q[a + 2] - c * z);
      sw += f * (sign * q[a + 3] - c * w);
    }
    const length = Math.sqrt(sx * sx + sy * sy + sz * sz + sw * sw);
    const s = length < 1e-12 ? 1 : Math.sin(length) / length;
    const c = Math.cos(length);
    x = c * x + s * sx;
    y = c * y + s * sy;
    z = c * z + s * sz;
    w = c * w + s * sw;
    const n = 1 / Math.sqrt(x * x + y * y + z * z + w * w);
    x *= n;
    y *= n;
    z *= n;
    w *= n;
    if (length < 1e-12) break;
  }
  out[o] = x;
  out[o + 1] = y;
  out[o + 2] = z;
  out[o + 3] = w;
}

/** Cosine over which the normalised sum is the mean to 1e-5 radians: poses within 7 degrees of it. */
const NEAR = 0.998;

/**
 * Blends rows of rotations that are in one hemisphere already: `joints` quaternions from each of `count` rows.
 *
 * @param out written, 4 x joints. @param rows row k begins at k x stride; unit to rounding.
 * @param first the first joint, `joints` the one after the last.
 */
export function blendRows(
  out: Float64Array,
  rows: Float64Array,
  stride: number,
  weights: Float64Array,
  count: number,
  first: number,
  joints: number,
): void {
  for (let j = first; j < joints; j++) {
    const o = 4 * j;
    let x = 0;
    let y = 0;
    let z = 0;
    let w = 0;
    for (let k = 0; k < count; k++) {
      const a = k * stride + o;
      const f = weights[k];
      x += f * rows[a];
      y += f * rows[a + 1];
      z += f * rows[a + 2];
      w += f * rows[a + 3];
    }
    let n = 1 / Math.sqrt(x * x + y * y + z * z + w * w);
    x *= n;
    y *= n;
    z *= n;
    w *= n;
    // 1 / n is the weighted mean of the cosines: near 1, all poses are near each other.
    if (n * NEAR > 1) {
      let sx = 0;
      let sy = 0;
      let sz = 0;
      let sw = 0;
      let own = 1;
      for (let k = 0; k < count; k++) {
        const a = k * stride + o;
        const c = x * rows[a] + y * rows[a + 1] + z * rows[a + 2] + w * rows[a + 3];
        const f = weights[k] * arcOverSine(1 - c);
        sx += f * rows[a];
        sy += f * rows[a + 1];
        sz += f * rows[a + 2];
        sw += f * rows[a + 3];
        own -= f * c;
      }
      x = sx + own * x;
      y = sy + own * y;
      z = sz + own * z;
      w = sw + own * w;
      n = 1 / Math.sqrt(x * x + y * y + z * z + w * w);
      x *= n;
      y *= n;
      z *= n;
      w *= n;
    }
    out[o] = x;
    out[o + 1] = y;
    out[o + 2] = z;
    out[o + 3] = w;
  }
}
