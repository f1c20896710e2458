/** The full-body motion that answers a plan. */
import type { ContactTrack } from "../steps/types.ts";

/** Frames `first` to `first + frames - 1` of a motion at 60 Hz. */
export interface MotionChunk {
  first: number;
  frames: number;
  /** The hips' world place, frames x 3. */
  root: Float32Array;
  /** Local rotations xyzw, frames x JOINT_COUNT x 4. */
  rotations: Float32Array;
  contacts: ContactTrack;
}

/** Where a carried box is: one row a frame from `first`: place of its centre (3) and rotation xyzw (4). */
export interface BoxTrack {
  /** Ids of the lift task and, when it is put down, the place task. */
  lift: string;
  place: string | null;
  first: number;
  frames: number;
  transforms: Float32Array;
}

/** Ink on a board: pen points with their times. */
export interface InkStroke {
  task: string;
  /** Time of each point, seconds. */
  times: Float32Array;
  /** World places, points x 3. */
  points: Float32Array;
}

/** The motion-quality figures of DESIGN, as measured on a motion with contacts; null where there is nothing to measure. */
export interface QualityFigures {
  skate: number | null;
  skateFlat: number | null;
  penetration: number | null;
  float: number | null;
  reach: number | null;
  footstepError: { position: number; yaw: number } | null;
  limitViolations: number;
  popping: number | null;
  poppingOwn: number | null;
  jerk: number | null;
  balance: number | null;
  balanceWithin50mm: number | null;
  missedPlants: number | null;
}
