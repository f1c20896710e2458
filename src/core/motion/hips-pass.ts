/**
 * Hips between the passes: led onto the seat, and lowered softly where a leg would not reach its foot.
 */
import { minimumJerk, softEnvelope } from "../math/interpolate.ts";
import { quatRotate } from "../math/quaternion.ts";
import { J, JOINT_COUNT } from "../skeleton/joints.ts";
import type { Skeleton } from "../skeleton/skeleton.ts";
import type { KeptBalance } from "./balance-pass.ts";
import type { BodyTrack } from "./body-pass.ts";
import { FOOT_STRIDE, pitchOf } from "./foot-pose.ts";
import type { SegmentSetup } from "./segment-setup.ts";
import { mapByTask, shows, type TaskWindow, windowWeight } from "./task-windows.ts";

const Q = JOINT_COUNT * 4;
/**
 * Least knee flexion, radians: near straight a millimetre at the hip is degrees at the knee, which pops; the 2 mm of
 * hip height that it costs are not seen.
 */
const LEAST_KNEE = (8 * Math.PI) / 180;
/** Of the capture's own flexion this much stays where the plan's footsteps are farther: planted leg, swinging leg. */
const STANCE_SHARE = 0.35;
const SWING_SHARE = 0.7;
/**
 * A raised heel goes with a bent knee: its flexion beside the heel's rise. A straight leg over a raised heel, as where a step is far
 * longer than its capture's, snaps as the foot lifts.
 */
const PUSH_SHARE = 0.35;
/** Softness of the limits, metres: hips' height, swinging foot. */
const EASE = 0.006;
const PULL = 0.008;
/** Half window of the soft lowering, frames. */
const SOFT = 8;

const v = new Float64Array(6);

/** Leads the hips onto seats: from the body's own way to the capture's place at the seat. Mutates `track.root`. */
export function leadToSeats(
  track: BodyTrack,
  setups: readonly SegmentSetup[],
  windows: readonly TaskWindow[],
  skeleton: Skeleton,
): void {
  for (const w of windows) {
    if (w.task.category !== "sit") continue;
    const gap = new Float64Array(3);
    const rest = seatGap(track, setups, w, skeleton);
    for (let f = Math.max(0, w.from); f < Math.min(track.frames, w.over); f++) {
      const setup = setups[track.segmentOf[f]];
      if (shows(w, setup.segment.clip, track.sourceFrame[f]) && f <= w.end) {
        const clip = setup.source.clip;
        const i = Math.max(0, Math.min(clip.frames - 1, Math.round(track.sourceFrame[f])));
        mapByTask(v, 0, w, clip.root[3 * i], clip.root[3 * i + 1], clip.root[3 * i + 2]);
        for (let k = 0; k < 3; k++) gap[k] = v[k] + rest[k] - track.root[3 * f + k];
      }
      const weight = windowWeight(w, f);
      for (let k = 0; k < 3; k++) track.root[3 * f + k] += weight * gap[k];
    }
  }
}

/** Within the 60 to 120 mm under the hip joints at which a seat is met, metres at 1.75 m. */
const UNDER_HIPS = 0.098;

/** What is left between the seat and the point that meets it at contact, once the capture's hips are laid there. */
function seatGap(
  track: BodyTrack,
  setups: readonly SegmentSetup[],
  w: TaskWindow,
  skeleton: Skeleton,
): Float64Array {
  const out = new Float64Array(3);
  const f = Math.max(0, Math.min(track.frames - 1, w.contact));
  const setup = setups[track.segmentOf[f]];
  if (setup.segment.clip !== w.clip) return out;
  const clip = setup.source.clip;
  const i = Math.max(0, Math.min(clip.frames - 1, Math.round(track.sourceFrame[f])));
  mapByTask(v, 0, w, clip.root[3 * i], clip.root[3 * i + 1], clip.root[3 * i + 2]);
  const under = UNDER_HIPS * (skeleton.height / 1.75) - skeleton.offsets[3 * J.leftUpperLeg + 1];
  quatRotate(v, 3, track.rotations, Q * f, 0, -under, 0);
  out[0] = w.target.x - v[0] - v[3];
  out[1] = w.target.y - v[1] - v[4];
  out[2] = w.target.z - v[2] - v[5];
  return out;
}

/** Length of a leg whose knee is bent by `flexion`, metres. */
const legLength = (thigh: number, shank: number, flexion: number): number =>
  Math.sqrt(thigh * thigh + shank * shank + 2 * thigh * shank * Math.cos(flexion));

/** Flexion of a knee in the pose that the captures gave, radians. */
function flexionOf(track: BodyTrack, frame: number, knee: number): number {
  const o = Q * frame + 4 * knee;
  const r = track.rotations;
  return 2 * Math.atan2(Math.hypot(r[o], r[o + 1], r[o + 2]), Math.abs(r[o + 3]));
}

