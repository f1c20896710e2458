/**
 * Strides of a sample and how like they are: which cuts are possible and how many plants keep the style.
 *
 * A stride runs from the middle of a left plant to the middle of the next one [Express §5.2]. The paper chooses the number
 * of steps by eye (Table 1); our criterion is stated at `chooseCut`.
 */
import type { Clip } from "../capture/clip.ts";
import { forwardKinematics } from "../skeleton/forward-kinematics.ts";
import { JOINT_COUNT } from "../skeleton/joints.ts";
import { createPhaseMap, frameOfPhase } from "./gait-phase.ts";
import type { Plant } from "./plants.ts";
import { EFFECTOR_COUNT, EFFECTOR_JOINTS } from "./rows.ts";

/** A stride: its frames, the right plant inside, and the left plants it begins and ends in. */
export interface Stride {
  from: number;
  to: number;
  left: Plant;
  right: Plant;
  next: Plant;
  /** Ground covered, metres. */
  length: number;
}

/** Moments of a stride that are compared. */
const PHASES = 24;
/** How unlike the sample a repeated loop may always be: RMS over end effectors and time, legs of 0.93 m, metres. */
const KEEPS = 0.042;
/** Beyond it, how much more than the best number of strides loses. */
const NEAR_BEST = 1.3;
/** A sample of which every loop loses more than this never repeats itself, metres. */
const NOTHING_REPEATS = 0.13;
/** How much the strides' durations and lengths may differ, shares. */
const KEEPS_TIMING = 0.25;
/** Strides slower than this share of the usual speed are starts and stops. */
const STEADY = 0.85;

/** Strides of a sample, in order; each follows the one before where no plant is missing between. */
export function stridesOf(clip: Clip, plants: readonly [Plant[], Plant[]]): Stride[] {
  const [lefts, rights] = plants;
  const out: Stride[] = [];
  const inside = (p: Plant) => p.from > 0 && p.to < clip.frames;
  // A plant cut off by the clip's ends is used where nothing else is left; its middle is where a whole one's would be.
  const whole = lefts.filter(inside);
  const usable = (whole.length >= 2 ? whole : lefts).filter((p) => p.to - p.from >= 3);
  const usual = median([...lefts, ...rights].filter(inside).map((p) => p.to - p.from));
  const middle = (p: Plant): number => {
    if (inside(p) || usual === 0) return (p.from + p.to - 1) / 2;
    return p.from > 0 ? p.from + (usual - 1) / 2 : p.to - (usual + 1) / 2;
  };
  for (let i = 0; i + 1 < usable.length; i++) {
    const a = usable[i];
    const b = usable[i + 1];
    // Both at one moment of the plant, early enough for some frames to follow.
    const early = Math.min(0, clip.frames - 3 - middle(b));
    const from = Math.max(0, Math.round(middle(a) + early));
    const to = Math.round(middle(b) + early);
    const right = rights.filter((r) => r.from > from && r.to <= to);
    if (right.length !== 1) continue;
    const seconds = (to - from) / clip.rate;
    if (seconds > 4.5) continue;
    out.push({
      from,
      to,
      left: a,
      right: right[0],
      next: b,
      length: Math.hypot(
        clip.root[3 * to] - clip.root[3 * from],
        clip.root[3 * to + 2] - clip.root[3 * from + 2],
      ),
    });
  }
  const pace = median(out.map((s) => s.length / (s.to - s.from)));
  return out.filter((s) => s.length / (s.to - s.from) >= STEADY * pace);
}

function median(values: number[]): number {
  const sorted = [...values].sort((a, b) => a - b);
  return sorted[sorted.length >> 1] ?? 0;
}

