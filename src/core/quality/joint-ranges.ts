/**
 * Joints outside of their anatomical range [motion quality: limitViolations].
 *
 * Angles are read as goniometry does: hips and ankles by where the bone points in its neighbour's frame, knees and elbows by
 * the angle between the bones, signed by their hinge; spine and neck by swing and twist of chest on pelvis, head on chest.
 */
import { quatInverseMultiply, quatRotate } from "../math/quaternion.ts";
import { J, JOINT_COUNT } from "../skeleton/joints.ts";

const DEG = 180 / Math.PI;

/**
 * What counts as possible, degrees: usual adult ranges of motion (American Academy of Orthopaedic Surgeons; Norkin and
 * White), widened by what the definition of a skeleton and brisk motion add.
 */
export const RANGES = {
  hipFlexion: [-40, 140],
  hipAbduction: [-45, 65],
  /** Judged by the knee's hinge, so only where the knee bends by 30 to 120 degrees. */
  hipRotation: [-65, 65],
  kneeFlexion: [-10, 160],
  ankleDorsiflexion: [-70, 45],
  ankleInversion: [-45, 50],
  toeExtension: [-50, 95],
  elbowFlexion: [-12, 160],
  spineFlexion: [-45, 100],
  spineLateral: [-45, 45],
  spineTwist: [-60, 60],
  neckFlexion: [-80, 75],
  neckLateral: [-55, 55],
  neckTwist: [-95, 95],
} as const;

export type RangeName = keyof typeof RANGES;

const LEGS = [
  { side: 1, upper: J.leftUpperLeg },
  { side: -1, upper: J.rightUpperLeg },
] as const;
const ARMS = [J.leftUpperArm, J.rightUpperArm] as const;

/** Scratch for one frame's angles; made once a motion. */
export interface RangeWorkspace {
  v: Float64Array;
  q: Float64Array;
}

export const createRangeWorkspace = (): RangeWorkspace => ({
  v: new Float64Array(12),
  q: new Float64Array(4),
});

/**
 * The joints of one frame that are outside of their range, as names; empty where all is well.
 *
 * @param p world places at `po` (JOINT_COUNT x 3), `w` world rotations at `wo` (JOINT_COUNT x 4).
 */
