/**
 * One character's frame: blend, place, close the legs, matrices. Hot path: no allocation.
 */
import { quatMultiply } from "../math/quaternion.ts";
import { contactsOfPitch } from "../motion/sole.ts";
import { forwardKinematics } from "../skeleton/forward-kinematics.ts";
import { J, JOINT_COUNT } from "../skeleton/joints.ts";
import { balanceHips } from "./balance.ts";
import {
  AIR,
  ANKLE,
  type Batch,
  BLEND_FROM,
  BLEND_TIME,
  FOOT,
  FOOT_STATE,
  HIPS_TIME,
  LAND,
  LAST_SIDE,
  LIFT,
  NOW,
  OTHER_LAND,
  PHI,
  PITCH,
  PLACE,
  POSE,
  QUEUE,
  QUEUE_ROW,
  STATE,
  STEPPING,
  T1,
} from "./batch.ts";
import { easeAirborne, easeAnkle, footAt } from "./foot-track.ts";
import { closeLeg, type Leg, legOf, sinkFor } from "./leg-ik.ts";
import { easedShare, FLIGHT, HIPS_AT } from "./library.ts";
import { rootAt } from "./root-track.ts";
import { applyHipsOffset, applyOffset, sampleBody } from "./sample.ts";

/**
 * Phase of the body's rows at time t [Barycentric §5, time warping]: 0 at the lift, 1 at the landing, and at the next lift what
 * the clips have there. A runner's other foot lands at FLIGHT, and its next lift comes before the landing.
 */
function bodyPhase(s: Float64Array, o: number, t: number): number {
  const lift = s[o + LIFT];
  const land = s[o + LAND];
  const other = s[o + OTHER_LAND];
  if (other > 0) {
    if (t < other) return (FLIGHT * (t - lift)) / (other - lift);
    if (t <= land) return FLIGHT + ((1 - FLIGHT) * (t - other)) / (land - other);
  }
  if (t <= land) return (t - lift) / (land - lift);
  const end = s[o + T1];
  if (end <= land + 0.02) return 1 + (t - land) / (land - lift);
  return 1 + (Math.max(0.05, s[o + PHI] - 1) * (t - land)) / (end - land);
}

/** What is shown at time t before feet are placed: blended rotations and the hips' place in the root's frame. */
export function shownBody(out: Float64Array, b: Batch, i: number, t: number): void {
  const s = b.state;
  const o = STATE * i;
  if (s[o + STEPPING] === 1) sampleBody(out, b, 3 * i, s[o + LAST_SIDE], bodyPhase(s, o, t));
  else {
    const { stand } = b.library;
    for (let k = 0; k < HIPS_AT + 3; k++) out[k] = stand[k];
    leanOver(out, b, i, t);
  }
  const length = s[o + BLEND_TIME];
  if (length > 0) {
    const time = Math.max(0, t - s[o + BLEND_FROM]);
    applyOffset(out, b, i, time, length);
    const hips = s[o + HIPS_TIME];
    if (time < hips) applyHipsOffset(out, b, i, time, hips);
  }
}

/** Seconds before a first lift at which the weight begins to go over; share of the way to the supporting foot that it goes. */
const LEAN_TIME = 0.5;
const LEAN = 0.45;

/** Before a first step the hips go over the foot that will bear [anticipatory adjustment, Breniere and Do 1986]. */
function leanOver(out: Float64Array, b: Batch, i: number, t: number): void {
  if (b.queueCount[i] === 0) return;
  const row = QUEUE_ROW * (QUEUE * i + b.queueHead[i]);
  const u = 1 + (t - b.queue[row + 7]) / LEAN_TIME;
  if (u <= 0) return;
  const s = b.state;
  const o = STATE * i;
  const side = b.queue[row];
  const f = o + FOOT + FOOT_STATE * (1 - side) + PLACE;
  const g = o + FOOT + FOOT_STATE * side + PLACE;
  const share = LEAN * easedShare(Math.min(1, u));
  const dx = (share * (s[f] - s[g])) / 2;
  const dz = (share * (s[f + 2] - s[g + 2])) / 2;
  const c = Math.cos(s[o + NOW + 2]);
  const n = Math.sin(s[o + NOW + 2]);
  out[HIPS_AT] += c * dx - n * dz;
  out[HIPS_AT + 2] += n * dx + c * dz;
}

