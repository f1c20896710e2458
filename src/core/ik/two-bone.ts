/**
 * Analytic two-bone chains: legs and arms, closed exactly.
 *
 * The middle joint bends in the plane that the pose given shows, then the whole limb turns the shortest way onto its
 * target, so the twist of the data's pose is kept.
 */
import {
  quatBetween,
  quatInverseMultiply,
  quatMultiply,
  quatNormalize,
  quatRotate,
} from "../math/quaternion.ts";

const work = new Float64Array(32);

/**
 * Turns `upper` and `lower` of a limb so that its end joint stands on a target.
 *
 * @param rotations local rotations (JOINT_COUNT x 4 from `base`), upper's and lower's entries are written.
 * @param positions world places of the joints; those of lower and end are written.
 * @param worldRotations world rotations; those of upper and lower are written.
 * @param parent joint above `upper`.
 * @param hint x, y, z in `hints` at `hintOffset`: the direction the middle joint points to when the limb is
 *   straight, world.
 * @returns how far the target is beyond reach, metres; 0 when reached.
 */
export function solveTwoBone(
  rotations: Float64Array,
  base: number,
  positions: Float64Array,
  worldRotations: Float64Array,
  parent: number,
  upper: number,
  lower: number,
  end: number,
  offsets: Float64Array,
  tx: number,
  ty: number,
  tz: number,
  hints: Float64Array,
  hintOffset: number,
): number {
  const hx = positions[3 * upper];
  const hy = positions[3 * upper + 1];
  const hz = positions[3 * upper + 2];
  const a = Math.hypot(offsets[3 * lower], offsets[3 * lower + 1], offsets[3 * lower + 2]);
  const b = Math.hypot(offsets[3 * end], offsets[3 * end + 1], offsets[3 * end + 2]);
  let dx = tx - hx;
  let dy = ty - hy;
  let dz = tz - hz;
  const distance = Math.sqrt(dx * dx + dy * dy + dz * dz);
  const longest = (a + b) * 0.99999;
  const shortest = Math.abs(a - b) * 1.001 + 1e-6;
  const reach = Math.max(shortest, Math.min(longest, distance));
  const short = Math.max(0, distance - longest);
  if (distance > 1e-9) {
    dx /= distance;
    dy /= distance;
    dz /= distance;
  } else dy = -1;
  // Direction of the middle joint, square to the way to the target.
  let px = positions[3 * lower] - hx;
  let py = positions[3 * lower + 1] - hy;
  let pz = positions[3 * lower + 2] - hz;
  let along = px * dx + py * dy + pz * dz;
  px -= along * dx;
  py -= along * dy;
  pz -= along * dz;
  let n = Math.sqrt(px * px + py * py + pz * pz);
  // Near straight the pose says little: lean on the hint.
  const trust = Math.min(1, n / (0.06 * a));
  let qx = hints[hintOffset];
  let qy = hints[hintOffset + 1];
  let qz = hints[hintOffset + 2];
  along = qx * dx + qy * dy + qz * dz;
  qx -= along * dx;
  qy -= along * dy;
  qz -= along * dz;
  const m = Math.sqrt(qx * qx + qy * qy + qz * qz);
  if (trust < 1 && m > 1e-6) {
    const f = n > 1e-9 ? trust / n : 0;
    const g = (1 - trust) / m;
    px = px * f + qx * g;
    py = py * f + qy * g;
    pz = pz * f + qz * g;
    n = Math.sqrt(px * px + py * py + pz * pz);
  }
  if (n < 1e-9) return short;
  px /= n;
  py /= n;
  pz /= n;
  const cosHip = Math.max(-1, Math.min(1, (a * a + reach * reach - b * b) / (2 * a * reach)));
  const sinHip = Math.sqrt(1 - cosHip * cosHip);
  const kx = hx + a * (cosHip * dx + sinHip * px);
  const ky = hy + a * (cosHip * dy + sinHip * py);
  const kz = hz + a * (cosHip * dz + sinHip * pz);
  const ex = hx + reach * dx;
  const ey = hy + reach * dy;
  const ez = hz + reach * dz;
  // Upper bone: from where the pose points to the middle joint.
  aim(worldRotations, upper, positions, lower, hx, hy, hz, kx, ky, kz, a);
  // Lower bone follows the upper rigidly before it is aimed: keep the local rotation of the pose.
  quatMultiply(worldRotations, 4 * lower, worldRotations, 4 * upper, rotations, base + 4 * lower);
  positions[3 * lower] = kx;
  positions[3 * lower + 1] = ky;
  positions[3 * lower + 2] = kz;
  quatRotate(
    work,
    0,
    worldRotations,
    4 * lower,
    offsets[3 * end],
    offsets[3 * end + 1],
    offsets[3 * end + 2],
  );
  positions[3 * end] = kx + work[0];
  positions[3 * end + 1] = ky + work[1];
  positions[3 * end + 2] = kz + work[2];
  aim(worldRotations, lower, positions, end, kx, ky, kz, ex, ey, ez, b);
  positions[3 * end] = ex;
  positions[3 * end + 1] = ey;
  positions[3 * end + 2] = ez;
  quatInverseMultiply(rotations, base + 4 * upper, worldRotations, 4 * parent, worldRotations, 4 * upper);
  quatInverseMultiply(rotations, base + 4 * lower, worldRotations, 4 * upper, worldRotations, 4 * lower);
  quatNormalize(rotations, base + 4 * upper);
  quatNormalize(rotations, base + 4 * lower);
  return short;
}

/** Turns a joint's world rotation so that its child, now at `positions[child]`, comes to lie towards the target. */
function aim(
  worldRotations: Float64Array,
  joint: number,
  positions: Float64Array,
  child: number,
  jx: number,
  jy: number,
  jz: number,
  tx: number,
  ty: number,
  tz: number,
  length: number,
): void {
  const f = 1 / length;
  quatBetween(
    work,
    8,
    (positions[3 * child] - jx) * f,
    (positions[3 * child + 1] - jy) * f,
    (positions[3 * child + 2] - jz) * f,
    (tx - jx) * f,
    (ty - jy) * f,
    (tz - jz) * f,
  );
  quatMultiply(worldRotations, 4 * joint, work, 8, worldRotations, 4 * joint);
  quatNormalize(worldRotations, 4 * joint);
}
