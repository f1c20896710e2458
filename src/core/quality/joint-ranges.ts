/**
 * Anatomical ranges, judged on where the bones are: frames in which a joint is bent farther than a person's goes.
 *
 * Angles follow the clinical planes: flexion in the plane of the parent's up and forward, abduction outwards, twist of what is
 * left. The ranges are the widest that are found in goniometry tables, not those of comfort.
 */
import { quatInverseMultiply, quatRotate } from "../math/quaternion.ts";
import type { MotionChunk } from "../motion/types.ts";
import { forwardKinematics } from "../skeleton/forward-kinematics.ts";
import { J, JOINT_COUNT } from "../skeleton/joints.ts";
import type { Skeleton } from "../skeleton/skeleton.ts";

/** Least and largest angle, degrees. */
export const RANGES = {
  hipFlexion: [-40, 140],
  hipAbduction: [-45, 65],
  kneeFlexion: [-10, 160],
  ankleDorsiflexion: [-70, 45],
  ankleInversion: [-45, 50],
  toeExtension: [-50, 95],
  elbowFlexion: [-12, 160],
  spineFlexion: [-45, 100],
  spineLateral: [-45, 45],
  spineTwist: [-60, 60],
  neckFlexion: [-75, 80],
  neckLateral: [-55, 55],
  neckTwist: [-95, 95],
} as const satisfies Record<string, readonly [number, number]>;

export type JointAngle = keyof typeof RANGES;

/** A stretch of angles out of range: which, how many frames, the worst with its frame. */
export interface RangeViolation {
  angle: JointAngle;
  side: "left" | "right" | null;
  frames: number;
  worst: number;
  frame: number;
}

const DEG = 180 / Math.PI;
const p = new Float64Array(3 * JOINT_COUNT);
const w = new Float64Array(4 * JOINT_COUNT);
const v = new Float64Array(9);
const q = new Float64Array(4);

/** How many frames have any joint out of range, and what was. */
export function rangeViolations(
  skeleton: Skeleton,
  chunks: readonly MotionChunk[],
  frames: number,
): { frames: number; list: RangeViolation[] } {
  const found = new Map<string, RangeViolation>();
  let count = 0;
  let frame = 0;
  let bad = false;
  const check = (angle: JointAngle, side: RangeViolation["side"], degrees: number): void => {
    const [low, high] = RANGES[angle];
    const over = Math.max(low - degrees, degrees - high);
    if (over <= 0) return;
    bad = true;
    const key = `${angle}${side}`;
    const before = found.get(key);
    if (!before) found.set(key, { angle, side, frames: 1, worst: degrees, frame });
    else {
      before.frames++;
      if (over > Math.max(low - before.worst, before.worst - high)) {
        before.worst = degrees;
        before.frame = frame;
      }
    }
  };
  for (const chunk of chunks) {
    for (let k = 0; k < chunk.frames && chunk.first + k < frames; k++) {
      frame = chunk.first + k;
      bad = false;
      forwardKinematics(p, w, skeleton, chunk.root, 3 * k, chunk.rotations, 4 * JOINT_COUNT * k);
      leg(check, "left");
      leg(check, "right");
      arm(check, "left", chunk.rotations, 4 * JOINT_COUNT * k);
      arm(check, "right", chunk.rotations, 4 * JOINT_COUNT * k);
      swing(check, ["spineFlexion", "spineLateral", "spineTwist"], J.hips, J.upperChest);
      swing(check, ["neckFlexion", "neckLateral", "neckTwist"], J.upperChest, J.head);
      if (bad) count++;
    }
  }
  return { frames: count, list: [...found.values()] };
}

type Check = (angle: JointAngle, side: RangeViolation["side"], degrees: number) => void;

/** Direction from joint a to joint b in the frame of a joint's world rotation, into v[o..o+2], of unit length. */
function along(a: number, b: number, frame: number, o: number): void {
  const x = p[3 * b] - p[3 * a];
  const y = p[3 * b + 1] - p[3 * a + 1];
  const z = p[3 * b + 2] - p[3 * a + 2];
  const n = Math.hypot(x, y, z) || 1;
  for (let i = 0; i < 3; i++) q[i] = -w[4 * frame + i];
  q[3] = w[4 * frame + 3];
  quatRotate(v, o, q, 0, x / n, y / n, z / n);
}

function leg(check: Check, side: "left" | "right"): void {
  const upper = side === "left" ? J.leftUpperLeg : J.rightUpperLeg;
  const sign = side === "left" ? 1 : -1;
  const knee = upper + 1;
  const foot = upper + 2;
  along(upper, knee, J.hips, 0);
  check("hipFlexion", side, DEG * Math.atan2(v[2], -v[1]));
  check("hipAbduction", side, DEG * Math.asin(Math.max(-1, Math.min(1, sign * v[0]))));
  // Everything of the lower leg is seen from the foot, which says what is forward.
  along(upper, knee, foot, 0);
  along(knee, foot, foot, 3);
  const cx = v[1] * v[5] - v[2] * v[4];
  const cy = v[2] * v[3] - v[0] * v[5];
  const cz = v[0] * v[4] - v[1] * v[3];
  const dot = v[0] * v[3] + v[1] * v[4] + v[2] * v[5];
  // The shank's up is -v[3..5]; its cross with the foot's forward is the hinge's axis.
  const sense = cx * -v[4] + cy * v[3];
  check("kneeFlexion", side, DEG * Math.atan2(Math.hypot(cx, cy, cz), dot) * (sense >= 0 ? 1 : -1));
  check("ankleDorsiflexion", side, DEG * Math.atan2(-v[5], -v[4]));
  check("ankleInversion", side, DEG * Math.asin(Math.max(-1, Math.min(1, -sign * v[3]))));
  quatRotate(v, 0, w, 4 * (foot + 1), 0, 0, 1);
  for (let i = 0; i < 3; i++) q[i] = -w[4 * foot + i];
  q[3] = w[4 * foot + 3];
  quatRotate(v, 3, q, 0, v[0], v[1], v[2]);
  check("toeExtension", side, DEG * Math.atan2(v[4], v[5]));
}

/** The elbow's hinge is -Y on the left and Y on the right of the upper arm's frame. */
function arm(check: Check, side: "left" | "right", rotations: ArrayLike<number>, o: number): void {
  const lower = side === "left" ? J.leftLowerArm : J.rightLowerArm;
  const i = o + 4 * lower;
  const sign = (side === "left" ? -1 : 1) * (rotations[i + 3] < 0 ? -1 : 1);
  const bend = 2 * Math.atan2(sign * rotations[i + 1], Math.abs(rotations[i + 3]));
  check("elbowFlexion", side, DEG * bend);
}

/** Flexion, side bend and twist of one joint's rotation against another's. */
function swing(
  check: Check,
  names: readonly [JointAngle, JointAngle, JointAngle],
  from: number,
  to: number,
): void {
  quatInverseMultiply(q, 0, w, 4 * from, w, 4 * to);
  quatRotate(v, 0, q, 0, 0, 1, 0);
  check(names[0], null, DEG * Math.atan2(v[2], v[1]));
  check(names[1], null, DEG * Math.asin(Math.max(-1, Math.min(1, v[0]))));
  let twist = 2 * Math.atan2(q[1], q[3]);
  if (twist > Math.PI) twist -= 2 * Math.PI;
  else if (twist < -Math.PI) twist += 2 * Math.PI;
  check(names[2], null, DEG * twist);
}
