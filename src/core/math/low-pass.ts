/** Zero-phase Butterworth low-pass and third derivatives of evenly sampled tracks. */

/**
 * Runs a second-order Butterworth low-pass forwards and back over a track (fourth order in all, no phase), in place.
 *
 * @param track samples, `stride` apart from `offset`; ends are continued point-symmetrically.
 * @param count samples, 16 at least, else nothing is done.
 * @param rate samples a second; `cutoff` in Hz, under 0.45 of it, else nothing is done.
 */
export function lowPass(
  track: Float64Array,
  offset: number,
  stride: number,
  count: number,
  rate: number,
  cutoff: number,
): void {
  if (count < 16 || cutoff >= 0.45 * rate) return;
  const k = Math.tan((Math.PI * cutoff) / rate);
  const norm = 1 / (1 + Math.SQRT2 * k + k * k);
  const b0 = k * k * norm;
  const a1 = 2 * (k * k - 1) * norm;
  const a2 = (1 - Math.SQRT2 * k + k * k) * norm;
  const pad = Math.min(count - 2, Math.floor(rate));
  const n = count + 2 * pad;
  const x = new Float64Array(n);
  const first = track[offset];
  const last = track[offset + (count - 1) * stride];
  for (let i = 0; i < count; i++) x[pad + i] = track[offset + i * stride];
  for (let i = 1; i <= pad; i++) {
    x[pad - i] = 2 * first - track[offset + i * stride];
    x[pad + count - 1 + i] = 2 * last - track[offset + (count - 1 - i) * stride];
  }
  for (let pass = 0; pass < 2; pass++) {
    // Starts as if the first value had stood there for ever.
    let z1 = x[0] * (1 - b0);
    let z2 = x[0] * (b0 - a2);
    for (let i = 0; i < n; i++) {
      const v = x[i];
      const y = b0 * v + z1;
      z1 = 2 * b0 * v - a1 * y + z2;
      z2 = b0 * v - a2 * y;
      x[i] = y;
    }
    x.reverse();
  }
  for (let i = 0; i < count; i++) track[offset + i * stride] = x[pad + i];
}

/** Poles of the quintic B-spline's inverse filter. */
const POLES = [-0.430575347099973, -0.043096288203264] as const;

/**
 * Third derivative at the samples, from the quintic spline through them: true up to a third of the rate, where
 * differences fade. The first and last few values depend on how the ends are continued (mirrored) and are not to be used.
 *
 * @param out `count` values, units a second cubed.
 */
export function thirdDerivative(
  out: Float64Array,
  track: Float64Array,
  offset: number,
  stride: number,
  count: number,
  rate: number,
): void {
  const c = new Float64Array(count);
  for (let i = 0; i < count; i++) c[i] = 120 * track[offset + i * stride];
  for (const z of POLES) {
    // Unser's recursive filters, forwards and back.
    const gain = (1 - z) * (1 - 1 / z);
    let sum = 0;
    let power = 1;
    for (let i = 0; i < Math.min(count, 30); i++) {
      sum += power * c[i];
      power *= z;
    }
    c[0] = sum;
    for (let i = 1; i < count; i++) c[i] += z * c[i - 1];
    c[count - 1] = (z / (z * z - 1)) * (c[count - 1] + z * c[Math.max(0, count - 2)]);
    for (let i = count - 2; i >= 0; i--) c[i] = z * (c[i + 1] - c[i]);
    for (let i = 0; i < count; i++) c[i] *= gain;
  }
  // The 120 belongs to the spline's denominator; the gains have answered for it.
  const scale = (rate * rate * rate) / 120;
  const at = (i: number): number => c[Math.max(0, Math.min(count - 1, i))];
  for (let i = 0; i < count; i++)
    out[i] = scale * (0.5 * at(i + 2) - at(i + 1) + at(i - 1) - 0.5 * at(i - 2));
}
