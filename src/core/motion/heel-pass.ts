/**
 * Heels that rise as the body goes ahead of the foot: a planted leg that is too short for its step, or whose ankle would bend up
 * more than ankles do, rolls over its ball, as a walker's rear foot does.
 *
 * A capture's heel rises as its own step asked for. Where the plan's step is longer, a foot kept flat would pull the hips down.
 */
import { wrapAngle } from "../math/angle.ts";
import { minimumJerk, smoothstep, softEnvelope } from "../math/interpolate.ts";
import { quatFromYawPitchRoll, quatRotate, quatYaw } from "../math/quaternion.ts";
import { J, JOINT_COUNT } from "../skeleton/joints.ts";
import type { Skeleton } from "../skeleton/skeleton.ts";
import type { KeptBalance } from "./balance-pass.ts";
import type { BodyTrack } from "./body-pass.ts";
import { FOOT_STRIDE, pitchOf } from "./foot-pose.ts";
import type { SegmentSetup } from "./segment-setup.ts";
import { contactsOfPitch, plantedAnkle } from "./sole.ts";

const Q = JOINT_COUNT * 4;
/** Ankles bend up so far with ease, radians: weight-bearing dorsiflexion is 35 to 45 degrees. */
const EASY_ANKLE = (38 * Math.PI) / 180;
/** Least flexion of a leg that stands far behind, radians. */
const REAR_KNEE = (8 * Math.PI) / 180;
/** Most that a heel is raised beyond its capture, radians, and the steps in which it is looked for. */
const MOST = (40 * Math.PI) / 180;
const STEP = (2 * Math.PI) / 180;
/**
 * A heel that never needs more stays down, and one that does rises quickly past what it needs less than that for: none hovers a
 * few millimetres over the ground. Radians.
 */
const WORTH = (10 * Math.PI) / 180;
const STAYS = (5 * Math.PI) / 180;
const RISES = (9 * Math.PI) / 180;
/** Lowest pitch that a raised heel comes to, radians. */
const LOWEST = (-55 * Math.PI) / 180;
/** Half window of the soft rise, frames; frames after landing in which no heel rises fully; frames of a swing in which it comes back. */
const SOFT = 6;
const LANDED = 14;
const COMES_BACK = 14;
/** Frames in which what a shown motion had goes over into a new one's. */
const TAKE_OVER = 16;

const place = new Float64Array(3);
const lower = new Float64Array(3);
const v = new Float64Array(6);

/**
 * Raises the heels of planted feet. Mutates `track.feet` and `track.contacts`, and notes the rise in `track.heels`.
 *
 * @param setups of the plan's segments: plants that are enforced keep their heels.
 * @param kept the motion that is shown: its frames so far keep their rise.
 */
export function raiseHeels(
  track: BodyTrack,
  setups: readonly SegmentSetup[],
  skeleton: Skeleton,
  kept: KeptBalance | null,
): void {
  for (let side = 0 as 0 | 1; side < 2; side = (side + 1) as 0 | 1) {
    const need = new Float64Array(track.frames);
    let any = false;
    for (let f = 0; f < track.frames; f++) {
      if (!stands(track, f, side) || held(track, setups, f, side)) continue;
      need[f] = neededRise(track, f, side, skeleton);
      any ||= need[f] > 0;
    }
    if (!any && !kept) continue;
    leaveSmall(need);
    applyRise(track, side, softEnvelope(need, SOFT), skeleton, kept);
  }
}

/** Takes out stretches whose largest need is not worth a rise. */
function leaveSmall(need: Float64Array): void {
  for (let f = 0; f < need.length; f++) {
    let end = f;
    let most = 0;
    while (end < need.length && need[end] > 0) most = Math.max(most, need[end++]);
    if (most < WORTH) need.fill(0, f, end);
    f = Math.max(f, end);
  }
}

/** Whether the ball of a foot bears. */
const stands = (track: BodyTrack, frame: number, side: number): boolean =>
  ((track.contacts[frame] >> (2 * side)) & 2) !== 0;

/** Whether the user wants a foot flat while it rests: its heel stays. */
function held(track: BodyTrack, setups: readonly SegmentSetup[], frame: number, side: 0 | 1): boolean {
  const { plantBefore, plantAfter } = setups[track.segmentOf[frame]];
  const flat = ((track.contacts[frame] >> (2 * side)) & 3) === 3;
  return flat && (plantBefore[side] === "enforce" || plantAfter[side] === "enforce");
}

