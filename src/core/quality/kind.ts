/** What kind of motion a stretch is, by the way of its hips and where they face. */
import { wrapAngle } from "../math/angle.ts";
import { lowPass } from "../math/low-pass.ts";
import type { MotionKind } from "./real-reference.ts";

export interface MotionPace {
  kind: MotionKind;
  /** From the first frame in which the hips move to the last: what is stood before and after says nothing of the kind. */
  first: number;
  last: number;
  /** Mean speed of the hips over the ground from `first` to `last`, m/s. */
  speed: number;
  /** The hips' speed over the ground in each frame, m/s, after a low-pass of 2 Hz. */
  speeds: Float64Array;
  /** The same with what they climb or descend, after one of 0.5 Hz: as fast as they go along a stair's or a slope's way. */
  alongWay: Float64Array;
}

/** Low-pass of the climb, Hz: no step's rise and fall is left. */
const CLIMB_CUTOFF = 0.5;

/** Speed of the hips, after the low-pass, from which on somebody moves at all, m/s. */
const MOVES = 0.1;

/**
 * Walk, run, turn, side step or stand; `all` for what is none of them, or too short (half a second).
 *
 * @param root the hips' world place, frames x 3, metres.
 * @param yaw where the hips face, radians, one a frame.
 * @param rate frames a second.
 */
export function paceOf(
  root: ArrayLike<number>,
  yaw: ArrayLike<number>,
  frames: number,
  rate: number,
): MotionPace {
  const speeds = new Float64Array(frames);
  if (frames < rate / 2)
    return { kind: "all", first: 0, last: frames - 1, speed: 0, speeds, alongWay: speeds };
  const way = new Float64Array(2 * frames);
  for (let f = 0; f < frames; f++) {
    way[2 * f] = root[3 * f];
    way[2 * f + 1] = root[3 * f + 2];
  }
  lowPass(way, 0, 2, frames, rate, 2);
  lowPass(way, 1, 2, frames, rate, 2);
  const velocity = new Float64Array(2 * frames);
  for (let f = 0; f < frames; f++) {
    const a = Math.max(0, f - 1);
    const b = Math.min(frames - 1, f + 1);
    for (let k = 0; k < 2; k++) velocity[2 * f + k] = ((way[2 * b + k] - way[2 * a + k]) * rate) / (b - a);
    speeds[f] = Math.hypot(velocity[2 * f], velocity[2 * f + 1]);
  }
  const height = Float64Array.from({ length: frames }, (_, f) => root[3 * f + 1]);
  lowPass(height, 0, 1, frames, rate, CLIMB_CUTOFF);
  const alongWay = speeds.map((speed, f) => {
    const a = Math.max(0, f - 1);
    const b = Math.min(frames - 1, f + 1);
    return Math.hypot(speed, ((height[b] - height[a]) * rate) / (b - a));
  });
  let first = speeds.findIndex((v) => v > MOVES);
  let last = speeds.findLastIndex((v) => v > MOVES);
  if (first < 0 || last - first < rate / 2) [first, last] = [0, frames - 1];
  const n = last + 1 - first;
  let speed = 0;
  let forward = 0;
  let sideways = 0;
  let turned = 0;
  for (let f = first; f <= last; f++) {
    const vx = velocity[2 * f];
    const vz = velocity[2 * f + 1];
    const s = Math.sin(yaw[f]);
    const c = Math.cos(yaw[f]);
    speed += speeds[f] / n;
    forward += (vx * s + vz * c) / n;
    sideways += (vx * c - vz * s) / n;
    if (f > first) turned += wrapAngle(yaw[f] - yaw[f - 1]);
  }
  const degreesPerSecond = (Math.abs(turned) * 180 * rate) / (Math.PI * n);
  const kind = ((): MotionKind => {
    if (speed < 0.25) return degreesPerSecond > 30 ? "turn" : "stand";
    if (Math.abs(sideways) > 0.7 * Math.abs(forward) && Math.abs(sideways) > 0.2) return "sidestep";
    if (degreesPerSecond > 18) return "turn";
    if (forward > 2) return "run";
    return forward > 0.35 ? "walk" : "all";
  })();
  return { kind, first, last, speed, speeds, alongWay };
}

/** Speed that counts as going, m/s, and what is left out after setting off and before stopping, seconds. */
const GOING = 0.35;
const SETTLE = 0.4;
/** Seconds that what is left must last: a stride, in which either foot swings once. */
const STRIDE = 1.2;

/** 1 for frames in which the hips keep going, away from where they set off and stop. */
export function steadyFrames(pace: MotionPace, rate: number): Uint8Array {
  const { speeds } = pace;
  const out = new Uint8Array(speeds.length);
  const margin = Math.round(SETTLE * rate);
  const stride = Math.round(STRIDE * rate);
  for (let f = 0; f < speeds.length; f++) {
    if (speeds[f] < GOING) continue;
    let end = f;
    while (end < speeds.length && speeds[end] >= GOING) end++;
    if (end - f >= 2 * margin + stride) out.fill(1, f + margin, end - margin);
    f = end;
  }
  return out;
}
