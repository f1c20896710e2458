/** What kind of motion a stretch is, by the way of its hips and where they face. */
import { wrapAngle } from "../math/angle.ts";
import { lowPass } from "../math/low-pass.ts";
import type { MotionKind } from "./real-reference.ts";

export interface MotionPace {
  kind: MotionKind;
  /** Mean speed of the hips over the ground, m/s. */
  speed: number;
  /** The hips' speed in each frame, m/s, after a low-pass of 2 Hz. */
  speeds: Float64Array;
}

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
  if (frames < rate / 2) return { kind: "all", speed: 0, speeds };
  const way = new Float64Array(2 * frames);
  for (let f = 0; f < frames; f++) {
    way[2 * f] = root[3 * f];
    way[2 * f + 1] = root[3 * f + 2];
  }
  lowPass(way, 0, 2, frames, rate, 2);
  lowPass(way, 1, 2, frames, rate, 2);
  let speed = 0;
  let forward = 0;
  let sideways = 0;
  let turned = 0;
  for (let f = 0; f < frames; f++) {
    const a = Math.max(0, f - 1);
    const b = Math.min(frames - 1, f + 1);
    const vx = ((way[2 * b] - way[2 * a]) * rate) / (b - a);
    const vz = ((way[2 * b + 1] - way[2 * a + 1]) * rate) / (b - a);
    const s = Math.sin(yaw[f]);
    const c = Math.cos(yaw[f]);
    speeds[f] = Math.hypot(vx, vz);
    speed += speeds[f] / frames;
    forward += (vx * s + vz * c) / frames;
    sideways += (vx * c - vz * s) / frames;
    if (f > 0) turned += wrapAngle(yaw[f] - yaw[f - 1]);
  }
  const degreesPerSecond = (Math.abs(turned) * 180 * rate) / (Math.PI * frames);
  const kind = ((): MotionKind => {
    if (speed < 0.25) return degreesPerSecond > 30 ? "turn" : "stand";
    if (Math.abs(sideways) > 0.7 * Math.abs(forward) && Math.abs(sideways) > 0.2) return "sidestep";
    if (degreesPerSecond > 18) return "turn";
    if (forward > 2) return "run";
    return forward > 0.35 ? "walk" : "all";
  })();
  return { kind, speed, speeds };
}

/** Speed that counts as going, m/s, and what is left out after setting off and before stopping, seconds. */
const GOING = 0.35;
const SETTLE = 0.4;

/** 1 for frames in which the hips keep going, away from where they set off and stop. */
export function steadyFrames(pace: MotionPace, rate: number): Uint8Array {
  const { speeds } = pace;
  const out = new Uint8Array(speeds.length);
  const margin = Math.round(SETTLE * rate);
  for (let f = 0; f < speeds.length; f++) {
    if (speeds[f] < GOING) continue;
    let end = f;
    while (end < speeds.length && speeds[end] >= GOING) end++;
    if (end - f > 2 * margin) out.fill(1, f + margin, end - margin);
    f = end;
  }
  return out;
}
