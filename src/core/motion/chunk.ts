/** Motions as the pieces in which they are handed on. */
import type { Clip } from "../capture/clip.ts";
import type { ContactTrack } from "../steps/types.ts";
import type { MotionChunk } from "./types.ts";

/**
 * A whole clip as one piece, in the precision in which motions are shown and judged.
 *
 * @param contacts four bits a frame, as many frames as the clip; not copied.
 */
export const wholeChunk = (
  clip: Pick<Clip, "frames" | "root" | "rotations">,
  contacts: ContactTrack,
): MotionChunk => ({
  first: 0,
  frames: clip.frames,
  root: Float32Array.from(clip.root),
  rotations: Float32Array.from(clip.rotations),
  contacts,
});
