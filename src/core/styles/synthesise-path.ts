/**
 * Frames of a walk along a path: rows of the loops laid on the path by displacement mapping [Express §6.3], feet
 * constrained [§7.1], posture adjusted [§7.2], legs closed.
 */
import { CLIP_RATE, type Clip } from "../capture/clip.ts";
import { solveLeg } from "../ik/leg.ts";
import { smoothstep, softEnvelope } from "../math/interpolate.ts";
import {
  quatFromAxisAngle,
  quatFromRotationVector,
  quatFromYawPitchRoll,
  quatInverseMultiply,
  quatMultiply,
  quatRotate,
} from "../math/quaternion.ts";
import { J, JOINT_COUNT } from "../skeleton/joints.ts";
import type { Skeleton } from "../skeleton/skeleton.ts";
import type { ContactTrack } from "../steps/types.ts";
import { balanceOnPath } from "./balance.ts";
import { MEMBER_ROW, readFamily, type StrideFamily } from "./family.ts";
import {
  constrainFeet,
  createFeetTrack,
  findPlants,
  freeFeet,
  growPlants,
  type StylePlant,
  settleFeet,
} from "./feet.ts";
import { easeKnees } from "./knees.ts";
import { leanAlong } from "./lean.ts";
import type { LoopSequence } from "./loop.ts";
import { type MotionPath, placeOnPath, readPath } from "./path.ts";
import { LEG_STRIDE, LEG_TILT, LEGS, mixQuat, mixRows, QUAT_COUNT, QUATS, ROW } from "./rows.ts";
import { createTimeline, type StyleChange, type Timeline, type TimelineOptions } from "./timeline.ts";

/** Each enhancement of [Express §§6.2, 7] can be switched off to show why it is there. */
export interface PathOptions extends TimelineOptions {
  /** Feet stay where they are planted. */
  feet: boolean;
  /** The body leans into turns. */
  lean: boolean;
  /** The hips keep the sample's sway about the path [Express §6.3]; else they are drawn along it. */
  displacement: boolean;
  /** The zero-moment point is brought back over the planted feet. */
  balance: boolean;
}

export const PATH_DEFAULTS: PathOptions = {
  adaptive: true,
  stride: true,
  stand: true,
  feet: true,
  lean: true,
  displacement: true,
  balance: true,
};

export interface PathMotion {
  clip: Clip;
  contacts: ContactTrack;
  plants: StylePlant[];
  timeline: Timeline;
  /** Lean a frame, radians towards the path's left. */
  lean: Float64Array;
  /** How far the hips leave the sample's own offset from the path across it at most, metres. */
  offset: number;
}

const Q = 4 * JOINT_COUNT;
/** Standing: half the distance across the ankles, and the feet's turn outwards, at a leg of 0.93 m. */
const STAND_HALF = 0.095;
const STAND_OUT = (7 * Math.PI) / 180;
/** A knee is never straighter than this, radians. */
const LEAST_KNEE = (7 * Math.PI) / 180;

/**
 * Walks a path in styles.
 *
 * @param families the styles' loops, fitted to the skeleton, with their shorter strides.
 * @param changes styles from places on the path on, metres; in order, the first at 0.
 */
export function synthesisePath(
  path: MotionPath,
  families: readonly StrideFamily[],
  changes: readonly StyleChange[],
  skeleton: Skeleton,
  options: Partial<PathOptions> = {},
): PathMotion {
  const o = { ...PATH_DEFAULTS, ...options };
  const timeline = createTimeline(path, families, changes, o);
  const n = timeline.frames;
  const clip: Clip = {
    name: "path",
    skeleton,
    rate: CLIP_RATE,
    frames: n,
    root: new Float64Array(3 * n),
    rotations: new Float64Array(Q * n),
  };
  const lean = o.lean ? leanAlong(path, timeline.at) : new Float64Array(n);
  const feet = createFeetTrack(n);
  feet.down.set(timeline.down);
  const knees = new Float64Array(6 * n);
  layFrames(clip, path, families, timeline, lean, feet, knees, o.displacement);
  const laid = clip.root.slice();
  const plants = findPlants(feet);
  if (o.feet) {
    settleFeet(feet, plants);
    constrainFeet(feet, plants, skeleton.foot, skeleton.legLength);
    if (growPlants(feet, plants)) {
      settleFeet(feet, plants);
      constrainFeet(feet, plants, skeleton.foot, skeleton.legLength);
    }
  } else freeFeet(feet, skeleton.foot);
  reachFeet(clip, feet.ankle);
  closeLegs(clip, feet, knees);
  if (o.feet && o.balance) {
    const heading = timeline.at.map((s) => readPath(path, path.tangent, s));
    balanceOnPath(clip, plants, feet.contacts, heading, () => closeLegs(clip, feet, knees));
    reachFeet(clip, feet.ankle);
    closeLegs(clip, feet, knees);
  }
  if (o.feet && easeKnees(clip, feet, plants)) closeLegs(clip, feet, knees);
  return {
    clip,
    contacts: feet.contacts,
    plants,
    timeline,
    lean,
    offset: offsetOf(clip.root, laid, path, timeline.at),
  };
}