/** One cut of a sample and what it loses. */
export interface CutCandidate {
  /** Index of the first stride, and how many strides the loop has. */
  first: number;
  strides: number;
  /** RMS distance of the end effectors between the sample's other strides and the loop repeated, metres at a leg of 0.93 m; 0 when the loop is the whole sample. */
  loss: number;
  /** Largest difference of duration and of length likewise, as shares. */
  timing: number;
  /** RMS distance of the end effectors across the joint, metres: what pre-blending has to bridge. */
  seam: number;
}

/** What was weighed in choosing a cut: every candidate, the limit, the chosen one. */
export interface CutChoice {
  candidates: CutCandidate[];
  limit: number;
  chosen: CutCandidate;
}

/**
 * Chooses where to cut a sample, and how many strides the loop has.
 *
 * Criterion of "the fewest plants that keep the style": the loop, repeated, is laid beside the sample from which it was
 * cut. Every stride outside it is compared with the stride of the loop that would be played there, at 24 moments aligned by
 * the plants' boundaries, in the places of head, hands and feet about the hips. The loop keeps the style when the RMS
 * distance is at most 4.2 cm (legs of 0.93 m) or within 30 % of the least that any number of strides reaches (more
 * strides would not tell more), and durations and lengths differ by 25 % at most. The fewest strides that do are taken,
 * among those the cut with the smallest sum of loss and seam. A sample that never repeats itself (13 cm and more) becomes
 * one loop as a whole.
 *
 * @param strides at least one; only runs of strides that follow each other can be a loop.
 * @param fixed wanted number of strides, for comparison with plain two-step loops; null for the criterion.
 */
export function chooseCut(clip: Clip, strides: readonly Stride[], fixed: number | null): CutChoice {
  const poses = strides.map((s) => sampleStride(clip, s));
  const scale = clip.skeleton.legLength / 0.93;
  const candidates: CutCandidate[] = [];
  for (let m = 1; m <= strides.length; m++) {
    for (let i = 0; i + m <= strides.length; i++) {
      let connected = true;
      for (let k = i + 1; k < i + m; k++) if (strides[k].from !== strides[k - 1].to) connected = false;
      if (!connected) continue;
      let sum = 0;
      let count = 0;
      let timing = 0;
      for (let j = 0; j < strides.length; j++) {
        if (j >= i && j < i + m) continue;
        const like = i + ((((j - i) % m) + m) % m);
        sum += squareDistance(poses[j], poses[like]);
        count++;
        const a = strides[j];
        const b = strides[like];
        timing = Math.max(
          timing,
          Math.abs(Math.log((a.to - a.from) / (b.to - b.from))),
          Math.abs(Math.log(a.length / b.length)),
        );
      }
      candidates.push({
        first: i,
        strides: m,
        loss: count > 0 ? Math.sqrt(sum / count) / scale : 0,
        timing,
        seam: seamOf(clip, strides[i], strides[i + m - 1]) / scale,
      });
    }
  }
  const heldOut = candidates.filter((c) => c.strides < strides.length && c.loss > 0);
  const least = Math.min(NOTHING_REPEATS, ...heldOut.map((c) => c.loss));
  const limit =
    least >= NOTHING_REPEATS ? KEEPS : Math.max(KEEPS, Math.min(NOTHING_REPEATS, NEAR_BEST * least));
  const keeps = (c: CutCandidate) => c.loss <= limit && c.timing <= KEEPS_TIMING;
  const allowed = candidates.filter((c) => (fixed === null ? keeps(c) : c.strides === fixed));
  const pool = allowed.length > 0 ? allowed : candidates;
  const fewest =
    allowed.length > 0
      ? Math.min(...pool.map((c) => c.strides))
      : Math.max(...pool.map((c) => c.strides).filter((m) => fixed === null || m <= fixed));
  const chosen = pool
    .filter((c) => c.strides === fewest)
    .reduce((a, b) => (b.loss + b.seam < a.loss + a.seam ? b : a));
  return { candidates, limit, chosen };
}

const place = new Float64Array(3 * JOINT_COUNT);
const world = new Float64Array(4 * JOINT_COUNT);

