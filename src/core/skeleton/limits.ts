/**
 * Anatomical ranges of the joints: a cone for how far a bone swings from rest, a range for its twist, a range for hinges.
 *
 * Sources: ranges of motion of adults as in the goniometry tables of the American Academy of Orthopaedic Surgeons,
 * rounded; spine shared over its three joints. Wider than comfort, narrower than contortion.
 */
import { J, JOINT_COUNT } from "./joints.ts";

/** Row of a joint: bone axis (x, y, z), largest swing, least and largest twist about the bone; radians. */
export const LIMIT_STRIDE = 6;

const DEG = Math.PI / 180;

/** Least and largest flexion of elbows and knees, radians. */
export const ELBOW_RANGE: readonly [number, number] = [0, 150 * DEG];
export const KNEE_RANGE: readonly [number, number] = [0, 150 * DEG];

/** Rows for all joints; a joint with a swing of pi or more is free. */
export const LIMITS: Float64Array = makeLimits();

function makeLimits(): Float64Array {
  const out = new Float64Array(JOINT_COUNT * LIMIT_STRIDE);
  const set = (joint: number, x: number, y: number, z: number, swing: number, low: number, high: number) =>
    out.set([x, y, z, swing * DEG, low * DEG, high * DEG], joint * LIMIT_STRIDE);
  for (let j = 0; j < JOINT_COUNT; j++) set(j, 0, 1, 0, 360, -360, 360);
  for (const j of [J.spine, J.chest, J.upperChest]) set(j, 0, 1, 0, 32, -16, 16);
  set(J.neck, 0, 1, 0, 45, -55, 55);
  set(J.head, 0, 1, 0, 35, -30, 30);
  set(J.leftShoulder, 1, 0, 0, 28, -12, 12);
  set(J.rightShoulder, -1, 0, 0, 28, -12, 12);
  set(J.leftUpperArm, 1, 0, 0, 118, -95, 95);
  set(J.rightUpperArm, -1, 0, 0, 118, -95, 95);
  set(J.leftUpperLeg, 0, -1, 0, 120, -48, 48);
  set(J.rightUpperLeg, 0, -1, 0, 120, -48, 48);
  return out;
}

/**
 * Splits a local rotation into swing and twist about the joint's bone, and holds both to the limits.
 *
 * @param q quaternion xyzw at `o`, changed in place when it is outside.
 * @returns by how much it was outside, radians (swing plus twist); 0 within.
 */
export function holdToLimits(q: Float64Array, o: number, joint: number): number {
  const l = joint * LIMIT_STRIDE;
  const most = LIMITS[l + 3];
  if (most >= Math.PI) return 0;
  const ax = LIMITS[l];
  const ay = LIMITS[l + 1];
  const az = LIMITS[l + 2];
  let x = q[o];
  let y = q[o + 1];
  let z = q[o + 2];
  let w = q[o + 3];
  if (w < 0) {
    x = -x;
    y = -y;
    z = -z;
    w = -w;
  }
  const along = x * ax + y * ay + z * az;
  let twist = 2 * Math.atan2(along, w);
  if (twist > Math.PI) twist -= 2 * Math.PI;
  else if (twist < -Math.PI) twist += 2 * Math.PI;
  // Length of the part of the vector that is square to the bone: sine of half the swing.
  const sine = Math.min(1, Math.sqrt(Math.max(0, x * x + y * y + z * z - along * along)));
  const swing = 2 * Math.asin(sine);
  const heldTwist = Math.max(LIMITS[l + 4], Math.min(LIMITS[l + 5], twist));
  const heldSwing = Math.min(most, swing);
  const over = Math.abs(twist - heldTwist) + (swing - heldSwing);
  if (over < 1e-9) return 0;
  // swing = q * twist^-1, an axis square to the bone.
  const tc = Math.cos(twist / 2);
  const ts = -Math.sin(twist / 2);
  const tx = ts * ax;
  const ty = ts * ay;
  const tz = ts * az;
  const sx = w * tx + x * tc + y * tz - z * ty;
  const sy = w * ty - x * tz + y * tc + z * tx;
  const sz = w * tz + x * ty - y * tx + z * tc;
  const n = Math.sqrt(sx * sx + sy * sy + sz * sz);
  const f = n > 1e-12 ? Math.sin(heldSwing / 2) / n : 0;
  const cw = Math.cos(heldSwing / 2);
  const hc = Math.cos(heldTwist / 2);
  const hs = Math.sin(heldTwist / 2);
  const ux = sx * f;
  const uy = sy * f;
  const uz = sz * f;
  const vx = hs * ax;
  const vy = hs * ay;
  const vz = hs * az;
  q[o] = cw * vx + ux * hc + uy * vz - uz * vy;
  q[o + 1] = cw * vy - ux * vz + uy * hc + uz * vx;
  q[o + 2] = cw * vz + ux * vy - uy * vx + uz * hc;
  q[o + 3] = cw * hc - ux * vx - uy * vy - uz * vz;
  return over;
}