/** Shares of a torso's twist: of the hips over the feet, of each joint of the spine; and what neck and head turn back, to look ahead. */
const HIPS_TWIST = 0.5;
const SPINE_TWIST = 1 / 6;
const NECK_BACK = -0.45;
const HEAD_BACK = -0.35;

/** Turns a joint about its parent's upright. */
function turnJoint(pose: Float64Array, joint: number, angle: number): void {
  turn[1] = Math.sin(angle / 2);
  turn[3] = Math.cos(angle / 2);
  quatMultiply(pose, 4 * joint, turn, 0, pose, 4 * joint);
}

function twistBody(pose: Float64Array, twist: number): void {
  turnJoint(pose, J.spine, SPINE_TWIST * twist);
  turnJoint(pose, J.chest, SPINE_TWIST * twist);
  turnJoint(pose, J.upperChest, SPINE_TWIST * twist);
  turnJoint(pose, J.neck, NECK_BACK * twist);
  turnJoint(pose, J.head, HEAD_BACK * twist);
}

const legs = new WeakMap<object, Leg>();
const turn = new Float64Array(4);
const shift = new Float64Array(3);

function legFor(b: Batch): Leg {
  const key = b.library.skeleton;
  let leg = legs.get(key);
  if (!leg) {
    leg = legOf(key);
    legs.set(key, leg);
  }
  return leg;
}

/**
 * Writes the frame at time t: root, rotations, contacts and, where wanted, matrices.
 *
 * @param landed side of a foot that came down since the frame before, -1 for none: its distance from the blend is noted.
 */
export function writePose(b: Batch, i: number, t: number, dt: number, landed: number): void {
  const s = b.state;
  const o = STATE * i;
  const { pose, positions, world, v } = b.scratch;
  const { skeleton } = b.library;
  const offsets = skeleton.offsets;
  const leg = legFor(b);
  rootAt(s, o, t);
  shownBody(pose, b, i, t);
  const yaw = s[o + NOW + 2];
  const c = Math.cos(yaw);
  const n = Math.sin(yaw);
  const twist = b.upperYaw[i];
  turnJoint(pose, J.hips, yaw + HIPS_TWIST * twist);
  if (twist !== 0) twistBody(pose, twist);
  v[0] = s[o + NOW] + c * pose[HIPS_AT] + n * pose[HIPS_AT + 2];
  v[1] = s[o + NOW + 3] + pose[HIPS_AT + 1];
  v[2] = s[o + NOW + 1] - n * pose[HIPS_AT] + c * pose[HIPS_AT + 2];
  forwardKinematics(positions, world, skeleton, v, 0, pose, 0);
  let contacts = 0;
  let sink = 0;
  footAt(b, i, 0, t, dt);
  footAt(b, i, 1, t, dt);
  balanceHips(shift, b, i, t, dt);
  for (let side = 0; side < 2; side++) {
    const f = o + FOOT + FOOT_STATE * side;
    const joint = 3 * (side === 0 ? J.leftUpperLeg : J.rightUpperLeg);
    const need = sinkFor(
      leg,
      s[f + ANKLE] - positions[joint] - shift[0],
      s[f + ANKLE + 1] - positions[joint + 1] - shift[2],
      s[f + ANKLE + 2] - positions[joint + 2] - shift[1],
    );
    // A smooth largest of both.
    const a = sink * sink;
    const c = need * need;
    sink = Math.sqrt(Math.sqrt(a * a + c * c));
    if (side === landed) {
      const ankle = joint + 6;
      const dx = positions[ankle] - s[f + ANKLE];
      const dz = positions[ankle + 2] - s[f + ANKLE + 2];
      b.landingError[i] = Math.sqrt(dx * dx + dz * dz);
    }
  }
  for (let j = 0; j < JOINT_COUNT; j++) {
    positions[3 * j] += shift[0];
    positions[3 * j + 1] += shift[2] - sink;
    positions[3 * j + 2] += shift[1];
  }
  for (let side = 0; side < 2; side++) {
    const f = o + FOOT + FOOT_STATE * side;
    const upper = side === 0 ? J.leftUpperLeg : J.rightUpperLeg;
    if (twist !== 0) {
      // Hips turn over their legs: knees go on over the feet, and not out to the side.
      turnJoint(world, upper, -HIPS_TWIST * twist);
      turnJoint(world, upper + 2, -HIPS_TWIST * twist);
    }
    closeLeg(leg, offsets, pose, positions, world, upper, s, f);
    const q = 4 * (upper + 2);
    // Of the two quaternions of one turn the shorter way round: the other reads as a bend of a whole turn more.
    const bend = -2 * Math.atan2(pose[q + 3] < 0 ? -pose[q] : pose[q], Math.abs(pose[q + 3]));
    const air = s[f + AIR] === 1;
    if (air ? easeAirborne(b, i, side, bend) : easeAnkle(b, i, side, bend))
      closeLeg(leg, offsets, pose, positions, world, upper, s, f);
    if (air) continue;
    contacts |= contactsOfPitch(s[f + PITCH]) << (2 * side);
  }
  b.root[3 * i] = positions[0];
  b.root[3 * i + 1] = positions[1];
  b.root[3 * i + 2] = positions[2];
  const r = POSE * i;
  for (let k = 0; k < POSE; k++) b.rotations[r + k] = pose[k];
  b.contacts[i] = contacts;
  if (b.options.matrices) writeMatrices(b, i);
}

