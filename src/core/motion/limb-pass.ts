/**
 * Second pass of the synthesis: the legs closed onto the feet, the hands led to their tasks, the trunk helping where an
 * arm is too short [TaskLoco §6, Figure 12].
 */
import { basisAlong, solveLeg } from "../ik/leg.ts";
import { closeLimb, type Limb, limbsOf } from "../ik/limb.ts";
import { bendTrunk } from "../ik/trunk.ts";
import { smoothstep } from "../math/interpolate.ts";
import {
  quatBetween,
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
  hinge: Float64Array;
  limbs: Limb[] | null;
}

export function createLimbWorkspace(): LimbWorkspace {
  return {
    positions: new Float64Array(JOINT_COUNT * 3),
    world: new Float64Array(JOINT_COUNT * 4),
    pose: new Float64Array(Q),
    root: new Float64Array(3),
    hints: new Float64Array(12),
    q: new Float64Array(8),
    hinge: new Float64Array(4),
    limbs: null,
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
    quatRotate(w.hints, 0, track.feet, o + 3, 0, 0, 1);
    quatRotate(w.hints, 3, w.world, 0, 0, 0, 1);
    quatRotate(w.hints, 6, w.world, 4 * upper, 0, 0, 1);
    for (let k = 0; k < 3; k++) w.hints[9 + k] = track.feet[o + k] - w.positions[3 * upper + k];
    kneeDirection(w.hints);
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
    if (((track.contacts[frame] >> (2 * side)) & 3) === 0) relaxAnkle(w, foot, skeleton);
    quatFromAxisAngle(w.pose, 4 * (foot + 1), 1, 0, 0, -track.feet[o + 7]);
    quatMultiply(w.world, 4 * (foot + 1), w.world, 4 * foot, w.pose, 4 * (foot + 1));
  }
}

/** Dorsiflexion from which on an ankle in the air gives way, and how far beyond it at most; radians. */
const EASY_ANKLE = (30 * Math.PI) / 180;
const ANKLE_GIVE = (10 * Math.PI) / 180;

/** A foot in the air hangs: its ankle bends up no farther than it does with ease, as far as the toes clear the ground. */
function relaxAnkle(w: LimbWorkspace, foot: number, skeleton: Skeleton): void {
  const bend = -2 * Math.atan2(w.pose[4 * foot], w.pose[4 * foot + 3]);
  if (bend <= EASY_ANKLE || bend > Math.PI) return;
  const over = bend - EASY_ANKLE - ANKLE_GIVE * Math.tanh((bend - EASY_ANKLE) / ANKLE_GIVE);
  const { ankleHeight, ballForward, tipForward } = skeleton.foot;
  const length = ballForward + tipForward;
  quatRotate(w.hints, 0, w.world, 4 * foot, 0, -ankleHeight, length);
  const clear = Math.max(0, w.positions[3 * foot + 1] + w.hints[1] - 0.006);
  quatFromAxisAngle(w.hinge, 0, 1, 0, 0, Math.min(over, clear / length));
  quatMultiply(w.pose, 4 * foot, w.pose, 4 * foot, w.hinge, 0);
  quatMultiply(w.world, 4 * foot, w.world, 4 * (foot - 1), w.pose, 4 * foot);
}

/** Farthest that a knee points away from the middle of foot and hips, radians: the hip turns no more. */
const MOST_KNEE_TURN = (50 * Math.PI) / 180;

/**
 * Where the knee points: as the pose's does (h[6..8]), softly held to the middle of the foot's forward (h[0..2]) and
 * the hips' (h[3..5]), about the way from hip to ankle (h[9..11]). Where these two point opposite ways, as a foot left
 * behind in a turn does, they say nothing and the pose is taken. Writes h[0..2].
 */
function kneeDirection(h: Float64Array): void {
  const l = Math.hypot(h[9], h[10], h[11]) || 1;
  const ax = h[9] / l;
  const ay = h[10] / l;
  const az = h[11] / l;
  let rx = h[0] + h[3];
  let ry = h[1] + h[4];
  let rz = h[2] + h[5];
  const ra = rx * ax + ry * ay + rz * az;
  rx -= ra * ax;
  ry -= ra * ay;
  rz -= ra * az;
  const r = Math.hypot(rx, ry, rz);
  const ta = h[6] * ax + h[7] * ay + h[8] * az;
  const tx = h[6] - ta * ax;
  const ty = h[7] - ta * ay;
  const tz = h[8] - ta * az;
  h[0] = tx;
  h[1] = ty;
  h[2] = tz;
  if (r < 1e-6) return;
  rx /= r;
  ry /= r;
  rz /= r;
  // Third axis, square to the limb and to the middle.
  const sx = ay * rz - az * ry;
  const sy = az * rx - ax * rz;
  const sz = ax * ry - ay * rx;
  const turn = Math.atan2(tx * sx + ty * sy + tz * sz, tx * rx + ty * ry + tz * rz);
  const held = MOST_KNEE_TURN * Math.tanh(turn / MOST_KNEE_TURN);
  const angle = turn + Math.min(1, r) * (held - turn);
  const c = Math.cos(angle);
  const s = Math.sin(angle);
  h[0] = c * rx + s * sx;
  h[1] = c * ry + s * sy;
  h[2] = c * rz + s * sz;
}

