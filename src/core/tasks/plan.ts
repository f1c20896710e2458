/**
 * The task planner [TaskLoco Algorithm 1]: from a scene's tasks to footsteps with their motion segments and times.
 *
 * For every pair of consecutive tasks: exit (a template of the task that is left), locomotion (walking steps along the
 * route), enter (a template of the task that is come to); near tasks skip the locomotion, nearer ones the exit.
 */
import { CLIP_RATE } from "../capture/clip.ts";
import { type GroundPose, groundDistance, midPose } from "../math/frame2.ts";
import type { Skeleton } from "../skeleton/skeleton.ts";
import type { Foot, Footstep } from "../steps/types.ts";
import type { Library } from "../templates/types.ts";
import { closingStep } from "./approach.ts";
import type { Feet } from "./draft.ts";
import { chooseEntry, planEntry } from "./entry-phase.ts";
import { planExit } from "./exit-phase.ts";
import { closingOrder, goToOf, laidOn, standsAt } from "./go-to.ts";
import { holdAtTask } from "./hold.ts";
import type { Kept } from "./keep.ts";
import { walksOf } from "./locomotion.ts";
import { createPhaseWorkspace } from "./optimise-phase.ts";
import { type Aim, CLEARANCE, type Context, lay, type Place, placeOf } from "./plan-context.ts";
import type { Plan } from "./plan-types.ts";
import { findRoute, type Obstacle } from "./route.ts";
import { standingFeet } from "./standing-feet.ts";
import type { Timeline } from "./timeline.ts";
import type { TaskGoal } from "./transition.ts";
import { planLocomotion } from "./walk-phase.ts";

export interface PlanInput {
  /** Templates retargeted to the skeleton. */
  library: Library;
  skeleton: Skeleton;
  start: GroundPose;
  /** Where the feet stand at first; left out: beside each other at the start. */
  feet?: readonly [Footstep, Footstep] | null;
  /** Tasks still to be done, in order. */
  tasks: TaskGoal[];
  obstacles: Obstacle[];
  /** What has begun of an earlier plan, or null. */
  kept: Kept | null;
  /** The task whose place `kept` left, or null for the start. */
  keptTask: TaskGoal | null;
  /** Whether to record the optimiser's terms. */
  trace: boolean;
  /** Feet that the user asks for, by "task index:count of the step among those that lead to it". */
  feetWished?: ReadonlyMap<string, Foot>;
}

/**
 * Plans footsteps for the tasks in order.
 *
 * Never throws on reachable or unreachable goals: what could not be met is a sentence in `warnings`.
 */
export function planTasks(input: PlanInput): Plan {
  const { library, skeleton, kept } = input;
  const walks = walksOf(library);
  const feet: Feet = kept
    ? { ...kept.feet }
    : input.feet
      ? { left: input.feet[0], right: input.feet[1] }
      : standingFeet(input.start, skeleton);
  const timeline: Timeline = kept
    ? { steps: [...kept.steps], segments: [...kept.segments], cursor: kept.cursor }
    : { steps: [], segments: [], cursor: 0 };
  const plan: Plan = {
    start: kept ? kept.start : [feet.left, feet.right],
    steps: timeline.steps,
    segments: timeline.segments,
    tasks: kept ? [...kept.done] : [],
    duration: 0,
    candidates: [],
    traces: [],
    warnings: [],
  };
  const context: Context = {
    feetWished: input.feetWished ?? new Map(),
    library,
    skeleton,
    walks,
    workspace: createPhaseWorkspace(),
    obstacles: input.obstacles,
    trace: input.trace,
    timeline,
    feet,
    lastFoot: kept?.lastFoot ?? null,
    carrying: kept ? carriesAfter(library, kept) : false,
    plan,
  };
  if (timeline.cursor === 0) openStance(context);
  let current: Place = input.keptTask
    ? placeOf(input.keptTask)
    : { category: null, effort: 1, frame: input.start, exitClip: -1, exitTask: -1 };
  const firstIndex = kept ? kept.done.length : 0;
  input.tasks.forEach((task, k) => {
    const index = firstIndex + k;
    const underWay = k === 0 && kept !== null && timeline.steps.some((s) => s.task === index);
    current = planTask(context, current, task, input.tasks[k + 1] ?? null, index, underWay);
  });
  plan.duration = timeline.cursor / CLIP_RATE;
  return plan;
}

