/**
 * Full-body FABRIK with joint limits and five end effectors: both hands, both feet, the head
 * [Aristidou and Lasenby 2011, §4: multiple end effectors and sub-bases; TaskLoco §6, Figure 12].
 *
 * A round goes as FABRIK's does. Backward: every chain is laid from its target towards the trunk; two-bone limbs by the
 * place their passes converge to (limb.ts), so a limb that reaches asks for nothing, and one that does not asks its
 * sub-base for what it lacks. Forward: hips and spine, each a rigid sub-base of several chains, move by the mean of
 * what is asked of them and turn to it, every joint held to its limits, and the limbs close again from their new sockets. It
 * starts from the pose of the data, so the answer is the nearest such pose rather than any.
 */
import {
  quatFromRotationVector,
  quatInverseMultiply,
  quatMultiply,
  quatNormalize,
} from "../math/quaternion.ts";
import { forwardKinematics } from "../skeleton/forward-kinematics.ts";
import { J, JOINT_COUNT, PARENTS } from "../skeleton/joints.ts";
import { holdToLimits } from "../skeleton/limits.ts";
import type { Skeleton } from "../skeleton/skeleton.ts";
import { closeLimb, type Limb, limbsOf } from "./limb.ts";

/** Order of effectors in `targets`: left hand, right hand, left foot, right foot, head. */
export const EFFECTORS: readonly number[] = [J.leftHand, J.rightHand, J.leftFoot, J.rightFoot, J.head];

export interface FabrikOptions {
  /** Metres. */
  tolerance: number;
  rounds: number;
  /** Whether the hips may move; else they stay where the pose has them. */
  freeHips: boolean;
}

/** Room for solving on one skeleton; made once. */
export interface FabrikWorkspace {
  skeleton: Skeleton;
  limbs: Limb[];
  positions: Float64Array;
  world: Float64Array;
  lack: Float64Array;
  q: Float64Array;
  /** Best answer so far: pose, root. */
  best: Float64Array;
}

export function createFabrik(skeleton: Skeleton): FabrikWorkspace {
  return {
    skeleton,
    limbs: limbsOf(skeleton),
    positions: new Float64Array(3 * JOINT_COUNT),
    world: new Float64Array(4 * JOINT_COUNT),
    lack: new Float64Array(3 * EFFECTORS.length),
    q: new Float64Array(12),
    best: new Float64Array(4 * JOINT_COUNT + 3),
  };
}

/** Joints between hips and head, and those between hips and the arms' sockets, from the hips up. */
const TRUNK = [J.spine, J.chest, J.upperChest] as const;
const SHOULDERS = [J.leftShoulder, J.rightShoulder] as const;
const HELD = [...TRUNK, ...SHOULDERS, J.neck, J.head] as const;

/**
 * Moves `root` (x, y, z) and `pose` (JOINT_COUNT x xyzw, local) so that the effectors come to their targets.
 *
 * @param targets world places, 5 x 3, in the order of EFFECTORS, metres.
 * @param weights 5: 0 leaves an effector free, 1 holds it.
 * @returns the largest distance left, metres: within the tolerance when solved. Joints are within their limits either way.
 */
export function solveFabrik(
  w: FabrikWorkspace,
  root: Float64Array,
  pose: Float64Array,
  targets: Float64Array,
  weights: ArrayLike<number>,
  options: FabrikOptions,
): number {
  hold(pose);
  let left = attempt(w, root, pose, targets, weights, options);
  if (left <= options.tolerance) return left;
  // Stuck at limits: from other trunks, the nearest first; the best answer is kept.
  const { best } = w;
  best.set(pose);
  best.set(root, pose.length);
  for (const [forward, aside, twist] of OTHER_TRUNKS) {
    for (const joint of TRUNK) quatFromRotationVector(pose, 4 * joint, forward, twist, aside);
    for (const joint of [...SHOULDERS, J.neck])
      quatFromRotationVector(pose, 4 * joint, -0.3 * forward, 0, 0.2 * aside);
    hold(pose);
    const other = attempt(w, root, pose, targets, weights, options);
    if (other < left) {
      left = other;
      best.set(pose);
      best.set(root, pose.length);
    }
    if (left <= options.tolerance) break;
  }
  pose.set(best.subarray(0, pose.length));
  root.set(best.subarray(pose.length, pose.length + 3));
  return left;
}

