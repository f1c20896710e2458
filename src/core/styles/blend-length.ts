/** How long a change of style takes [Express §6.2], so that no end effector has to hurry. */
import { frameOfPhase } from "./gait-phase.ts";
import type { LoopSequence } from "./loop.ts";
import { loopRow } from "./loop.ts";
import { EFFECTOR_COUNT, EFFECTORS, ROW } from "./rows.ts";

/** The blend length of earlier work, kept for comparison, seconds [Express §8]. */
export const FIXED_BLEND = 0.33;
/** Shortest blend, seconds. */
const SHORTEST = 0.15;
/**
 * How fast a person gains or loses speed without haste, m/s2. Not in the paper: hands that are far apart and travel at very different
 * speeds, as a jogger's and a balancer's, give a blend in which the whole body would have to stop within half a second.
 */
const UNHURRIED = 1.25;
const RATE = 60;

export const EFFECTOR_NAMES = ["head", "leftHand", "rightHand", "leftFoot", "rightFoot"] as const;

export interface BlendLength {
  /** Frames at 60 Hz. */
  frames: number;
  /** End effector with the largest gap, index in EFFECTOR_NAMES, and that gap in metres. */
  effector: number;
  gap: number;
  /** Difference of its mean travel in the two styles, metres a frame. */
  pace: number;
}

const rowA = new Float64Array(ROW);
const rowB = new Float64Array(ROW);

/**
 * Blend length from frame `a` of one loop to frame `b` of another: the largest gap of an end effector over the difference
 * of its mean travel a frame, hips' place and heading removed; at least 0.15 s and what the body needs from one speed to the other,
 * at most one pass of the longer loop.
 */
export function blendLength(from: LoopSequence, a: number, to: LoopSequence, b: number): BlendLength {
  loopRow(rowA, 0, from, a);
  loopRow(rowB, 0, to, b);
  let effector = 0;
  let gap = -1;
  for (let i = 0; i < EFFECTOR_COUNT; i++) {
    const e = EFFECTORS + 3 * i;
    const d = Math.hypot(rowA[e] - rowB[e], rowA[e + 1] - rowB[e + 1], rowA[e + 2] - rowB[e + 2]);
    if (d > gap) {
      gap = d;
      effector = i;
    }
  }
  const pace = Math.abs(from.travel[effector] - to.travel[effector]);
  const longest = Math.max(from.frames, to.frames);
  const least = RATE * Math.max(SHORTEST, (RATE * Math.abs(from.speed - to.speed)) / UNHURRIED);
  const frames = Math.min(longest, Math.max(least, pace > 1e-9 ? gap / pace : longest));
  return { frames, effector, gap, pace };
}

/**
 * The blend from a phase of one loop to the other: joined at the stride of the other, at the same place within the stride,
 * whose pose is nearest.
 *
 * @param phase strides passed in `from`, fractional. @returns the stride of `to`, its frame there, and the length.
 */
export function blendAt(
  from: LoopSequence,
  phase: number,
  to: LoopSequence,
): { stride: number; frame: number; length: BlendLength } {
  const a = frameOfPhase(from.phases, phase);
  const u = phase - Math.floor(phase);
  let best = { stride: 0, frame: 0, length: blendLength(from, a, to, frameOfPhase(to.phases, u)) };
  for (let stride = 0; stride < to.strides; stride++) {
    const frame = frameOfPhase(to.phases, stride + u);
    const length = blendLength(from, a, to, frame);
    if (stride === 0 || length.gap < best.length.gap) best = { stride, frame, length };
  }
  return best;
}

/** Starts a stride that `blendLengths` looks at. */
export const BLEND_STARTS = 24;

/** Lengths known already: loops are kept over the edits of a path. */
const known = new WeakMap<LoopSequence, WeakMap<LoopSequence, Float32Array>>();

/** Blend lengths from everywhere in one pass of `from`, BLEND_STARTS a stride, frames at 60 Hz: by where a change begins. */
export function blendLengths(from: LoopSequence, to: LoopSequence): Float32Array {
  const others = known.get(from) ?? new WeakMap<LoopSequence, Float32Array>();
  known.set(from, others);
  const lengths =
    others.get(to) ??
    Float32Array.from(
      { length: BLEND_STARTS * from.strides },
      (_, k) => blendAt(from, k / BLEND_STARTS, to).length.frames,
    );
  others.set(to, lengths);
  return lengths;
}