/** End effectors about the hips, in the stride's own heading, at one frame. */
function effectorsAt(out: Float64Array, o: number, clip: Clip, frame: number, yaw: number): void {
  forwardKinematics(
    place,
    world,
    clip.skeleton,
    clip.root,
    3 * frame,
    clip.rotations,
    4 * JOINT_COUNT * frame,
  );
  const s = Math.sin(yaw);
  const c = Math.cos(yaw);
  for (let i = 0; i < EFFECTOR_COUNT; i++) {
    const j = EFFECTOR_JOINTS[i];
    const dx = place[3 * j] - place[0];
    const dz = place[3 * j + 2] - place[2];
    out[o + 3 * i] = c * dx - s * dz;
    out[o + 3 * i + 1] = place[3 * j + 1] - place[1];
    out[o + 3 * i + 2] = s * dx + c * dz;
  }
}

const headingOf = (clip: Clip, from: number, to: number): number =>
  Math.atan2(clip.root[3 * to] - clip.root[3 * from], clip.root[3 * to + 2] - clip.root[3 * from + 2]);

function sampleStride(clip: Clip, stride: Stride): Float64Array {
  const row = 3 * EFFECTOR_COUNT;
  const out = new Float64Array(PHASES * row);
  const yaw = headingOf(clip, stride.from, stride.to);
  // Aligned by the key-times: the plants' boundaries share out the moments.
  const map = createPhaseMap(
    [0, stride.to - stride.from],
    [
      [
        stride.left.to - stride.from,
        stride.right.from - stride.from,
        stride.right.to - stride.from,
        stride.next.from - stride.from,
      ],
    ],
  );
  for (let k = 0; k < PHASES; k++)
    effectorsAt(out, k * row, clip, Math.round(stride.from + frameOfPhase(map, k / PHASES)), yaw);
  return out;
}

function squareDistance(a: Float64Array, b: Float64Array): number {
  let s = 0;
  for (let k = 0; k < a.length; k++) s += (a[k] - b[k]) ** 2;
  return s / (a.length / 3);
}

function seamOf(clip: Clip, first: Stride, last: Stride): number {
  const row = 3 * EFFECTOR_COUNT;
  const a = new Float64Array(row);
  const b = new Float64Array(row);
  const yaw = headingOf(clip, first.from, last.to);
  effectorsAt(a, 0, clip, first.from, yaw);
  effectorsAt(b, 0, clip, last.to, yaw);
  return Math.sqrt(squareDistance(a, b));
}

/**
 * The frame of a loop's last plant whose pose is nearest to that of the loop's first frame: "any frame within a foot-plant"
 * may end a loop [Express §5.2]; the middle one is where the search begins, a quarter of the plant either way.
 */
export function bestEnd(clip: Clip, from: number, last: Stride): number {
  const row = 3 * EFFECTOR_COUNT;
  const poses = new Float64Array(4 * row);
  const yaw = headingOf(clip, from, last.to);
  const reach = Math.max(1, Math.round((last.next.to - last.next.from) / 4));
  const pair = (o: number, f: number) => {
    effectorsAt(poses, o, clip, f, yaw);
    effectorsAt(poses, o + row, clip, Math.min(clip.frames - 1, f + 1), yaw);
  };
  pair(0, from);
  let best = last.to;
  let least = Number.POSITIVE_INFINITY;
  for (let f = last.to - reach; f <= last.to + reach; f++) {
    if (f >= clip.frames - 2 || f <= last.next.from || f >= last.next.to - 1) continue;
    pair(2 * row, f);
    let s = 0;
    for (let k = 0; k < row; k++) {
      const gap = poses[2 * row + k] - poses[k];
      const pace = poses[3 * row + k] - poses[2 * row + k] - (poses[row + k] - poses[k]);
      s += gap * gap + 9 * pace * pace;
    }
    if (s < least) {
      least = s;
      best = f;
    }
  }
  return best;
}