/** Bends of each spine joint that are tried where the pose's own leads nowhere: forward, aside, twist, radians. */
const OTHER_TRUNKS = [
  [0, 0, 0],
  [0.35, 0, 0],
  [-0.2, 0, 0],
  [0.15, 0.3, 0],
  [0.15, -0.3, 0],
  [0.15, 0, 0.25],
  [0.15, 0, -0.25],
] as const;

function hold(pose: Float64Array): void {
  for (const joint of HELD) holdToLimits(pose, 4 * joint, joint);
}

/** FABRIK's rounds from the pose given; returns the largest distance left. */
function attempt(
  w: FabrikWorkspace,
  root: Float64Array,
  pose: Float64Array,
  targets: Float64Array,
  weights: ArrayLike<number>,
  options: FabrikOptions,
): number {
  forwardKinematics(w.positions, w.world, w.skeleton, root, 0, pose, 0);
  let left = 0;
  for (let round = 0; round <= options.rounds; round++) {
    left = closeLimbs(w, pose, targets, weights);
    if (left <= options.tolerance || round === options.rounds) break;
    askTrunk(w, root, pose, weights, options.freeHips, round);
  }
  return left;
}

/** Closes the four limbs and notes what each effector still lacks; returns the largest lack. */
function closeLimbs(
  w: FabrikWorkspace,
  pose: Float64Array,
  targets: Float64Array,
  weights: ArrayLike<number>,
): number {
  let worst = 0;
  for (let e = 0; e < EFFECTORS.length; e++) {
    const t = 3 * e;
    if (weights[e] <= 0) {
      w.lack[t] = w.lack[t + 1] = w.lack[t + 2] = 0;
      continue;
    }
    if (e < 4) closeLimb(w.limbs[e], pose, w.positions, w.world, targets[t], targets[t + 1], targets[t + 2]);
    const at = 3 * EFFECTORS[e];
    for (let k = 0; k < 3; k++) w.lack[t + k] = targets[t + k] - w.positions[at + k];
    worst = Math.max(worst, Math.hypot(w.lack[t], w.lack[t + 1], w.lack[t + 2]));
  }
  return worst;
}

/** Hips, spine, shoulders and neck answer what the chains lack, from the root up. */
function askTrunk(
  w: FabrikWorkspace,
  root: Float64Array,
  pose: Float64Array,
  weights: ArrayLike<number>,
  freeHips: boolean,
  round: number,
): void {
  // Every joint asks anew: what those before it have given is taken off by the kinematics in between.
  if (freeHips) {
    let count = 0;
    let mx = 0;
    let my = 0;
    let mz = 0;
    for (let e = 0; e < EFFECTORS.length; e++) {
      if (weights[e] <= 0) continue;
      const t = 3 * e;
      const l = Math.hypot(w.lack[t], w.lack[t + 1], w.lack[t + 2]);
      if (l < 1e-5) continue;
      mx += w.lack[t];
      my += w.lack[t + 1];
      mz += w.lack[t + 2];
      count++;
    }
    if (count > 0) {
      const f = 0.9 / count;
      shift(w, root, f * mx, f * my, f * mz);
      turn(w, pose, J.hips, 31, weights, 0.6);
    }
  }
  // By turns from the pelvis up and from the neck down, so that no joint always goes first.
  for (let i = 0; i < 3; i++) turn(w, pose, TRUNK[round & 1 ? 2 - i : i], 19, weights, 0.8);
  for (let side = 0; side < 2; side++) turn(w, pose, SHOULDERS[side], 1 << side, weights, 1);
  turn(w, pose, J.neck, 16, weights, 1);
  forwardKinematics(w.positions, w.world, w.skeleton, root, 0, pose, 0);
}

/** Moves everything; what effectors lack shrinks by it. */
function shift(w: FabrikWorkspace, root: Float64Array, x: number, y: number, z: number): void {
  root[0] += x;
  root[1] += y;
  root[2] += z;
  for (let j = 0; j < JOINT_COUNT; j++) {
    w.positions[3 * j] += x;
    w.positions[3 * j + 1] += y;
    w.positions[3 * j + 2] += z;
  }
  for (let e = 0; e < EFFECTORS.length; e++) {
    if (w.lack[3 * e] === 0 && w.lack[3 * e + 1] === 0 && w.lack[3 * e + 2] === 0) continue;
    w.lack[3 * e] -= x;
    w.lack[3 * e + 1] -= y;
    w.lack[3 * e + 2] -= z;
  }
}

