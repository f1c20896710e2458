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
function storyOf({ motion, path, styles, spans }: PathPlan): PathStory {
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

/** Before a walk its place is so far short of its start, metres: its first moment can be told from what came before. */
const SHORT = 1e-3;

/**
 * The stories of several walks of one motion as one, over all of its frames: between walks the place rests, at no speed. Null of
 * none.
 *
 * @param walks with the frame at which each begins, in order.
 */
export function joinStories(
  walks: readonly { first: number; walk: PathPlan }[],
  frames: number,
): PathStory | null {
  if (walks.length === 0) return null;
  const out: PathStory = {
    frames,
    length: 0,
    styles: [],
    at: new Float32Array(frames),
    speed: new Float32Array(frames),
    scale: new Float32Array(frames).fill(1),
    lean: new Float32Array(frames),
    blends: [],
    loopStarts: [],
    spans: [],
    offset: 0,
  };
  let from = 0;
  walks.forEach(({ first, walk }, i) => {
    const story = storyOf(walk);
    const end = Math.min(frames, first + story.frames);
    out.at.fill(out.length - SHORT, from, first);
    for (let f = first; f < end; f++) {
      out.at[f] = out.length + story.at[f - first];
      out.speed[f] = story.speed[f - first];
      out.scale[f] = story.scale[f - first];
      out.lean[f] = story.lean[f - first];
    }
    const styles = story.styles.map((name) => {
      const known = out.styles.indexOf(name);
      return known >= 0 ? known : out.styles.push(name) - 1;
    });
    for (const b of story.blends)
      out.blends.push({ ...b, start: b.start + first, from: styles[b.from], to: styles[b.to] });
    for (const l of story.loopStarts) out.loopStarts.push({ frame: l.frame + first, style: styles[l.style] });
    for (const x of story.spans)
      out.spans.push({ id: x.id, from: x.from + out.length, to: x.to + out.length });
    out.length += story.length;
    out.offset = Math.max(out.offset, story.offset);
    from = end;
    if (i === walks.length - 1) out.at.fill(out.length, end, frames);
  });
  return out;
}
