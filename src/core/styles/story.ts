/** What happened along a path, as plain data for plots, bands and lessons. */
import type { PathPlan } from "./plan-paths.ts";
import type { StyleBlend } from "./timeline.ts";

/** One row a frame of the motion where nothing else is said. */
export interface PathStory {
  frames: number;
  /** Metres of the whole way. */
  length: number;
  /** Names of the styles; the numbers below are places in this list. */
  styles: string[];
  /** Metres along the way, metres a second, share of the full stride, lean in radians towards the path's left. */
  at: Float32Array;
  speed: Float32Array;
  scale: Float32Array;
  lean: Float32Array;
  /** Changes of style, in order: when each begins, how long it takes, and the gap that decided. */
  blends: StyleBlend[];
  /** Frames at which a loop begins anew. */
  loopStarts: { frame: number; style: number }[];
  /** Where each of the scene's paths lies on the way, metres. */
  spans: { id: string; from: number; to: number }[];
  /** Largest distance of the hips from the path beyond the style's own sway, metres. */
  offset: number;
}

/** The story of a plan along paths. */
export function storyOf({ motion, path, styles, spans }: PathPlan): PathStory {
  const { timeline, lean } = motion;
  const n = timeline.frames;
  const speed = new Float32Array(n);
  for (let f = 0; f < n; f++) {
    const a = Math.max(0, f - 1);
    const b = Math.min(n - 1, f + 1);
    speed[f] = b > a ? ((timeline.at[b] - timeline.at[a]) * 60) / (b - a) : 0;
  }
  return {
    frames: n,
    length: path.length,
    styles,
    at: Float32Array.from(timeline.at),
    speed,
    scale: Float32Array.from(timeline.scale),
    lean: Float32Array.from(lean),
    blends: timeline.blends,
    loopStarts: timeline.loopStarts,
    spans,
    offset: motion.offset,
  };
}
