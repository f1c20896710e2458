/**
 * Motion into steps [TaskLoco §4.1, step segmentation]: "each step starts when either the swing foot loses firm
 * contact with the ground or it enters a sliding motion", and ends when it rests again.
 *
 * Pivots are steps of their own: the foot turns while one end stays down.
 */
import type { Clip } from "../capture/clip.ts";
import { wrapAngle } from "../math/angle.ts";
import { pitchOf } from "../motion/foot-pose.ts";
import { plantedAnkle } from "../motion/sole.ts";
import { forwardKinematics } from "../skeleton/forward-kinematics.ts";
import { J, JOINT_COUNT } from "../skeleton/joints.ts";
import type { ContactTrack, Foot, Footstep, Step } from "./types.ts";

export interface SegmentOptions {
  /** Changes smaller than both make no step: metres at a leg of 0.93 m, radians. */
  least: number;
  leastTurn: number;
  /** A resting foot that turns this much has pivoted, radians. */
  pivot: number;
  /** Shortest time off the ground that is a step, frames. */
  shortest: number;
}

export const SEGMENT_DEFAULTS: SegmentOptions = { least: 0.02, leastTurn: 0.07, pivot: 0.14, shortest: 5 };

/** One foot's rest pose a frame, corrected for its roll: x, z, unwrapped yaw. */
interface RestTrack {
  x: Float64Array;
  z: Float64Array;
  yaw: Float64Array;
  /** Ankle height, for what is airborne. */
  low: Float64Array;
}

/** Steps of a clip in order of their start; category and phase are filled by `categorise` and `assignPhases`. */
export function segmentSteps(
  clip: Clip,
  contacts: ContactTrack,
  options: Partial<SegmentOptions> = {},
): { steps: Step[]; initialStance: [Footstep, Footstep] } {
  const o = { ...SEGMENT_DEFAULTS, ...options };
  const left = restTrack(clip, "left");
  const right = restTrack(clip, "right");
  const l = footSteps("left", left, contacts, clip, o);
  const r = footSteps("right", right, contacts, clip, o);
  const steps = [...l.steps, ...r.steps].sort((a, b) => a.start - b.start || a.end - b.end);
  return { steps, initialStance: [l.first, r.first] };
}

function restTrack(clip: Clip, foot: Foot): RestTrack {
  const n = clip.frames;
  const t: RestTrack = {
    x: new Float64Array(n),
    z: new Float64Array(n),
    yaw: new Float64Array(n),
    low: new Float64Array(n),
  };
  const joint = foot === "left" ? J.leftFoot : J.rightFoot;
  const p = new Float64Array(3 * JOINT_COUNT);
  const w = new Float64Array(4 * JOINT_COUNT);
  const a = new Float64Array(3);
  const shape = clip.skeleton.foot;
  for (let f = 0; f < n; f++) {
    forwardKinematics(p, w, clip.skeleton, clip.root, 3 * f, clip.rotations, 4 * JOINT_COUNT * f);
    const q = 4 * joint;
    const fx = 2 * (w[q] * w[q + 2] + w[q + 3] * w[q + 1]);
    const fz = 1 - 2 * (w[q] * w[q] + w[q + 1] * w[q + 1]);
    const yaw = Math.atan2(fx, fz);
    const pitch = pitchOf(w, q);
    plantedAnkle(a, shape, Math.max(-1.2, Math.min(0.6, pitch)));
    t.x[f] = p[3 * joint] - Math.sin(yaw) * a[0];
    t.z[f] = p[3 * joint + 2] - Math.cos(yaw) * a[0];
    t.yaw[f] = f > 0 ? t.yaw[f - 1] + wrapAngle(yaw - t.yaw[f - 1]) : yaw;
    // How far the sole is over where it would rest.
    t.low[f] = p[3 * joint + 1] - a[1];
  }
  return t;
}

/** Middle value of a track over frames [from, to). */
function median(track: Float64Array, from: number, to: number): number {
  const part = Array.from(track.subarray(from, Math.max(from + 1, to))).sort((x, y) => x - y);
  return part[part.length >> 1];
}

interface Rest {
  from: number;
  to: number;
  x: number;
  z: number;
  yaw: number;
  /** How the foot came here: a pivot, or through the air. */
  pivot: "heel" | "ball" | null;
}