/** Largest distance between two ways of the hips across a path, metres. */
function offsetOf(root: Float64Array, laid: Float64Array, path: MotionPath, at: Float64Array): number {
  let most = 0;
  for (let f = 0; f < at.length; f++) {
    const t = readPath(path, path.tangent, at[f]);
    const across =
      Math.cos(t) * (root[3 * f] - laid[3 * f]) - Math.sin(t) * (root[3 * f + 2] - laid[3 * f + 2]);
    most = Math.max(most, Math.abs(across));
  }
  return most;
}

/** A loop's row with the legs of the stride wanted, to `row`; `member` is work. */
function readRow(
  row: Float64Array,
  member: Float64Array,
  family: StrideFamily,
  frame: number,
  scale: number,
): void {
  const { loop } = family;
  const f = frame - Math.floor(frame / loop.frames) * loop.frames;
  const i = Math.min(loop.frames - 1, Math.floor(f));
  const u = f - i;
  const a = ROW * i;
  const b = ROW * (i + 1 < loop.frames ? i + 1 : 0);
  row[1] = loop.rows[a + 1] + u * (loop.rows[b + 1] - loop.rows[a + 1]);
  if (u < 1e-6) for (let k = QUATS; k < LEGS; k++) row[k] = loop.rows[a + k];
  else
    for (let j = 0; j < QUAT_COUNT; j++)
      mixQuat(row, QUATS + 4 * j, loop.rows, a + QUATS + 4 * j, loop.rows, b + QUATS + 4 * j, u);
  readFamily(member, family, frame, scale);
  row[0] = member[0];
  row[2] = member[1];
  for (let k = 0; k < 2 * LEG_STRIDE; k++) row[LEGS + k] = member[2 + k];
}

/** Mixes the parts of two rows that are laid on the path: all but the end effectors. */
function mixInto(a: Float64Array, b: Float64Array, u: number): void {
  for (let k = 0; k < QUATS; k++) a[k] += u * (b[k] - a[k]);
  for (let j = 0; j < QUAT_COUNT; j++) mixQuat(a, QUATS + 4 * j, a, QUATS + 4 * j, b, QUATS + 4 * j, u);
  for (let k = LEGS; k < LEGS + 2 * LEG_STRIDE; k++) a[k] += u * (b[k] - a[k]);
}

/** Highest place of a loop's hips: how it stands. */
const standing = new WeakMap<LoopSequence, number>();
function standHeight(loop: LoopSequence, skeleton: Skeleton): number {
  let h = standing.get(loop);
  if (h === undefined) {
    h = 0;
    for (let f = 0; f < loop.frames; f++) h = Math.max(h, loop.rows[ROW * f + 2]);
    h = Math.min(h, 0.9945 * skeleton.legLength - skeleton.offsets[3 * J.leftUpperLeg + 1]);
    standing.set(loop, h);
  }
  return h;
}

/** Towards standing in the style's mean pose, by 1 - amount: feet under the hips, lifted a little where they step. */
function towardsStanding(
  row: Float64Array,
  mean: Float64Array,
  height: number,
  amount: number,
  skeleton: Skeleton,
): void {
  const still = 1 - amount;
  const size = skeleton.legLength / 0.93;
  row[0] *= amount;
  row[1] *= amount;
  row[2] += still * (height - row[2]);
  for (let j = 0; j < QUAT_COUNT; j++)
    mixQuat(row, QUATS + 4 * j, row, QUATS + 4 * j, mean, QUATS + 4 * j, still);
  for (let side = 0; side < 2; side++) {
    const l = LEGS + LEG_STRIDE * side;
    const sign = side === 0 ? 1 : -1;
    row[l] += still * (sign * STAND_HALF * size - row[l]);
    row[l + 1] *= 0.4 + 0.6 * amount;
    row[l + 2] *= amount;
    row[l + 3] += still * (sign * STAND_OUT - row[l + 3]);
    row[l + 4] *= amount;
    row[l + 5] *= amount;
    for (let k = LEG_TILT; k < LEG_STRIDE; k++) row[l + k] *= amount;
  }
}

