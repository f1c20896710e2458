/**
 * Foot plants by height and speed: the plain methods, after the smoothing and the neighbour vote of [Express §5.1].
 *
 * A heel rests when its point is low and slow; a toe when the ball or the tip is. Limits scale with the leg.
 */
import type { Clip } from "../capture/clip.ts";
import { quatRotate } from "../math/quaternion.ts";
import { savitzkyGolay } from "../math/savitzky-golay.ts";
import { forwardKinematics } from "../skeleton/forward-kinematics.ts";
import { J, JOINT_COUNT } from "../skeleton/joints.ts";
import type { ContactTrack } from "../steps/types.ts";
import { dropShort } from "./runs.ts";

export const CONTACT_METHODS = ["height", "speed", "both"] as const;
export type ContactMethod = (typeof CONTACT_METHODS)[number];

export interface BaselineOptions {
  /** Height of a resting point over the ground at a leg of 0.93 m, metres. */
  height: number;
  /** Its speed, metres a second. */
  speed: number;
  /** Half window of the smoothing, frames; 0 for none. */
  smooth: number;
  /** Shortest plant and shortest gap kept, frames. */
  shortest: number;
}

export const BASELINE_DEFAULTS: BaselineOptions = { height: 0.022, speed: 0.22, smooth: 2, shortest: 4 };

/** Points of a sole: heel, ball, tip; x, y, z each. */
const POINTS = 3;
const ROW = POINTS * 3;

/** World places of heel point, ball and tip of both feet: frames x 2 x 9. */
export function solePoints(clip: Clip): Float64Array {
  const { skeleton } = clip;
  const shape = skeleton.foot;
  const out = new Float64Array(clip.frames * 2 * ROW);
  const p = new Float64Array(3 * JOINT_COUNT);
  const w = new Float64Array(4 * JOINT_COUNT);
  const v = new Float64Array(3);
  for (let f = 0; f < clip.frames; f++) {
    forwardKinematics(p, w, skeleton, clip.root, 3 * f, clip.rotations, 4 * JOINT_COUNT * f);
    for (let side = 0; side < 2; side++) {
      const foot = side === 0 ? J.leftFoot : J.rightFoot;
      const o = (2 * f + side) * ROW;
      quatRotate(v, 0, w, 4 * foot, 0, -shape.ankleHeight, -shape.heelBack);
      for (let k = 0; k < 3; k++) out[o + k] = p[3 * foot + k] + v[k];
      quatRotate(v, 0, w, 4 * foot, 0, -shape.ballHeight, 0);
      for (let k = 0; k < 3; k++) out[o + 3 + k] = p[3 * (foot + 1) + k] + v[k];
      quatRotate(v, 0, w, 4 * (foot + 1), 0, -shape.ballHeight, shape.tipForward);
      for (let k = 0; k < 3; k++) out[o + 6 + k] = p[3 * (foot + 1) + k] + v[k];
    }
  }
  return out;
}

/** Contact bits of a clip on the ground y = 0. */
export function detectContacts(
  clip: Clip,
  method: ContactMethod,
  options: Partial<BaselineOptions> = {},
): ContactTrack {
  const o = { ...BASELINE_DEFAULTS, ...options };
  const scale = clip.skeleton.legLength / 0.93;
  const raw = solePoints(clip);
  const points = o.smooth > 0 ? savitzkyGolay(raw, 2 * ROW, o.smooth) : raw;
  const n = clip.frames;
  const bits = new Uint8Array(4 * n);
  const rests = (f: number, side: number, point: number): boolean => {
    const i = (2 * f + side) * ROW + 3 * point;
    const low = points[i + 1] < o.height * scale;
    const a = Math.max(0, f - 1);
    const b = Math.min(n - 1, f + 1);
    const ia = (2 * a + side) * ROW + 3 * point;
    const ib = (2 * b + side) * ROW + 3 * point;
    const back =
      Math.hypot(points[i] - points[ia], points[i + 1] - points[ia + 1], points[i + 2] - points[ia + 2]) *
      clip.rate;
    const ahead =
      Math.hypot(points[ib] - points[i], points[ib + 1] - points[i + 1], points[ib + 2] - points[i + 2]) *
      clip.rate;
    // At a boundary the point moves on one side alone.
    const slow = Math.min(f > 0 ? back : ahead, f < n - 1 ? ahead : back) < o.speed * scale;
    return method === "height"
      ? low
      : method === "speed"
        ? slow && points[i + 1] < 6 * o.height * scale
        : low && slow;
  };
  for (let f = 0; f < n; f++) {
    for (let side = 0; side < 2; side++) {
      if (rests(f, side, 0)) bits[2 * side * n + f] = 1;
      if (rests(f, side, 1) || rests(f, side, 2)) bits[(2 * side + 1) * n + f] = 1;
    }
  }
  const out = new Uint8Array(n);
  for (let b = 0; b < 4; b++) {
    const track = bits.subarray(b * n, (b + 1) * n);
    vote(track, 2);
    dropShort(track, 0, o.shortest);
    dropShort(track, 1, o.shortest);
    for (let f = 0; f < n; f++) out[f] |= track[f] << b;
  }
  return out;
}

/** Each frame takes the majority of its neighbourhood. */
function vote(track: Uint8Array, half: number): void {
  const copy = track.slice();
  for (let f = 0; f < track.length; f++) {
    let sum = 0;
    let count = 0;
    for (let k = Math.max(0, f - half); k <= Math.min(track.length - 1, f + half); k++) {
      sum += copy[k];
      count++;
    }
    track[f] = 2 * sum > count ? 1 : 0;
  }
}
