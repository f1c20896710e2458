/**
 * Footskate removal on a BVH as it is: its own skeleton, rate and channels [Kovar, Schreiner and Gleicher 2002, as Oracle §7 uses it].
 *
 * Every plant gets one place; the feet are moved onto it, the root follows softly by half of what both feet need, the legs close
 * analytically with a little give, and corrections blend into the frames around. Heel and toe are honoured apart, so a
 * foot still rolls.
 */
import type { BvhChannel, BvhFile } from "../capture/bvh-parse.ts";
import { worldOf } from "../capture/bvh-world.ts";
import type { Clip } from "../capture/clip.ts";
import { mapJoints } from "../capture/names.ts";
import { LEG_ROW, POINT, trackOf } from "../contacts/motion-track.ts";
import { gaussian, softEnvelope } from "../math/interpolate.ts";
import {
  quatBetween,
  quatConjugate,
  quatFromAxisAngle,
  quatInverseMultiply,
  quatMultiply,
  quatNormalize,
  quatRotate,
} from "../math/quaternion.ts";
import type { ContactTrack } from "../steps/types.ts";
import { eulerNear } from "./euler.ts";
import { correctFoot, type FootPath } from "./targets.ts";

export interface CleanReport {
  plants: number;
  /** Largest move of a foot and of the root, metres. */
  largestMove: number;
  largestRoot: number;
}

/** Seconds in which a correction blends in and out: 30 frames at 60 Hz [Oracle §7]. */
const BLEND = 0.5;
/** Softness of the root's way, seconds. */
const ROOT_SOFT = 0.12;
/** Of a knee's captured flexion this much stays at least, and at least this angle where it was more, radians. */
const KNEE_SHARE = 0.6;
const KNEE_LEAST = (4 * Math.PI) / 180;

interface Leg {
  thigh: number;
  shank: number;
  foot: number;
}

/**
 * A cleaned copy of `file`.
 *
 * @param clip the same motion on the project's skeleton at 60 Hz (what importBvh gives): it knows the soles.
 * @param contacts its contacts, one byte a clip frame.
 * @throws Error when thigh, shank and foot do not follow one another in the file's skeleton.
 */