/** Unconstrained frames: hips and upper body into the clip, feet into their track. */
function layFrames(
  clip: Clip,
  path: MotionPath,
  families: readonly StrideFamily[],
  timeline: Timeline,
  lean: Float64Array,
  feet: ReturnType<typeof createFeetTrack>,
  knees: Float64Array,
  displacement: boolean,
): void {
  const { skeleton } = clip;
  const row = new Float64Array(ROW);
  const other = new Float64Array(ROW);
  const member = new Float64Array(MEMBER_ROW);
  const mean = new Float64Array(ROW);
  const p = new Float64Array(2);
  const q = new Float64Array(12);
  for (let f = 0; f < timeline.frames; f++) {
    const familyA = families[timeline.styleA[f]];
    const w = timeline.weight[f];
    readRow(row, member, familyA, timeline.frameA[f], timeline.scale[f]);
    let height = standHeight(familyA.loop, skeleton);
    if (w > 0) {
      const familyB = families[timeline.styleB[f]];
      readRow(other, member, familyB, timeline.frameB[f], timeline.scale[f]);
      mixInto(row, other, w);
      height += w * (standHeight(familyB.loop, skeleton) - height);
    }
    if (timeline.amount[f] < 1) {
      let stance = familyA.loop.mean;
      if (w > 0) {
        mixRows(mean, 0, stance, 0, families[timeline.styleB[f]].loop.mean, 0, w);
        stance = mean;
      }
      towardsStanding(row, stance, height, timeline.amount[f], skeleton);
    }
    feet.still[f] = timeline.amount[f] <= 0 && timeline.down[f] === 3 ? 1 : 0;
    feet.slow[f] = timeline.amount[f] < 1 ? 1 : 0;
    const s = timeline.at[f];
    const tilt = lean[f];
    const yaw = readPath(path, path.heading, s);
    // Hips: on the path's own offset. The lean turns the body about them.
    const ahead = displacement ? row[0] : 0;
    const left = displacement ? row[1] : 0;
    placeOnPath(p, path, s + ahead);
    const t = readPath(path, path.heading, s + ahead);
    clip.root[3 * f] = p[0] + Math.cos(t) * left;
    clip.root[3 * f + 1] = row[2] * Math.cos(tilt);
    clip.root[3 * f + 2] = p[1] - Math.sin(t) * left;
    quatFromYawPitchRoll(q, 0, yaw, 0, -tilt);
    const r = Q * f;
    quatMultiply(clip.rotations, r, q, 0, row, QUATS);
    for (let k = 4; k < 4 * QUAT_COUNT; k++) clip.rotations[r + k] = row[QUATS + k];
    const outwards = row[2] * Math.sin(tilt);
    for (let side = 0; side < 2; side++) {
      const l = LEGS + LEG_STRIDE * side;
      const i = 2 * f + side;
      const g = 6 * f + 3 * side;
      // A foot is laid where the path will be or was: what rests in the sample rests on the path.
      const along = s + row[l + 2];
      placeOnPath(p, path, along);
      const heading = readPath(path, path.heading, along);
      const lateral = row[l] - outwards;
      feet.print[g] = p[0] + Math.cos(heading) * lateral;
      feet.print[g + 1] = row[l + 1];
      feet.print[g + 2] = p[1] - Math.sin(heading) * lateral;
      feet.yaw[i] = heading + row[l + 3];
      feet.pitch[i] = (timeline.down[f] >> side) & 1 ? settled(row[l + 4]) : row[l + 4];
      feet.toeBend[i] = row[l + 5];
      for (let k = 0; k < 3; k++) feet.tilt[g + k] = row[l + LEG_TILT + k];
      // Knees point half with the foot, half with the body, where the path turns between them.
      const k = yaw + 0.5 * (heading - yaw);
      const c = Math.cos(k);
      const sn = Math.sin(k);
      knees[g] = c * row[l + 6] + sn * row[l + 8];
      knees[g + 1] = row[l + 7];
      knees[g + 2] = -sn * row[l + 6] + c * row[l + 8];
    }
  }
}

