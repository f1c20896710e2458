/** The legs of a corrected frame: the root lowered where a leg would be too straight, hip, knee and ankle closed analytically. */
import type { BvhFile } from "../capture/bvh-parse.ts";
import { smoothstep, softEnvelope } from "../math/interpolate.ts";
import {
  quatBetween,
  quatConjugate,
  quatFromAxisAngle,
  quatInverseMultiply,
  quatMultiply,
  quatRotate,
} from "../math/quaternion.ts";
import { writeRotation } from "./file-motion.ts";
import type { FootCorrection } from "./roll.ts";
import type { FileMotion, FootJoints } from "./soles.ts";

/** Of a knee's captured flexion this much stays at least, and at least this angle where it was more, radians. */
const KNEE_SHARE = 0.5;
const KNEE_LEAST = (1.5 * Math.PI) / 180;

/** Joints of one leg in the file. */
export interface Leg {
  thigh: number;
  shank: number;
  foot: number;
}

/** Lowers the root softly where a corrected foot would straighten its leg more than the capture did. */
export function lowerRoot(
  shift: Float64Array,
  legs: readonly Leg[],
  corrections: readonly { move: Float64Array }[],
  { p, joints: count, frames: n, rate, axes: [ga, gb, up] }: FileMotion,
): void {
  const drop = new Float64Array(n);
  for (let f = 0; f < n; f++) {
    legs.forEach((leg, side) => {
      const hip = 3 * (f * count + leg.thigh);
      const knee = 3 * (f * count + leg.shank);
      const ankle = 3 * (f * count + leg.foot);
      const distance = (a: number, b: number): number =>
        Math.hypot(p[a] - p[b], p[a + 1] - p[b + 1], p[a + 2] - p[b + 2]);
      const a = distance(hip, knee);
      const b = distance(knee, ankle);
      const was = distance(hip, ankle);
      const flexion = Math.acos(Math.max(-1, Math.min(1, (was * was - a * a - b * b) / (2 * a * b))));
      const kept = Math.min(flexion, Math.max(KNEE_LEAST, KNEE_SHARE * flexion));
      const longest = Math.sqrt(a * a + b * b + 2 * a * b * Math.cos(kept));
      const da = p[hip + ga] + shift[3 * f + ga] - p[ankle + ga] - corrections[side].move[3 * f];
      const db = p[hip + gb] + shift[3 * f + gb] - p[ankle + gb] - corrections[side].move[3 * f + 1];
      const rise = p[hip + up] + shift[3 * f + up] - p[ankle + up] - corrections[side].move[3 * f + 2];
      const height = Math.sqrt(Math.max(1e-4, longest * longest - da * da - db * db));
      drop[f] = Math.max(drop[f], rise - height);
    });
  }
  const lower = softEnvelope(drop, Math.max(2, Math.round(0.13 * rate)));
  for (let f = 0; f < n; f++) shift[3 * f + up] -= lower[f];
}

/** Seconds before and after a plant in which the knee already, or still, bends by as much more or less as at the plant's edge. */
const SETTLE = 0.2;

/**
 * Moves a swinging foot along its leg so that the knee comes to a plant, and leaves it, as it is there: a plant that bends a
 * straight knee is prepared while the foot is in the air.
 */
