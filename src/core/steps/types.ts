/** Words of the project's steps: see docs/glossary.md. */

export const FEET = ["left", "right"] as const;
export type Foot = (typeof FEET)[number];

/** Step categories in contract order [TaskLoco §4.1, Figure 5]. */
export const STEP_CATEGORIES = [
  "HeelPivot",
  "ToePivot",
  "SideStep",
  "TurnAndStep",
  "Walk",
  "ForwardStepDuringTask",
  "BackwardStepDuringTask",
] as const;
export type StepCategory = (typeof STEP_CATEGORIES)[number];

export const PHASES = ["exit", "locomotion", "enter"] as const;
export type Phase = (typeof PHASES)[number];

/**
 * Where and how a foot comes to rest. `x`, `z`: the ground point under the ankle joint of the flat foot,
 * metres; `yaw`: heel-to-toe axis, radians from +Z towards +X.
 */
export interface Footstep {
  foot: Foot;
  x: number;
  /** Height of the ground there, metres. */
  y: number;
  z: number;
  yaw: number;
  /** Horizontal part (x, z) of the unit normal of the ground there; left out where it is level. */
  normal?: readonly [number, number];
}

/** The motion of one foot to a footstep: eq. 1's tuple of [TaskLoco §4.1], frames of its clip. */
export interface Step {
  foot: Foot;
  /** Frame at which the foot loses firm contact or begins to slide. */
  start: number;
  /** Frame at which firm contact is made or the slide ends. */
  end: number;
  /** First and last frame of the airborne part; start and end for a slide or pivot. */
  airStart: number;
  airEnd: number;
  category: StepCategory;
  phase: Phase;
  /** Where the foot rested before. */
  from: Footstep;
  /** Where it comes to rest. */
  to: Footstep;
}

/**
 * Contact bits, one byte a frame: bit 0 left heel, 1 left toe, 2 right heel, 3 right toe. A bit is 1 only while
 * that point rests.
 */
export type ContactTrack = Uint8Array;

export const CONTACT = { leftHeel: 1, leftToe: 2, rightHeel: 4, rightToe: 8 } as const;
