/** A motion on the project's skeleton: the hips' place and every joint's local rotation, one row a frame. */
import type { Skeleton } from "../skeleton/skeleton.ts";

/** Frames a second that every clip is kept at. */
export const CLIP_RATE = 60;

export interface Clip {
  name: string;
  skeleton: Skeleton;
  /** Frames a second; CLIP_RATE except inside importers. */
  rate: number;
  frames: number;
  /** The hips' world place, frames x 3, metres. */
  root: Float64Array;
  /** Local rotations xyzw, frames x JOINT_COUNT x 4. Consecutive frames are in the same hemisphere. */
  rotations: Float64Array;
}