export function settleKnee(
  leg: Leg,
  { move, plants }: FootCorrection,
  shift: Float64Array,
  { p, joints: count, frames: n, rate, axes: [ga, gb, up] }: FileMotion,
): void {
  const reach = Math.max(1, Math.round(SETTLE * rate));
  const bend = (a: number, b: number, d: number): number =>
    Math.acos(Math.max(-1, Math.min(1, (d * d - a * a - b * b) / (2 * a * b))));
  const legOf = (f: number) => {
    const [hip, knee, ankle] = [leg.thigh, leg.shank, leg.foot].map((j) => 3 * (f * count + j));
    const between = (i: number, j: number): number =>
      Math.hypot(p[i] - p[j], p[i + 1] - p[j + 1], p[i + 2] - p[j + 2]);
    const a = between(hip, knee);
    const b = between(knee, ankle);
    const to = [0, 0, 0];
    for (const k of [0, 1, 2]) to[k] = p[ankle + k] - p[hip + k] - shift[3 * f + k];
    to[ga] += move[3 * f];
    to[gb] += move[3 * f + 1];
    to[up] += move[3 * f + 2];
    const d = Math.hypot(to[0], to[1], to[2]) || 1e-9;
    const was = bend(a, b, between(hip, ankle));
    return { a, b, to, d, was, more: bend(a, b, d) - was };
  };
  const settle = (f: number, edge: number, weight: number): void => {
    const { a, b, to, d, was, more } = legOf(f);
    const wanted = Math.max(0, was + more + weight * (edge - more));
    const length = Math.sqrt(a * a + b * b + 2 * a * b * Math.cos(wanted));
    const by = (length - d) / d;
    move[3 * f] += by * to[ga];
    move[3 * f + 1] += by * to[gb];
    move[3 * f + 2] += by * to[up];
  };
  for (let i = 0; i <= plants.length; i++) {
    const from = i > 0 ? plants[i - 1].to : 0;
    const to = i < plants.length ? plants[i].from : n;
    const last = i > 0 ? legOf(from - 1).more : 0;
    const next = i < plants.length ? legOf(to).more : 0;
    for (let f = from; f < to; f++) {
      const since = i > 0 ? 1 - smoothstep((f - from + 1) / reach) : 0;
      const till = i < plants.length ? 1 - smoothstep((to - f) / reach) : 0;
      const total = since + till;
      if (total > 0) settle(f, (since * last + till * next) / total, Math.min(1, total));
    }
  }
}

/** Sines of a knee's bend between which its plane goes over from the hinge's to the capture's. */
const HINGE_FROM = 0.1;
const HINGE_TO = 0.35;

/** The knee's axis in the thigh's own frame: the mean of what the bent frames show; of length 1. */
export function hingeOf(leg: Leg, { q, p, joints: count, frames: n }: FileMotion): Float64Array {
  const out = new Float64Array(3);
  const inverse = new Float64Array(4);
  const v = new Float64Array(3);
  for (let f = 0; f < n; f++) {
    const [h, k, a] = [leg.thigh, leg.shank, leg.foot].map((j) => 3 * (f * count + j));
    const t = [0, 1, 2].map((c) => p[k + c] - p[h + c]);
    const s = [0, 1, 2].map((c) => p[a + c] - p[k + c]);
    quatConjugate(inverse, 0, q, 4 * (f * count + leg.thigh));
    const cross = [t[1] * s[2] - t[2] * s[1], t[2] * s[0] - t[0] * s[2], t[0] * s[1] - t[1] * s[0]];
    quatRotate(v, 0, inverse, 0, cross[0], cross[1], cross[2]);
    for (let c = 0; c < 3; c++) out[c] += v[c];
  }
  const l = Math.hypot(out[0], out[1], out[2]) || 1;
  return out.map((x) => x / l);
}

const w = new Float64Array(36);
const axis = new Float64Array(3);

