/**
 * Knees in the air: a foot whose new way [Express §7.1] leads it just out of reach makes the leg snap straight and back within
 * a few frames. Where a knee would accelerate more than real ones do, its bend is spread over the neighbouring frames and
 * the foot is carried a few millimetres nearer to the hip. Not in the paper.
 */
import type { Clip } from "../capture/clip.ts";
import { quatRotate } from "../math/quaternion.ts";
import { J, JOINT_COUNT } from "../skeleton/joints.ts";
import type { FeetTrack, StylePlant } from "./feet.ts";

/**
 * Largest acceleration of a knee in the air, radians a second squared. The 99.9th percentile of real walks is 240, of real
 * runs 400 (30 frames a second).
 */
const MOST = 320;
/** Sweeps over a swing; most need a few. */
const SWEEPS = 60;
/** A foot is never carried farther from the hip than this, metres: it might meet the ground. */
const MOST_DOWN = 0.003;

const Q = 4 * JOINT_COUNT;

/**
 * Eases the knees of a clip between plants: moves `feet.ankle`, the legs are to be closed anew.
 *
 * @returns whether any ankle was moved.
 */
export function easeKnees(clip: Clip, feet: FeetTrack, plants: readonly StylePlant[]): boolean {
  const o = clip.skeleton.offsets;
  const thigh = -o[3 * J.leftLowerLeg + 1];
  const shank = -o[3 * J.leftFoot + 1];
  const squares = thigh * thigh + shank * shank;
  const product = 2 * thigh * shank;
  const n = clip.frames;
  const limit = MOST / (clip.rate * clip.rate);
  const bend = new Float64Array(n);
  const hip = new Float64Array(3 * n);
  const v = new Float64Array(3);
  let moved = false;
  for (let side = 0; side < 2; side++) {
    const foot = side === 0 ? "left" : "right";
    const joint = 3 * (side === 0 ? J.leftUpperLeg : J.rightUpperLeg);
    const own = plants.filter((p) => p.foot === foot);
    for (let f = 0; f < n; f++) {
      quatRotate(v, 0, clip.rotations, Q * f, o[joint], o[joint + 1], o[joint + 2]);
      let square = 0;
      for (let k = 0; k < 3; k++) {
        hip[3 * f + k] = clip.root[3 * f + k] + v[k];
        const d = feet.ankle[6 * f + 3 * side + k] - hip[3 * f + k];
        square += d * d;
      }
      bend[f] = Math.acos(Math.max(-1, Math.min(1, (square - squares) / product)));
    }
    for (let i = 0; i + 1 < own.length; i++) {
      const from = own[i].to;
      const to = own[i + 1].from;
      if (from < 2 || to + 2 > n || to <= from || !relax(bend, from, to, limit)) continue;
      for (let f = from; f < to; f++) {
        const p = 6 * f + 3 * side;
        let square = 0;
        for (let k = 0; k < 3; k++) {
          const d = feet.ankle[p + k] - hip[3 * f + k];
          square += d * d;
        }
        const far = Math.sqrt(square);
        const wanted = Math.min(far + MOST_DOWN, Math.sqrt(squares + product * Math.cos(bend[f])));
        for (let k = 0; k < 3; k++)
          feet.ankle[p + k] = hip[3 * f + k] + ((feet.ankle[p + k] - hip[3 * f + k]) * wanted) / far;
      }
      moved = true;
    }
  }
  return moved;
}

/** Spreads second differences over `limit` to the neighbours; frames outside [from, to) stay. False when there were none. */
function relax(track: Float64Array, from: number, to: number, limit: number): boolean {
  let changed = false;
  for (let sweep = 0; sweep < SWEEPS; sweep++) {
    let calm = true;
    for (let f = from - 1; f <= to; f++) {
      const a = track[f - 1] - 2 * track[f] + track[f + 1];
      const excess = a > limit ? a - limit : a < -limit ? a + limit : 0;
      if (excess === 0) continue;
      const before = f - 1 >= from && f - 1 < to ? 1 : 0;
      const here = f >= from && f < to ? 1 : 0;
      const after = f + 1 >= from && f + 1 < to ? 1 : 0;
      const weight = before + 4 * here + after;
      if (weight === 0) continue;
      if (Math.abs(excess) > 0.02 * limit) calm = false;
      const share = excess / weight;
      track[f - 1] -= before * share;
      track[f] += 2 * here * share;
      track[f + 1] -= after * share;
      changed = true;
    }
    if (calm) break;
  }
  return changed;
}
