/**
 * A two-bone limb in a fixed plane about its socket: the place that FABRIK's two passes converge to, taken at once.
 *
 * Both bones share the hinge's axis, so elbow and knee never twist. What is free is the swivel about the way from socket to
 * target: the limb swings there as one piece, and its swivel stays as long as the socket's limits allow, else it turns the least that does.
 */
import {
  quatBetween,
  quatInverseMultiply,
  quatMultiply,
  quatNormalize,
  quatRotate,
} from "../math/quaternion.ts";
import { J } from "../skeleton/joints.ts";
import { ELBOW_RANGE, holdToLimits, KNEE_RANGE } from "../skeleton/limits.ts";
import type { Skeleton } from "../skeleton/skeleton.ts";

/** The four limbs: left arm, right arm, left leg, right leg. */
export interface Limb {
  upper: number;
  parent: number;
  /** Lengths of both bones, metres. */
  a: number;
  b: number;
  /** Bone's way at rest and the hinge's axis about which flexion is positive, in the joint's own frame. */
  bone: readonly [number, number, number];
  hinge: readonly [number, number, number];
  range: readonly [number, number];
}

/** The limbs of a skeleton, in the order of the effectors: hands, then feet. */
export function limbsOf(skeleton: Skeleton): Limb[] {
  const o = skeleton.offsets;
  const length = (j: number): number => Math.hypot(o[3 * j], o[3 * j + 1], o[3 * j + 2]);
  const limb = (upper: number, bone: Limb["bone"], hinge: Limb["hinge"], range: Limb["range"]): Limb => ({
    upper,
    parent: upper === J.leftUpperLeg || upper === J.rightUpperLeg ? J.hips : upper - 1,
    a: length(upper + 1),
    b: length(upper + 2),
    bone,
    hinge,
    range,
  });
  return [
    limb(J.leftUpperArm, [1, 0, 0], [0, -1, 0], ELBOW_RANGE),
    limb(J.rightUpperArm, [-1, 0, 0], [0, 1, 0], ELBOW_RANGE),
    limb(J.leftUpperLeg, [0, -1, 0], [1, 0, 0], KNEE_RANGE),
    limb(J.rightUpperLeg, [0, -1, 0], [1, 0, 0], KNEE_RANGE),
  ];
}

const w = new Float64Array(32);
/** Swivels that are tried, radians, the nearest first; then the best is refined. */
const TRIES = Array.from({ length: 36 }, (_, i) => (((i & 1 ? 1 : -1) * ((i >> 1) + 1)) / 18) * Math.PI);

/**
 * Closes a limb on a target: local rotations of its two bones are written, places and world rotations of its joints brought up
 * to date.
 *
 * @param held whether the socket keeps to its limits. Over frames it should not: which swivel is nearest within limits may jump
 *   from one frame to the next, and a motion's own poses are within them but for a little.
 * @returns the distance left, metres.
 */
