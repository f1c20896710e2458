/** What the phases of a plan share while it is made: where the feet are, what has been laid, what has to be walked round. */
import type { GroundPose } from "../math/frame2.ts";
import type { FootstepWorkspace } from "../optimize/optimize-footsteps.ts";
import type { TaskCategory } from "../scene/task-types.ts";
import type { Skeleton } from "../skeleton/skeleton.ts";
import type { Foot, Footstep } from "../steps/types.ts";
import type { Library } from "../templates/types.ts";
import type { DraftStep, Feet } from "./draft.ts";
import type { Walks } from "./locomotion.ts";
import { optimisePhase, type PhaseGoal } from "./optimise-phase.ts";
import type { OptimisationTrace, Plan } from "./plan-types.ts";
import type { GroundPoint, Obstacle } from "./route.ts";
import { appendStep, type Timeline } from "./timeline.ts";
import type { TaskGoal } from "./transition.ts";

/** How many templates compete [TaskLoco §4.2: k = 5]. */
export const COMPETITORS = 5;

/** The body's middle keeps this far from what it walks past, metres. */
export const CLEARANCE = 0.4;

export interface Context {
  feetWished: ReadonlyMap<string, Foot>;
  library: Library;
  skeleton: Skeleton;
  walks: Walks;
  workspace: FootstepWorkspace;
  obstacles: Obstacle[];
  trace: boolean;
  timeline: Timeline;
  feet: Feet;
  /** Foot that landed last in this walk; null when both have stood. */
  lastFoot: Foot | null;
  carrying: boolean;
  plan: Plan;
}

/** Where a transition starts from. */
export interface Place {
  category: TaskCategory | null;
  effort: 0 | 1;
  frame: GroundPose;
  /** Clip and task whose motion is being left, to be gone on with where an exit template of it fits; -1 for none. */
  exitClip: number;
  exitTask: number;
}

export function placeOf(task: TaskGoal): Place {
  return { category: task.category, effort: task.effort, frame: task.frame, exitClip: -1, exitTask: -1 };
}

/** What a walk is aimed at. */
export interface Aim {
  /** Where both feet are when it ends, and the steps of the capture before. */
  stance: Feet;
  before: GroundPose[];
  /** The foot that lands last, and where. */
  stanceFoot: Foot;
  aim: Footstep;
  route: GroundPoint[];
}

/** Runs the optimiser on a phase and notes what it did. */
export function optimise(context: Context, steps: DraftStep[], goal: PhaseGoal, index: number): void {
  const result = optimisePhase(context.workspace, context.skeleton, context.feet, steps, goal, context.trace);
  if (!result || !context.trace) return;
  const trace: OptimisationTrace = {
    task: index,
    phase: goal.phase,
    first: context.timeline.steps.length,
    count: steps.length,
    before: result.before,
    terms: result.terms,
  };
  context.plan.traces.push(trace);
}

export function lay(context: Context, step: DraftStep, index: number, from: number | null): void {
  appendStep(context.library, context.timeline, step, index, from);
  context.feet[step.foot] = { foot: step.foot, x: step.x, y: step.y, z: step.z, yaw: step.yaw };
  context.lastFoot = step.foot;
}
