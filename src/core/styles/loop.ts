/**
 * A loop sequence: one style's sample cut so that it repeats without a seam [Express §5.2].
 */
import type { Clip } from "../capture/clip.ts";
import { smoothstep } from "../math/interpolate.ts";
import {
  quatFromRotationVector,
  quatInverseMultiply,
  quatMultiply,
  quatToRotationVector,
} from "../math/quaternion.ts";
import { type ContactPhases, createPhaseMap, KEY_PHASES, type PhaseMap } from "./gait-phase.ts";
import { detectPlants } from "./plants.ts";
import {
  EFFECTOR_COUNT,
  EFFECTORS,
  LEG_STRIDE,
  LEGS,
  meanRow,
  mixRows,
  QUAT_COUNT,
  QUATS,
  type ReferenceLine,
  ROOT,
  ROW,
  rowOf,
  scaleRow,
} from "./rows.ts";
import { bestEnd, type CutChoice, chooseCut, stridesOf } from "./strides.ts";

export interface LoopSequence {
  /** The style's name. */
  name: string;
  frames: number;
  /** Two steps each. */
  strides: number;
  /** Metres a frame along the reference line [Express §6.3: l_i / N_i]. */
  speed: number;
  /** frames x ROW, relative to the reference line; frame 0 is the middle of a left plant. */
  rows: Float64Array;
  phases: PhaseMap;
  /** One a stride. */
  contacts: ContactPhases[];
  /** The style's mean pose, for standing. */
  mean: Float64Array;
  /** Mean travel of each end effector a frame about the hips, metres [Express §6.2: T_i]. */
  travel: Float64Array;
  /** Leg length of the body it is for, metres. */
  legLength: number;
  /** Frames blended at the joint [Express §5.2: N_b]. */
  blended: number;
  /** Where it was cut from: source frames, first and one past the last. */
  source: { from: number; to: number };
  choice: CutChoice;
}

/** A sample that no loop can be cut from. */
export class StyleError extends Error {}

/** Pitches under this are a flat foot's noise in captures, radians. */
const FLAT = (4 * Math.PI) / 180;

/**
 * Cuts a loop from one straight, unlabelled sample.
 *
 * @param steps wanted number of steps (even), for comparison; null for the fewest that keep the style.
 * @throws StyleError when fewer than three foot-plants in a row (left, right, left) are found, or the sample stands still.
 */
export function cutLoop(clip: Clip, name: string, steps: number | null = null): LoopSequence {
  const plants = detectPlants(clip);
  const strides = stridesOf(clip, plants);
  if (strides.length === 0)
    throw new StyleError(
      `${name}: a left, a right and a left foot-plant in a row are needed, found ${plants[0].length} left and ${plants[1].length} right.`,
    );
  const choice = chooseCut(clip, strides, steps === null ? null : Math.max(1, Math.round(steps / 2)));
  const { first, strides: count } = choice.chosen;
  const own = strides.slice(first, first + count);
  const from = own[0].from;
  const to = bestEnd(clip, from, own[count - 1]);
  const frames = to - from;
  const end = own[count - 1].next;
  let blended = Math.min(own[0].left.to - 1 - from, end.to - 1 - to, frames >> 1, clip.frames - 1 - to);
  blended = Math.max(2, blended - (blended % 2));
  if (to + blended > clip.frames) blended = Math.max(0, clip.frames - to - ((clip.frames - to) % 2));
  const line = referenceLine(clip, from, to, blended);
  if (!(line.speed * clip.rate > 0.05))
    throw new StyleError(
      `${name}: the sample moves ${(line.speed * clip.rate).toFixed(2)} m/s, 0.05 are needed.`,
    );
  // The loop, and what follows it in the sample as far as it is blended into its beginning.
  const sample = new Float64Array(ROW * (frames + blended));
  for (let f = 0; f < frames + blended; f++) rowOf(sample, ROW * f, clip, from + f, line);
  closeLoop(sample, frames, clip, from, line);
  const rows = sample.slice(0, ROW * frames);
  preBlend(rows, sample.subarray(ROW * frames), blended);
  const boundaries = own.map((s): [number, number, number, number] => [
    s.left.to - from,
    s.right.from - from,
    s.right.to - from,
    s.next.from - from,
  ]);
  // The first plant's end was blended with the last one's: both count.
  const wrapped = Math.round((own[0].left.to - from + (end.to - to)) / 2);
  boundaries[0][0] = Math.max(2, wrapped);
  const contacts = boundaries.map(contactPhases);
  const starts = [...own.map((s) => s.from - from), frames];
  const phases = createPhaseMap(starts, boundaries);
  flattenPlants(rows, frames, boundaries, starts);
  return {
    name,
    frames,
    strides: count,
    speed: line.speed,
    rows,
    phases,
    contacts,
    mean: meanRow(rows, frames),
    travel: meanTravel(rows, frames),
    legLength: clip.skeleton.legLength,
    blended,
    source: { from, to },
    choice,
  };
}

