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

/** Of the way from a body's middle to its shoulder, m^2. */
const SQUARE = SHOULDER * SHOULDER;

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
  const least = leastSquare(dx, dz, d2, a[i + 2], a[i + 3], b[k + 2], b[k + 3]);
  const gap = Math.sqrt(least > 0 ? least : 0) - 2 * BODY_RADIUS;
  return gap < enough ? gap : enough;
}

/**
 * Least square of the distance between two bodies' circles, middle to middle, m^2 (a rounding error below 0 at worst).
 *
 * That is |d + t B - s A|^2 over s and t of -1, 0, 1, with A and B from the middles to the left shoulders: the best signs in each case.
 *
 * @param dx, dz, d2 from one's middle to the other's, and its square. @param ax, az, bx, bz their facings.
 */
export function leastSquare(
  dx: number,
  dz: number,
  d2: number,
  ax: number,
  az: number,
  bx: number,
  bz: number,
): number {
  const da = SHOULDER * (dx * az - dz * ax);
  const db = SHOULDER * (dx * bz - dz * bx);
  const ab = SQUARE * (az * bz + ax * bx);
  const one = SQUARE - 2 * Math.max(Math.abs(da), Math.abs(db));
  const both = 2 * (SQUARE - Math.max(ab + Math.abs(db - da), Math.abs(db + da) - ab));
  return d2 + Math.min(0, one, both);
}

/** Whether two planted feet are on each other. */
export function feetMeet(a: Float64Array, i: number, b: Float64Array, k: number): boolean {
  const dx = b[k + 4] - a[i + 4];
  const dz = b[k + 5] - a[i + 5];
  return dx * dx + dz * dz < FEET_APART * FEET_APART;
}

const shoulders = new Float64Array(4);

/** Whether a body and its planted foot stand clear of walls. */
export function clearOfWalls(ground: Ground, a: Float64Array, i: number): boolean {
  if (farFromWalls(ground, a[i], a[i + 1])) return true;
  const need = BODY_RADIUS + WALL_MARGIN;
  const gap = nearestGap(ground, a, i);
  if (gap < need) return false;
  // What is not farther from the middle than the wall is from it is clear as well.
  const footX = a[i + 4] - a[i];
  const footZ = a[i + 5] - a[i + 1];
  const left = gap - FOOT_RADIUS;
  if (gap >= need + SHOULDER && footX * footX + footZ * footZ <= left * left) return true;
  const sx = SHOULDER * a[i + 3];
  const sz = -SHOULDER * a[i + 2];
  shoulders[0] = a[i] + sx;
  shoulders[1] = a[i + 1] + sz;
  shoulders[2] = a[i] - sx;
  shoulders[3] = a[i + 1] - sz;
  return (
    nearestGap(ground, shoulders, 0) >= need &&
    nearestGap(ground, shoulders, 2) >= need &&
    nearestGap(ground, a, i + 4) >= FOOT_RADIUS
  );
}
