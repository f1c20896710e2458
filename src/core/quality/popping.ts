/**
 * Popping: joints' angular accelerations, unfiltered, against what real captures reach [DESIGN of motion quality].
 *
 * A pop is a jump between two frames: its second difference towers over anything that a muscle does. No filter is applied, since it
 * would hide the pop. The references are the 99.9th percentiles over 215 real clips (Bandai-Namco Research motion datasets 1
 * and 2, PFNN): statistics, no capture's own curve.
 */
import { quatConjugate, quatMultiply, quatToRotationVector } from "../math/quaternion.ts";
import type { MotionChunk } from "../motion/types.ts";
import { JOINT_COUNT, JOINT_NAMES, type JointName } from "../skeleton/joints.ts";

/** All joints pooled at 60 frames a second, rad/s^2. */
const POOLED_60 = 1230.86;
/** Each joint at 30 frames a second, where the references are widest, rad/s^2. */
const OWN_30: Record<JointName, number> = {
  hips: 101.42,
  spine: 66.35,
  chest: 129.89,
  upperChest: 138.57,
  neck: 61.78,
  head: 77.89,
  leftShoulder: 106.39,
  leftUpperArm: 221.18,
  leftLowerArm: 428.08,
  leftHand: 237.59,
  rightShoulder: 108.34,
  rightUpperArm: 256.07,
  rightLowerArm: 438.33,
  rightHand: 417.23,
  leftUpperLeg: 200.82,
  leftLowerLeg: 310.18,
  leftFoot: 463.32,
  leftToes: 599.38,
  rightUpperLeg: 209.67,
  rightLowerLeg: 308.76,
  rightFoot: 556.51,
  rightToes: 594.26,
};

export interface Popping {
  /** Largest acceleration at 60 Hz over the pooled reference. */
  pooled: number;
  /** Largest acceleration at 30 Hz of any joint over its own reference; which joint, and its frame at 60 Hz. */
  own: number;
  joint: JointName;
  frame: number;
}

/** The popping of a motion at 60 Hz whose chunks follow each other from frame 0; null for fewer than five frames. */
export function poppingOf(chunks: readonly MotionChunk[], frames: number): Popping | null {
  if (frames < 5) return null;
  const out: Popping = { pooled: 0, own: 0, joint: "hips", frame: 0 };
  const rotations = new Float64Array(4 * frames);
  for (let j = 0; j < JOINT_COUNT; j++) {
    for (const chunk of chunks)
      for (let k = 0; k < chunk.frames && chunk.first + k < frames; k++)
        for (let i = 0; i < 4; i++)
          rotations[4 * (chunk.first + k) + i] = chunk.rotations[4 * (JOINT_COUNT * k + j) + i];
    const pooled = largest(rotations, frames, 1);
    out.pooled = Math.max(out.pooled, pooled.value / POOLED_60);
    const own = largest(rotations, frames, 2);
    const ratio = own.value / OWN_30[JOINT_NAMES[j]];
    if (ratio > out.own) {
      out.own = ratio;
      out.joint = JOINT_NAMES[j];
      out.frame = own.frame;
    }
  }
  return out;
}

const q = new Float64Array(8);
const v = new Float64Array(6);

/** Largest change of the angular velocity from step to step, rad/s^2, looked at every `every` frames of 1/60 s. */
function largest(rotations: Float64Array, frames: number, every: number): { value: number; frame: number } {
  const rate = 60 / every;
  let value = 0;
  let frame = 0;
  for (let phase = 0; phase < every; phase++) {
    for (let f = phase, k = 0; f + every < frames; f += every, k++) {
      quatConjugate(q, 0, rotations, 4 * f);
      quatMultiply(q, 4, rotations, 4 * (f + every), q, 0);
      const now = k % 2 === 0 ? 0 : 3;
      quatToRotationVector(v, now, q, 4);
      if (k === 0) continue;
      const a = Math.hypot(v[0] - v[3], v[1] - v[4], v[2] - v[5]) * rate * rate;
      if (a > value) {
        value = a;
        frame = f;
      }
    }
  }
  return { value, frame };
}