/** Turns thigh, shank, foot and toes of a frame so that the ankle stands where its correction wants it. */
export function closeLeg(
  file: BvhFile,
  leg: Leg & FootJoints,
  f: number,
  { q, p, joints: count, axes: [ga, gb, up] }: FileMotion,
  shift: Float64Array,
  correction: FootCorrection,
  hinge: Float64Array,
): void {
  const { move, heading } = correction;
  const turn = correction.turn[f];
  const tilt = correction.tilt[f];
  const toeTilt = correction.toeTilt[f];
  const hip = 3 * (f * count + leg.thigh);
  const knee = 3 * (f * count + leg.shank);
  const ankle = 3 * (f * count + leg.foot);
  const still =
    Math.hypot(move[3 * f], move[3 * f + 1], move[3 * f + 2]) +
      Math.abs(turn) +
      Math.abs(tilt) +
      Math.abs(toeTilt) <
    1e-9;
  if (still && Math.hypot(shift[3 * f], shift[3 * f + 1], shift[3 * f + 2]) < 1e-9) return;
  const target = [p[ankle], p[ankle + 1], p[ankle + 2]];
  target[ga] += move[3 * f];
  target[gb] += move[3 * f + 1];
  target[up] += move[3 * f + 2];
  const h = [0, 1, 2].map((k) => p[hip + k] + shift[3 * f + k]);
  const bone = (from: number, to: number): [number, number, number, number] => {
    const d = [0, 1, 2].map((k) => p[to + k] - p[from + k]);
    const l = Math.hypot(d[0], d[1], d[2]) || 1e-9;
    return [d[0] / l, d[1] / l, d[2] / l, l];
  };
  const thigh = bone(hip, knee);
  const shank = bone(knee, ankle);
  const a = thigh[3];
  const b = shank[3];
  let dx = target[0] - h[0];
  let dy = target[1] - h[1];
  let dz = target[2] - h[2];
  const distance = Math.hypot(dx, dy, dz) || 1e-9;
  dx /= distance;
  dy /= distance;
  dz /= distance;
  const reach = Math.min(distance, (a + b) * 0.9999);
  // The knee stays in the plane that the capture shows; a straight one shows none, there its hinge says.
  const nx = thigh[1] * shank[2] - thigh[2] * shank[1];
  const ny = thigh[2] * shank[0] - thigh[0] * shank[2];
  const nz = thigh[0] * shank[1] - thigh[1] * shank[0];
  const bent = Math.hypot(nx, ny, nz);
  const shows = smoothstep((bent - HINGE_FROM) / (HINGE_TO - HINGE_FROM)) / Math.max(1e-9, bent);
  quatRotate(w, 0, q, 4 * (f * count + leg.thigh), hinge[0], hinge[1], hinge[2]);
  const hinged = 1 - shows * bent;
  const mx = shows * nx + hinged * w[0];
  const my = shows * ny + hinged * w[1];
  const mz = shows * nz + hinged * w[2];
  let px = dy * mz - dz * my;
  let py = dz * mx - dx * mz;
  let pz = dx * my - dy * mx;
  const length = Math.hypot(px, py, pz) || 1e-9;
  px /= length;
  py /= length;
  pz /= length;
  const cosine = Math.max(-1, Math.min(1, (a * a + reach * reach - b * b) / (2 * a * reach)));
  const sine = Math.sqrt(1 - cosine * cosine);
  const u = [cosine * dx + sine * px, cosine * dy + sine * py, cosine * dz + sine * pz];
  const k = [h[0] + a * u[0], h[1] + a * u[1], h[2] + a * u[2]];
  const s = [0, 1, 2].map((i) => (h[i] + reach * [dx, dy, dz][i] - k[i]) / b);
  quatBetween(w, 0, thigh[0], thigh[1], thigh[2], u[0], u[1], u[2]);
  quatMultiply(w, 4, w, 0, q, 4 * (f * count + leg.thigh));
  // The shank first goes with the thigh, then the rest of the way.
  quatRotate(w, 8, w, 0, shank[0], shank[1], shank[2]);
  const n = Math.hypot(s[0], s[1], s[2]) || 1;
  quatBetween(w, 12, w[8], w[9], w[10], s[0] / n, s[1] / n, s[2] / n);
  quatMultiply(w, 16, w, 0, q, 4 * (f * count + leg.shank));
  quatMultiply(w, 16, w, 12, w, 16);
  quatFromAxisAngle(w, 20, up === 0 ? 1 : 0, up === 1 ? 1 : 0, up === 2 ? 1 : 0, turn);
  const toed = leg.toes >= 0 && file.joints[leg.toes].parent === leg.foot;
  // Tilted about the foot's level left first, then turned.
  axis[ga] = -heading[2 * f + 1];
  axis[gb] = heading[2 * f];
  axis[up] = 0;
  quatFromAxisAngle(w, 28, axis[0], axis[1], axis[2], tilt);
  quatFromAxisAngle(w, 32, axis[0], axis[1], axis[2], toeTilt);
  if (toed) {
    quatMultiply(w, 32, w, 20, w, 32);
    quatMultiply(w, 32, w, 32, q, 4 * (f * count + leg.toes));
  }
  quatMultiply(w, 20, w, 20, w, 28);
  quatMultiply(w, 20, w, 20, q, 4 * (f * count + leg.foot));
  const parent = file.joints[leg.thigh].parent;
  quatInverseMultiply(w, 24, q, 4 * (f * count + parent), w, 4);
  writeRotation(file, leg.thigh, f, w, 24);
  quatInverseMultiply(w, 24, w, 4, w, 16);
  writeRotation(file, leg.shank, f, w, 24);
  quatInverseMultiply(w, 24, w, 16, w, 20);
  writeRotation(file, leg.foot, f, w, 24);
  if (!toed || (tilt === 0 && toeTilt === 0)) return;
  quatInverseMultiply(w, 24, w, 20, w, 32);
  writeRotation(file, leg.toes, f, w, 24);
}