/** Turns a joint by what the effectors of `mask` lack, within its limits; effectors and lacks follow to first order. */
function turn(
  w: FabrikWorkspace,
  pose: Float64Array,
  joint: number,
  mask: number,
  weights: ArrayLike<number>,
  share: number,
): void {
  const { positions: p, lack, q } = w;
  const jx = p[3 * joint];
  const jy = p[3 * joint + 1];
  const jz = p[3 * joint + 2];
  // Least squares of sum |omega x r - d|^2: (sum |r|^2 I - r r^T) omega = sum r x d, with a little damping.
  let xx = 1e-4;
  let yy = 1e-4;
  let zz = 1e-4;
  let xy = 0;
  let xz = 0;
  let yz = 0;
  let bx = 0;
  let by = 0;
  let bz = 0;
  for (let e = 0; e < EFFECTORS.length; e++) {
    if (weights[e] <= 0 || !(mask & (1 << e))) continue;
    const d = 3 * e;
    const asked = Math.abs(lack[d]) + Math.abs(lack[d + 1]) + Math.abs(lack[d + 2]) > 1e-6;
    // A limb that reaches has play; the head has none.
    if (!asked && e !== 4) continue;
    const at = 3 * EFFECTORS[e];
    const rx = p[at] - jx;
    const ry = p[at + 1] - jy;
    const rz = p[at + 2] - jz;
    bx += ry * lack[d + 2] - rz * lack[d + 1];
    by += rz * lack[d] - rx * lack[d + 2];
    bz += rx * lack[d + 1] - ry * lack[d];
    xx += ry * ry + rz * rz;
    yy += rx * rx + rz * rz;
    zz += rx * rx + ry * ry;
    xy -= rx * ry;
    xz -= rx * rz;
    yz -= ry * rz;
  }
  if (bx === 0 && by === 0 && bz === 0) return;
  // About one effector's own line nothing is asked: damp that way too.
  xx += 0.02;
  yy += 0.02;
  zz += 0.02;
  const c0 = yy * zz - yz * yz;
  const c1 = xz * yz - xy * zz;
  const c2 = xy * yz - xz * yy;
  const f = share / (xx * c0 + xy * c1 + xz * c2);
  let ox = f * (c0 * bx + c1 * by + c2 * bz);
  let oy = f * (c1 * bx + (xx * zz - xz * xz) * by + (xy * xz - xx * yz) * bz);
  let oz = f * (c2 * bx + (xy * xz - xx * yz) * by + (xx * yy - xy * xy) * bz);
  const angle = Math.hypot(ox, oy, oz);
  if (angle > 0.35) {
    ox *= 0.35 / angle;
    oy *= 0.35 / angle;
    oz *= 0.35 / angle;
  }
  quatFromRotationVector(q, 0, ox, oy, oz);
  quatMultiply(q, 4, q, 0, w.world, 4 * joint);
  const parent = PARENTS[joint];
  if (parent < 0) for (let k = 0; k < 4; k++) pose[4 * joint + k] = q[4 + k];
  else {
    quatInverseMultiply(pose, 4 * joint, w.world, 4 * parent, q, 4);
    if (holdToLimits(pose, 4 * joint, joint) > 0) {
      // Held: what was really turned is less; the next kinematics tell.
      quatNormalize(pose, 4 * joint);
      return;
    }
  }
  quatNormalize(pose, 4 * joint);
  for (let e = 0; e < EFFECTORS.length; e++) {
    if (!(mask & (1 << e))) continue;
    const at = 3 * EFFECTORS[e];
    const rx = p[at] - jx;
    const ry = p[at + 1] - jy;
    const rz = p[at + 2] - jz;
    const d = 3 * e;
    lack[d] -= oy * rz - oz * ry;
    lack[d + 1] -= oz * rx - ox * rz;
    lack[d + 2] -= ox * ry - oy * rx;
  }
}