/**
 * Leads the hands to their targets: the trunk bends for what the arms lack, then each arm closes. Free arms are only made
 * hinges, so that an arm that is let go does not change its roll.
 */
export function closeArms(w: LimbWorkspace, targets: HandTargets, skeleton: Skeleton): void {
  // The targets were made for hands that point as they do now, whatever the trunk does.
  for (let side = 0; side < 2; side++) {
    const hand = side === 0 ? J.leftHand : J.rightHand;
    for (let k = 0; k < 4; k++) w.q[4 * side + k] = w.world[4 * hand + k];
  }
  if (targets.weight[0] > 0 || targets.weight[1] > 0)
    bendTrunk(w.pose, w.positions, w.world, w.root, skeleton, targets.weight, targets.place);
  w.limbs ??= limbsOf(skeleton);
  for (let side = 0; side < 2; side++) {
    const upper = side === 0 ? J.leftUpperArm : J.rightUpperArm;
    const hand = upper + 2;
    rollToHinge(w, upper, side === 0 ? 1 : -1);
    if (targets.weight[side] > 0) {
      const t = 3 * side;
      const { place } = targets;
      closeLimb(w.limbs[side], w.pose, w.positions, w.world, place[t], place[t + 1], place[t + 2], false);
    }
    // The hand keeps the way it pointed.
    for (let k = 0; k < 4; k++) w.world[4 * hand + k] = w.q[4 * side + k];
    quatInverseMultiply(w.pose, 4 * hand, w.world, 4 * (upper + 1), w.world, 4 * hand);
    quatNormalize(w.pose, 4 * hand);
  }
}

/** Sine of the elbow's bend from which on its plane alone says how the upper arm is rolled. */
const SURE_BEND = 0.35;

/**
 * Rolls an upper arm about its own bone so that the elbow bends about its hinge: -Y on the left, Y on the right. The
 * bones stay where they are. A nearly straight arm keeps its roll.
 */
function rollToHinge(w: LimbWorkspace, upper: number, sign: 1 | -1): void {
  const { positions: p, world, pose, hints: h } = w;
  const lower = upper + 1;
  const hand = upper + 2;
  const bone = (a: number, b: number, o: number) => {
    const x = p[3 * b] - p[3 * a];
    const y = p[3 * b + 1] - p[3 * a + 1];
    const z = p[3 * b + 2] - p[3 * a + 2];
    const n = Math.hypot(x, y, z) || 1;
    h[o] = x / n;
    h[o + 1] = y / n;
    h[o + 2] = z / n;
  };
  bone(upper, lower, 0);
  bone(lower, hand, 3);
  const nx = h[1] * h[5] - h[2] * h[4];
  const ny = h[2] * h[3] - h[0] * h[5];
  const nz = h[0] * h[4] - h[1] * h[3];
  const sine = Math.hypot(nx, ny, nz);
  if (sine < 1e-6) return;
  const sure = smoothstep(sine / SURE_BEND);
  quatRotate(h, 6, world, 4 * upper, 0, 1, 0);
  // The wanted Y axis, square to the bone already; the present one is, by construction.
  const f = (-sign * sure) / sine;
  let yx = f * nx + (1 - sure) * h[6];
  let yy = f * ny + (1 - sure) * h[7];
  let yz = f * nz + (1 - sure) * h[8];
  const along = yx * h[0] + yy * h[1] + yz * h[2];
  yx -= along * h[0];
  yy -= along * h[1];
  yz -= along * h[2];
  const n = Math.hypot(yx, yy, yz);
  if (n < 1e-6) return;
  basisAlong(world, 4 * upper, sign * h[0], sign * h[1], sign * h[2], yx / n, yy / n, yz / n);
  quatInverseMultiply(pose, 4 * upper, world, 4 * (upper - 1), world, 4 * upper);
  quatNormalize(pose, 4 * upper);
  // The lower arm turns about the hinge, and what is left of its way about the plane's normal.
  quatRotate(h, 6, world, 4 * upper, sign, 0, 0);
  quatBetween(w.hinge, 0, h[6], h[7], h[8], h[3], h[4], h[5]);
  quatMultiply(world, 4 * lower, w.hinge, 0, world, 4 * upper);
  quatInverseMultiply(pose, 4 * lower, world, 4 * upper, world, 4 * lower);
  quatNormalize(pose, 4 * lower);
}
