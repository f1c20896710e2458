/**
 * The oracle: the k nearest labelled examples vote on each contact bit of a frame [Oracle §3-4].
 *
 * It is trained by remembering. Every example is also remembered mirrored; the share of plants among the k nearest, with
 * hysteresis, is the label; the distance of the nearest says how well the oracle knows what it sees.
 */
import type { ContactTrack } from "../steps/types.ts";
import type { Examples } from "./examples.ts";
import { examplesPerFrame, type FeatureOptions, featureSize, featuresOf } from "./features.ts";
import { type MotionTrack, mirrorTrack } from "./motion-track.ts";
import { createNearestIndex, createNearestSearch, findNearest, type NearestIndex } from "./nearest.ts";
import { dropShort } from "./runs.ts";

/** A motion with its labels; frames with a mask of 0 are not learned from. */
export interface LabelledTrack {
  track: MotionTrack;
  labels: ContactTrack;
  mask?: Uint8Array;
}

export interface OracleOptions extends FeatureOptions {
  /** Neighbours that vote. */
  k: number;
  /** Share of votes at which a plant begins, and under which it ends. */
  on: number;
  off: number;
  /** Shortest plant and shortest gap, frames at 60 Hz; 0 leaves them. */
  shortest: number;
}

/** As published: 21 frames, ten neighbours, hysteresis of 0.6 and 0.4 [Oracle §4]. */
export const PAPER_ORACLE: OracleOptions = { set: "paper", half: 10, k: 10, on: 0.6, off: 0.4, shortest: 0 };
/** What the project uses. */
export const OWN_ORACLE: OracleOptions = { set: "own", half: 10, k: 10, on: 0.6, off: 0.4, shortest: 6 };

export interface Oracle {
  options: OracleOptions;
  sources: LabelledTrack[];
  /** Examples that it began with, before the sources. */
  base: Examples | null;
  index: NearestIndex;
  /** Labels of each example: four bits of a frame, or the two of a foot. */
  labels: Uint8Array;
}

/**
 * An oracle of labelled motions.
 *
 * @param base examples to begin with: another oracle's, made with the same features.
 * @throws Error when there is nothing to learn from, labels are another clip's, or the base has other features.
 */
export function trainOracle(
  sources: readonly LabelledTrack[],
  options: OracleOptions = OWN_ORACLE,
  base: Examples | null = null,
): Oracle {
  const size = featureSize(options);
  if (base && base.size !== size) throw new Error("The starting examples have other features.");
  const own = examplesOf(sources, options);
  const first = base?.count ?? 0;
  const rows = first + own.count;
  if (rows === 0) throw new Error("The oracle needs at least one labelled frame.");
  const data = new Float32Array(rows * size);
  const labels = new Uint8Array(rows);
  if (base) {
    data.set(base.features);
    labels.set(base.labels);
  }
  data.set(own.features, first * size);
  labels.set(own.labels, first);
  return { options, sources: [...sources], base, index: createNearestIndex(data, rows, size), labels };
}

/** The examples that labelled motions give. @throws Error when labels are another clip's. */
export function examplesOf(sources: readonly LabelledTrack[], options: OracleOptions): Examples {
  const size = featureSize(options);
  const per = examplesPerFrame(options);
  const doubled = options.set !== "own";
  let count = 0;
  for (const s of sources) {
    if (s.labels.length !== s.track.frames)
      throw new Error(
        `${s.track.name}: ${s.labels.length} labels for ${s.track.frames} frames: they are of another clip.`,
      );
    for (let f = 0; f < s.track.frames; f++) if (!s.mask || s.mask[f]) count += per;
  }
  const rows = doubled ? 2 * count : count;
  const features = new Float32Array(rows * size);
  const labels = new Uint8Array(rows);
  let i = 0;
  const learn = (track: MotionTrack, s: LabelledTrack, mirrored: boolean): void => {
    const all = featuresOf(track, options);
    for (let f = 0; f < track.frames; f++) {
      if (s.mask && !s.mask[f]) continue;
      for (let e = 0; e < per; e++) {
        const row = (f * per + e) * size;
        features.set(all.subarray(row, row + size), i * size);
        const bits = mirrored ? ((s.labels[f] & 3) << 2) | (s.labels[f] >> 2) : s.labels[f];
        labels[i++] = per === 1 ? bits : (bits >> (2 * e)) & 3;
      }
    }
  };
  for (const s of sources) learn(s.track, s, false);
  // A foot at a time needs no mirror: left and right already teach each other.
  if (doubled) for (const s of sources) learn(mirrorTrack(s.track), s, true);
  return { size, count: rows, features, labels };
}

export interface OracleAnswer {
  labels: ContactTrack;
  /** Share of votes for a plant, frames x 4 bits. */
  share: Float32Array;
  /** Distance to the nearest example of each frame: how foreign it is. */
  distance: Float32Array;
}

/** Labels of a whole motion. */
export function askOracle(oracle: Oracle, track: MotionTrack): OracleAnswer {
  const asked = askInSlices(oracle, track, track.frames);
  let step = asked.next();
  while (!step.done) step = asked.next();
  return step.value;
}

/** The same in slices of so many frames: yields the share that is done, so that hosts can show it or stop. */
export function* askInSlices(
  oracle: Oracle,
  track: MotionTrack,
  slice: number,
): Generator<number, OracleAnswer> {
  const { options, index } = oracle;
  const per = examplesPerFrame(options);
  const features = featuresOf(track, options);
  const n = track.frames;
  const share = new Float32Array(4 * n);
  const distance = new Float32Array(n);
  for (let e = 0; e < per; e++) {
    const search = createNearestSearch(index, Math.min(options.k, index.count));
    for (let f = 0; f < n; f++) {
      findNearest(search, features, (f * per + e) * index.size);
      voteFrame(oracle, search.found, search.size, share, 4 * f + 2 * e);
      distance[f] = Math.max(distance[f], Math.sqrt(search.distance[0]));
      if ((f + 1) % slice === 0) yield (e + (f + 1) / n) / per;
    }
  }
  return { labels: labelsOf(share, n, options), share, distance };
}

/** Shares of votes of one example's neighbours. */
export function voteFrame(
  oracle: Oracle,
  found: Int32Array,
  size: number,
  share: Float32Array,
  at: number,
): void {
  const bits = oracle.options.set === "own" ? 2 : 4;
  for (let i = 0; i < size; i++) {
    const l = oracle.labels[found[i]];
    for (let b = 0; b < bits; b++) share[at + b] += (l >> b) & 1;
  }
  for (let b = 0; b < bits; b++) share[at + b] /= size;
}

/** Votes to labels: hysteresis [Oracle §4], then runs that are too short to be a plant or a step. */
export function labelsOf(share: Float32Array, frames: number, o: OracleOptions): ContactTrack {
  const out = new Uint8Array(frames);
  const bit = new Uint8Array(frames);
  for (let b = 0; b < 4; b++) {
    let down = share[b] >= 0.5;
    for (let f = 0; f < frames; f++) {
      const v = share[4 * f + b];
      if (down ? v < o.off : v > o.on) down = !down;
      bit[f] = down ? 1 : 0;
    }
    if (o.shortest > 0) {
      dropShort(bit, 0, Math.ceil(o.shortest / 2));
      dropShort(bit, 1, o.shortest);
      dropShort(bit, 0, o.shortest);
    }
    for (let f = 0; f < frames; f++) out[f] |= bit[f] << b;
  }
  return out;
}
