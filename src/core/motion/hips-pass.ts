/**
 * Hips between the passes: led onto the seat, and lowered softly where a leg would not reach its foot.
 */
import { softEnvelope } from "../math/interpolate.ts";
import { quatRotate } from "../math/quaternion.ts";
import { J, JOINT_COUNT } from "../skeleton/joints.ts";
import type { Skeleton } from "../skeleton/skeleton.ts";
import type { BodyTrack } from "./body-pass.ts";
import { FOOT_STRIDE } from "./foot-pose.ts";
import type { SegmentSetup } from "./segment-setup.ts";
import { mapByTask, shows, type TaskWindow, windowWeight } from "./task-windows.ts";

const Q = JOINT_COUNT * 4;
/** Least knee flexion kept in a supporting leg, radians: a fully straight knee pops. */
const LEAST_KNEE = (3 * Math.PI) / 180;
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

/** How far each frame's hips must come down for both legs to reach, then softened over neighbours. Mutates `track.root`. */
export function reachWithLegs(track: BodyTrack, skeleton: Skeleton): void {
  const { offsets } = skeleton;
  const thigh = Math.abs(offsets[3 * J.leftLowerLeg + 1]);
  const shank = Math.abs(offsets[3 * J.leftFoot + 1]);
  const longest = Math.sqrt(thigh * thigh + shank * shank + 2 * thigh * shank * Math.cos(LEAST_KNEE));
  const n = track.frames;
  const drop = new Float64Array(n);
  for (let f = 0; f < n; f++) {
    let need = 0;
    for (let side = 0; side < 2; side++) {
      const hip = side === 0 ? J.leftUpperLeg : J.rightUpperLeg;
      quatRotate(v, 0, track.rotations, Q * f, offsets[3 * hip], offsets[3 * hip + 1], offsets[3 * hip + 2]);
      const o = (2 * f + side) * FOOT_STRIDE;
      const dx = track.root[3 * f] + v[0] - track.feet[o];
      const dy = track.root[3 * f + 1] + v[1] - track.feet[o + 1];
      const dz = track.root[3 * f + 2] + v[2] - track.feet[o + 2];
      const across = dx * dx + dz * dz;
      const height = Math.sqrt(Math.max(0.04, longest * longest - across));
      need = Math.max(need, dy - height);
    }
    drop[f] = need;
  }
  const lower = softEnvelope(drop, SOFT);
  for (let f = 0; f < n; f++) track.root[3 * f + 1] -= lower[f];
}
