/** Savitzky-Golay smoothing and differentiation: a parabola fitted over 2 h + 1 samples [Savitzky and Golay 1964]. */

/** Smoothed track, `stride` numbers a frame; the ends repeat the first and last sample. */
export function savitzkyGolay(track: Float64Array, stride: number, half: number): Float64Array {
  const n = track.length / stride;
  const out = new Float64Array(track.length);
  // Weights of the central value of a quadratic fit.
  const m = 2 * half + 1;
  const weights = Float64Array.from({ length: m }, (_, k) => {
    const i = k - half;
    return (
      (3 * (3 * half * half + 3 * half - 1 - 5 * i * i)) / ((2 * half + 3) * (2 * half + 1) * (2 * half - 1))
    );
  });
  for (let f = 0; f < n; f++) {
    for (let c = 0; c < stride; c++) {
      let s = 0;
      for (let k = 0; k < m; k++)
        s += weights[k] * track[stride * Math.max(0, Math.min(n - 1, f + k - half)) + c];
      out[stride * f + c] = s;
    }
  }
  return out;
}
