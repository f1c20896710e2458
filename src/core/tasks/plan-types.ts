/** What the task planner gives to the motion stage, the view and the plots. Plain data. */
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

export interface Plan {
  /** The two stances the plan begins with: left, right. */
  start: [Footstep, Footstep];
  steps: PlannedStep[];
  tasks: PlannedTask[];
  /** Seconds. */
  duration: number;
  candidates: { task: number; phase: "exit" | "enter"; list: Candidate[] }[];
  traces: OptimisationTrace[];
  /** One sentence each, naming the place, for what could not be met. */
  warnings: string[];
}
