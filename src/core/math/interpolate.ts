/** Small one-dimensional tools: easing, tables, and smoothing of tracks. */

/** Clamp to [0, 1]. */
export const unit = (u: number): number => (u <= 0 ? 0 : Math.min(u, 1));

/** 0 to 1 with no speed at either end. */
export function smoothstep(u: number): number {
  const t = unit(u);
  return t * t * (3 - 2 * t);
}

/** 0 to 1 with neither speed nor acceleration at either end: minimum jerk [Flash and Hogan 1985]. */
export function minimumJerk(u: number): number {
  const t = unit(u);
  return t * t * t * (10 + t * (6 * t - 15));
}

/** Catmull-Rom through evenly spaced keys, u in [0, 1]; ends are held. */
export function readKeys(keys: readonly number[], u: number): number {
  const n = keys.length - 1;
  const f = unit(u) * n;
  const i = Math.min(n - 1, Math.floor(f));
  const t = f - i;
  const a = keys[Math.max(0, i - 1)];
  const b = keys[i];
  const c = keys[i + 1];
  const d = keys[Math.min(n, i + 2)];
  return b + 0.5 * t * (c - a + t * (2 * a - 5 * b + 4 * c - d + t * (3 * (b - c) + d - a)));
}

/** A smooth periodic curve: its mean, then cosine and sine parts of its first harmonics. */
export type Harmonics = readonly number[];

/** The first harmonics of the curve that has these values at even distances over its period; at most (keys - 1) / 2. */
export function harmonicsOf(keys: readonly number[], count: number): Harmonics {
  const n = keys.length;
  const out = [keys.reduce((a, b) => a + b, 0) / n];
  for (let h = 1; h <= count; h++) {
    let c = 0;
    let s = 0;
    keys.forEach((k, i) => {
      c += (2 / n) * k * Math.cos((2 * Math.PI * h * i) / n);
      s += (2 / n) * k * Math.sin((2 * Math.PI * h * i) / n);
    });
    out.push(c, s);
  }
  return out;
}

/** Value at `u` periods. */
export function readHarmonics(curve: Harmonics, u: number): number {
  let out = curve[0];
  for (let h = 1; 2 * h < curve.length; h++)
    out += curve[2 * h - 1] * Math.cos(2 * Math.PI * h * u) + curve[2 * h] * Math.sin(2 * Math.PI * h * u);
  return out;
}

/** Piecewise cubic through (times, values) that never overshoots [Fritsch and Carlson 1980]; ends are held. */
export function readMonotone(times: readonly number[], values: readonly number[], t: number): number {
  const n = times.length;
  if (t <= times[0]) return values[0];
  if (t >= times[n - 1]) return values[n - 1];
  let i = 0;
  while (times[i + 1] < t) i++;
  const h = times[i + 1] - times[i];
  const slope = (k: number) => {
    if (k <= 0 || k >= n - 1) return 0;
    const s0 = (values[k] - values[k - 1]) / (times[k] - times[k - 1]);
    const s1 = (values[k + 1] - values[k]) / (times[k + 1] - times[k]);
    return s0 * s1 <= 0 ? 0 : (2 * s0 * s1) / (s0 + s1);
  };
  const u = (t - times[i]) / h;
  const m0 = slope(i) * h;
  const m1 = slope(i + 1) * h;
  const u2 = u * u;
  const u3 = u2 * u;
  return (
    (2 * u3 - 3 * u2 + 1) * values[i] +
    (u3 - 2 * u2 + u) * m0 +
    (3 * u2 - 2 * u3) * values[i + 1] +
    (u3 - u2) * m1
  );
}

/** Gaussian smoothing of a track in place: `stride` numbers a frame, standard deviation in frames, ends held. */
export function gaussian(track: Float64Array, stride: number, sigma: number): void {
  const r = Math.max(1, Math.ceil(3 * sigma));
  const kernel = Float64Array.from({ length: 2 * r + 1 }, (_, k) => Math.exp(-0.5 * ((k - r) / sigma) ** 2));
  const total = kernel.reduce((a, b) => a + b, 0);
  const n = track.length / stride;
  const copy = Float64Array.from(track);
  for (let c = 0; c < stride; c++) {
    for (let f = 0; f < n; f++) {
      let s = 0;
      for (let k = -r; k <= r; k++)
        s += kernel[k + r] * copy[stride * Math.max(0, Math.min(n - 1, f + k)) + c];
      track[stride * f + c] = s / total;
    }
  }
}

/** Angles made continuous in place. */
export function unwrap(track: Float64Array): void {
  for (let f = 1; f < track.length; f++) {
    const d = track[f] - track[f - 1];
    track[f] -= 2 * Math.PI * Math.round(d / (2 * Math.PI));
  }
}

/** Solves a tridiagonal system in place (Thomas): a below, b on, c above the diagonal; the answer replaces `d`. */
export function solveTridiagonal(a: Float64Array, b: Float64Array, c: Float64Array, d: Float64Array): void {
  const n = d.length;
  const cp = new Float64Array(n);
  cp[0] = c[0] / b[0];
  d[0] /= b[0];
  for (let i = 1; i < n; i++) {
    const m = 1 / (b[i] - a[i] * cp[i - 1]);
    cp[i] = c[i] * m;
    d[i] = (d[i] - a[i] * d[i - 1]) * m;
  }
  for (let i = n - 2; i >= 0; i--) d[i] -= cp[i] * d[i + 1];
}

/** Never less than `need`, smooth: the largest value within `half` frames, then a bell of the same width. */
export function softEnvelope(need: Float64Array, half: number): Float64Array {
  const n = need.length;
  const wide = new Float64Array(n);
  for (let f = 0; f < n; f++) {
    let m = 0;
    for (let k = Math.max(0, f - half); k <= Math.min(n - 1, f + half); k++) if (need[k] > m) m = need[k];
    wide[f] = m;
  }
  let total = 0;
  const bell = Float64Array.from({ length: 2 * half + 1 }, (_, k) => {
    const x = Math.cos(((k - half) / (half + 1)) * (Math.PI / 2));
    total += x * x;
    return x * x;
  });
  const out = new Float64Array(n);
  for (let f = 0; f < n; f++) {
    let s = 0;
    for (let k = -half; k <= half; k++) s += bell[k + half] * wide[Math.max(0, Math.min(n - 1, f + k))];
    out[f] = s / total;
  }
  return out;
}