/** World rotation and place of each joint times the inverse of its rest place: the rest pose has no rotations. */
function writeMatrices(b: Batch, i: number): void {
  const { positions, world } = b.scratch;
  const m = b.matrices;
  const rest = restOf(b);
  let o = 16 * JOINT_COUNT * i;
  for (let j = 0; j < JOINT_COUNT; j++, o += 16) {
    const x = world[4 * j];
    const y = world[4 * j + 1];
    const z = world[4 * j + 2];
    const w = world[4 * j + 3];
    const xx = 1 - 2 * (y * y + z * z);
    const xy = 2 * (x * y + w * z);
    const xz = 2 * (x * z - w * y);
    const yx = 2 * (x * y - w * z);
    const yy = 1 - 2 * (x * x + z * z);
    const yz = 2 * (y * z + w * x);
    const zx = 2 * (x * z + w * y);
    const zy = 2 * (y * z - w * x);
    const zz = 1 - 2 * (x * x + y * y);
    const rx = rest[3 * j];
    const ry = rest[3 * j + 1];
    const rz = rest[3 * j + 2];
    m[o] = xx;
    m[o + 1] = xy;
    m[o + 2] = xz;
    m[o + 3] = 0;
    m[o + 4] = yx;
    m[o + 5] = yy;
    m[o + 6] = yz;
    m[o + 7] = 0;
    m[o + 8] = zx;
    m[o + 9] = zy;
    m[o + 10] = zz;
    m[o + 11] = 0;
    m[o + 12] = positions[3 * j] - (xx * rx + yx * ry + zx * rz);
    m[o + 13] = positions[3 * j + 1] - (xy * rx + yy * ry + zy * rz);
    m[o + 14] = positions[3 * j + 2] - (xz * rx + yz * ry + zz * rz);
    m[o + 15] = 1;
  }
}

const rests = new WeakMap<object, Float64Array>();

/** Joints' places in the rest pose. */
function restOf(b: Batch): Float64Array {
  const { skeleton } = b.library;
  let rest = rests.get(skeleton);
  if (!rest) {
    rest = new Float64Array(3 * JOINT_COUNT);
    const still = new Float64Array(4 * JOINT_COUNT);
    for (let j = 0; j < JOINT_COUNT; j++) still[4 * j + 3] = 1;
    forwardKinematics(rest, new Float64Array(4 * JOINT_COUNT), skeleton, skeleton.offsets, 0, still, 0);
    rests.set(skeleton, rest);
  }
  return rest;
}