export function jointsOutOfRange(
  p: Float64Array,
  po: number,
  w: Float64Array,
  wo: number,
  space: RangeWorkspace,
): RangeName[] {
  const out: RangeName[] = [];
  const judge = (name: RangeName, degrees: number): void => {
    const [low, high] = RANGES[name];
    if (degrees < low || degrees > high) out.push(name);
  };
  const { v, q } = space;
  // v: 0 bone a (world), 3 bone b (world), 6 a in a neighbour's frame, 9 an axis.
  const bone = (o: number, from: number, to: number): void => {
    let n = 0;
    for (let k = 0; k < 3; k++) {
      v[o + k] = p[po + 3 * to + k] - p[po + 3 * from + k];
      n += v[o + k] * v[o + k];
    }
    n = Math.sqrt(n) || 1;
    for (let k = 0; k < 3; k++) v[o + k] /= n;
  };
  const into = (o: number, joint: number, from: number): void => {
    const i = wo + 4 * joint;
    q[0] = -w[i];
    q[1] = -w[i + 1];
    q[2] = -w[i + 2];
    q[3] = w[i + 3];
    quatRotate(v, o, q, 0, v[from], v[from + 1], v[from + 2]);
  };
  const between = (): number => {
    const dot = v[0] * v[3] + v[1] * v[4] + v[2] * v[5];
    v[9] = v[1] * v[5] - v[2] * v[4];
    v[10] = v[2] * v[3] - v[0] * v[5];
    v[11] = v[0] * v[4] - v[1] * v[3];
    return Math.atan2(Math.hypot(v[9], v[10], v[11]), dot) * DEG;
  };
  for (const { side, upper } of LEGS) {
    bone(0, upper, upper + 1);
    bone(3, upper + 1, upper + 2);
    into(6, J.hips, 0);
    judge("hipFlexion", Math.atan2(v[8], -v[7]) * DEG);
    const sideways = v[6];
    judge("hipAbduction", Math.asin(Math.max(-1, Math.min(1, side * sideways))) * DEG);
    const bent = between();
    // The foot says which way is forward: a knee's axis is to the left of it.
    const f = wo + 4 * (upper + 2);
    quatRotate(v, 6, w, f, 0, 0, 1);
    const lx = -v[4] * v[8] + v[5] * v[7];
    const ly = -v[5] * v[6] + v[3] * v[8];
    const lz = -v[3] * v[7] + v[4] * v[6];
    const flexion = v[9] * lx + v[10] * ly + v[11] * lz >= 0 ? bent : -bent;
    judge("kneeFlexion", flexion);
    if (flexion > 30 && flexion < 120 && Math.abs(sideways) < 0.8) judge("hipRotation", side * hipTurn());
    for (let k = 3; k < 6; k++) v[k] = -v[k];
    into(6, upper + 2, 3);
    judge("ankleDorsiflexion", Math.atan2(v[8], v[7]) * DEG);
    judge("ankleInversion", Math.asin(Math.max(-1, Math.min(1, side * v[6]))) * DEG);
    quatRotate(v, 0, w, wo + 4 * (upper + 3), 0, 0, 1);
    into(6, upper + 2, 0);
    judge("toeExtension", Math.atan2(v[7], v[8]) * DEG);
  }
  for (const upper of ARMS) {
    bone(0, upper, upper + 1);
    bone(3, upper + 1, upper + 2);
    const bent = between();
    // An elbow's hinge is the upper arm's own: up at rest for the left arm, down for the right.
    quatRotate(v, 6, w, wo + 4 * upper, 0, upper === J.leftUpperArm ? -1 : 1, 0);
    judge(
      "elbowFlexion",
      bent > 12 && v[9] * v[6] + v[10] * v[7] + v[11] * v[8] < -0.5 * Math.hypot(v[9], v[10], v[11])
        ? -bent
        : bent,
    );
  }
  swingTwist("spine", J.hips, J.upperChest);
  swingTwist("neck", J.upperChest, J.head);
  return out;

  /** Turn of the knee's axis (9) about the thigh (0) from the pelvis's left, degrees. */
  function hipTurn(): number {
    quatRotate(v, 6, w, wo + 4 * J.hips, 1, 0, 0);
    const along = v[0] * v[6] + v[1] * v[7] + v[2] * v[8];
    for (let k = 0; k < 3; k++) v[6 + k] -= along * v[k];
    const x = v[7] * v[11] - v[8] * v[10];
    const y = v[8] * v[9] - v[6] * v[11];
    const z = v[6] * v[10] - v[7] * v[9];
    return Math.atan2(-(x * v[0] + y * v[1] + z * v[2]), v[6] * v[9] + v[7] * v[10] + v[8] * v[11]) * DEG;
  }

  function swingTwist(name: "spine" | "neck", from: number, to: number): void {
    quatInverseMultiply(q, 0, w, wo + 4 * from, w, wo + 4 * to);
    quatRotate(v, 0, q, 0, 0, 1, 0);
    judge(`${name}Flexion`, Math.atan2(v[2], v[1]) * DEG);
    judge(`${name}Lateral`, Math.asin(Math.max(-1, Math.min(1, v[0]))) * DEG);
    // Twist about the bone: what is left when the swing is taken off.
    let twist = 2 * Math.atan2(q[1], q[3]) * DEG;
    if (twist > 180) twist -= 360;
    if (twist < -180) twist += 360;
    judge(`${name}Twist`, twist);
  }
}

/** How far apart rows of places and rotations are. */
export const PLACE_ROW = 3 * JOINT_COUNT;
export const ROTATION_ROW = 4 * JOINT_COUNT;