export function closeLimb(
  limb: Limb,
  rotations: Float64Array,
  positions: Float64Array,
  world: Float64Array,
  tx: number,
  ty: number,
  tz: number,
  held = true,
): number {
  const { upper, parent, a, b, range } = limb;
  const s = 3 * upper;
  const hx = positions[s];
  const hy = positions[s + 1];
  const hz = positions[s + 2];
  let dx = tx - hx;
  let dy = ty - hy;
  let dz = tz - hz;
  const distance = Math.sqrt(dx * dx + dy * dy + dz * dz);
  const least = Math.sqrt(a * a + b * b + 2 * a * b * Math.cos(range[1]));
  const reach = Math.max(least, Math.min(a + b, distance));
  const inverse = 1 / Math.max(1e-9, distance);
  dx *= inverse;
  dy *= inverse;
  dz *= inverse;
  const cosFlexion = Math.max(-1, Math.min(1, (reach * reach - a * a - b * b) / (2 * a * b)));
  const flexion = Math.acos(cosFlexion);
  const cosSocket = Math.max(-1, Math.min(1, (a * a + reach * reach - b * b) / (2 * a * reach)));
  const sinSocket = Math.sqrt(1 - cosSocket * cosSocket);
  // The pose's own hinge axis, carried along as the whole limb swings from where it points to the target: taken by itself it
  // would turn about wildly where the way to the target passes near it.
  quatRotate(w, 0, world, 4 * upper, limb.hinge[0], limb.hinge[1], limb.hinge[2]);
  const ex = positions[s + 6] - hx;
  const ey = positions[s + 7] - hy;
  const ez = positions[s + 8] - hz;
  const e = Math.sqrt(ex * ex + ey * ey + ez * ez);
  if (e > 1e-6) {
    quatBetween(w, 24, ex / e, ey / e, ez / e, dx, dy, dz);
    quatRotate(w, 0, w, 24, w[0], w[1], w[2]);
  }
  const along = w[0] * dx + w[1] * dy + w[2] * dz;
  let nx = w[0] - along * dx;
  let ny = w[1] - along * dy;
  let nz = w[2] - along * dz;
  let n = Math.sqrt(nx * nx + ny * ny + nz * nz);
  if (n < 1e-6) {
    // The hinge lies along the way: any square axis will do.
    nx = Math.abs(dx) < 0.9 ? 0 : -dz;
    ny = Math.abs(dx) < 0.9 ? dz : 0;
    nz = Math.abs(dx) < 0.9 ? -dy : dx;
    n = Math.sqrt(nx * nx + ny * ny + nz * nz);
  }
  nx /= n;
  ny /= n;
  nz /= n;
  let over = orient(limb, rotations, world, dx, dy, dz, nx, ny, nz, cosSocket, sinSocket, flexion, 0, held);
  if (over > 0) {
    let best = 0;
    let least = over;
    for (const swivel of TRIES) {
      over = orient(
        limb,
        rotations,
        world,
        dx,
        dy,
        dz,
        nx,
        ny,
        nz,
        cosSocket,
        sinSocket,
        flexion,
        swivel,
        held,
      );
      if (over < least) {
        least = over;
        best = swivel;
        if (over === 0) break;
      }
    }
    for (let step = Math.PI / 36; least > 0 && step > 0.002; step /= 2) {
      for (const swivel of [best - step, best + step]) {
        over = orient(
          limb,
          rotations,
          world,
          dx,
          dy,
          dz,
          nx,
          ny,
          nz,
          cosSocket,
          sinSocket,
          flexion,
          swivel,
          held,
        );
        if (over < least) {
          least = over;
          best = swivel;
        }
      }
    }
    over = orient(limb, rotations, world, dx, dy, dz, nx, ny, nz, cosSocket, sinSocket, flexion, best, held);
  }
  // Local rotations within limits; then the joints' places.
  quatNormalize(rotations, 4 * upper);
  quatMultiply(world, 4 * upper, world, 4 * parent, rotations, 4 * upper);
  const half = flexion / 2;
  const sine = Math.sin(half);
  const l = 4 * (upper + 1);
  rotations[l] = limb.hinge[0] * sine;
  rotations[l + 1] = limb.hinge[1] * sine;
  rotations[l + 2] = limb.hinge[2] * sine;
  rotations[l + 3] = Math.cos(half);
  quatMultiply(world, l, world, 4 * upper, rotations, l);
  const { bone } = limb;
  quatRotate(positions, s + 3, world, 4 * upper, bone[0] * a, bone[1] * a, bone[2] * a);
  for (let k = 0; k < 3; k++) positions[s + 3 + k] += positions[s + k];
  quatRotate(positions, s + 6, world, l, bone[0] * b, bone[1] * b, bone[2] * b);
  for (let k = 0; k < 3; k++) positions[s + 6 + k] += positions[s + 3 + k];
  return Math.hypot(positions[s + 6] - tx, positions[s + 7] - ty, positions[s + 8] - tz);
}

