/**
 * The trunk's share of a reach: where a hand's target lies beyond its arm, the spine turns towards it.
 *
 * FABRIK's forward step over the spine: the shoulder is drawn to where the arm just reaches, and the spine's joints
 * share the turn that takes it there, each within a limit [Aristidou and Lasenby 2011, §4].
 */
import {
  quatBetween,
  quatConjugate,
  quatFromRotationVector,
  quatInverseMultiply,
  quatMultiply,
  quatNormalize,
  quatSlerp,
  quatToRotationVector,
} from "../math/quaternion.ts";
import { forwardKinematics } from "../skeleton/forward-kinematics.ts";
import { J } from "../skeleton/joints.ts";
import type { Skeleton } from "../skeleton/skeleton.ts";

const SPINE = [J.spine, J.chest, J.upperChest] as const;
/** An arm is asked for at most this share of its length before the trunk helps. */
const COMFORT = 0.96;
const ROUNDS = 20;
/** Most that one joint turns in one round, radians. */
const MOST_TURN = 0.12;

const q = new Float64Array(16);
/** Where the hands are led in the end, and how near their shoulders come. */
const aim = new Float64Array(6);
const goal = new Float64Array(2);
const straight = new Float64Array(12);
const identity = Float64Array.of(0, 0, 0, 1);

/** Softness of what an arm lacks, metres: a trunk that helps from one frame to the next only would start with a jerk. */
const EASE = 0.02;
/** What each joint of the spine bends with ease, and at most, for a reach: forward, about itself, to the side; radians. */
const EASY_BEND = [0.35, 0.25, 0.15] as const;
const MOST_BEND = [0.5, 0.35, 0.24] as const;
/** Weight under which nothing is led. */
const NOTHING = 1e-4;

/**
 * Bends the spine of `pose` so that both shoulders come within an arm of their targets; kinematics are updated.
 *
 * The bend is the one that the whole way would need, from where the hand is through `place`, and is then made by the weight.
 * What a hand on its way lacks by itself says little: one that hangs straight down lacks a few millimetres along the spine,
 * which no small turn of it brings.
 *
 * @param weight how much of its way each hand has been led, 0 to 1. @param place where each hand joint is led, 2 x 3.
 */
export function bendTrunk(
  pose: Float64Array,
  positions: Float64Array,
  world: Float64Array,
  root: Float64Array,
  skeleton: Skeleton,
  weight: readonly [number, number],
  place: Float64Array,
): void {
  const o = skeleton.offsets;
  const arm = Math.abs(o[3 * J.leftLowerArm]) + Math.abs(o[3 * J.leftHand]);
  const made = Math.max(weight[0], weight[1]);
  if (made < NOTHING) return;
  for (let side = 0; side < 2; side++) {
    if (weight[side] <= 0) continue;
    const hand = 3 * (side === 0 ? J.leftHand : J.rightHand);
    for (let k = 0; k < 3; k++) {
      const own = positions[hand + k];
      aim[3 * side + k] = own + (place[3 * side + k] - own) / made;
    }
    const far = toTarget(positions, aim, side);
    const over = far - COMFORT * arm;
    goal[side] = far - 0.5 * (over + Math.sqrt(over * over + EASE * EASE));
  }
  for (const [i, joint] of SPINE.entries())
    for (let k = 0; k < 4; k++) straight[4 * i + k] = pose[4 * joint + k];
  if (!drawShoulders(pose, positions, world, root, skeleton, weight)) return;
  for (const [i, joint] of SPINE.entries()) {
    quatConjugate(q, 0, straight, 4 * i);
    quatMultiply(q, 4, pose, 4 * joint, q, 0);
    quatToRotationVector(q, 8, q, 4);
    for (let k = 0; k < 3; k++) q[8 + k] = made * within(q[8 + k], EASY_BEND[k], MOST_BEND[k]);
    quatFromRotationVector(q, 0, q[8], q[9], q[10]);
    quatMultiply(pose, 4 * joint, q, 0, straight, 4 * i);
    quatNormalize(pose, 4 * joint);
  }
  forwardKinematics(positions, world, skeleton, root, 0, pose, 0);
}

/** An angle as it is up to `easy`, beyond it softly under `most`. */
function within(angle: number, easy: number, most: number): number {
  const over = Math.abs(angle) - easy;
  return over <= 0 ? angle : Math.sign(angle) * (easy + (most - easy) * Math.tanh(over / (most - easy)));
}

/** Turns the spine until each shoulder is as near to its aim as `goal` says; false where they are from the first. */
function drawShoulders(
  pose: Float64Array,
  positions: Float64Array,
  world: Float64Array,
  root: Float64Array,
  skeleton: Skeleton,
  weight: readonly [number, number],
): boolean {
  for (let round = 0; round < ROUNDS; round++) {
    // What the shoulders lack, as one pull of their middle.
    let px = 0;
    let py = 0;
    let pz = 0;
    let sx = 0;
    let sy = 0;
    let sz = 0;
    let total = 0;
    for (let side = 0; side < 2; side++) {
      if (weight[side] <= 0) continue;
      const s = side === 0 ? J.leftUpperArm : J.rightUpperArm;
      const d = toTarget(positions, aim, side);
      const lack = Math.max(0, d - goal[side]);
      // Each shoulder counts by what it lacks: neither comes in nor drops out from one frame to the next.
      const share = weight[side] * lack;
      const pull = (share * lack) / d;
      total += share;
      sx += share * positions[3 * s];
      sy += share * positions[3 * s + 1];
      sz += share * positions[3 * s + 2];
      px += pull * (aim[3 * side] - positions[3 * s]);
      py += pull * (aim[3 * side + 1] - positions[3 * s + 1]);
      pz += pull * (aim[3 * side + 2] - positions[3 * s + 2]);
    }
    if (total <= 1e-4) return round > 0;
    for (const joint of SPINE) {
      const jx = positions[3 * joint];
      const jy = positions[3 * joint + 1];
      const jz = positions[3 * joint + 2];
      let ax = sx / total - jx;
      let ay = sy / total - jy;
      let az = sz / total - jz;
      let bx = ax + px / total;
      let by = ay + py / total;
      let bz = az + pz / total;
      const a = Math.sqrt(ax * ax + ay * ay + az * az);
      const b = Math.sqrt(bx * bx + by * by + bz * bz);
      if (a < 1e-6 || b < 1e-6) continue;
      ax /= a;
      ay /= a;
      az /= a;
      bx /= b;
      by /= b;
      bz /= b;
      quatBetween(q, 0, ax, ay, az, bx, by, bz);
      const angle = Math.acos(Math.max(-1, Math.min(1, ax * bx + ay * by + az * bz)));
      const share = angle > 1e-9 ? Math.min(0.6, MOST_TURN / angle) : 0;
      quatSlerp(q, 4, identity, 0, q, 0, share);
      quatMultiply(q, 8, q, 4, world, 4 * joint);
      quatInverseMultiply(pose, 4 * joint, world, 4 * (joint - 1), q, 8);
      quatNormalize(pose, 4 * joint);
      forwardKinematics(positions, world, skeleton, root, 0, pose, 0);
    }
  }
  return true;
}

/** Distance from a side's shoulder to its target. */
function toTarget(positions: Float64Array, place: Float64Array, side: number): number {
  const s = 3 * (side === 0 ? J.leftUpperArm : J.rightUpperArm);
  return Math.hypot(
    place[3 * side] - positions[s],
    place[3 * side + 1] - positions[s + 1],
    place[3 * side + 2] - positions[s + 2],
  );
}
