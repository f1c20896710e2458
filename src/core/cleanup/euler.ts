/** Rotation channels of a BVH joint from a quaternion, near to what they were. */

/**
 * Angles in degrees for R = R(axes[0]) R(axes[1]) R(axes[2]), of the two equal answers (and their full turns) the nearest to
 * `near`.
 *
 * @param axes 0, 1, 2 for x, y, z; all different.
 */
export function eulerNear(
  out: Float64Array,
  q: Float64Array,
  o: number,
  axes: readonly [number, number, number],
  near: readonly number[],
): void {
  const x = q[o];
  const y = q[o + 1];
  const z = q[o + 2];
  const w = q[o + 3];
  const m = [
    1 - 2 * (y * y + z * z),
    2 * (x * y - z * w),
    2 * (x * z + y * w),
    2 * (x * y + z * w),
    1 - 2 * (x * x + z * z),
    2 * (y * z - x * w),
    2 * (x * z - y * w),
    2 * (y * z + x * w),
    1 - 2 * (x * x + y * y),
  ];
  const [i, j, k] = axes;
  const e = (j - i + 3) % 3 === 1 ? 1 : -1;
  const at = (r: number, c: number): number => m[3 * r + c];
  const a1 = Math.atan2(-e * at(j, k), at(k, k));
  const b1 = Math.asin(Math.max(-1, Math.min(1, e * at(i, k))));
  const c1 = Math.atan2(-e * at(i, j), at(i, i));
  const deg = 180 / Math.PI;
  const options = [
    [a1 * deg, b1 * deg, c1 * deg],
    [a1 * deg + 180, 180 - b1 * deg, c1 * deg + 180],
  ];
  let best = Number.POSITIVE_INFINITY;
  for (const option of options) {
    let far = 0;
    for (let n = 0; n < 3; n++) {
      option[n] += 360 * Math.round((near[n] - option[n]) / 360);
      far += Math.abs(option[n] - near[n]);
    }
    if (far < best) {
      best = far;
      out.set(option, 0);
    }
  }
}
