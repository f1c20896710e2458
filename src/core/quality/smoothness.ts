/**
 * Popping and jerk: how a motion's accelerations stand beside those of real captures [motion quality; docs/quality.md].
 *
 * Popping takes raw second differences, since a filter would hide a pop; jerk is taken after a low-pass, since noise of a
 * marker is not jerk of a person.
 */
import { lowPass, thirdDerivative } from "../math/low-pass.ts";
import { quatConjugate, quatMultiply, quatToRotationVector } from "../math/quaternion.ts";
import { J, JOINT_COUNT } from "../skeleton/joints.ts";
import { JERK_EFFECTORS, type MotionKind, REAL_ACCELERATION, REAL_JERK } from "./real-reference.ts";

const Q = 4 * JOINT_COUNT;
/** What jerk keeps, Hz: what 30 frames a second still hold. */
const JERK_CUTOFF = 10;
/** Effectors that move where the feet stand: hands, head, hips. */
const FREE = JERK_EFFECTORS.map((e) => !e.endsWith("Foot"));

/**
 * Largest angular acceleration of each joint in its parent's frame, rad/s2, every `step`-th frame compared, whichever
 * frame is begun with.
 *
 * @param rotations local rotations xyzw, frames x JOINT_COUNT x 4.
 */
export function largestAccelerations(
  rotations: Float64Array,
  frames: number,
  rate: number,
  step: number,
): Float64Array {
  const out = new Float64Array(JOINT_COUNT);
  const fps = rate / step;
  const inverse = new Float64Array(4);
  const turn = new Float64Array(4);
  const before = new Float64Array(3);
  const after = new Float64Array(3);
  for (let joint = 0; joint < JOINT_COUNT; joint++) {
    const velocity = (v: Float64Array, f: number): void => {
      quatConjugate(inverse, 0, rotations, Q * f + 4 * joint);
      quatMultiply(turn, 0, rotations, Q * (f + step) + 4 * joint, inverse, 0);
      quatToRotationVector(v, 0, turn, 0);
    };
    let most = 0;
    for (let f = 0; f + 2 * step < frames; f++) {
      velocity(before, f);
      velocity(after, f + step);
      most = Math.max(most, Math.hypot(after[0] - before[0], after[1] - before[1], after[2] - before[2]));
    }
    out[joint] = most * fps * fps;
  }
  return out;
}

export interface Popping {
  /** Largest acceleration over what all joints of real captures reach, at the motion's own 60 Hz. */
  popping: number;
  /** Largest over the joint's own real range, at 30 Hz. */
  own: number;
  /** Index of the joint that `own` is of. */
  joint: number;
}

/** Popping of a motion at 60 Hz beside real captures of its kind; null of fewer than five frames. */
export function poppingOf(rotations: Float64Array, frames: number, kind: MotionKind): Popping | null {
  if (frames < 5) return null;
  const real = REAL_ACCELERATION[kind];
  const fine = largestAccelerations(rotations, frames, 60, 1);
  const coarse = largestAccelerations(rotations, frames, 60, 2);
  const pooled = real.pooled60 ?? REAL_ACCELERATION.all.pooled60 ?? real.pooled30;
  let own = 0;
  let joint = 0;
  for (let j = 0; j < JOINT_COUNT; j++) {
    const range = real.joints[j] || REAL_ACCELERATION.all.joints[j];
    if (range > 0 && coarse[j] / range > own) {
      own = coarse[j] / range;
      joint = j;
    }
  }
  return { popping: Math.max(...fine) / pooled, own, joint };
}

/**
 * Jerk of the effectors over that of real captures of the kind at the same speed: the geometric mean of their ratios, 1 like
 * real ones, under it too smooth. Where the feet stand still only what moves is judged: hands, head and hips.
 *
 * @returns null when fewer than a third of a second counts.
 */
export function jerkRatio(...of: Parameters<typeof jerkRatios>): number | null {
  const ratios = jerkRatios(...of);
  if (!ratios) return null;
  const judged = [...ratios.values()];
  return Math.exp(judged.reduce((sum, r) => sum + Math.log(Math.max(r, 1e-9)), 0) / judged.length);
}

/**
 * The ratios that `jerkRatio` is the mean of, by effector.
 *
 * @param joints world places, frames x JOINT_COUNT x 3, metres, at `rate`.
 * @param legLength hip to ankle, metres.
 * @param speed of the hips, metres a second; one a frame where it changes much: each frame is then held against real ones at its own
 *   speed, running from 2 m/s on where the kind is a walk or a run.
 * @param steady frames that count; null for all but the first and last tenth of a second.
 */
export function jerkRatios(
  joints: Float64Array,
  frames: number,
  rate: number,
  legLength: number,
  kind: MotionKind,
  speed: number | Float64Array,
  steady: ((frame: number) => boolean) | null = null,
): Map<(typeof JERK_EFFECTORS)[number], number> | null {
  const edge = Math.round(0.1 * rate);
  const track = new Float64Array(frames);
  const jerk = new Float64Array(frames);
  const out = new Map<(typeof JERK_EFFECTORS)[number], number>();
  for (const [e, name] of JERK_EFFECTORS.entries()) {
    if (kind === "stand" && !FREE[e]) continue;
    const squares = new Float64Array(frames);
    for (let k = 0; k < 3; k++) {
      for (let f = 0; f < frames; f++) track[f] = joints[3 * (JOINT_COUNT * f + J[name]) + k];
      lowPass(track, 0, 1, frames, rate, JERK_CUTOFF);
      thirdDerivative(jerk, track, 0, 1, frames, rate);
      for (let f = 0; f < frames; f++) squares[f] += jerk[f] * jerk[f];
    }
    let own = 0;
    let real = 0;
    let n = 0;
    for (let f = edge; f < frames - edge; f++) {
      if (steady && !steady(f)) continue;
      own += squares[f];
      real += realJerk(kind, e, typeof speed === "number" ? speed : speed[f], typeof speed !== "number") ** 2;
      n++;
    }
    if (n < rate / 3) return null;
    out.set(name, Math.sqrt(own / real) / legLength);
  }
  return out;
}

/** Speed from which on people run, m/s, as kinds are told apart. */
const RUNS = 2;

/** Jerk of effector `e` in real captures at a speed, 1/s3; with `changes`, of walks or runs as the speed says. */
function realJerk(kind: MotionKind, e: number, speed: number, changes: boolean): number {
  const goes = changes && (kind === "walk" || kind === "run");
  const { median, bySpeed } = REAL_JERK[goes ? (speed > RUNS ? "run" : "walk") : kind];
  return median[e] * (bySpeed ? Math.exp(bySpeed[0] + bySpeed[1] * Math.log(Math.max(speed, 0.2))) : 1);
}