export function cleanBvh(
  file: BvhFile,
  clip: Clip,
  contacts: ContactTrack,
): { file: BvhFile; report: CleanReport } {
  const joints = mapJoints(
    file.joints.map((j) => j.name),
    file.joints.map((j) => j.parent),
  );
  const index = (name: Parameters<typeof joints.get>[0]): number => joints.get(name) ?? -1;
  const world = worldOf(file, joints);
  const up = world.up === "y" ? 1 : 2;
  // Ground axes such that (a, b, up) turn the same way: z then x under y, x then y under z.
  const ga = world.up === "y" ? 2 : 0;
  const gb = world.up === "y" ? 0 : 1;
  const n = file.frames;
  const rate = 1 / file.frameTime;
  const legs: Leg[] = (["left", "right"] as const).map((side) => {
    const leg = {
      thigh: index(`${side}UpperLeg`),
      shank: index(`${side}LowerLeg`),
      foot: index(`${side}Foot`),
    };
    if (file.joints[leg.shank]?.parent !== leg.thigh || file.joints[leg.foot]?.parent !== leg.shank)
      throw new Error(`${file.name}: thigh, shank and foot of the ${side} leg do not follow one another.`);
    return leg;
  });
  const count = file.joints.length;
  const q = new Float64Array(4 * count * n);
  const p = new Float64Array(3 * count * n);
  kinematics(file, q, p);
  const scale = world.scale;
  for (let i = 0; i < p.length; i++) p[i] *= scale;
  const track = trackOf(clip);
  const clipFrame = (f: number): number =>
    Math.max(0, Math.min(clip.frames - 1, Math.round((f * clip.rate) / rate)));
  const corrections = legs.map((leg, side) => {
    const path: FootPath = {
      frames: n,
      ground: new Float64Array(6 * n),
      ankle: new Float64Array(2 * n),
      ballHeight: new Float64Array(n),
      heel: new Uint8Array(n),
      toe: new Uint8Array(n),
    };
    const soles = solesOf(leg.foot, side, track, contacts, clipFrame, q, p, count, n, world.up);
    const v = new Float64Array(3);
    for (let f = 0; f < n; f++) {
      const bits = (contacts[clipFrame(f)] >> (2 * side)) & 3;
      path.heel[f] = bits & 1;
      path.toe[f] = bits >> 1;
      const o = 3 * (f * count + leg.foot);
      path.ankle[2 * f] = p[o + ga];
      path.ankle[2 * f + 1] = p[o + gb];
      for (let k = 0; k < 3; k++) {
        const s = 3 * (3 * f + k);
        for (let c = 0; c < 3; c++) v[c] = soles[s + c];
        path.ground[6 * f + 2 * k] = v[ga];
        path.ground[6 * f + 2 * k + 1] = v[gb];
        if (k === 1) path.ballHeight[f] = v[up];
      }
    }
    return { path, ...correctFoot(path, Math.max(2, Math.round(BLEND * rate)), Math.max(1, 0.05 * rate)) };
  });
  // Root: half of what both feet need, softly; then down where a leg would be too straight.
  const shift = new Float64Array(3 * n);
  for (let f = 0; f < n; f++) {
    shift[3 * f + ga] = (corrections[0].move[2 * f] + corrections[1].move[2 * f]) / 2;
    shift[3 * f + gb] = (corrections[0].move[2 * f + 1] + corrections[1].move[2 * f + 1]) / 2;
  }
  gaussian(shift, 3, Math.max(1, ROOT_SOFT * rate));
  lowerRoot(shift, legs, corrections, p, count, n, rate, [ga, gb, up]);
  const out: BvhFile = { ...file, values: file.values.slice() };
  writeRoot(out, index("hips"), shift, q, count, scale);
  let largestMove = 0;
  let largestRoot = 0;
  for (let f = 0; f < n; f++) {
    largestRoot = Math.max(largestRoot, Math.hypot(shift[3 * f], shift[3 * f + 1], shift[3 * f + 2]));
    for (let side = 0; side < 2; side++) {
      const c = corrections[side];
      largestMove = Math.max(largestMove, Math.hypot(c.move[2 * f], c.move[2 * f + 1]));
      closeLeg(out, legs[side], f, q, p, count, shift, c.move, c.turn[f], [ga, gb, up]);
    }
  }
  const plants = corrections.reduce(
    (sum, c) => sum + c.path.heel.reduce((k, b, f) => k + (b && !c.path.heel[f - 1] ? 1 : 0), 0),
    0,
  );
  return { file: out, report: { plants, largestMove, largestRoot } };
}

const AXIS: Record<string, number> = { X: 0, Y: 1, Z: 2 };
const isRotation = (c: BvhChannel): boolean => c.endsWith("rotation");

/** World rotations and places (file's units) of all joints in all frames. */
function kinematics(file: BvhFile, q: Float64Array, p: Float64Array): void {
  const n = file.joints.length;
  const r = new Float64Array(8);
  const v = new Float64Array(6);
  for (let f = 0; f < file.frames; f++) {
    for (let j = 0; j < n; j++) {
      const joint = file.joints[j];
      v.set(joint.offset, 0);
      r.set([0, 0, 0, 1], 0);
      joint.channels.forEach((channel, c) => {
        const value = file.values[f * file.columns + joint.column + c];
        const axis = AXIS[channel[0]];
        if (!isRotation(channel)) {
          v[axis] = value;
          return;
        }
        quatFromAxisAngle(
          r,
          4,
          axis === 0 ? 1 : 0,
          axis === 1 ? 1 : 0,
          axis === 2 ? 1 : 0,
          (value * Math.PI) / 180,
        );
        quatMultiply(r, 0, r, 0, r, 4);
      });
      const o = f * n + j;
      if (joint.parent < 0) {
        for (let k = 0; k < 4; k++) q[4 * o + k] = r[k];
        for (let k = 0; k < 3; k++) p[3 * o + k] = v[k];
        continue;
      }
      const parent = f * n + joint.parent;
      quatRotate(v, 3, q, 4 * parent, v[0], v[1], v[2]);
      for (let k = 0; k < 3; k++) p[3 * o + k] = p[3 * parent + k] + v[3 + k];
      quatMultiply(q, 4 * o, q, 4 * parent, r, 0);
      quatNormalize(q, 4 * o);
    }
  }
}