/** Toes of a resting foot that are up by less than the first lie on the ground; from the second on they are up; radians. */
const LIES = Math.PI / 180;
const STANDS_UP = (3.2 * Math.PI) / 180;

/** Pitch of a resting foot without what blends and closed loops leave of its toes in the air. */
function settled(pitch: number): number {
  return pitch <= 0 ? pitch : pitch * smoothstep((pitch - LIES) / (STANDS_UP - LIES));
}

/** Lowers the hips softly where a leg would not reach its foot. */
function reachFeet(clip: Clip, ankle: Float64Array): void {
  const o = clip.skeleton.offsets;
  const thigh = -o[3 * J.leftLowerLeg + 1];
  const shank = -o[3 * J.leftFoot + 1];
  const longest = Math.sqrt(thigh * thigh + shank * shank + 2 * thigh * shank * Math.cos(LEAST_KNEE));
  const need = new Float64Array(clip.frames);
  const v = new Float64Array(3);
  let any = false;
  for (let f = 0; f < clip.frames; f++) {
    for (let side = 0; side < 2; side++) {
      const hip = 3 * (side === 0 ? J.leftUpperLeg : J.rightUpperLeg);
      quatRotate(v, 0, clip.rotations, Q * f, o[hip], o[hip + 1], o[hip + 2]);
      const g = 6 * f + 3 * side;
      const dx = clip.root[3 * f] + v[0] - ankle[g];
      const dy = clip.root[3 * f + 1] + v[1] - ankle[g + 1];
      const dz = clip.root[3 * f + 2] + v[2] - ankle[g + 2];
      const lack = dy - Math.sqrt(Math.max(0.01, longest * longest - dx * dx - dz * dz));
      if (lack > need[f]) {
        need[f] = lack;
        any = true;
      }
    }
  }
  if (!any) return;
  const lower = softEnvelope(need, 6);
  for (let f = 0; f < clip.frames; f++) clip.root[3 * f + 1] -= lower[f];
}

/** Legs onto their ankles; feet and toes as wanted. */
function closeLegs(clip: Clip, feet: ReturnType<typeof createFeetTrack>, knees: Float64Array): void {
  const o = clip.skeleton.offsets;
  const positions = new Float64Array(3 * JOINT_COUNT);
  const world = new Float64Array(Q);
  const pose = new Float64Array(Q);
  const v = new Float64Array(3);
  const tilt = new Float64Array(4);
  for (let f = 0; f < clip.frames; f++) {
    const r = Q * f;
    for (let k = 0; k < 4; k++) world[k] = clip.rotations[r + k];
    for (let side = 0; side < 2; side++) {
      const upper = side === 0 ? J.leftUpperLeg : J.rightUpperLeg;
      quatRotate(v, 0, world, 0, o[3 * upper], o[3 * upper + 1], o[3 * upper + 2]);
      for (let k = 0; k < 3; k++) positions[3 * upper + k] = clip.root[3 * f + k] + v[k];
      const g = 6 * f + 3 * side;
      solveLeg(
        pose,
        positions,
        world,
        J.hips,
        upper,
        o,
        feet.ankle[g],
        feet.ankle[g + 1],
        feet.ankle[g + 2],
        knees[g],
        knees[g + 1],
        knees[g + 2],
      );
      const foot = upper + 2;
      quatFromYawPitchRoll(world, 4 * foot, feet.yaw[2 * f + side], -feet.pitch[2 * f + side], 0);
      quatFromRotationVector(tilt, 0, feet.tilt[g], feet.tilt[g + 1], feet.tilt[g + 2]);
      quatMultiply(world, 4 * foot, world, 4 * foot, tilt, 0);
      quatInverseMultiply(pose, 4 * foot, world, 4 * (upper + 1), world, 4 * foot);
      quatFromAxisAngle(pose, 4 * (foot + 1), 1, 0, 0, -feet.toeBend[2 * f + side]);
      for (let k = 4 * upper; k < 4 * (upper + 4); k++) clip.rotations[r + k] = pose[k];
    }
    // Consecutive rotations in one hemisphere.
    if (f > 0) {
      const b = r - Q;
      const q = clip.rotations;
      for (let k = 0; k < Q; k += 4)
        if (
          q[r + k] * q[b + k] +
            q[r + k + 1] * q[b + k + 1] +
            q[r + k + 2] * q[b + k + 2] +
            q[r + k + 3] * q[b + k + 3] <
          0
        )
          for (let c = 0; c < 4; c++) q[r + k + c] = -q[r + k + c];
    }
  }
}
