/**
 * Motion paths: pointer samples smoothed as they come, control points made into a curve, arc length [Express §4].
 */

import { wrapAngle } from "../math/angle.ts";
import { unit } from "../math/interpolate.ts";

/** Distance between the points that the filter and the stride rule see, metres. */
export const POINT_SPACING = 0.1;
/** Points of the running filter [Express §4: N_p = 7]. */
const WINDOW = 7;
/** Distance between rows of the finished table, metres. */
const TABLE_STEP = 0.02;
/** Deviation of the bell that softens the body's heading along the path, metres: a corner is turned over a step or two. */
const HEADING_SIGMA = 0.2;

/** A place on the ground, x and z, metres. */
export type PathPoint = readonly [number, number];

/** A curve on the ground by arc length: a row every `step` metres from 0 to `length`. */
export interface MotionPath {
  /** Metres. */
  length: number;
  step: number;
  rows: number;
  x: Float64Array;
  z: Float64Array;
  /** Direction of the curve itself, radians from +Z towards +X, unwrapped (continuous). */
  tangent: Float64Array;
  /** The body's heading: the tangent, softened over a fraction of a step; unwrapped. */
  heading: Float64Array;
  /** Turning to the left (towards +X at yaw 0), radians a metre. */
  curvature: Float64Array;
}

const KERNEL = Float64Array.from({ length: WINDOW }, (_, k) => Math.exp(-0.5 * (k - WINDOW / 2 + 0.5) ** 2));

/**
 * Appends a pointer sample to a stroke and smooths it as [Express §4] does: of the last seven points the middle one is
 * replaced by its Gaussian mean (deviation: one point), so that every point is filtered once, among filtered ones.
 *
 * @param stroke changed in place; samples nearer than a third of the spacing to the last one are dropped.
 */
export function addPointerSample(stroke: [number, number][], x: number, z: number): void {
  const last = stroke[stroke.length - 1];
  if (last && Math.hypot(x - last[0], z - last[1]) < POINT_SPACING / 3) return;
  stroke.push([x, z]);
  const n = stroke.length;
  if (n >= WINDOW) smoothPoint(stroke, n - 1 - (WINDOW >> 1));
}

/** The Gaussian mean of a point and its three neighbours either side, fewer near the ends (as many on both sides). */
function smoothPoint(points: [number, number][], i: number): void {
  const half = Math.min(WINDOW >> 1, i, points.length - 1 - i);
  let sx = 0;
  let sz = 0;
  let total = 0;
  for (let k = -half; k <= half; k++) {
    const g = KERNEL[k + (WINDOW >> 1)];
    sx += g * points[i + k][0];
    sz += g * points[i + k][1];
    total += g;
  }
  points[i] = [sx / total, sz / total];
}

/** A whole stroke of pointer samples, smoothed; its ends stay where they are. Also finishes the last three points. */
export function smoothStroke(samples: readonly PathPoint[]): [number, number][] {
  const out: [number, number][] = [];
  for (const [x, z] of samples) addPointerSample(out, x, z);
  for (let i = Math.max(1, out.length - (WINDOW >> 1)); i < out.length - 1; i++) smoothPoint(out, i);
  return out;
}

/**
 * Control points of a stroke: as few as keep within `tolerance` metres of it [Douglas and Peucker 1973], none farther apart than
 * `most`, so that a drawn path can be bent afterwards.
 */
export function simplifyStroke(
  stroke: readonly PathPoint[],
  tolerance: number,
  most: number,
): [number, number][] {
  const keep = new Uint8Array(stroke.length);
  const visit = (a: number, b: number): void => {
    const dx = stroke[b][0] - stroke[a][0];
    const dz = stroke[b][1] - stroke[a][1];
    const length = Math.hypot(dx, dz);
    let worst = -1;
    let far = tolerance;
    for (let i = a + 1; i < b; i++) {
      const px = stroke[i][0] - stroke[a][0];
      const pz = stroke[i][1] - stroke[a][1];
      const d = length > 1e-9 ? Math.abs(px * dz - pz * dx) / length : Math.hypot(px, pz);
      if (d > far) {
        far = d;
        worst = i;
      }
    }
    if (worst < 0 && length > most && b - a > 1) worst = (a + b) >> 1;
    if (worst < 0) return;
    keep[worst] = 1;
    visit(a, worst);
    visit(worst, b);
  };
  if (stroke.length > 2) visit(0, stroke.length - 1);
  return stroke
    .filter((_, i) => i === 0 || i === stroke.length - 1 || keep[i] === 1)
    .map((p): [number, number] => [p[0], p[1]]);
}

