/**
 * The space-time collision model [Footsteps §3.3, Figure 1c]: five circles, torso and two shoulders turned with the facing and the
 * feet where they are planted, each where it is at the moment asked about.
 */
import { farFromWalls, type Ground, nearestGap } from "./ground.ts";
import { BODY_RADIUS, FOOT_RADIUS, SHOULDER } from "./types.ts";

/** Gap kept to walls, and between feet, metres. */
const WALL_MARGIN = 0.015;
const FOOT_MARGIN = 0.01;
const FEET_APART = 2 * FOOT_RADIUS + FOOT_MARGIN;

/** Centres nearer than this may be bodies that touch, metres. */
export const REACH = 2 * BODY_RADIUS + 2 * SHOULDER;

/**
 * Gap between two bodies of three circles, metres, negative where they overlap; anything over `enough` may come back as that.
 *
 * @param a, i array and offset of one's x, z, facing x, z; b, k of the other's.
 */
export function bodyGap(a: Float64Array, i: number, b: Float64Array, k: number, enough: number): number {
  const dx = b[k] - a[i];
  const dz = b[k + 1] - a[i + 1];
  const d2 = dx * dx + dz * dz;
  const sure = enough + REACH;
  if (d2 > sure * sure) return enough;
  const ax = SHOULDER * a[i + 3];
  const az = -SHOULDER * a[i + 2];
  const bx = SHOULDER * b[k + 3];
  const bz = -SHOULDER * b[k + 2];
  let least = d2;
  for (let s = -1; s <= 1; s++)
    for (let t = -1; t <= 1; t++) {
      const x = dx + t * bx - s * ax;
      const z = dz + t * bz - s * az;
      const q = x * x + z * z;
      if (q < least) least = q;
    }
  const gap = Math.sqrt(least) - 2 * BODY_RADIUS;
  return gap < enough ? gap : enough;
}

/** Whether two planted feet are on each other. */
export function feetMeet(a: Float64Array, i: number, b: Float64Array, k: number): boolean {
  const dx = b[k + 4] - a[i + 4];
  const dz = b[k + 5] - a[i + 5];
  return dx * dx + dz * dz < FEET_APART * FEET_APART;
}

/** Whether a body and its planted foot stand clear of walls. */
export function clearOfWalls(ground: Ground, a: Float64Array, i: number): boolean {
  if (farFromWalls(ground, a[i], a[i + 1])) return true;
  const need = BODY_RADIUS + WALL_MARGIN;
  if (nearestGap(ground, a[i], a[i + 1]) < need) return false;
  const sx = SHOULDER * a[i + 3];
  const sz = -SHOULDER * a[i + 2];
  return (
    nearestGap(ground, a[i] + sx, a[i + 1] + sz) >= need &&
    nearestGap(ground, a[i] - sx, a[i + 1] - sz) >= need &&
    nearestGap(ground, a[i + 4], a[i + 5]) >= FOOT_RADIUS
  );
}
