/**
 * How the root follows corrected feet: by half of what both need, and so that no leg changes its length more than it must.
 *
 * A knee near straight turns a millimetre of leg length into degrees. So the root is what makes the sum least of the
 * squared knee changes (to first order), its distance from the middle of both feet's moves, and its own acceleration: one
 * banded system over the whole motion.
 */
import { factorBand, solveBand } from "../optimize/banded-cholesky.ts";
import type { Leg } from "./legs.ts";
import type { FileMotion } from "./soles.ts";

/** A metre beside the middle weighs as so many radians of knee. */
const MIDDLE = 2.5;
/** Stiffness: radians of knee that a root acceleration of 1 m/s^2 weighs as. */
const STIFF = 0.025;
/** A straight knee counts as one that bends by a radian with this much of leg length, metres. */
const STRAIGHT = 0.03;
/** Unknowns a frame, and how far the smoothness reaches. */
const WIDTH = 9;

/** Bend of a knee a frame, radians, and how leg length turns into it, radians a metre. */
export function kneesOf(
  { p, joints, frames }: FileMotion,
  leg: Leg,
): { flexion: Float64Array; gain: Float64Array } {
  const flexion = new Float64Array(frames);
  const gain = new Float64Array(frames);
  for (let f = 0; f < frames; f++) {
    const at = (j: number): number => 3 * (f * joints + j);
    const between = (i: number, j: number): number =>
      Math.hypot(p[i] - p[j], p[i + 1] - p[j + 1], p[i + 2] - p[j + 2]);
    const a = between(at(leg.thigh), at(leg.shank));
    const b = between(at(leg.shank), at(leg.foot));
    const d = between(at(leg.thigh), at(leg.foot));
    const k = Math.acos(Math.max(-1, Math.min(1, (d * d - a * a - b * b) / (2 * a * b))));
    flexion[f] = k;
    gain[f] = 1 / ((a * b * Math.sin(k)) / Math.max(1e-6, d) + STRAIGHT);
  }
  return { flexion, gain };
}

/** The root's shift in the file's axes, frames x 3, metres. @param moves of both feet: two ground axes and the height. */
export function rootShift(
  motion: FileMotion,
  legs: readonly Leg[],
  moves: readonly Float64Array[],
): Float64Array {
  const { p, joints, frames: n, rate, axes } = motion;
  const size = 3 * n;
  const band = new Float64Array(size * WIDTH);
  const shift = new Float64Array(size);
  const add = (i: number, j: number, v: number): void => {
    if (i >= j) band[i * WIDTH + (i - j)] += v;
  };
  const knees = legs.map((leg) => kneesOf(motion, leg));
  for (let f = 0; f < n; f++) {
    for (let k = 0; k < 3; k++) {
      const i = 3 * f + k;
      const at = 3 * f + axes.indexOf(k as 0 | 1 | 2);
      add(i, i, MIDDLE * MIDDLE);
      shift[i] += MIDDLE * MIDDLE * ((moves[0][at] + moves[1][at]) / 2);
    }
    legs.forEach((leg, side) => {
      const hip = 3 * (f * joints + leg.thigh);
      const ankle = 3 * (f * joints + leg.foot);
      const d = [0, 1, 2].map((k) => p[hip + k] - p[ankle + k]);
      const l = Math.hypot(d[0], d[1], d[2]) || 1;
      const w = knees[side].gain[f] ** 2;
      let along = 0;
      for (let k = 0; k < 3; k++) along += (d[k] / l) * moves[side][3 * f + axes.indexOf(k as 0 | 1 | 2)];
      for (let i = 0; i < 3; i++) {
        shift[3 * f + i] += w * along * (d[i] / l);
        for (let j = 0; j <= i; j++) add(3 * f + i, 3 * f + j, w * (d[i] / l) * (d[j] / l));
      }
    });
  }
  const stiff = (STIFF * rate * rate) ** 2;
  const second = [1, -2, 1];
  for (let f = 1; f + 1 < n; f++)
    for (let k = 0; k < 3; k++)
      for (let i = 0; i < 3; i++)
        for (let j = 0; j <= i; j++)
          add(3 * (f - 1 + i) + k, 3 * (f - 1 + j) + k, stiff * second[i] * second[j]);
  factorBand(band, size, WIDTH, 1e-9);
  solveBand(band, size, WIDTH, shift);
  return shift;
}