/**
 * The line of evenly moving least squares: its way a frame is what the loop repeats with, so that the joint closes, its
 * place the mean of the sample about it [Express §6.3].
 */
function referenceLine(clip: Clip, from: number, to: number, blended: number): ReferenceLine {
  const r = clip.root;
  const frames = to - from;
  let dx = 0;
  let dz = 0;
  const n = Math.max(1, Math.min(blended, clip.frames - to));
  for (let i = 0; i < n; i++) {
    dx += (r[3 * (to + i)] - r[3 * (from + i)]) / n;
    dz += (r[3 * (to + i) + 2] - r[3 * (from + i) + 2]) / n;
  }
  const line: ReferenceLine = {
    at: from,
    x: 0,
    z: 0,
    yaw: Math.atan2(dx, dz),
    speed: Math.hypot(dx, dz) / frames,
  };
  for (let f = 0; f < frames; f++) {
    line.x += (r[3 * (from + f)] - (dx * f) / frames) / frames;
    line.z += (r[3 * (from + f) + 2] - (dz * f) / frames) / frames;
  }
  return line;
}

/** Windows at least this long bridge the joint alone, frames. */
const ENOUGH = 24;
/** Frames over which the speed on either side of the joint is taken. */
const SPEED_OVER = 3;

/**
 * What the joint lacks in place and in speed, spread over the whole loop: a run's plants leave pre-blending only a few frames,
 * too few to bridge two strides that differ. Not in the paper; long plants leave nothing to it.
 *
 * @param rows the loop's frames and what follows them, changed in place.
 */
function closeLoop(rows: Float64Array, frames: number, clip: Clip, from: number, line: ReferenceLine): void {
  const follow = rows.length / ROW - frames;
  const share = Math.max(0, 1 - (follow / ENOUGH) ** 2);
  const over = Math.min(SPEED_OVER, clip.frames - 1 - from - frames);
  if (share === 0 || over < 1) return;
  const row = (frame: number): Float64Array => {
    const r = new Float64Array(ROW);
    rowOf(r, 0, clip, frame, line);
    return r;
  };
  const lack = difference(row(from), row(from + frames));
  const start = difference(row(from + over), row(from));
  const end = difference(row(from + frames + over), row(from + frames));
  const q = new Float64Array(8);
  const change = new Float64Array(ROW);
  for (let f = 0; f < frames + follow; f++) {
    // Half before the joint, half after it: the middle of the loop stays as captured.
    const u = f / frames - 0.5;
    const bend = (0.5 * frames * (u * u - 0.25)) / over;
    for (let k = 0; k < ROW; k++) change[k] = share * (u * lack[k] + bend * (start[k] - end[k]));
    const o = ROW * f;
    for (let k = 0; k < ROW; k++) if (k < QUATS || k >= LEGS) rows[o + k] += change[k];
    for (let j = 0; j < QUAT_COUNT; j++) {
      const i = QUATS + 4 * j;
      quatFromRotationVector(q, 0, change[i], change[i + 1], change[i + 2]);
      quatMultiply(rows, o + i, rows, o + i, q, 0);
    }
  }
}

/** A row less another: rotations as rotation vectors in their first three places. */
function difference(a: Float64Array, b: Float64Array): Float64Array {
  const out = new Float64Array(ROW);
  const q = new Float64Array(4);
  for (let k = 0; k < ROW; k++) if (k < QUATS || k >= LEGS) out[k] = a[k] - b[k];
  for (let j = 0; j < QUAT_COUNT; j++) {
    const i = QUATS + 4 * j;
    quatInverseMultiply(q, 0, b, i, a, i);
    quatToRotationVector(out, i, q, 0);
  }
  return out;
}