/** The way from a foot's ankle to its hip joint at a frame, into v[3..5]; its length. */
function footToHip(track: BodyTrack, frame: number, side: number, offsets: ArrayLike<number>): number {
  const hip = side === 0 ? J.leftUpperLeg : J.rightUpperLeg;
  quatRotate(v, 0, track.rotations, Q * frame, offsets[3 * hip], offsets[3 * hip + 1], offsets[3 * hip + 2]);
  const o = (2 * frame + side) * FOOT_STRIDE;
  for (let k = 0; k < 3; k++) v[3 + k] = track.root[3 * frame + k] + v[k] - track.feet[o + k];
  return Math.sqrt(v[3] * v[3] + v[4] * v[4] + v[5] * v[5]);
}

/**
 * Draws a foot in the air softly to its hip where its leg would be straighter than the capture's was: a few
 * millimetres at the foot are many degrees at a knee that is nearly straight. Nothing at lift and landing.
 * Mutates `track.feet`.
 */
export function softenSwings(track: BodyTrack, skeleton: Skeleton): void {
  const { offsets } = skeleton;
  const thigh = Math.abs(offsets[3 * J.leftLowerLeg + 1]);
  const shank = Math.abs(offsets[3 * J.leftFoot + 1]);
  for (let side = 0; side < 2; side++) {
    const knee = side === 0 ? J.leftLowerLeg : J.rightLowerLeg;
    const swings = (f: number): boolean => ((track.contacts[f] >> (2 * side)) & 3) === 0;
    for (let f = 0; f < track.frames; ) {
      if (!swings(f)) {
        f++;
        continue;
      }
      let end = f;
      while (end < track.frames && swings(end)) end++;
      const length = end - f + 1;
      for (let k = f; k < end; k++) {
        const u = (k - f + 1) / length;
        const weight = minimumJerk(Math.min(1, u / 0.3)) * minimumJerk(Math.min(1, (1 - u) / 0.3));
        const flexion = Math.max(LEAST_KNEE, SWING_SHARE * flexionOf(track, k, knee));
        const distance = footToHip(track, k, side, offsets);
        const over = distance - legLength(thigh, shank, flexion);
        const pull = (weight * 0.5 * (over + Math.sqrt(over * over + PULL * PULL))) / distance;
        const o = (2 * k + side) * FOOT_STRIDE;
        for (let i = 0; i < 3; i++) track.feet[o + i] += pull * v[3 + i];
      }
      f = end;
    }
  }
}

/** Frames in which the drop of a motion that was shown goes over into a new one's. */
const TAKE_OVER = 16;

/**
 * How far each frame's hips must come down for both legs to reach, then softened over neighbours. Mutates `track.root` and notes
 * the drop in `track.drop`.
 *
 * @param kept the motion that is shown: its frames so far keep their drop, as what is planned anew would soften back into them.
 */
export function reachWithLegs(track: BodyTrack, skeleton: Skeleton, kept: KeptBalance | null): void {
  const { offsets } = skeleton;
  const thigh = Math.abs(offsets[3 * J.leftLowerLeg + 1]);
  const shank = Math.abs(offsets[3 * J.leftFoot + 1]);
  const n = track.frames;
  const drop = new Float64Array(n);
  for (let f = 0; f < n; f++) {
    let need = 0;
    for (let side = 0; side < 2; side++) {
      const knee = side === 0 ? J.leftLowerLeg : J.rightLowerLeg;
      footToHip(track, f, side, offsets);
      const rise = Math.max(0, -pitchOf(track.feet, (2 * f + side) * FOOT_STRIDE + 3));
      const flexion = Math.max(LEAST_KNEE, STANCE_SHARE * flexionOf(track, f, knee), PUSH_SHARE * rise);
      const longest = legLength(thigh, shank, flexion);
      const across = v[3] * v[3] + v[5] * v[5];
      const over = v[4] - Math.sqrt(Math.max(0.04, longest * longest - across));
      // Softly from a little before the leg is at its longest: nothing may begin at once.
      need = Math.max(need, 0.5 * (over + Math.sqrt(over * over + EASE * EASE)) - EASE * EASE);
    }
    drop[f] = need;
  }
  const lower = softEnvelope(drop, SOFT);
  for (let f = 0; f < n; f++) {
    if (kept && f < kept.until + TAKE_OVER && kept.drop.length > 0) {
      const held = kept.drop[Math.min(f, kept.until, kept.drop.length - 1)];
      const fresh = minimumJerk((f - kept.until) / TAKE_OVER);
      lower[f] = held + fresh * (lower[f] - held);
    }
    track.drop[f] = lower[f];
    track.root[3 * f + 1] -= lower[f];
  }
}
