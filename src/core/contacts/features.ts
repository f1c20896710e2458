/**
 * What describes a frame to the oracle: a window of 21 frames at 60 Hz around it [Oracle §3].
 *
 * `paper`: places of knees, ankles and toes of both legs, moved so that the centre frame's root is at the origin with no yaw,
 * in units of leg length; one example answers all four bits. `own`: one foot at a time; heights of heel, ball and tip
 * over the foot's own lowest place nearby and their speeds, both in logarithm, so that the difference between resting and
 * almost resting weighs as much as between slow and fast; nothing in it changes when the whole figure drifts or turns, and
 * a left foot teaches a right one.
 */
import { gaussian } from "../math/interpolate.ts";
import { LEG_ROW, type MotionTrack, POINT } from "./motion-track.ts";

/** The paper's set, two of its variants from [Oracle Table 1] (with the root's place; without knees), and our own. */
export const FEATURE_SETS = ["paper", "paper-root", "paper-knees", "own"] as const;
export type FeatureSet = (typeof FEATURE_SETS)[number];

export interface FeatureOptions {
  set: FeatureSet;
  /** Half window, frames at 60 Hz. */
  half: number;
}

/** 21 frames at 60 Hz: a third of a second. */
export const PAPER_HALF = 10;

/** Numbers a frame of the window, of the sets that look at the whole body. */
const BODY_ROW = { paper: 18, "paper-root": 21, "paper-knees": 12 } as const;
type BodySet = keyof typeof BODY_ROW;

/** Numbers an example. */
export function featureSize(o: FeatureOptions): number {
  return o.set === "own" ? offsetsOf(o.half).length * OWN_ROW : (2 * o.half + 1) * BODY_ROW[o.set];
}

/** Examples a frame: one of the whole body, or one of each foot. */
export const examplesPerFrame = (o: FeatureOptions): number => (o.set === "own" ? 2 : 1);

/** Points of a sole. */
const SOLE = [POINT.heel, POINT.ball, POINT.tip] as const;
/** Heights and speeds of heel, ball and tip. */
const OWN_ROW = 6;
/** Where speeds begin to count as moving and heights as raised: at a leg of 0.93 m. */
const SPEED = 0.12;
const HEIGHT = 0.012;
/** Half of the time in which a foot's lowest place is looked for, frames. */
const FLOOR = 40;

/** Frames of the window that are looked at, denser at its middle. */
function offsetsOf(half: number): number[] {
  const out = [0];
  for (let k = 1; k <= half; k += k < 4 ? 1 : 2) out.push(-k, k);
  if (!out.includes(half)) out.push(-half, half);
  return out.sort((a, b) => a - b);
}

/** All examples of a track, row after row: frames x examplesPerFrame x featureSize. */
export function featuresOf(track: MotionTrack, o: FeatureOptions): Float32Array {
  return o.set === "own" ? ownFeatures(track, o.half) : paperFeatures(track, o.half, o.set);
}

const clamp = (f: number, n: number): number => (f < 0 ? 0 : f >= n ? n - 1 : f);

/** The examples of one frame of a track: examplesPerFrame x featureSize. */
export function featuresOfFrame(track: MotionTrack, frame: number, o: FeatureOptions): Float32Array {
  const out = new Float32Array(examplesPerFrame(o) * featureSize(o));
  if (o.set !== "own") {
    paperRow(out, 0, track, frame, o.half, o.set);
    return out;
  }
  const offsets = offsetsOf(o.half);
  for (let side = 0; side < 2; side++)
    ownRow(out, side * featureSize(o), footRows(track, side), track.frames, frame, offsets);
  return out;
}

function paperFeatures(track: MotionTrack, half: number, set: BodySet): Float32Array {
  const size = (2 * half + 1) * BODY_ROW[set];
  const out = new Float32Array(track.frames * size);
  for (let f = 0; f < track.frames; f++) paperRow(out, f * size, track, f, half, set);
  return out;
}

