/** Which frames to label next: the segment that holds what the oracle knows least [Oracle §5]. */

import type { MotionTrack } from "./motion-track.ts";
import type { Oracle } from "./oracle.ts";
import { askOracle } from "./oracle.ts";

/** Frames a segment [Oracle §5]. */
export const SEGMENT = 200;

export interface Segment {
  /** Index of the motion, its first frame, and one past its last. */
  motion: number;
  first: number;
  last: number;
  /** Largest distance of a frame in it to the nearest example. */
  foreign: number;
}

/** All segments of the motions, the most foreign first. Segments at a motion's end may be shorter. */
export function rankSegments(oracle: Oracle, motions: readonly MotionTrack[], frames = SEGMENT): Segment[] {
  return rankDistances(
    motions.map((track) => askOracle(oracle, track).distance),
    frames,
  );
}

/** The same of distances known already, one array a motion, one number a frame. */
export function rankDistances(distances: readonly Float32Array[], frames = SEGMENT): Segment[] {
  const out: Segment[] = [];
  distances.forEach((distance, motion) => {
    for (let first = 0; first < distance.length; first += frames) {
      const last = Math.min(distance.length, first + frames);
      let foreign = 0;
      for (let f = first; f < last; f++) foreign = Math.max(foreign, distance[f]);
      out.push({ motion, first, last, foreign });
    }
  });
  return out.sort((a, b) => b.foreign - a.foreign || a.motion - b.motion || a.first - b.first);
}
