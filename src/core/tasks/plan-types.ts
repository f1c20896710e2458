/** What the task planner gives to the motion stage, the view and the plots. Plain data. */
import type { BlendStory } from "../blending/types.ts";
import type { PlantMode } from "../scene/types.ts";
import type { Foot, Footstep, Phase, StepCategory } from "../steps/types.ts";

/** A planned step: the footstep, the motion segment it is made of, its times. */
export interface PlannedStep extends Footstep {
  category: StepCategory;
  phase: Phase;
  /** Index of the scene task that this step leads to (exit: leaves); -1 before the first. */
  task: number;
  /** Template's id; null for a locomotion step. */
  template: string | null;
  /** Motion segment: clip and step of the library. */
  clip: number;
  step: number;
  /** Seconds. */
  lift: number;
  land: number;
  /** What the user asks of the plant that it begins; left out: as the capture has it. */
  plant?: Exclude<PlantMode, "auto">;
}

export interface PlannedTask {
  /** Id of the scene task. */
  id: string;
  start: number;
  contact: number;
  end: number;
  /** Clip and task of the library whose motion performs it; -1 where none is needed. */
  clip: number;
  clipTask: number;
}

/** How one template did in the competition for a phase. */
export interface Candidate {
  template: string;
  /** Distance of eqs. 8-10. */
  distance: number;
  chosen: boolean;
  /** Feet and categories of its steps, for the picture. */
  steps: { foot: Foot; category: StepCategory }[];
}

/** One optimisation: what it started from and how its terms fell. */
export interface OptimisationTrace {
  task: number;
  phase: "exit" | "locomotion" | "enterPreparation" | "enter";
  /** Index of its first footstep in the plan and how many. */
  first: number;
  count: number;
  before: { x: number; z: number; yaw: number }[];
  /** One row an iteration: total, data prior, smooth step, orientation, goal, location (weighted). */
  terms: number[][];
}

/**
 * A run of frames of one library clip laid on the plan's time: the motion stage plays it, placed and warped.
 * Steps' segments reach from the landing of the step before to their own landing; a hold has no step.
 */
export interface PlannedSegment {
  clip: number;
  /** Source frames: first, and one past the last (the next segment's first frame shows that instant). */
  from: number;
  to: number;
  /** Plan frame (60 Hz) of its first frame, and how many frames it fills; frames != to - from stretches time. */
  start: number;
  frames: number;
  /** Index in `steps`; -1 for a hold. */
  step: number;
  /** Index of the scene task it leads to, holds or leaves; -1 before the first. */
  task: number;
}

export interface Plan {
  /** The two stances the plan begins with: left, right. */
  start: [Footstep, Footstep];
  steps: PlannedStep[];
  /** Contiguous in time from frame 0. */
  segments: PlannedSegment[];
  tasks: PlannedTask[];
  /** Seconds. */
  duration: number;
  candidates: { task: number; phase: "exit" | "enter"; list: Candidate[] }[];
  traces: OptimisationTrace[];
  /** One sentence each, naming the place, for what could not be met. */
  warnings: string[];
  /** What the blend did for steps on stones [Barycentric]; left out where there are none. */
  blend?: BlendStory;
}