function paperRow(
  out: Float32Array,
  at: number,
  track: MotionTrack,
  f: number,
  half: number,
  set: BodySet,
): void {
  const unit = 1 / track.leg;
  const x = track.root[4 * f];
  const y = track.root[4 * f + 1];
  const z = track.root[4 * f + 2];
  const c = Math.cos(track.root[4 * f + 3]);
  const s = Math.sin(track.root[4 * f + 3]);
  let i = at;
  const put = (from: Float64Array, o: number): void => {
    const dx = from[o] - x;
    const dz = from[o + 2] - z;
    out[i++] = (c * dx - s * dz) * unit;
    out[i++] = (from[o + 1] - y) * unit;
    out[i++] = (s * dx + c * dz) * unit;
  };
  for (let k = -half; k <= half; k++) {
    const g = clamp(f + k, track.frames);
    for (let side = 0; side < 2; side++)
      for (let p = set === "paper-knees" ? 3 : 0; p < 9; p += 3)
        put(track.points, (2 * g + side) * LEG_ROW + p);
    if (set === "paper-root") put(track.root, 4 * g);
  }
}

function ownFeatures(track: MotionTrack, half: number): Float32Array {
  const offsets = offsetsOf(half);
  const size = offsets.length * OWN_ROW;
  const n = track.frames;
  const out = new Float32Array(2 * n * size);
  for (let side = 0; side < 2; side++) {
    const rows = footRows(track, side);
    for (let f = 0; f < n; f++) ownRow(out, (2 * f + side) * size, rows, n, f, offsets);
  }
  return out;
}

function ownRow(
  out: Float32Array,
  at: number,
  rows: Float64Array,
  n: number,
  f: number,
  offsets: readonly number[],
): void {
  let i = at;
  for (const k of offsets) {
    const g = clamp(f + k, n) * OWN_ROW;
    // What is near in time says most.
    const weight = 1 / (1 + Math.abs(k) / 3);
    for (let c = 0; c < OWN_ROW; c++) out[i++] = rows[g + c] * weight;
  }
}

/** Heights and speeds of a foot's points in logarithm, frames x OWN_ROW. */
function footRows(track: MotionTrack, side: number): Float64Array {
  const n = track.frames;
  const scale = track.leg / 0.93;
  const rows = new Float64Array(n * OWN_ROW);
  const heights = new Float64Array(n);
  const drift = driftOf(track, side);
  SOLE.forEach((point, c) => {
    const at = (f: number, k: number): number =>
      track.points[(2 * f + side) * LEG_ROW + point + k] - drift[3 * f + k];
    for (let f = 0; f < n; f++) heights[f] = at(f, 1);
    const floor = lowest(heights, FLOOR);
    for (let f = 0; f < n; f++) {
      const a = Math.max(0, f - 1);
      const b = Math.min(n - 1, f + 1);
      const speed =
        (Math.hypot(at(b, 0) - at(a, 0), at(b, 1) - at(a, 1), at(b, 2) - at(a, 2)) * 60) / Math.max(1, b - a);
      rows[f * OWN_ROW + c] = Math.log1p(Math.max(0, heights[f] - floor[f]) / (HEIGHT * scale));
      rows[f * OWN_ROW + 3 + c] = Math.log1p(speed / (SPEED * scale));
    }
  });
  return rows;
}

/** Frames before a frame that its features look at. */
export const lookBack = (o: FeatureOptions): number =>
  o.set !== "own" ? o.half : o.half + Math.max(FLOOR, FLOW + 3 * DRIFT_SOFT + 1);

/** Half of the time in which a foot is expected to rest once, frames. */
const REST = 32;
/** Spread of the frames that say how the ground moves now, and how far they are looked at, frames. */
const SPREAD = 18;
const FLOW = 50;
/** Points whose velocities differ by this stand on the same ground: metres a second at a leg of 0.93 m. */
const ALIKE = 0.05;
/** Rounds in which the velocity that most share is found; what is left of it afterwards is smoothed over so many frames. */
const ROUNDS = 4;
const DRIFT_SOFT = 5;

/**
 * How the ground that a foot stands on moves: an edited motion drifts as a whole, and a planted foot with it. The velocity that
 * most of the foot's points have nearby in time, summed: x, y, z a frame.
 *
 * The stillest frames say where to begin; but what is stillest in a drift is often a point that happens to roll against it. From
 * there the mean moves to where velocities gather (mean shift). Each foot has its own: feet of a blended motion slide apart.
 */