/** Points `spacing` apart along a polyline, its ends included (the last gap is stretched to fit). */
function resample(points: readonly PathPoint[], spacing: number): [number, number][] {
  const sums = [0];
  for (let i = 1; i < points.length; i++)
    sums.push(sums[i - 1] + Math.hypot(points[i][0] - points[i - 1][0], points[i][1] - points[i - 1][1]));
  const length = sums[sums.length - 1];
  const n = Math.max(1, Math.round(length / spacing));
  const out: [number, number][] = [];
  let i = 0;
  for (let k = 0; k <= n; k++) {
    const s = (length * k) / n;
    while (i + 2 < points.length && sums[i + 1] < s) i++;
    const gap = sums[i + 1] - sums[i];
    const u = gap > 1e-12 ? (s - sums[i]) / gap : 0;
    out.push([
      points[i][0] + u * (points[i + 1][0] - points[i][0]),
      points[i][1] + u * (points[i + 1][1] - points[i][1]),
    ]);
  }
  return out;
}

/** Centripetal Catmull-Rom through control points [Yuksel et al. 2011]: no loops between near points. */
function throughPoints(points: readonly PathPoint[]): [number, number][] {
  const n = points.length;
  const out: [number, number][] = [];
  const beyond = (a: PathPoint, b: PathPoint): PathPoint => [2 * a[0] - b[0], 2 * a[1] - b[1]];
  for (let i = 0; i + 1 < n; i++) {
    const p1 = points[i];
    const p2 = points[i + 1];
    const p0 = i > 0 ? points[i - 1] : beyond(p1, p2);
    const p3 = i + 2 < n ? points[i + 2] : beyond(p2, p1);
    const knot = (a: PathPoint, b: PathPoint) =>
      Math.max(1e-4, Math.sqrt(Math.hypot(b[0] - a[0], b[1] - a[1])));
    const d1 = knot(p0, p1);
    const d2 = knot(p1, p2);
    const d3 = knot(p2, p3);
    const pieces = Math.max(2, Math.ceil((d2 * d2) / 0.02));
    for (let k = 0; k < pieces; k++) {
      const u = k / pieces;
      const at = (c: 0 | 1) => {
        const m1 = d2 * ((p1[c] - p0[c]) / d1 - (p2[c] - p0[c]) / (d1 + d2) + (p2[c] - p1[c]) / d2);
        const m2 = d2 * ((p2[c] - p1[c]) / d2 - (p3[c] - p1[c]) / (d2 + d3) + (p3[c] - p2[c]) / d3);
        const u2 = u * u;
        const u3 = u2 * u;
        return (
          (2 * u3 - 3 * u2 + 1) * p1[c] + (u3 - 2 * u2 + u) * m1 + (3 * u2 - 2 * u3) * p2[c] + (u3 - u2) * m2
        );
      };
      out.push([at(0), at(1)]);
    }
  }
  out.push([points[n - 1][0], points[n - 1][1]]);
  return out;
}

/** Natural cubic spline through points of equal parameter distance: second derivatives. */
function splineMoments(values: readonly number[]): Float64Array {
  const n = values.length;
  const m = new Float64Array(n);
  if (n < 3) return m;
  const c = new Float64Array(n);
  for (let i = 1; i < n - 1; i++) {
    const b = 4 - c[i - 1];
    c[i] = 1 / b;
    m[i] = (6 * (values[i + 1] - 2 * values[i] + values[i - 1]) - m[i - 1]) / b;
  }
  for (let i = n - 2; i >= 1; i--) m[i] -= c[i] * m[i + 1];
  return m;
}

/**
 * The motion path of control points.
 *
 * Points 0.1 m apart along the curve (a spline through the points when `smooth`, else straight lines) pass the filter of
 * [Express §4], which rounds corners over some 0.4 m; a cubic spline through them is tabulated by arc length.
 *
 * @param points two at least, metres; neighbours that coincide are merged.
 * @throws RangeError when fewer than two different points are left or a coordinate is no number.
 */
export function createPath(points: readonly PathPoint[], smooth: boolean): MotionPath {
  const kept: PathPoint[] = [];
  points.forEach((p, i) => {
    if (!(Number.isFinite(p[0]) && Number.isFinite(p[1])))
      throw new RangeError(`points[${i}]: two numbers are needed, found ${p[0]}, ${p[1]}.`);
    const last = kept[kept.length - 1];
    if (!last || Math.hypot(p[0] - last[0], p[1] - last[1]) > 1e-6) kept.push(p);
  });
  if (kept.length < 2) throw new RangeError(`points: two different points are needed, found ${kept.length}.`);
  const even = resample(smooth ? throughPoints(kept) : kept, POINT_SPACING);
  const soft = even.map((p): [number, number] => [p[0], p[1]]);
  for (let i = 1; i < soft.length - 1; i++) smoothPoint(soft, i);
  const curve = fine(soft);
  const table = resample(curve, TABLE_STEP);
  const rows = table.length;
  const path: MotionPath = {
    length: 0,
    step: TABLE_STEP,
    rows,
    x: Float64Array.from(table, (p) => p[0]),
    z: Float64Array.from(table, (p) => p[1]),
    tangent: new Float64Array(rows),
    heading: new Float64Array(rows),
    curvature: new Float64Array(rows),
  };
  let sum = 0;
  for (let i = 1; i < rows; i++) sum += Math.hypot(path.x[i] - path.x[i - 1], path.z[i] - path.z[i - 1]);
  path.length = sum;
  path.step = sum / (rows - 1);
  for (let i = 0; i < rows; i++) {
    const a = Math.max(0, i - 1);
    const b = Math.min(rows - 1, i + 1);
    const t = Math.atan2(path.x[b] - path.x[a], path.z[b] - path.z[a]);
    path.tangent[i] = i === 0 ? t : path.tangent[i - 1] + wrapAngle(t - path.tangent[i - 1]);
  }
  path.heading.set(soften(path.tangent, HEADING_SIGMA / path.step));
  // Turning between points 0.1 m apart is what the stride rule counts: the same span here.
  const half = Math.max(1, Math.round(POINT_SPACING / 2 / path.step));
  for (let i = 0; i < rows; i++) {
    const a = Math.max(0, i - half);
    const b = Math.min(rows - 1, i + half);
    path.curvature[i] = b > a ? (path.tangent[b] - path.tangent[a]) / ((b - a) * path.step) : 0;
  }
  return path;
}

