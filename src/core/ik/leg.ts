/**
 * A leg closed on its ankle with the knee as a pure hinge: both bones share the knee's axis, so the knee never twists.
 */
import { quatInverseMultiply, quatNormalize, quatSet } from "../math/quaternion.ts";

/** Rotation whose columns are x, y, z (orthonormal) as a quaternion. */
export function quatFromBasis(
  out: Float64Array,
  o: number,
  xx: number,
  xy: number,
  xz: number,
  yx: number,
  yy: number,
  yz: number,
  zx: number,
  zy: number,
  zz: number,
): void {
  const trace = xx + yy + zz;
  if (trace > 0) {
    const s = 2 * Math.sqrt(trace + 1);
    quatSet(out, o, (yz - zy) / s, (zx - xz) / s, (xy - yx) / s, s / 4);
  } else if (xx > yy && xx > zz) {
    const s = 2 * Math.sqrt(1 + xx - yy - zz);
    quatSet(out, o, s / 4, (yx + xy) / s, (zx + xz) / s, (yz - zy) / s);
  } else if (yy > zz) {
    const s = 2 * Math.sqrt(1 + yy - xx - zz);
    quatSet(out, o, (yx + xy) / s, s / 4, (zy + yz) / s, (zx - xz) / s);
  } else {
    const s = 2 * Math.sqrt(1 + zz - xx - yy);
    quatSet(out, o, (zx + xz) / s, (zy + yz) / s, s / 4, (xy - yx) / s);
  }
}

/**
 * Bends the leg whose thigh is joint `upper` (shank upper + 1, foot upper + 2) to bring its ankle to (tx, ty, tz): the one two-bone
 * solution of the studio, the planner and the batch. No allocation.
 *
 * @param positions the hip's is read, knee's and ankle's are written; @param worldRotations thigh's and shank's are written.
 * @param a, b lengths of thigh and shank, metres. @param kx, ky, kz the way the knee points, any length.
 * @returns how far the target is beyond reach, metres.
 */
export function bendLeg(
  positions: Float64Array,
  worldRotations: Float64Array,
  upper: number,
  a: number,
  b: number,
  tx: number,
  ty: number,
  tz: number,
  kx: number,
  ky: number,
  kz: number,
): number {
  const lower = upper + 1;
  const foot = upper + 2;
  const hx = positions[3 * upper];
  const hy = positions[3 * upper + 1];
  const hz = positions[3 * upper + 2];
  let dx = tx - hx;
  let dy = ty - hy;
  let dz = tz - hz;
  const distance = Math.sqrt(dx * dx + dy * dy + dz * dz);
  const longest = (a + b) * 0.99999;
  const reach = Math.max(Math.abs(a - b) + 0.05 * (a + b), Math.min(longest, distance));
  const f = 1 / Math.max(1e-9, distance);
  dx *= f;
  dy *= f;
  dz *= f;
  const along = kx * dx + ky * dy + kz * dz;
  let px = kx - along * dx;
  let py = ky - along * dy;
  let pz = kz - along * dz;
  const n = Math.max(1e-9, Math.sqrt(px * px + py * py + pz * pz));
  px /= n;
  py /= n;
  pz /= n;
  const cosHip = Math.max(-1, Math.min(1, (a * a + reach * reach - b * b) / (2 * a * reach)));
  const sinHip = Math.sqrt(1 - cosHip * cosHip);
  const ux = cosHip * dx + sinHip * px;
  const uy = cosHip * dy + sinHip * py;
  const uz = cosHip * dz + sinHip * pz;
  const jx = hx + a * ux;
  const jy = hy + a * uy;
  const jz = hz + a * uz;
  const ex = hx + reach * dx;
  const ey = hy + reach * dy;
  const ez = hz + reach * dz;
  // Knee axis: to the left when the knee points forward.
  const xx = py * dz - pz * dy;
  const xy = pz * dx - px * dz;
  const xz = px * dy - py * dx;
  basisAlong(worldRotations, 4 * upper, xx, xy, xz, -ux, -uy, -uz);
  const sx = (ex - jx) / b;
  const sy = (ey - jy) / b;
  const sz = (ez - jz) / b;
  basisAlong(worldRotations, 4 * lower, xx, xy, xz, -sx, -sy, -sz);
  positions[3 * lower] = jx;
  positions[3 * lower + 1] = jy;
  positions[3 * lower + 2] = jz;
  positions[3 * foot] = ex;
  positions[3 * foot + 1] = ey;
  positions[3 * foot + 2] = ez;
  return Math.max(0, distance - longest);
}

/**
 * Closes the leg whose thigh is joint `upper` on the ankle place (tx, ty, tz).
 *
 * @param rotations local rotations, those of thigh and shank are written; @param positions, @param worldRotations
 *   likewise, hip's read; those of the foot's place written.
 * @param kx, ky, kz the way the knee points, any length.
 * @returns how far the target is beyond reach, metres.
 */
export function solveLeg(
  rotations: Float64Array,
  positions: Float64Array,
  worldRotations: Float64Array,
  parent: number,
  upper: number,
  offsets: Float64Array,
  tx: number,
  ty: number,
  tz: number,
  kx: number,
  ky: number,
  kz: number,
): number {
  const lower = upper + 1;
  const foot = upper + 2;
  const a = Math.hypot(offsets[3 * lower], offsets[3 * lower + 1], offsets[3 * lower + 2]);
  const b = Math.hypot(offsets[3 * foot], offsets[3 * foot + 1], offsets[3 * foot + 2]);
  const beyond = bendLeg(positions, worldRotations, upper, a, b, tx, ty, tz, kx, ky, kz);
  quatInverseMultiply(rotations, 4 * upper, worldRotations, 4 * parent, worldRotations, 4 * upper);
  quatInverseMultiply(rotations, 4 * lower, worldRotations, 4 * upper, worldRotations, 4 * lower);
  quatNormalize(rotations, 4 * upper);
  quatNormalize(rotations, 4 * lower);
  return beyond;
}

/** World rotation with the given X and Y axes (square to each other, unit). */
export function basisAlong(
  out: Float64Array,
  o: number,
  xx: number,
  xy: number,
  xz: number,
  yx: number,
  yy: number,
  yz: number,
): void {
  quatFromBasis(out, o, xx, xy, xz, yx, yy, yz, xy * yz - xz * yy, xz * yx - xx * yz, xx * yy - xy * yx);
  quatNormalize(out, o);
}
