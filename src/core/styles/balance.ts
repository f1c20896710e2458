/**
 * Balance on a path: the hips are shifted over the ground so that the zero-moment point comes back to the planted soles.
 *
 * The same correction as core/motion/balance-pass.ts, here for bodies that follow a path: along the path the shift is free,
 * across it the hips stay within a few centimetres of where the sample carries them [Express §6.3].
 */

import { CLIP_RATE, type Clip } from "../capture/clip.ts";
import { GRAVITY } from "../math/gravity.ts";
import { convexHull, createHull, nearestInHull } from "../math/hull.ts";
import { gaussian, solveTridiagonal } from "../math/interpolate.ts";
import { forwardKinematics } from "../skeleton/forward-kinematics.ts";
import { JOINT_COUNT } from "../skeleton/joints.ts";
import { zeroMomentPoint } from "../skeleton/zero-moment.ts";
import type { StylePlant } from "./feet.ts";

/** Rounds of measuring and shifting: the legs follow the hips by half. */
const ROUNDS = 3;
/** No frame asks for more in a round, metres. */
const MOST = 0.14;
/** The hips leave the sample's own way by no more than this, along and across the path, metres. */
const MOST_ALONG = 0.09;
const MOST_ACROSS = 0.03;
/** Softness over time, frames. */
const SOFT = 2.5;
/** Half widths of the sole under heel, ball and tip, as shares of the distance from ankle to ball. */
const HALF = [0.2, 0.3, 0.24] as const;

const Q = 4 * JOINT_COUNT;
const corners = new Float64Array(24);
const nearest = new Float64Array(2);
const hull = createHull(12);

/**
 * Shifts a clip's hips; the feet stay.
 *
 * @param contacts contact bits a frame; @param heading of the path itself a frame, radians.
 * @param closeLegs closes the legs on the feet after each shift.
 */
export function balanceOnPath(
  clip: Clip,
  plants: readonly StylePlant[],
  contacts: Uint8Array,
  heading: Float64Array,
  closeLegs: () => void,
): void {
  const n = clip.frames;
  if (n < 12) return;
  const joints = new Float64Array(3 * JOINT_COUNT * n);
  const place = new Float64Array(3 * JOINT_COUNT);
  const world = new Float64Array(Q);
  const missing = new Float64Array(2 * n);
  const raw = new Float64Array(2 * n);
  const root = clip.root.slice();
  for (let round = 0; round < ROUNDS; round++) {
    for (let f = 0; f < n; f++) {
      forwardKinematics(place, world, clip.skeleton, clip.root, 3 * f, clip.rotations, Q * f);
      joints.set(place, 3 * JOINT_COUNT * f);
    }
    missingSupport(missing, zeroMomentPoint(joints, n, CLIP_RATE, 3), clip, plants, contacts);
    solveShift(missing, clip);
    for (let k = 0; k < 2 * n; k++) raw[k] += missing[k];
    for (let f = 0; f < n; f++) {
      const s = Math.sin(heading[f]);
      const c = Math.cos(heading[f]);
      const along = bounded(s * raw[2 * f] + c * raw[2 * f + 1], MOST_ALONG);
      const across = bounded(c * raw[2 * f] - s * raw[2 * f + 1], MOST_ACROSS);
      clip.root[3 * f] = root[3 * f] + s * along + c * across;
      clip.root[3 * f + 2] = root[3 * f + 2] + c * along - s * across;
    }
    closeLegs();
  }
}

/** Softly at most `most`: nearly the value itself while it is small. */
const bounded = (v: number, most: number): number => most * Math.tanh(v / most);

/** How far each frame's zero-moment point must move to lie in the support; nothing in flight. */
function missingSupport(
  out: Float64Array,
  point: Float64Array,
  clip: Clip,
  plants: readonly StylePlant[],
  contacts: Uint8Array,
): void {
  const { foot } = clip.skeleton;
  const standing: (StylePlant | null)[] = [null, null];
  let next = 0;
  for (let f = 0; f < clip.frames; f++) {
    while (next < plants.length && plants[next].from <= f) {
      standing[plants[next].foot === "left" ? 0 : 1] = plants[next];
      next++;
    }
    let count = 0;
    for (let side = 0; side < 2; side++) {
      const plant = standing[side];
      const bits = (contacts[f] >> (2 * side)) & 3;
      if (!plant || bits === 0) continue;
      const s = Math.sin(plant.yaw);
      const c = Math.cos(plant.yaw);
      for (let k = 0; k < 3; k++) {
        if (!(bits & (k === 0 ? 1 : 2))) continue;
        const ahead =
          k === 0 ? -foot.heelBack : k === 1 ? foot.ballForward : foot.ballForward + foot.tipForward;
        for (let half = -1; half <= 1; half += 2) {
          const w = half * HALF[k] * foot.ballForward;
          corners[2 * count] = plant.x + s * ahead + c * w;
          corners[2 * count + 1] = plant.z + c * ahead - s * w;
          count++;
        }
      }
    }
    out[2 * f] = 0;
    out[2 * f + 1] = 0;
    if (count === 0) continue;
    convexHull(hull, corners, count);
    nearestInHull(nearest, hull, point[2 * f], point[2 * f + 1]);
    const dx = nearest[0] - point[2 * f];
    const dz = nearest[1] - point[2 * f + 1];
    const scale = Math.min(1, MOST / (Math.sqrt(dx * dx + dz * dz) || 1));
    out[2 * f] = scale * dx;
    out[2 * f + 1] = scale * dz;
  }
  gaussian(out, 2, SOFT);
}

/** Solves d - h/g d'' = missing for each axis, in place; no speed at either end. */
function solveShift(missing: Float64Array, clip: Clip): void {
  const n = clip.frames;
  const a = new Float64Array(n);
  const b = new Float64Array(n);
  const c = new Float64Array(n);
  const d = new Float64Array(n);
  for (let axis = 0; axis < 2; axis++) {
    for (let f = 0; f < n; f++) {
      // The centre of mass is a little over the hips.
      const k = (Math.max(0.3, clip.root[3 * f + 1] * 1.05) / GRAVITY) * CLIP_RATE * CLIP_RATE;
      a[f] = f > 0 ? -k : 0;
      c[f] = f < n - 1 ? -k : 0;
      b[f] = 1 - a[f] - c[f];
      d[f] = missing[2 * f + axis];
    }
    solveTridiagonal(a, b, c, d);
    for (let f = 0; f < n; f++) missing[2 * f + axis] = d[f];
  }
}