/** Whether a box is in the hands once the tasks that are done have been. */
function carriesAfter(library: Library, kept: Kept): boolean {
  const last = kept.done.findLast((t) => {
    const category = library.clips[t.clip]?.tasks[t.clipTask]?.category;
    return category === "lift" || category === "place";
  });
  return last !== undefined && library.clips[last.clip].tasks[last.clipTask].category === "lift";
}

function planTask(
  context: Context,
  current: Place,
  task: TaskGoal,
  followup: TaskGoal | null,
  index: number,
  underWay: boolean,
): Place {
  const firstSegment = context.timeline.segments.length;
  if (task.category === "stand") {
    if (task.feet) goTo(context, current, task, task.feet, index);
    holdAtTask(
      context.library,
      context.timeline,
      context.plan.tasks,
      null,
      task,
      index,
      firstSegment,
      followup === null,
      context.carrying,
    );
    context.lastFoot = null;
    return {
      ...current,
      category: current.category === "sit" ? "stand" : current.category,
      frame: midPose(context.feet.left, context.feet.right),
    };
  }
  const entry = chooseEntry(context, current, task, followup, index);
  if (!entry) {
    context.plan.warnings.push(
      `tasks[${index}] (${task.category}): the library has no template that enters it.`,
    );
    return placeOf(task);
  }
  const radius = context.library.enterRadius[task.category];
  const nearest = Math.min(
    groundDistance(context.feet.left, task.frame),
    groundDistance(context.feet.right, task.frame),
  );
  if (nearest > radius && !underWay) planExit(context, current, task, entry, index, radius);
  planLocomotion(context, entry, index);
  planEntry(context, entry, index);
  context.carrying = task.category === "lift" ? true : task.category === "place" ? false : context.carrying;
  holdAtTask(
    context.library,
    context.timeline,
    context.plan.tasks,
    entry.template,
    task,
    index,
    firstSegment,
    followup === null,
    context.carrying,
  );
  context.lastFoot = entry.template.singleStance ? context.lastFoot : null;
  return {
    category: task.category,
    effort: task.effort,
    frame: task.frame,
    exitClip: entry.template.clip,
    exitTask: entry.template.task,
  };
}

/** Walks to a stance that is given foot by foot and stands in it exactly. */
function goTo(
  context: Context,
  current: Place,
  task: TaskGoal,
  feet: readonly [Footstep, Footstep],
  index: number,
): void {
  const { library } = context;
  const goal = goToOf(feet, context.feet, context.skeleton.legLength);
  const here = midPose(context.feet.left, context.feet.right);
  const route = findRoute(here, goal.aim, context.obstacles, CLEARANCE).points;
  const aim: Aim = { ...goal, before: [], route };
  if (groundDistance(here, midPose(feet[0], feet[1])) > library.enterRadius.stand)
    planExit(context, current, task, aim, index, library.enterRadius.stand);
  planLocomotion(context, aim, index);
  for (const foot of closingOrder(goal)) {
    const at = feet[foot === "left" ? 0 : 1];
    if (standsAt(context.feet[foot], at)) continue;
    const step = closingStep(library, context.feet, foot, at);
    if (step) lay(context, laidOn(step, at), index, null);
  }
}

/** Half a second of standing before the first lift, from a capture that begins so. */
function openStance(context: Context): void {
  const clips = context.library.clips;
  const c = clips.findIndex((clip) => clip.steps.length > 0 && clip.steps[0].start >= 30);
  if (c < 0) return;
  const frames = 12;
  context.timeline.segments.push({ clip: c, from: 0, to: frames, start: 0, frames, step: -1, task: -1 });
  context.timeline.cursor = frames;
}
