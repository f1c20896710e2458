/** Our skeleton posed like a file's joints: bones take their directions, knees and elbows bend in their planes, ankles stand on theirs. */
import { quatFromBasis, solveLeg } from "../ik/leg.ts";
import { unit } from "../math/interpolate.ts";
import {
  quatBetween,
  quatFromAxisAngle,
  quatFromYawPitchRoll,
  quatInverseMultiply,
  quatMultiply,
  quatNormalize,
  quatRotate,
  quatSlerp,
} from "../math/quaternion.ts";
import { toeSegmentPitch } from "../motion/sole.ts";
import { forwardKinematics } from "../skeleton/forward-kinematics.ts";
import { J, JOINT_COUNT, type JointName } from "../skeleton/joints.ts";
import type { Skeleton } from "../skeleton/skeleton.ts";
import type { FeetCalibration } from "./import-measure.ts";
import type { Joints } from "./names.ts";

const lateral = new Float64Array(3);

/** A foot of which only the ankle is known: level. Returns its pitch. */
function levelFoot(rotations: Float64Array, o: number, yaw: number): number {
  quatFromYawPitchRoll(rotations, o, yaw, 0, 0);
  return 0;
}

/**
 * World rotation of a foot from its ankle and toe joint, at `o`; returns its pitch against flat, toe up positive.
 *
 * The foot's own left is level as long as the foot is; in push-off, when ankle and toe are nearly above each other (and pass
 * each other), it is the shank's: the heading of a vertical foot says nothing.
 */
function footOnToe(
  rotations: Float64Array,
  o: number,
  shank: number,
  at: Float64Array,
  foot: number,
  toe: number,
  rest: number,
): number {
  const d = [0, 1, 2].map((k) => at[3 * toe + k] - at[3 * foot + k]);
  const length = Math.hypot(d[0], d[1], d[2]) || 1e-9;
  for (let k = 0; k < 3; k++) d[k] /= length;
  quatRotate(lateral, 0, rotations, shank, 1, 0, 0);
  const level = Math.hypot(d[0], d[2]);
  const side = level > 1e-6 && d[2] * lateral[0] - d[0] * lateral[2] < 0 ? -1 : 1;
  const along = lateral[0] * d[0] + lateral[1] * d[1] + lateral[2] * d[2];
  const own = lateral.map((x, k) => x - along * d[k]);
  const n = Math.hypot(own[0], own[1], own[2]) || 1;
  const u = Math.max(0, Math.min(1, (0.75 - level) / 0.45));
  const flat = level > 1e-6 ? [(side * d[2]) / level, 0, (-side * d[0]) / level] : [0, 0, 0];
  // A toe that hangs sideways under the ankle has a heading across the shank, which turns round as it passes: not believed.
  const agree = Math.max(0, Math.min(1, (2 * (flat[0] * own[0] + flat[2] * own[2])) / n));
  const steep = 1 - (1 - u * u * (3 - 2 * u)) * agree * agree * (3 - 2 * agree);
  const x = [0, 1, 2].map((k) => (1 - steep) * flat[k] + (steep * own[k]) / n);
  const m = Math.hypot(x[0], x[1], x[2]) || 1;
  for (let k = 0; k < 3; k++) x[k] /= m;
  const y = [d[1] * x[2] - d[2] * x[1], d[2] * x[0] - d[0] * x[2], d[0] * x[1] - d[1] * x[0]];
  quatFromBasis(rotations, o, x[0], x[1], x[2], y[0], y[1], y[2], d[0], d[1], d[2]);
  quatFromAxisAngle(turned, 0, 1, 0, 0, rest);
  quatMultiply(rotations, o, rotations, o, turned, 0);
  quatNormalize(rotations, o);
  const across = Math.hypot(x[0], x[2]) || 1;
  const slope = Math.atan2(d[1], (x[0] * d[2] - x[2] * d[0]) / across);
  return (slope > Math.PI / 2 ? slope - 2 * Math.PI : slope) - rest;
}

const turned = new Float64Array(4);

/** Upper arms hang so far down from the T-pose, radians. */
const HANGS = 1.4;

export type Poser = (at: Float64Array, pose: Float64Array, root: Float64Array, o: number) => void;

