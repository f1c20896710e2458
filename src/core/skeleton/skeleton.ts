/**
 * A character's bones and the shape of its feet.
 *
 * Rest pose: T-pose standing on y = 0, facing +Z, arms along +-X, every local rotation the identity and
 * every joint frame parallel to the world. A joint's `offsets` entry is its place in its parent's frame.
 */
import { J, JOINT_COUNT, PARENTS } from "./joints.ts";

/** Sole geometry, shared by both feet; metres. See docs/glossary.md, "foot". */
export interface FootShape {
  /** Height of the ankle joint over the sole when the foot is flat. */
  ankleHeight: number;
  /** Ankle joint to the ball (toes) joint, forward. */
  ballForward: number;
  /** Height of the toes joint over the sole. */
  ballHeight: number;
  /** Toes joint to the tip of the toes, forward. */
  tipForward: number;
  /** Heel contact point behind the ankle joint. */
  heelBack: number;
}

export interface Proportions {
  /** Factors on the default build at the same height; 1 is the default. */
  leg: number;
  arm: number;
  torso: number;
}

export interface Skeleton {
  /** Standing height, metres. */
  height: number;
  proportions: Proportions;
  /** Rest offsets in the parent's frame, JOINT_COUNT x 3; the hips' entry is their rest place in the world. */
  offsets: Float64Array;
  foot: FootShape;
  /** Thigh plus shank plus ankle height: the unit that steps scale with, metres. */
  legLength: number;
  /** Hand joint to the middle of the palm / to the pen tip, along the hand's axis, metres. */
  palm: number;
  /** Head joint to the crown, metres. */
  headTop: number;
}

/** The build at 1.75 m; hip, knee, shoulder heights as [Winter, Biomechanics and Motor Control, table 4.1] rounds to. */
export const REFERENCE_HEIGHT = 1.75;

const REFERENCE_FOOT: FootShape = {
  ankleHeight: 0.09,
  ballForward: 0.125,
  ballHeight: 0.028,
  tipForward: 0.068,
  heelBack: 0.042,
};

/** [joint, x, y, z] offsets from the parent at 1.75 m. Left side given; the right mirrors it. */
const TRUNK: readonly (readonly [number, number, number, number])[] = [
  [J.spine, 0, 0.09, -0.005],
  [J.chest, 0, 0.12, -0.01],
  [J.upperChest, 0, 0.13, 0],
  [J.neck, 0, 0.17, 0.005],
  [J.head, 0, 0.09, 0.015],
  [J.leftShoulder, 0.035, 0.12, 0.005],
];
const ARM: readonly (readonly [number, number, number, number])[] = [
  [J.leftUpperArm, 0.133, 0, -0.005],
  [J.leftLowerArm, 0.285, 0, 0],
  [J.leftHand, 0.25, 0, 0],
];
const THIGH = 0.42;
const SHANK = 0.42;
const HIP_HALF_WIDTH = 0.09;
const HIP_DROP = 0.03;

export const DEFAULT_PROPORTIONS: Proportions = { leg: 1, arm: 1, torso: 1 };

/**
 * A skeleton of the given height and proportions.
 *
 * @param height standing height in metres, 1.2 to 2.3.
 * @param proportions factors on legs (with the feet), arms and torso, 0.7 to 1.4; the height given is that of
 *   the default build, so a longer leg makes a taller character.
 * @throws RangeError when out of range.
 */
export function createSkeleton(
  height = REFERENCE_HEIGHT,
  proportions: Proportions = DEFAULT_PROPORTIONS,
): Skeleton {
  if (!(height >= 1.2 && height <= 2.3))
    throw new RangeError(`height: 1.2 to 2.3 m is possible, found ${height}.`);
  for (const key of ["leg", "arm", "torso"] as const) {
    const f = proportions[key];
    if (!(f >= 0.7 && f <= 1.4))
      throw new RangeError(`proportions.${key}: 0.7 to 1.4 is possible, found ${f}.`);
  }
  const s = height / REFERENCE_HEIGHT;
  const leg = s * proportions.leg;
  const arm = s * proportions.arm;
  const torso = s * proportions.torso;
  const offsets = new Float64Array(JOINT_COUNT * 3);
  const set = (joint: number, x: number, y: number, z: number) => {
    offsets[3 * joint] = x;
    offsets[3 * joint + 1] = y;
    offsets[3 * joint + 2] = z;
  };
  const foot: FootShape = {
    ankleHeight: REFERENCE_FOOT.ankleHeight * leg,
    ballForward: REFERENCE_FOOT.ballForward * leg,
    ballHeight: REFERENCE_FOOT.ballHeight * leg,
    tipForward: REFERENCE_FOOT.tipForward * leg,
    heelBack: REFERENCE_FOOT.heelBack * leg,
  };
  const legLength = (THIGH + SHANK) * leg + foot.ankleHeight;
  set(J.hips, 0, legLength + HIP_DROP * s, 0);
  for (const [joint, x, y, z] of TRUNK) set(joint, x * s, y * torso, z * s);
  for (const [joint, x, y, z] of ARM) {
    const f = joint === J.leftUpperArm ? s : arm;
    set(joint, x * f, y * f, z * f);
  }
  set(J.leftUpperLeg, HIP_HALF_WIDTH * s, -HIP_DROP * s, 0);
  set(J.leftLowerLeg, 0, -THIGH * leg, 0);
  set(J.leftFoot, 0, -SHANK * leg, 0);
  set(J.leftToes, 0, foot.ballHeight - foot.ankleHeight, foot.ballForward);
  for (const [l, r] of [
    [J.leftShoulder, J.rightShoulder],
    [J.leftUpperArm, J.rightUpperArm],
    [J.leftLowerArm, J.rightLowerArm],
    [J.leftHand, J.rightHand],
    [J.leftUpperLeg, J.rightUpperLeg],
    [J.leftLowerLeg, J.rightLowerLeg],
    [J.leftFoot, J.rightFoot],
    [J.leftToes, J.rightToes],
  ] as const) {
    set(r, -offsets[3 * l], offsets[3 * l + 1], offsets[3 * l + 2]);
  }
  return {
    height,
    proportions: { ...proportions },
    offsets,
    foot,
    legLength,
    palm: 0.085 * arm,
    headTop: 0.19 * torso,
  };
}

export { JOINT_COUNT, PARENTS };