/** Heel, ball and tip of a foot in the file's axes, frames x 3 x 3: fixed to the ankle as they are on average where it lies flat. */
function solesOf(
  foot: number,
  side: number,
  track: ReturnType<typeof trackOf>,
  contacts: ContactTrack,
  clipFrame: (f: number) => number,
  q: Float64Array,
  p: Float64Array,
  count: number,
  n: number,
  up: "y" | "z",
): Float64Array {
  const local = new Float64Array(9);
  const v = new Float64Array(3);
  const inverse = new Float64Array(4);
  let flats = 0;
  for (const wanted of [3, 2, 1, 0]) {
    for (let f = 0; f < n; f++) {
      const g = clipFrame(f);
      if (((contacts[g] >> (2 * side)) & 3) !== wanted) continue;
      flats++;
      quatConjugate(inverse, 0, q, 4 * (f * count + foot));
      const row = (2 * g + side) * LEG_ROW;
      [POINT.heel, POINT.ball, POINT.tip].forEach((point, k) => {
        const d = [0, 1, 2].map((c) => track.points[row + point + c] - track.points[row + POINT.ankle + c]);
        if (up === "y") quatRotate(v, 0, inverse, 0, d[0], d[1], d[2]);
        else quatRotate(v, 0, inverse, 0, d[0], -d[2], d[1]);
        for (let c = 0; c < 3; c++) local[3 * k + c] += v[c];
      });
    }
    if (flats > 0) break;
  }
  for (let k = 0; k < 9; k++) local[k] /= Math.max(1, flats);
  const out = new Float64Array(9 * n);
  for (let f = 0; f < n; f++) {
    const o = f * count + foot;
    for (let k = 0; k < 3; k++) {
      quatRotate(v, 0, q, 4 * o, local[3 * k], local[3 * k + 1], local[3 * k + 2]);
      for (let c = 0; c < 3; c++) out[9 * f + 3 * k + c] = p[3 * o + c] + v[c];
    }
  }
  // Once the foot rolls over its ball the tip is the toes' own: where the clip has it.
  for (let f = 0; f < n; f++) {
    const row = (2 * clipFrame(f) + side) * LEG_ROW;
    const o = 3 * (f * count + foot);
    for (let c = 0; c < 3; c++)
      v[c] = track.points[row + POINT.tip + c] - track.points[row + POINT.ankle + c];
    const d = up === "y" ? [v[0], v[1], v[2]] : [v[0], -v[2], v[1]];
    for (let c = 0; c < 3; c++) out[9 * f + 6 + c] = p[o + c] + d[c];
  }
  return out;
}

type Axes = readonly [number, number, number];

/** Lowers the root softly where a corrected foot would straighten its leg more than the capture did. */
function lowerRoot(
  shift: Float64Array,
  legs: readonly Leg[],
  corrections: readonly { move: Float64Array }[],
  p: Float64Array,
  count: number,
  n: number,
  rate: number,
  [ga, gb, up]: Axes,
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
      const da = p[hip + ga] + shift[3 * f + ga] - p[ankle + ga] - corrections[side].move[2 * f];
      const db = p[hip + gb] + shift[3 * f + gb] - p[ankle + gb] - corrections[side].move[2 * f + 1];
      const rise = p[hip + up] - p[ankle + up];
      const height = Math.sqrt(Math.max(1e-4, longest * longest - da * da - db * db));
      drop[f] = Math.max(drop[f], rise - height);
    });
  }
  const lower = softEnvelope(drop, Math.max(2, Math.round(0.13 * rate)));
  for (let f = 0; f < n; f++) shift[3 * f + up] -= lower[f];
}

