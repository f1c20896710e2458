/** Words of footstep-parameterised blending [Barycentric]. Plain data; metres, seconds, radians. */
import type { Clip } from "../capture/clip.ts";
import type { Foot, Step } from "../steps/types.ts";

/** A cyclic clip with its steps, as the project's contact detection and segmentation find them. */
export interface CyclicSource {
  name: string;
  clip: Clip;
  /** In order of their start. */
  steps: readonly Step[];
}

/** Rigid motion on the ground in a frame: lateral, forward, turn. */
export interface GroundMove {
  x: number;
  z: number;
  yaw: number;
}

/**
 * One animation step A_i of a clip [Barycentric §4.1]: from the lift of `foot` to the next lift of the other foot.
 * Everything is seen in the root's frame on the ground at the lift, with the clip in place.
 */
export interface AnimationStep {
  foot: Foot;
  /** Seconds from the lift to the landing, and to the next lift (of the other foot; before the landing in a run). */
  swing: number;
  duration: number;
  /** Seconds that this foot then stays down. */
  stance: number;
  /** The landing point p_i (footstep place) and the foot's yaw there. */
  landing: GroundMove;
  /** The supporting foot's place at the lift. */
  support: GroundMove;
  /** Root displacement from the lift to the landing, d_i of eq. 2. */
  displacement: GroundMove;
  /** Root displacement from the lift to the next lift. */
  whole: GroundMove;
}

/** What the analysis says of a clip. */
export interface ClipAnalysis {
  name: string;
  /** Mean root velocity v_i in the root's own frame: lateral and forward m/s, turn rad/s. */
  velocity: GroundMove;
  /** Left foot's step, then the right's. */
  steps: [AnimationStep, AnimationStep];
  /** Frames of the clip between which the cycle lies: lifts of both steps, and of the first foot again. */
  frames: { first: number; second: number; end: number };
}