function driftOf(track: MotionTrack, side: number): Float64Array {
  const n = track.frames;
  const velocity = soleVelocities(track, side);
  const row = 3 * SOLE.length;
  const speed = new Float64Array(n);
  const stillest = new Int32Array(n);
  for (let f = 0; f < n; f++) {
    speed[f] = Number.POSITIVE_INFINITY;
    for (let i = row * f; i < row * (f + 1); i += 3) {
      const v = Math.hypot(velocity[i], velocity[i + 1], velocity[i + 2]);
      if (v >= speed[f]) continue;
      speed[f] = v;
      stillest[f] = i;
    }
  }
  const nearness = Float64Array.from({ length: FLOW + 1 }, (_, k) => Math.exp(-0.5 * (k / SPREAD) ** 2));
  const alike = ((ALIKE * track.leg) / 0.93 / 60) ** 2;
  const out = new Float64Array(3 * n);
  for (let f = 0; f < n; f++) {
    let total = 0;
    let least = Number.POSITIVE_INFINITY;
    const from = Math.max(0, f - REST);
    const to = Math.min(n - 1, f + REST);
    for (let g = from; g <= to; g++) least = Math.min(least, speed[g]);
    let x = 0;
    let y = 0;
    let z = 0;
    for (let g = from; g <= to; g++) {
      // Frames nearly as still as the stillest speak, the nearer the louder.
      if (speed[g] > 1.5 * least + 2e-4) continue;
      const weight = 1 / (4 + Math.abs(g - f));
      x += weight * velocity[stillest[g]];
      y += weight * velocity[stillest[g] + 1];
      z += weight * velocity[stillest[g] + 2];
      total += weight;
    }
    for (let round = 0; round <= ROUNDS; round++) {
      x /= total;
      y /= total;
      z /= total;
      if (round === ROUNDS) break;
      let sx = 0;
      let sy = 0;
      let sz = 0;
      total = 0;
      for (let g = Math.max(0, f - FLOW); g <= Math.min(n - 1, f + FLOW); g++) {
        for (let i = row * g; i < row * (g + 1); i += 3) {
          const far = (velocity[i] - x) ** 2 + (velocity[i + 1] - y) ** 2 + (velocity[i + 2] - z) ** 2;
          const weight = nearness[Math.abs(g - f)] / (1 + far / alike) ** 2;
          sx += weight * velocity[i];
          sy += weight * velocity[i + 1];
          sz += weight * velocity[i + 2];
          total += weight;
        }
      }
      x = sx;
      y = sy;
      z = sz;
    }
    out[3 * f] = x;
    out[3 * f + 1] = y;
    out[3 * f + 2] = z;
  }
  gaussian(out, 3, DRIFT_SOFT);
  for (let i = 3; i < 3 * n; i++) out[i] += out[i - 3];
  return out;
}

/** Velocities of a sole's points, metres a frame: frames x points x 3. */
function soleVelocities(track: MotionTrack, side: number): Float64Array {
  const n = track.frames;
  const out = new Float64Array(3 * SOLE.length * n);
  for (let f = 0; f < n; f++) {
    const a = Math.max(0, f - 1);
    const b = Math.min(n - 1, f + 1);
    SOLE.forEach((point, c) => {
      const i = (2 * a + side) * LEG_ROW + point;
      const j = (2 * b + side) * LEG_ROW + point;
      for (let k = 0; k < 3; k++)
        out[3 * (SOLE.length * f + c) + k] = (track.points[j + k] - track.points[i + k]) / Math.max(1, b - a);
    });
  }
  return out;
}

/** Lowest value within `half` frames to each side (van Herk's sliding minimum would do; windows are short). */
function lowest(values: Float64Array, half: number): Float64Array {
  const n = values.length;
  const out = new Float64Array(n);
  const queue: number[] = [];
  for (let f = 0; f < n + half; f++) {
    if (f < n) {
      while (queue.length > 0 && values[queue[queue.length - 1]] >= values[f]) queue.pop();
      queue.push(f);
    }
    const centre = f - half;
    if (centre < 0) continue;
    while (queue[0] < centre - half) queue.shift();
    out[centre] = values[queue[0]];
  }
  return out;
}