/** Adds the shift to the hips' position channels (the root's where the hips have none). */
function writeRoot(
  file: BvhFile,
  hips: number,
  shift: Float64Array,
  q: Float64Array,
  count: number,
  scale: number,
): void {
  let joint = hips;
  const hasPosition = (j: number): boolean => file.joints[j].channels.some((c) => !isRotation(c));
  while (joint > 0 && !hasPosition(joint)) joint = file.joints[joint].parent;
  const { parent, column, channels } = file.joints[joint];
  const inverse = new Float64Array(4);
  const v = new Float64Array(3);
  for (let f = 0; f < file.frames; f++) {
    for (let k = 0; k < 3; k++) v[k] = shift[3 * f + k] / scale;
    if (parent >= 0) {
      quatConjugate(inverse, 0, q, 4 * (f * count + parent));
      quatRotate(v, 0, inverse, 0, v[0], v[1], v[2]);
    }
    channels.forEach((channel, c) => {
      if (!isRotation(channel)) file.values[f * file.columns + column + c] += v[AXIS[channel[0]]];
    });
  }
}

const w = new Float64Array(32);

/** Turns thigh, shank and foot of a frame so that the ankle stands where its correction wants it. */
function closeLeg(
  file: BvhFile,
  leg: Leg,
  f: number,
  q: Float64Array,
  p: Float64Array,
  count: number,
  shift: Float64Array,
  move: Float64Array,
  turn: number,
  [ga, gb, up]: Axes,
): void {
  const hip = 3 * (f * count + leg.thigh);
  const knee = 3 * (f * count + leg.shank);
  const ankle = 3 * (f * count + leg.foot);
  const still = Math.abs(move[2 * f]) + Math.abs(move[2 * f + 1]) + Math.abs(turn) < 1e-9;
  if (still && Math.hypot(shift[3 * f], shift[3 * f + 1], shift[3 * f + 2]) < 1e-9) return;
  const target = [p[ankle], p[ankle + 1], p[ankle + 2]];
  target[ga] += move[2 * f];
  target[gb] += move[2 * f + 1];
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
  // The knee stays in the plane that the capture shows.
  const along = thigh[0] * dx + thigh[1] * dy + thigh[2] * dz;
  let px = thigh[0] - along * dx;
  let py = thigh[1] - along * dy;
  let pz = thigh[2] - along * dz;
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
  quatMultiply(w, 20, w, 20, q, 4 * (f * count + leg.foot));
  const parent = file.joints[leg.thigh].parent;
  quatInverseMultiply(w, 24, q, 4 * (f * count + parent), w, 4);
  writeRotation(file, leg.thigh, f, w, 24);
  quatInverseMultiply(w, 24, w, 4, w, 16);
  writeRotation(file, leg.shank, f, w, 24);
  quatInverseMultiply(w, 24, w, 16, w, 20);
  writeRotation(file, leg.foot, f, w, 24);
}

const angles = new Float64Array(3);

/** A local rotation into a joint's rotation channels. */
function writeRotation(file: BvhFile, joint: number, f: number, q: Float64Array, o: number): void {
  quatNormalize(q, o);
  const { channels, column } = file.joints[joint];
  const at = f * file.columns + column;
  const rotations = channels.flatMap((c, i) => (isRotation(c) ? [i] : []));
  if (rotations.length !== 3) return;
  const axes = rotations.map((i) => AXIS[channels[i][0]]) as [number, number, number];
  eulerNear(
    angles,
    q,
    o,
    axes,
    rotations.map((i) => file.values[at + i]),
  );
  rotations.forEach((i, k) => {
    file.values[at + i] = angles[k];
  });
}

/** The text of a BVH with other values: everything up to the frame time stays as it was written. */
export function rewriteBvh(text: string, file: BvhFile): string {
  const head = /^[\s\S]*?Frame\s+Time\s*:[^\r\n]*/i.exec(text);
  const rows: string[] = [head ? head[0] : ""];
  for (let f = 0; f < file.frames; f++) {
    const row: string[] = [];
    for (let c = 0; c < file.columns; c++)
      row.push(String(Math.round(file.values[f * file.columns + c] * 1e6) / 1e6));
    rows.push(row.join(" "));
  }
  return `${rows.join("\n")}\n`;
}