/** How far a heel must rise, radians: until its leg reaches and its ankle is at ease; 0 where the hips are not ahead of the foot. */
function neededRise(track: BodyTrack, frame: number, side: 0 | 1, skeleton: Skeleton): number {
  const { offsets, foot } = skeleton;
  const upper = side === 0 ? J.leftUpperLeg : J.rightUpperLeg;
  const thigh = Math.abs(offsets[3 * (upper + 1) + 1]);
  const shank = Math.abs(offsets[3 * (upper + 2) + 1]);
  const longest = Math.sqrt(thigh * thigh + shank * shank + 2 * thigh * shank * Math.cos(REAR_KNEE));
  const o = (2 * frame + side) * FOOT_STRIDE;
  quatRotate(
    v,
    0,
    track.rotations,
    Q * frame,
    offsets[3 * upper],
    offsets[3 * upper + 1],
    offsets[3 * upper + 2],
  );
  const yaw = quatYaw(track.feet, o + 3);
  const s = Math.sin(yaw);
  const c = Math.cos(yaw);
  const x = track.root[3 * frame] + v[0] - track.feet[o];
  const up = track.root[3 * frame + 1] + v[1] - track.feet[o + 1];
  const z = track.root[3 * frame + 2] + v[2] - track.feet[o + 2];
  const ahead = s * x + c * z;
  const across = c * x - s * z;
  if (ahead <= 0) return 0;
  const pitch = Math.min(0, pitchOf(track.feet, o + 3));
  plantedAnkle(place, foot, pitch);
  for (let rise = 0; rise < MOST; rise += STEP) {
    if (pitch - rise < LOWEST) return Math.max(0, pitch - LOWEST);
    plantedAnkle(lower, foot, pitch - rise);
    const forward = ahead - (lower[0] - place[0]);
    const height = up - (lower[1] - place[1]);
    const d = Math.hypot(forward, height, across);
    const bend = Math.acos(
      Math.max(-1, Math.min(1, (shank * shank + d * d - thigh * thigh) / (2 * shank * d))),
    );
    const ankle = Math.atan2(forward, height) + (d < longest ? bend : 0) + pitch - rise;
    if (d <= longest && ankle <= EASY_ANKLE) return rise;
  }
  return MOST;
}

/** Turns one foot's soles by the rise of each frame, and lets it die out in the swing after. */
function applyRise(
  track: BodyTrack,
  side: 0 | 1,
  rise: Float64Array,
  skeleton: Skeleton,
  kept: KeptBalance | null,
): void {
  const known = kept?.heels;
  let standing = LANDED;
  let left = 0;
  let pitchAtLift = 0;
  for (let f = 0; f < track.frames; f++) {
    const o = (2 * f + side) * FOOT_STRIDE;
    const planted = stands(track, f, side);
    let amount: number;
    let pitch: number;
    if (planted) {
      standing++;
      pitch = Math.min(0, pitchOf(track.feet, o + 3));
      amount = rise[f] * smoothstep((rise[f] - STAYS) / (RISES - STAYS)) * minimumJerk(standing / LANDED);
      left = amount;
      pitchAtLift = pitch;
    } else {
      standing = standing > 0 ? 0 : standing - 1;
      pitch = pitchAtLift;
      amount =
        ((track.contacts[f] >> (2 * side)) & 1) !== 0 ? 0 : left * (1 - minimumJerk(-standing / COMES_BACK));
    }
    if (known && kept && f < kept.until + TAKE_OVER && known.length > 0) {
      const held = known[2 * Math.min(f, kept.until, known.length / 2 - 1) + side];
      amount = held + minimumJerk((f - kept.until) / TAKE_OVER) * (amount - held);
    }
    track.heels[2 * f + side] = amount;
    if (amount <= 1e-6) continue;
    turnFoot(track.feet, o, pitch, amount, skeleton);
    if (planted) {
      const bits = (track.contacts[f] >> (2 * side)) & 3 & contactsOfPitch(pitch - amount);
      track.contacts[f] = (track.contacts[f] & ~(3 << (2 * side))) | (bits << (2 * side));
    }
  }
}

/** A foot's row with its heel raised by `amount`: as it rolls from `pitch` over its ball. */
function turnFoot(feet: Float64Array, o: number, pitch: number, amount: number, skeleton: Skeleton): void {
  plantedAnkle(place, skeleton.foot, pitch);
  plantedAnkle(lower, skeleton.foot, pitch - amount);
  const yaw = quatYaw(feet, o + 3);
  const forward = lower[0] - place[0];
  feet[o] += Math.sin(yaw) * forward;
  feet[o + 1] += lower[1] - place[1];
  feet[o + 2] += Math.cos(yaw) * forward;
  // About the foot's own axis across: what it has of roll stays.
  quatFromYawPitchRoll(v, 0, 0, amount, 0);
  rotateBy(feet, o + 3);
  feet[o + 7] = feet[o + 7] + wrapAngle(lower[2] - place[2]);
}

/** Multiplies a quaternion in place by the one in v[0..3], from the right. */
function rotateBy(q: Float64Array, i: number): void {
  const [x, y, z, w] = [q[i], q[i + 1], q[i + 2], q[i + 3]];
  q[i] = w * v[0] + x * v[3] + y * v[2] - z * v[1];
  q[i + 1] = w * v[1] - x * v[2] + y * v[3] + z * v[0];
  q[i + 2] = w * v[2] + x * v[1] - y * v[0] + z * v[3];
  q[i + 3] = w * v[3] - x * v[0] - y * v[1] - z * v[2];
}