function footSteps(
  foot: Foot,
  t: RestTrack,
  contacts: ContactTrack,
  clip: Clip,
  o: SegmentOptions,
): { steps: Step[]; first: Footstep } {
  const shift = foot === "left" ? 0 : 2;
  const n = clip.frames;
  const scale = clip.skeleton.legLength / 0.93;
  const bits = (f: number) => (contacts[f] >> shift) & 3;
  // Intervals in which the foot bears, gaps shorter than a step closed.
  const plants: [number, number][] = [];
  for (let f = 0; f < n; ) {
    if (bits(f) === 0) {
      f++;
      continue;
    }
    let e = f + 1;
    while (e < n && bits(e) !== 0) e++;
    const last = plants[plants.length - 1];
    if (last && f - last[1] < o.shortest) last[1] = e;
    else plants.push([f, e]);
    f = e;
  }
  const rests: Rest[] = [];
  for (const [a, b] of plants) {
    const [from, to] = firmEnds(t, a, b, n, scale);
    rests.push(...restsOf(t, from, to, bits, o));
  }
  if (rests.length === 0) {
    const place: Footstep = { foot, x: t.x[0], y: 0, z: t.z[0], yaw: wrapAngle(t.yaw[0]) };
    return { steps: [], first: place };
  }
  const at = (r: Rest): Footstep => ({ foot, x: r.x, y: 0, z: r.z, yaw: wrapAngle(r.yaw) });
  const steps: Step[] = [];
  let before = rests[0];
  for (let k = 1; k < rests.length; k++) {
    const r = rests[k];
    const moved = Math.hypot(r.x - before.x, r.z - before.z);
    const turned = Math.abs(r.yaw - before.yaw);
    if (!r.pivot && moved < o.least * scale && turned < o.leastTurn) {
      before = { ...r, from: before.from };
      continue;
    }
    const start = before.to;
    const end = r.from;
    let airStart = start;
    let airEnd = end;
    if (!r.pivot) {
      const air = 0.01 * scale;
      while (airStart < end && t.low[airStart] < air) airStart++;
      while (airEnd > airStart && t.low[airEnd - 1] < air) airEnd--;
      if (airEnd - airStart < 3) {
        airStart = start;
        airEnd = end;
      }
    }
    steps.push({
      foot,
      start,
      end,
      airStart,
      airEnd,
      category: r.pivot === "heel" ? "HeelPivot" : r.pivot === "ball" ? "ToePivot" : "Walk",
      phase: "locomotion",
      from: at(before),
      to: at(r),
    });
    before = r;
  }
  return { steps, first: at(rests[0]) };
}

/** Frames at each end of a plant that may turn out not to be firm; metres and radians that a resting foot stays within. */
const LOOSE = 8;
const STILL = 0.004;
const STILL_TURN = 0.03;

/**
 * The firm part of a plant: contacts found by height and speed hold on to a foot that creeps off or comes in slowly. The
 * rest pose, which rolling does not move, tells: a loose end is where it leaves what it is next to the middle, by more
 * than it trembles there.
 */
function firmEnds(t: RestTrack, from: number, to: number, n: number, scale: number): [number, number] {
  const length = to - from;
  if (length < 8) return [from, to];
  const most = Math.min(LOOSE, Math.floor(length / 3));
  const away = (f: number, at: number): number =>
    Math.max(
      Math.hypot(t.x[f] - t.x[at], t.z[f] - t.z[at], t.low[f] - t.low[at]) / (STILL * scale),
      Math.abs(t.yaw[f] - t.yaw[at]) / STILL_TURN,
    );
  const end = (edge: number, inwards: 1 | -1): number => {
    const at = edge + inwards * most;
    // How much it trembles (or rolls past the model) over the frames farther in.
    let tremble = 0;
    const calm = Math.min(most, Math.max(2, Math.floor(length / 2) - most));
    for (let k = 1; k <= calm; k++) tremble = Math.max(tremble, away(at + inwards * k, at) / k);
    const least = Math.max(1, 3 * tremble);
    let f = at;
    while (f !== edge && away(f - inwards, at) <= least) f -= inwards;
    return f;
  };
  // What begins or ends with the clip is not loose.
  const a = from === 0 ? from : end(from, 1);
  const b = to === n ? to : end(to - 1, -1) + 1;
  return b - a >= 4 ? [a, b] : [from, to];
}

/** A plant as one rest, or several with pivots between. */
function restsOf(
  t: RestTrack,
  from: number,
  to: number,
  bits: (f: number) => number,
  o: SegmentOptions,
): Rest[] {
  const plain = (a: number, b: number, pivot: Rest["pivot"]): Rest => ({
    from: a,
    to: b,
    x: median(t.x, a, b),
    z: median(t.z, a, b),
    yaw: median(t.yaw, a, b),
    pivot,
  });
  // Frames in which the foot turns.
  const rate = 0.0035;
  const out: Rest[] = [];
  let begin = from;
  let came: Rest["pivot"] = null;
  let f = from + 1;
  while (f < to - 1) {
    if (Math.abs(t.yaw[f + 1] - t.yaw[f - 1]) / 2 < rate) {
      f++;
      continue;
    }
    let e = f;
    while (e < to - 1 && Math.abs(t.yaw[Math.min(to - 1, e + 1)] - t.yaw[e - 1]) / 2 >= rate) e++;
    const turn = t.yaw[Math.min(to - 1, e)] - t.yaw[f - 1];
    if (Math.abs(turn) >= o.pivot && f - begin >= 2) {
      // Ends of a minimum-jerk turn lie before and after what the threshold sees.
      const total = turn;
      const base = t.yaw[f - 1];
      let a = f;
      while (Math.abs(t.yaw[a] - base) < 0.08 * Math.abs(total) && a < e) a++;
      let b = e;
      while (Math.abs(t.yaw[b] - base - total) < 0.08 * Math.abs(total) && b > f) b--;
      // A minimum-jerk turn is 8 % done at 0.235 of its time, 92 % at 0.765.
      const duration = (b - a) / 0.53;
      const start = Math.max(begin + 1, Math.round(a - 0.235 * duration));
      const end = Math.min(to - 1, Math.round(b + 0.235 * duration));
      let heel = 0;
      let toe = 0;
      for (let k = start; k < end; k++) {
        heel += bits(k) & 1;
        toe += (bits(k) >> 1) & 1;
      }
      out.push(plain(begin, start, came));
      came = heel >= toe ? "heel" : "ball";
      begin = end;
      f = Math.max(e, end);
    } else f = e + 1;
  }
  out.push(plain(begin, to, came));
  return out;
}
