/**
 * Second pass of the synthesis: the legs closed onto the feet, the hands led to their tasks, the trunk helping where an
 * arm is too short [TaskLoco §6, Figure 12].
 */
import { solveLeg } from "../ik/leg.ts";
import { bendTrunk } from "../ik/trunk.ts";
import { solveTwoBone } from "../ik/two-bone.ts";
import {
  quatFromAxisAngle,
  quatInverseMultiply,
  quatMultiply,
  quatNormalize,
  quatRotate,
} from "../math/quaternion.ts";
import { forwardKinematics } from "../skeleton/forward-kinematics.ts";
import { J, JOINT_COUNT } from "../skeleton/joints.ts";
import type { Skeleton } from "../skeleton/skeleton.ts";
import type { BodyTrack } from "./body-pass.ts";
import { FOOT_STRIDE } from "./foot-pose.ts";

const Q = JOINT_COUNT * 4;

export interface HandTargets {
  /** Weight of the target for each hand, left and right: 0 leaves the hand to the capture. */
  weight: [number, number];
  /** World place of the hand joint, 2 x 3. */
  place: Float64Array;
}

/** Room for one frame; made once. */
export interface LimbWorkspace {
  positions: Float64Array;
  world: Float64Array;
  pose: Float64Array;
  root: Float64Array;
  hints: Float64Array;
  q: Float64Array;
}

export function createLimbWorkspace(): LimbWorkspace {
  return {
    positions: new Float64Array(JOINT_COUNT * 3),
    world: new Float64Array(JOINT_COUNT * 4),
    pose: new Float64Array(Q),
    root: new Float64Array(3),
    hints: new Float64Array(12),
    q: new Float64Array(8),
  };
}

/** Loads a frame of the body pass and closes the legs on its feet: `pose`, `positions` and `world` are then up to date. */
export function closeLegs(w: LimbWorkspace, track: BodyTrack, frame: number, skeleton: Skeleton): void {
  for (let k = 0; k < 3; k++) w.root[k] = track.root[3 * frame + k];
  for (let k = 0; k < Q; k++) w.pose[k] = track.rotations[Q * frame + k];
  forwardKinematics(w.positions, w.world, skeleton, w.root, 0, w.pose, 0);
  for (let side = 0; side < 2; side++) {
    const upper = side === 0 ? J.leftUpperLeg : J.rightUpperLeg;
    const foot = upper + 2;
    const o = (2 * frame + side) * FOOT_STRIDE;
    // The knee points as the pose's does, drawn a little to the foot's and the hips' forward. (Leaning on these two more
    // was tried: where a foot is left far behind a turn they cancel, and the knee jumps.)
    quatRotate(w.hints, 0, track.feet, o + 3, 0, 0, 1);
    quatRotate(w.hints, 3, w.world, 0, 0, 0, 1);
    quatRotate(w.hints, 6, w.world, 4 * upper, 0, 0, 1);
    for (let k = 0; k < 3; k++) w.hints[k] = 0.25 * (w.hints[k] + w.hints[3 + k]) + w.hints[6 + k];
    solveLeg(
      w.pose,
      w.positions,
      w.world,
      J.hips,
      upper,
      skeleton.offsets,
      track.feet[o],
      track.feet[o + 1],
      track.feet[o + 2],
      w.hints[0],
      w.hints[1],
      w.hints[2],
    );
    for (let k = 0; k < 4; k++) w.world[4 * foot + k] = track.feet[o + 3 + k];
    quatInverseMultiply(w.pose, 4 * foot, w.world, 4 * (upper + 1), w.world, 4 * foot);
    quatNormalize(w.pose, 4 * foot);
    quatFromAxisAngle(w.pose, 4 * (foot + 1), 1, 0, 0, -track.feet[o + 7]);
    quatMultiply(w.world, 4 * (foot + 1), w.world, 4 * foot, w.pose, 4 * (foot + 1));
  }
}

/** Leads the hands to their targets: the trunk bends for what the arms lack, then each arm closes. */
export function closeArms(w: LimbWorkspace, targets: HandTargets, skeleton: Skeleton): void {
  if (targets.weight[0] <= 0 && targets.weight[1] <= 0) return;
  bendTrunk(w.pose, w.positions, w.world, w.root, skeleton, targets.weight, targets.place);
  for (let side = 0; side < 2; side++) {
    if (targets.weight[side] <= 0) continue;
    const upper = side === 0 ? J.leftUpperArm : J.rightUpperArm;
    const hand = upper + 2;
    // A straight elbow points down, out and back.
    quatRotate(w.hints, 0, w.world, 4 * J.upperChest, side === 0 ? 0.55 : -0.55, -1, -0.25);
    for (let k = 0; k < 4; k++) w.q[k] = w.world[4 * hand + k];
    solveTwoBone(
      w.pose,
      0,
      w.positions,
      w.world,
      upper - 1,
      upper,
      upper + 1,
      hand,
      skeleton.offsets,
      targets.place[3 * side],
      targets.place[3 * side + 1],
      targets.place[3 * side + 2],
      w.hints,
      0,
    );
    // The hand keeps the way it pointed.
    for (let k = 0; k < 4; k++) w.world[4 * hand + k] = w.q[k];
    quatInverseMultiply(w.pose, 4 * hand, w.world, 4 * (upper + 1), w.world, 4 * hand);
    quatNormalize(w.pose, 4 * hand);
  }
}
