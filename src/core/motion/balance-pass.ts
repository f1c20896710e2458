/**
 * Balance of a planned motion: the root is shifted over the ground so that the zero-moment point of the whole body
 * comes back to the planted feet.
 *
 * Warping a capture to other footsteps moves the feet exactly and the body about, so that the body's own forces no
 * longer go through the soles. For a shift d of the whole body at height h the zero-moment point moves by
 * d - h/g d'': given how far it lies outside the support, that is a boundary-value problem with one band, solved at
 * once for all frames [Kajita et al. 2003, Nakaoka et al. 2003 use the same correction]. Its influence dies out within
 * about a second, and frames already shown are held, so that a re-plan has no seam.
 */

import { CLIP_RATE } from "../capture/clip.ts";
import { GRAVITY } from "../math/gravity.ts";
import { convexHull, createHull, nearestInHull } from "../math/hull.ts";
import { gaussian, solveTridiagonal } from "../math/interpolate.ts";
import { quatRotate } from "../math/quaternion.ts";
import { JOINT_COUNT } from "../skeleton/joints.ts";
import type { Skeleton } from "../skeleton/skeleton.ts";
import { zeroMomentPoint } from "../skeleton/zero-moment.ts";
import type { BodyTrack } from "./body-pass.ts";
import { FOOT_STRIDE } from "./foot-pose.ts";
import { closeLegs, type LimbWorkspace } from "./limb-pass.ts";
import { type TaskWindow, windowWeight } from "./task-windows.ts";

/** What balance and reach have done to the motion that is shown, and its last frame that has been. */
export interface KeptBalance {
  shift: Float64Array;
  /** How far its hips were lowered for the legs to reach, a frame. */
  drop: Float64Array;
  /** How far its heels were raised, left and right a frame. */
  heels: Float64Array;
  until: number;
}

/** Rounds of measuring and shifting: the legs follow the hips by half, so that one round does not do. */
const ROUNDS = 3;
/** No frame asks for more, metres: beyond it the footsteps themselves are out of balance, and a body would step. */
const MOST = 0.14;
/** Softness of the correction over time, frames: support jumps where a foot lifts, forces do not. */
const SOFT = 2.5;
/** How firmly frames that were shown are held, and seats kept; frames in which the hold dies out. */
const HOLD = 1e6;
const SEAT = 300;
const FADE = 40;
/** Half widths of the sole under heel and ball, as shares of the distance from ankle to ball. */
const HALF_HEEL = 0.2;
const HALF_BALL = 0.3;

/** Shifts `track.root` over the ground and notes the shift in `track.shift`. */
export function balanceBody(
  track: BodyTrack,
  windows: readonly TaskWindow[],
  skeleton: Skeleton,
  limbs: LimbWorkspace,
  kept: KeptBalance | null,
): void {
  const n = track.frames;
  if (n < 12) return;
  const hold = new Float64Array(n);
  const wanted = new Float64Array(2 * n);
  for (const w of windows) {
    if (w.task.category !== "sit") continue;
    for (let f = Math.max(0, w.from); f < Math.min(n, w.over); f++)
      hold[f] = Math.max(hold[f], SEAT * windowWeight(w, f) ** 3);
  }
  if (kept) {
    const known = kept.shift.length / 2;
    for (let f = 0; f < Math.min(n, known, kept.until + FADE); f++) {
      const weight = f <= kept.until ? HOLD : HOLD * Math.exp((-20 * (f - kept.until)) / FADE);
      if (weight < hold[f]) continue;
      hold[f] = weight;
      wanted[2 * f] = kept.shift[2 * f];
      wanted[2 * f + 1] = kept.shift[2 * f + 1];
    }
  }
  const joints = new Float64Array(3 * JOINT_COUNT * n);
  const missing = new Float64Array(2 * n);
  for (let round = 0; round < ROUNDS; round++) {
    for (let f = 0; f < n; f++) {
      closeLegs(limbs, track, f, skeleton);
      joints.set(limbs.positions, 3 * JOINT_COUNT * f);
    }
    missingSupport(missing, zeroMomentPoint(joints, n, CLIP_RATE, 3), track, skeleton);
    shiftBody(track, missing, hold, wanted);
  }
}

const corners = new Float64Array(24);
const place = new Float64Array(3);
const nearest = new Float64Array(2);
const hull = createHull(12);

/** How far each frame's zero-moment point must move to lie in the support. */
function missingSupport(out: Float64Array, point: Float64Array, track: BodyTrack, skeleton: Skeleton): void {
  const n = track.frames;
  for (let f = 0; f < n; f++) {
    const count = supportCorners(track, f, skeleton);
    if (count === 0) {
      out[2 * f] = f > 0 ? out[2 * f - 2] : 0;
      out[2 * f + 1] = f > 0 ? out[2 * f - 1] : 0;
      continue;
    }
    convexHull(hull, corners, count);
    nearestInHull(nearest, hull, point[2 * f], point[2 * f + 1]);
    const dx = nearest[0] - point[2 * f];
    const dz = nearest[1] - point[2 * f + 1];
    const scale = Math.min(1, MOST / (Math.hypot(dx, dz) || 1));
    out[2 * f] = scale * dx;
    out[2 * f + 1] = scale * dz;
  }
  gaussian(out, 2, SOFT);
}

/** Corners of the planted ends of both soles at a frame, into `corners`; their number. */
function supportCorners(track: BodyTrack, frame: number, skeleton: Skeleton): number {
  const { foot } = skeleton;
  let count = 0;
  const push = (o: number, forward: number, half: number): void => {
    for (const s of [-half, half]) {
      quatRotate(place, 0, track.feet, o + 3, s, -foot.ankleHeight, forward);
      corners[2 * count] = track.feet[o] + place[0];
      corners[2 * count + 1] = track.feet[o + 2] + place[2];
      count++;
    }
  };
  for (let side = 0; side < 2; side++) {
    const bits = (track.contacts[frame] >> (2 * side)) & 3;
    const o = (2 * frame + side) * FOOT_STRIDE;
    if (bits & 1) push(o, -foot.heelBack, HALF_HEEL * foot.ballForward);
    if (bits & 2) {
      push(o, foot.ballForward, HALF_BALL * foot.ballForward);
      push(o, foot.ballForward + 0.7 * foot.tipForward, 0.8 * HALF_BALL * foot.ballForward);
    }
  }
  return count;
}

/** Solves d - h/g d'' + hold (d + shift - wanted) = missing for each axis and adds d to the root. */
function shiftBody(track: BodyTrack, missing: Float64Array, hold: Float64Array, wanted: Float64Array): void {
  const n = track.frames;
  const a = new Float64Array(n);
  const b = new Float64Array(n);
  const c = new Float64Array(n);
  const d = new Float64Array(n);
  const square = CLIP_RATE * CLIP_RATE;
  for (let axis = 0; axis < 2; axis++) {
    for (let f = 0; f < n; f++) {
      // The centre of mass is a little over the hips.
      const k = (Math.max(0.3, track.root[3 * f + 1] * 1.05) / GRAVITY) * square;
      // No speed at either end: the motion begins and ends standing.
      a[f] = f > 0 ? -k : 0;
      c[f] = f < n - 1 ? -k : 0;
      b[f] = 1 - a[f] - c[f] + hold[f];
      d[f] = missing[2 * f + axis] + hold[f] * (wanted[2 * f + axis] - track.shift[2 * f + axis]);
    }
    solveTridiagonal(a, b, c, d);
    for (let f = 0; f < n; f++) {
      track.root[3 * f + 2 * axis] += d[f];
      track.shift[2 * f + axis] += d[f];
    }
  }
}