/** The function that poses our skeleton like the file's joints. */
export function createPoser(joints: Joints, skeleton: Skeleton, feet: FeetCalibration): Poser {
  const g = (n: JointName) => joints.get(n);
  const positions = new Float64Array(3 * JOINT_COUNT);
  const rotations = new Float64Array(4 * JOINT_COUNT);
  const q = new Float64Array(24);
  const v = new Float64Array(3);
  const basis = (o: number, left: Float64Array, up: Float64Array) => {
    // +X along `left`, +Y as near to `up` as that allows.
    const n = Math.hypot(left[0], left[1], left[2]) || 1;
    const x = [left[0] / n, left[1] / n, left[2] / n];
    const d = up[0] * x[0] + up[1] * x[1] + up[2] * x[2];
    const y = [up[0] - d * x[0], up[1] - d * x[1], up[2] - d * x[2]];
    const m = Math.hypot(y[0], y[1], y[2]) || 1;
    for (let k = 0; k < 3; k++) y[k] /= m;
    // Not by one turn after another: a half turn has no axis, and a figure that faces backwards lost its trunk for a frame.
    const z = [x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]];
    quatFromBasis(q, o, x[0], x[1], x[2], y[0], y[1], y[2], z[0], z[1], z[2]);
    quatNormalize(q, o);
  };
  const sub = (at: Float64Array, a: number, b: number): Float64Array =>
    Float64Array.of(at[3 * a] - at[3 * b], at[3 * a + 1] - at[3 * b + 1], at[3 * a + 2] - at[3 * b + 2]);
  const lul = g("leftUpperLeg") as number;
  const rul = g("rightUpperLeg") as number;
  const top = g("neck") ?? g("head") ?? g("upperChest") ?? g("chest");
  const low = g("spine") ?? g("chest");
  const lua = g("leftUpperArm");
  const rua = g("rightUpperArm");
  /** Turns a bone the shortest way until it points `along`: its local rotation in `pose` and its world one, over its parent's. */
  const pointBone = (bone: number, along: Float64Array, pose: Float64Array): void => {
    const w = 4 * bone;
    quatMultiply(rotations, w, rotations, w - 4, pose, w);
    const far = Math.hypot(along[0], along[1], along[2]);
    if (far < 1e-6) return;
    const c = 3 * (bone + 1);
    const { offsets } = skeleton;
    quatRotate(v, 0, rotations, w, offsets[c], offsets[c + 1], offsets[c + 2]);
    const length = Math.hypot(v[0], v[1], v[2]);
    quatBetween(
      q,
      20,
      v[0] / length,
      v[1] / length,
      v[2] / length,
      along[0] / far,
      along[1] / far,
      along[2] / far,
    );
    quatMultiply(rotations, w, q, 20, rotations, w);
    quatInverseMultiply(pose, w, rotations, w - 4, rotations, w);
  };
  return (at, pose, root, o) => {
    pose.fill(0);
    for (let j = 0; j < JOINT_COUNT; j++) pose[4 * j + 3] = 1;
    const hips = Float64Array.of(
      (at[3 * lul] + at[3 * rul]) / 2,
      (at[3 * lul + 1] + at[3 * rul + 1]) / 2,
      (at[3 * lul + 2] + at[3 * rul + 2]) / 2,
    );
    const spineUp =
      low !== undefined && low !== lul
        ? Float64Array.of(at[3 * low] - hips[0], at[3 * low + 1] - hips[1], at[3 * low + 2] - hips[2])
        : Float64Array.of(0, 1, 0);
    const trunkUp =
      top !== undefined
        ? Float64Array.of(at[3 * top] - hips[0], at[3 * top + 1] - hips[1], at[3 * top + 2] - hips[2])
        : Float64Array.of(0, 1, 0);
    // A short first spine bone says little of the pelvis: lean on the trunk too.
    const up = Float64Array.of(spineUp[0] + trunkUp[0], spineUp[1] + trunkUp[1], spineUp[2] + trunkUp[2]);
    basis(0, sub(at, lul, rul), up);
    const shoulders = lua !== undefined && rua !== undefined ? sub(at, lua, rua) : sub(at, lul, rul);
    const chest = g("chest") ?? low;
    const overChest =
      top !== undefined && chest !== undefined && chest !== top ? sub(at, top, chest) : trunkUp;
    // Some skeletons have the neck where the chest is: then it says nothing, and the trunk does.
    const chestUp = Math.hypot(...overChest) > 0.05 * Math.hypot(...trunkUp) ? overChest : trunkUp;
    basis(4, shoulders, chestUp);
    const head = g("head");
    const neck = g("neck");
    if (head !== undefined && neck !== undefined) basis(8, shoulders, sub(at, head, neck));
    else for (let k = 0; k < 4; k++) q[8 + k] = q[4 + k];
    // The head keeps mostly upright over the chest.
    quatSlerp(q, 8, q, 4, q, 8, 0.4);
    for (let k = 0; k < 4; k++) pose[k] = q[k];
    quatSlerp(q, 12, q, 0, q, 4, 0.3);
    quatInverseMultiply(pose, 4 * J.spine, q, 0, q, 12);
    quatSlerp(q, 16, q, 0, q, 4, 0.65);
    quatInverseMultiply(pose, 4 * J.chest, q, 12, q, 16);
    quatInverseMultiply(pose, 4 * J.upperChest, q, 16, q, 4);
    quatSlerp(q, 12, q, 4, q, 8, 0.5);
    quatInverseMultiply(pose, 4 * J.neck, q, 4, q, 12);
    quatInverseMultiply(pose, 4 * J.head, q, 12, q, 8);
    // Our hip joints' middle on the file's.
    quatRotate(v, 0, pose, 0, 0, skeleton.offsets[3 * J.leftUpperLeg + 1], 0);
    root[o] = hips[0] - v[0];
    root[o + 1] = hips[1] - feet.floor - v[1];
    root[o + 2] = hips[2] - v[2];
    forwardKinematics(positions, rotations, skeleton, root, o, pose, 0);
    for (let side = 0; side < 2; side++) {
      const s = side === 0 ? "left" : "right";
      const foot = g(`${s}Foot`) as number;
      const knee = g(`${s}LowerLeg`) as number;
      const toe = g(`${s}Toes`);
      const upper = side === 0 ? J.leftUpperLeg : J.rightUpperLeg;
      const hip = side === 0 ? lul : rul;
      const ax = at[3 * foot];
      const rise = skeleton.foot.ankleHeight;
      const ay = at[3 * foot + 1] - feet.ankle[side] + rise;
      const az = at[3 * foot + 2];
      // Which way the knee points: out of the line from hip to ankle, else with the foot.
      const toKnee = sub(at, knee, hip);
      const toAnkle = sub(at, foot, hip);
      const reach = toAnkle[0] ** 2 + toAnkle[1] ** 2 + toAnkle[2] ** 2 || 1;
      const share = (toKnee[0] * toAnkle[0] + toKnee[1] * toAnkle[1] + toKnee[2] * toAnkle[2]) / reach;
      const mid = toKnee.map((x, k) => x - share * toAnkle[k]);
      // A foot that stands on its toes shows no way ahead on the ground: the less it does, the more the pelvis says.
      quatRotate(v, 0, pose, 0, 0, 0, 1);
      const ahead = [v[0], 0, v[2]];
      if (toe !== undefined) {
        const along = [at[3 * toe] - ax, at[3 * toe + 1] - at[3 * foot + 1], at[3 * toe + 2] - az];
        const steep = Math.hypot(along[0], along[1], along[2]) - Math.hypot(along[0], along[2]);
        for (const k of [0, 2]) ahead[k] = along[k] + steep * v[k];
      }
      const out = Math.hypot(mid[0], mid[1], mid[2]);
      const n = Math.hypot(ahead[0], ahead[2]) || 1;
      // Knees do not bend backwards: a straight one that seems to, by centimetres, is not believed.
      const forward = (mid[0] * ahead[0] + mid[2] * ahead[2]) / (n * (out || 1));
      const bent = Math.max(unit(2 * forward + 0.5), unit(out / 0.03 - 1));
      const f = bent * unit(out / 0.03);
      solveLeg(
        pose,
        positions,
        rotations,
        J.hips,
        upper,
        skeleton.offsets,
        ax,
        ay,
        az,
        (f * mid[0]) / (out || 1) + (1.1 - f) * (ahead[0] / n),
        (f * mid[1]) / (out || 1),
        (f * mid[2]) / (out || 1) + (1.1 - f) * (ahead[2] / n),
      );
      const pitch =
        toe !== undefined
          ? footOnToe(rotations, 4 * (upper + 2), 4 * (upper + 1), at, foot, toe, feet.slope[side])
          : levelFoot(rotations, 4 * (upper + 2), Math.atan2(ahead[0], ahead[2]));
      quatInverseMultiply(pose, 4 * (upper + 2), rotations, 4 * (upper + 1), rotations, 4 * (upper + 2));
      // Toes stay on the floor while the ball does.
      const ballHeight =
        ay +
        skeleton.foot.ballForward * Math.sin(pitch) -
        (rise - skeleton.foot.ballHeight) * Math.cos(pitch);
      const near = Math.max(0, Math.min(1, (0.08 - ballHeight) / 0.04));
      const bend = pitch < 0 ? (toeSegmentPitch(pitch) - pitch) * near : 0;
      quatFromAxisAngle(pose, 4 * (upper + 3), 1, 0, 0, -Math.min(1.1, bend));
    }
    // Arms as they hang, then upper arm and forearm each the shortest way to where the file's point: a person's twist.
    forwardKinematics(positions, rotations, skeleton, root, o, pose, 0);
    for (let side = 0; side < 2; side++) {
      const s = side === 0 ? "left" : "right";
      const ua = g(`${s}UpperArm`);
      const la = g(`${s}LowerArm`);
      const ha = g(`${s}Hand`);
      if (ua === undefined || la === undefined || ha === undefined) continue;
      const upper = side === 0 ? J.leftUpperArm : J.rightUpperArm;
      quatFromAxisAngle(pose, 4 * upper, 0, 0, 1, side === 0 ? -HANGS : HANGS);
      pointBone(upper, sub(at, la, ua), pose);
      pointBone(upper + 1, sub(at, ha, la), pose);
    }
  };
}