/**
 * Pre-blending [Express §5.2, eqs. 1 and 2]: the frames after F_e pass into those after F_s. The hips' height is not mixed
 * but taken from the frames after F_e in the first half and from those after F_s in the second; where the paper's height
 * would jump in the middle, that difference is spread over the window.
 *
 * @param after the frames after F_e, `blended` of them.
 */
function preBlend(rows: Float64Array, after: Float64Array, blended: number): void {
  const height = ROOT + 2;
  const half = blended / 2;
  const jump = blended > 0 ? rows[ROW * half + height] - after[ROW * half + height] : 0;
  for (let i = 0; i < blended; i++) {
    const w = 1 - (Math.cos(((i + 0.5) * Math.PI) / blended) / 2 + 0.5);
    const own = rows[ROW * i + height];
    const y = i < half ? after[ROW * i + height] + jump * w : own - jump * (1 - w);
    mixRows(rows, ROW * i, after, ROW * i, rows, ROW * i, w);
    rows[ROW * i + height] = y;
  }
}

/** Which key each plant boundary is: whether the foot lands before the other lifts (walk) or after (run). */
function contactPhases(b: readonly [number, number, number, number]): ContactPhases {
  const [k1, k2, k3, k4] = KEY_PHASES;
  const walksFirst = b[1] <= b[0];
  const walksSecond = b[3] <= b[2];
  return {
    rightLand: walksFirst ? k1 : k2,
    leftLift: walksFirst ? k2 : k1,
    leftLand: walksSecond ? k3 : k4,
    rightLift: walksSecond ? k4 : k3,
  };
}

/** While a foot rests, small pitches are noise: they pass softly to none, so that it lies flat. */
function flattenPlants(
  rows: Float64Array,
  frames: number,
  boundaries: readonly (readonly number[])[],
  starts: readonly number[],
): void {
  const down = [new Uint8Array(frames), new Uint8Array(frames)];
  boundaries.forEach((b, i) => {
    for (let f = starts[i]; f < b[0]; f++) down[0][f % frames] = 1;
    for (let f = b[1]; f < b[2]; f++) down[1][f % frames] = 1;
    for (let f = b[3]; f < starts[i + 1]; f++) down[0][f % frames] = 1;
  });
  for (let side = 0; side < 2; side++) {
    for (let f = 0; f < frames; f++) {
      if (!down[side][f]) continue;
      const i = ROW * f + LEGS + LEG_STRIDE * side + 4;
      rows[i] *= smoothstep(Math.abs(rows[i]) / FLAT);
    }
  }
}

function meanTravel(rows: Float64Array, frames: number): Float64Array {
  const out = new Float64Array(EFFECTOR_COUNT);
  for (let f = 0; f < frames; f++) {
    const a = ROW * f + EFFECTORS;
    const b = ROW * ((f + 1) % frames) + EFFECTORS;
    for (let i = 0; i < EFFECTOR_COUNT; i++)
      out[i] +=
        Math.hypot(
          rows[b + 3 * i] - rows[a + 3 * i],
          rows[b + 3 * i + 1] - rows[a + 3 * i + 1],
          rows[b + 3 * i + 2] - rows[a + 3 * i + 2],
        ) / frames;
  }
  return out;
}

/** The same loop for a body with legs of another length: every length scales, times stay. */
export function fitLoop(loop: LoopSequence, legLength: number): LoopSequence {
  const factor = legLength / loop.legLength;
  if (Math.abs(factor - 1) < 1e-12) return loop;
  const rows = loop.rows.slice();
  for (let f = 0; f < loop.frames; f++) scaleRow(rows, ROW * f, factor);
  const mean = loop.mean.slice();
  scaleRow(mean, 0, factor);
  return {
    ...loop,
    rows,
    mean,
    speed: loop.speed * factor,
    travel: loop.travel.map((t) => t * factor),
    legLength,
  };
}

/** Row at a fractional frame, over passes. */
export function loopRow(out: Float64Array, o: number, loop: LoopSequence, frame: number): void {
  const f = frame - Math.floor(frame / loop.frames) * loop.frames;
  const i = Math.min(loop.frames - 1, Math.floor(f));
  mixRows(out, o, loop.rows, ROW * i, loop.rows, ROW * ((i + 1) % loop.frames), f - i);
}