/** Writes the socket's local rotation for a swivel, held to limits; returns by how much it was outside. */
function orient(
  limb: Limb,
  rotations: Float64Array,
  world: Float64Array,
  dx: number,
  dy: number,
  dz: number,
  nx: number,
  ny: number,
  nz: number,
  cosSocket: number,
  sinSocket: number,
  flexion: number,
  swivel: number,
  held: boolean,
): number {
  const c = Math.cos(swivel);
  const s = Math.sin(swivel);
  // Hinge axis turned about the way to the target.
  const mx = c * nx + s * (dy * nz - dz * ny);
  const my = c * ny + s * (dz * nx - dx * nz);
  const mz = c * nz + s * (dx * ny - dy * nx);
  // Flexing turns the lower bone about the hinge, so the upper bone leads the other way.
  const px = -(my * dz - mz * dy);
  const py = -(mz * dx - mx * dz);
  const pz = -(mx * dy - my * dx);
  const side = flexion > 0 ? sinSocket : 0;
  const ux = cosSocket * dx + side * px;
  const uy = cosSocket * dy + side * py;
  const uz = cosSocket * dz + side * pz;
  const { bone, hinge } = limb;
  // Frame of the joint at rest (bone, hinge, third) onto (u, m, u x m).
  const rx = bone[1] * hinge[2] - bone[2] * hinge[1];
  const ry = bone[2] * hinge[0] - bone[0] * hinge[2];
  const rz = bone[0] * hinge[1] - bone[1] * hinge[0];
  const vx = uy * mz - uz * my;
  const vy = uz * mx - ux * mz;
  const vz = ux * my - uy * mx;
  // Matrix with columns for the joint's x, y, z.
  w[8] = bone[0] * ux + hinge[0] * mx + rx * vx;
  w[9] = bone[0] * uy + hinge[0] * my + rx * vy;
  w[10] = bone[0] * uz + hinge[0] * mz + rx * vz;
  w[11] = bone[1] * ux + hinge[1] * mx + ry * vx;
  w[12] = bone[1] * uy + hinge[1] * my + ry * vy;
  w[13] = bone[1] * uz + hinge[1] * mz + ry * vz;
  w[14] = bone[2] * ux + hinge[2] * mx + rz * vx;
  w[15] = bone[2] * uy + hinge[2] * my + rz * vy;
  w[16] = bone[2] * uz + hinge[2] * mz + rz * vz;
  toQuaternion(w, 20, w, 8);
  quatInverseMultiply(rotations, 4 * limb.upper, world, 4 * limb.parent, w, 20);
  return held ? holdToLimits(rotations, 4 * limb.upper, limb.upper) : 0;
}

/** Quaternion of a matrix given by its three columns. */
function toQuaternion(out: Float64Array, o: number, m: Float64Array, i: number): void {
  const xx = m[i];
  const yy = m[i + 4];
  const zz = m[i + 8];
  const trace = xx + yy + zz;
  if (trace > 0) {
    const s = 2 * Math.sqrt(trace + 1);
    out[o] = (m[i + 5] - m[i + 7]) / s;
    out[o + 1] = (m[i + 6] - m[i + 2]) / s;
    out[o + 2] = (m[i + 1] - m[i + 3]) / s;
    out[o + 3] = s / 4;
  } else if (xx > yy && xx > zz) {
    const s = 2 * Math.sqrt(1 + xx - yy - zz);
    out[o] = s / 4;
    out[o + 1] = (m[i + 3] + m[i + 1]) / s;
    out[o + 2] = (m[i + 6] + m[i + 2]) / s;
    out[o + 3] = (m[i + 5] - m[i + 7]) / s;
  } else if (yy > zz) {
    const s = 2 * Math.sqrt(1 + yy - xx - zz);
    out[o] = (m[i + 3] + m[i + 1]) / s;
    out[o + 1] = s / 4;
    out[o + 2] = (m[i + 7] + m[i + 5]) / s;
    out[o + 3] = (m[i + 6] - m[i + 2]) / s;
  } else {
    const s = 2 * Math.sqrt(1 + zz - xx - yy);
    out[o] = (m[i + 6] + m[i + 2]) / s;
    out[o + 1] = (m[i + 7] + m[i + 5]) / s;
    out[o + 2] = s / 4;
    out[o + 3] = (m[i + 1] - m[i + 3]) / s;
  }
}
