/**
 * The humanoid skeleton's joints: VRM 1.0 bone names, parents, and their order in every pose array.
 *
 * Parents come before children, so one forward pass computes the kinematics.
 */

/** VRM 1.0 humanoid bone names, in pose order. */
export const JOINT_NAMES = [
  "hips",
  "spine",
  "chest",
  "upperChest",
  "neck",
  "head",
  "leftShoulder",
  "leftUpperArm",
  "leftLowerArm",
  "leftHand",
  "rightShoulder",
  "rightUpperArm",
  "rightLowerArm",
  "rightHand",
  "leftUpperLeg",
  "leftLowerLeg",
  "leftFoot",
  "leftToes",
  "rightUpperLeg",
  "rightLowerLeg",
  "rightFoot",
  "rightToes",
] as const;

export type JointName = (typeof JOINT_NAMES)[number];

export const JOINT_COUNT = JOINT_NAMES.length;

/** Joint indices by short constant, for hot loops. */
export const J = {
  hips: 0,
  spine: 1,
  chest: 2,
  upperChest: 3,
  neck: 4,
  head: 5,
  leftShoulder: 6,
  leftUpperArm: 7,
  leftLowerArm: 8,
  leftHand: 9,
  rightShoulder: 10,
  rightUpperArm: 11,
  rightLowerArm: 12,
  rightHand: 13,
  leftUpperLeg: 14,
  leftLowerLeg: 15,
  leftFoot: 16,
  leftToes: 17,
  rightUpperLeg: 18,
  rightLowerLeg: 19,
  rightFoot: 20,
  rightToes: 21,
} as const satisfies Record<JointName, number>;

/** Parent of each joint; -1 for the hips. */
export const PARENTS: Int8Array = Int8Array.from([
  -1, 0, 1, 2, 3, 4, 3, 6, 7, 8, 3, 10, 11, 12, 0, 14, 15, 16, 0, 18, 19, 20,
]);

/** The joint on the other side of the body, itself when on the midline; for mirroring. */
export const MIRROR_JOINT: Int8Array = Int8Array.from([
  0, 1, 2, 3, 4, 5, 10, 11, 12, 13, 6, 7, 8, 9, 18, 19, 20, 21, 14, 15, 16, 17,
]);