/** The spline through the filtered points, some eight pieces a gap. */
function fine(points: readonly PathPoint[]): PathPoint[] {
  const out: PathPoint[] = [];
  const xs = points.map((p) => p[0]);
  const zs = points.map((p) => p[1]);
  const mx = splineMoments(xs);
  const mz = splineMoments(zs);
  const at = (v: readonly number[], m: Float64Array, i: number, u: number) => {
    const w = 1 - u;
    return w * v[i] + u * v[i + 1] + ((w * w * w - w) * m[i] + (u * u * u - u) * m[i + 1]) / 6;
  };
  for (let i = 0; i + 1 < points.length; i++)
    for (let k = 0; k < 8; k++) out.push([at(xs, mx, i, k / 8), at(zs, mz, i, k / 8)]);
  out.push(points[points.length - 1]);
  return out;
}

/** Gaussian mean of a track that goes on straight beyond its ends. */
export function soften(track: Float64Array, sigma: number): Float64Array {
  const n = track.length;
  const out = new Float64Array(n);
  const r = Math.ceil(3 * sigma);
  const kernel = Float64Array.from({ length: r + 1 }, (_, k) => Math.exp(-0.5 * (k / sigma) ** 2));
  let total = kernel[0];
  for (let k = 1; k <= r; k++) total += 2 * kernel[k];
  for (let i = 0; i < n; i++) {
    let s = kernel[0] * track[i];
    for (let k = 1; k <= r; k++) s += kernel[k] * (track[Math.max(0, i - k)] + track[Math.min(n - 1, i + k)]);
    out[i] = s / total;
  }
  return out;
}

/** A track of the path at arc length `s`, linear between rows; held beyond the ends. */
export function readPath(path: MotionPath, track: Float64Array, s: number): number {
  const f = Math.max(0, Math.min(path.rows - 1, s / path.step));
  const i = Math.min(path.rows - 2, Math.floor(f));
  return track[i] + (f - i) * (track[i + 1] - track[i]);
}

/**
 * Place on the path at arc length `s`: x to out[0], z to out[1]. Beyond the ends it goes on straight.
 */
export function placeOnPath(out: Float64Array, path: MotionPath, s: number): void {
  out[0] = readPath(path, path.x, s);
  out[1] = readPath(path, path.z, s);
  const beyond = s < 0 ? s : s > path.length ? s - path.length : 0;
  if (beyond !== 0) {
    const t = path.tangent[beyond < 0 ? 0 : path.rows - 1];
    out[0] += Math.sin(t) * beyond;
    out[1] += Math.cos(t) * beyond;
  }
}

/** Arc length of the point of the path nearest to (x, z), and how far off that is, metres. */
export function nearestOnPath(path: MotionPath, x: number, z: number): { at: number; distance: number } {
  let least = Number.POSITIVE_INFINITY;
  let at = 0;
  for (let i = 0; i < path.rows; i++) {
    const d = (path.x[i] - x) ** 2 + (path.z[i] - z) ** 2;
    if (d >= least) continue;
    least = d;
    at = i * path.step;
  }
  // Where the path crosses itself, or runs beside itself, the nearest row may be another stretch's than the nearest point.
  const reach = (Math.sqrt(least) + path.step) ** 2;
  for (let i = 0; i + 1 < path.rows; i++) {
    if ((path.x[i] - x) ** 2 + (path.z[i] - z) ** 2 > reach) continue;
    const dx = path.x[i + 1] - path.x[i];
    const dz = path.z[i + 1] - path.z[i];
    const u = unit(((x - path.x[i]) * dx + (z - path.z[i]) * dz) / Math.max(1e-12, dx * dx + dz * dz));
    const d = (path.x[i] + u * dx - x) ** 2 + (path.z[i] + u * dz - z) ** 2;
    if (d >= least) continue;
    least = d;
    at = (i + u) * path.step;
  }
  return { at, distance: Math.sqrt(least) };
}
