/**
 * The task planner [TaskLoco Algorithm 1]: from a scene's tasks to footsteps with their motion segments and times.
 *
 * For every pair of consecutive tasks: exit (a template of the task that is left), locomotion (walking steps along the
 * route), enter (a template of the task that is come to); near tasks skip the locomotion, nearer ones the exit.
 */
import { CLIP_RATE } from "../capture/clip.ts";
import { wrapAngle } from "../math/angle.ts";
import { bearing, type GroundPose, groundDistance, midPose, toLocal } from "../math/frame2.ts";
import type { FootstepWorkspace } from "../optimize/optimize-footsteps.ts";
import type { TaskCategory } from "../scene/task-types.ts";
import type { Skeleton } from "../skeleton/skeleton.ts";
import type { Foot, Footstep } from "../steps/types.ts";
import { type EntryQuery, retrieveEntry, retrieveExit } from "../templates/retrieve.ts";
import type { Library, Template } from "../templates/types.ts";
import { approach, closingStep, turningStep } from "./approach.ts";
import { type DraftStep, type Feet, footPose, otherFoot } from "./draft.ts";
import { closingOrder, goToOf, laidOn, standsAt } from "./go-to.ts";
import { holdAtTask } from "./hold.ts";
import type { Kept } from "./keep.ts";
import { chooseWalk, layWalk, type Walks, type WalkWish, walksOf } from "./locomotion.ts";
import { createPhaseWorkspace, optimisePhase, type PhaseGoal } from "./optimise-phase.ts";
import { pivotEnd, placePivots } from "./pivots.ts";
import type { OptimisationTrace, Plan } from "./plan-types.ts";
import { findRoute, type GroundPoint, type Obstacle } from "./route.ts";
import { tidyFootsteps, wayOut } from "./tidy.ts";
import { appendStep, type Timeline } from "./timeline.ts";
import { chainFrom, compete, layInTaskFrame, type TaskGoal } from "./transition.ts";

/** How many templates compete [TaskLoco §4.2: k = 5]. */
const COMPETITORS = 5;
/** The body's middle keeps this far from what it walks past, metres. */
const CLEARANCE = 0.4;
/** Most walking steps in one transition: a guard, 200 m. */
const MOST_STEPS = 320;

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

interface Context {
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

/** Where a transition starts from. */
interface Place {
  category: TaskCategory | null;
  effort: 0 | 1;
  frame: GroundPose;
  /** Clip and task whose motion is being left, to be gone on with where an exit template of it fits; -1 for none. */
  exitClip: number;
  exitTask: number;
}

function placeOf(task: TaskGoal): Place {
  return { category: task.category, effort: task.effort, frame: task.frame, exitClip: -1, exitTask: -1 };
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

type Laid = ReturnType<typeof layInTaskFrame>;

/** Cost of the best competitor from which on more are looked at. */
const FAR_OFF = 0.12;
/** Within this distance a body stands where a template begins, metres. */
const THERE = 0.3;

/**
 * What it costs to come to where an entry begins, in the metrics' units (a tenth a metre): they know of places alone, but an
 * entry that was walked into wants to be walked into the same way, and one that began from standing to be stood at.
 */
function approachCost(library: Library, laid: Laid, template: Template, here: GroundPose): number {
  const aim = midPose(laid.stance.left, laid.stance.right);
  const way = groundDistance(here, aim);
  let length = way;
  const feet: Feet = { ...laid.stance };
  for (const s of laid.steps) {
    length += 0.5 * groundDistance(feet[s.foot], s);
    feet[s.foot] = s;
  }
  const cost = 0.04 * length;
  if (way < THERE) return cost + 0.1 * way + 0.08 * Math.abs(wrapAngle(aim.yaw - here.yaw));
  const arrival = Math.abs(wrapAngle(aim.yaw - bearing(here, aim)));
  const source = library.clips[template.clip].steps;
  const first = source[template.first];
  const before = source[template.first - 1];
  const walkedInto = before !== undefined && first.start - before.end < 0.4 * CLIP_RATE;
  return cost + (walkedInto ? 0 : 0.08) + 0.08 * arrival;
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

/** What a walk is aimed at. */
interface Aim {
  /** Where both feet are when it ends, and the steps of the capture before. */
  stance: Feet;
  before: GroundPose[];
  /** The foot that lands last, and where. */
  stanceFoot: Foot;
  aim: Footstep;
  route: GroundPoint[];
}

interface Entry extends Aim {
  template: Template;
  /** Its steps, laid in the task's frame. */
  steps: DraftStep[];
  task: TaskGoal;
}

/** Chooses the entry by eqs. 9 and 10, from where the route comes in. */
function chooseEntry(
  context: Context,
  current: Place,
  task: TaskGoal,
  followup: TaskGoal | null,
  index: number,
): Entry | null {
  const { library } = context;
  const here = midPose(context.feet.left, context.feet.right);
  const from = current.category === null ? here : current.frame;
  const query = (origin: GroundPoint): EntryQuery => {
    const local = toLocal(task.frame, { ...origin, yaw: 0 });
    const next = followup ? toLocal(task.frame, followup.frame) : null;
    return {
      category: task.category,
      currentInNext: [local.x, local.z],
      nextEffort: task.effort,
      followupInNext: next ? [next.x, next.z] : null,
      followupEffort: followup ? followup.effort : null,
      hand: task.hand,
    };
  };
  const known = new Map<Template, Laid>();
  let origin: GroundPoint = from;
  let entry: Entry | null = null;
  for (let round = 0; round < 2; round++) {
    const lay = (t: Template): Laid => {
      const laid = known.get(t) ?? layInTaskFrame(library, t, task.frame);
      known.set(t, laid);
      return laid;
    };
    const rank = (k: number) =>
      compete(
        library,
        retrieveEntry(library, query(origin), k),
        (t) => lay(t).steps,
        context.obstacles,
        (t) => approachCost(library, lay(t), t, here),
      );
    let result = rank(COMPETITORS);
    // Where none of the nearest begins as the body stands, those that do lie farther in the metric.
    if ((result.list[0]?.distance ?? 0) > FAR_OFF) result = rank(4 * COMPETITORS);
    if (!result.winner) return null;
    const made = entryFrom(context, result.winner, task);
    const route = findRoute(here, made.aim, context.obstacles, CLEARANCE);
    if (route.blocked && round === 1)
      context.plan.warnings.push(
        `tasks[${index}] (${task.category}): no free way leads there; the straight one is taken.`,
      );
    entry = { ...made, route: route.points };
    if (round === 1 || route.points.length < 2) {
      context.plan.candidates.push({
        task: index,
        phase: "enter",
        list: result.list.slice(0, COMPETITORS),
      });
      break;
    }
    // Furniture makes the way come in from its last corner.
    origin = route.points[route.points.length - 2];
  }
  return entry;
}

/**
 * A template laid at its task, still without a way there. Where the stance at the task is in other furniture, all of it is moved
 * as a whole: the walk ends elsewhere, and the entry's own steps stay as the capture has them.
 */
function entryFrom(context: Context, template: Template, task: TaskGoal): Entry {
  const laid = layInTaskFrame(context.library, template, task.frame);
  const last: Feet = { ...laid.stance };
  for (const s of laid.steps) last[s.foot] = s;
  const [dx, dz] = wayOut(context.skeleton, [last.left, last.right], context.obstacles);
  if (dx !== 0 || dz !== 0) {
    const moved = <T extends GroundPose>(p: T): T => ({ ...p, x: p.x + dx, z: p.z + dz });
    laid.stance = { left: moved(laid.stance.left), right: moved(laid.stance.right) };
    laid.before = laid.before.map(moved);
    laid.steps = laid.steps.map(moved);
  }
  const stanceFoot = laid.steps[0] ? otherFoot(laid.steps[0].foot) : "left";
  return { template, ...laid, stanceFoot, aim: laid.stance[stanceFoot], route: [], task };
}

/** PlanTaskExitPhase: ends early where a step comes inside the enter radius or walks past the entry's stance. */
function planExit(
  context: Context,
  current: Place,
  task: TaskGoal,
  entry: Aim,
  index: number,
  radius: number,
): void {
  const { library } = context;
  const toward = entry.route[0];
  const local = toLocal(current.frame, { ...(entry.route.length > 1 ? toward : task.frame), yaw: 0 });
  const competitors = retrieveExit(
    library,
    {
      category: current.category,
      nextInCurrent: [local.x, local.z],
      currentEffort: current.effort,
      hand: task.hand,
    },
    COMPETITORS,
  );
  // After a single-stance end the other foot goes first [TaskLoco §4.2, eqs. 6 and 7].
  const wrongFoot = (t: Template) =>
    context.lastFoot !== null && library.clips[t.clip].steps[t.first]?.foot === context.lastFoot ? 1 : 0;
  const result = compete(
    library,
    competitors,
    (t) => chainFrom(library, t, context.feet),
    context.obstacles,
    wrongFoot,
  );
  context.plan.candidates.push({ task: index, phase: "exit", list: result.list });
  if (!result.winner) return;
  let steps = chainFrom(library, result.winner, context.feet);
  if (steps.length === 0) return;
  const stance = context.feet[otherFoot(steps[0].foot)];
  const goal: PhaseGoal = {
    phase: "exit",
    start: stance,
    goal: toward,
    goalYaw: bearing(stance, toward),
    goals: [],
  };
  optimise(context, steps, goal, index);
  steps = untilNear(context, steps, task.frame, radius, entry.aim);
  tidyFootsteps(context.skeleton, context.feet, steps, context.obstacles);
  // The exit's first segment goes on where the task's motion ends.
  const source = library.clips[result.winner.clip];
  const end = source.tasks[result.winner.task]
    ? Math.round(source.tasks[result.winner.task].end * CLIP_RATE)
    : null;
  steps.forEach((s, i) => {
    const from = i === 0 && end !== null && end < source.steps[s.step].start ? end : null;
    lay(context, s, index, from);
  });
}

/** The steps up to the first that lands within the radius of the task, or before the way to the aim grows again. */
function untilNear(
  context: Context,
  steps: DraftStep[],
  task: GroundPose,
  radius: number,
  aim: GroundPoint,
): DraftStep[] {
  let nearest = groundDistance(midPose(context.feet.left, context.feet.right), aim);
  for (let i = 0; i < steps.length; i++) {
    const d = groundDistance(steps[i], aim);
    if (groundDistance(steps[i], task) <= radius) return steps.slice(0, i + 1);
    if (i > 0 && d > nearest + 0.05 && nearest < 1.2 * context.walks.length) return steps.slice(0, i);
    nearest = Math.min(nearest, d);
  }
  return steps;
}

/** Course changes from which on a step has to turn, and how much more than its capture a step may; radians. */
const SHARP = 0.6;
const MORE_TURN = 0.45;

/** PlanLocomotionPhase: walking steps along the route, then the preparation of the entry. */
function planLocomotion(context: Context, entry: Aim, index: number): void {
  const { walks, feet, library } = context;
  if (walks.list.length === 0) return;
  const length = walks.length;
  let via = 0;
  let leg = midPose(feet.left, feet.right);
  let after: WalkWish["after"] = lastSegment(context);
  const firstStep = context.timeline.steps.length;
  const fresh: DraftStep[] = [];
  const earlier = context.timeline.steps.reduce((n, s) => (s.task === index ? n + 1 : n), 0);
  const beforeLocomotion: Feet = { ...feet };
  const beforeFoot = context.lastFoot;
  for (let guard = 0; guard < MOST_STEPS; guard++) {
    const middle = midPose(feet.left, feet.right);
    while (via < entry.route.length - 1 && passed(leg, entry.route[via], middle, 0.45 * length)) {
      leg = middle;
      via++;
    }
    const goal = entry.route[via];
    let remaining = groundDistance(middle, goal);
    for (let k = via + 1; k < entry.route.length; k++)
      remaining += groundDistance(entry.route[k - 1], entry.route[k]);
    const course = bearing(middle, goal);
    // Who has to arrive facing elsewhere begins to bend earlier.
    const bend = Math.abs(wrapAngle(entry.aim.yaw - course));
    if (via === entry.route.length - 1 && remaining < (2.4 + 0.9 * Math.min(2, bend)) * length) break;
    const foot =
      context.feetWished.get(`${index}:${earlier + fresh.length}`) ??
      (context.lastFoot ? otherFoot(context.lastFoot) : towards(feet, course));
    const stance = feet[otherFoot(foot)];
    const turn = wrapAngle(course - stance.yaw);
    const wish: WalkWish = {
      foot,
      // Turning steps are shorter.
      forward: length * Math.max(0.45, 1 - 0.4 * Math.abs(turn)),
      yaw: Math.max(-0.6, Math.min(0.6, turn)),
      carrying: context.carrying,
      after,
    };
    // Who walks the other way turns first, by steps that turn.
    const turning = Math.abs(turn) > SHARP ? turningStep(library, feet, foot, turn, context.carrying) : null;
    const walk = turning ? null : chooseWalk(walks, wish);
    if (!turning && !walk) break;
    const step = turning ?? layWalk(walk!, footPose(stance));
    // A step turns a little more or less than its capture, not by as much as there is to turn.
    const most = Math.abs(step.desired[2]) + MORE_TURN;
    const goalYaw = wrapAngle(
      stance.yaw + Math.max(-most, Math.min(most, wrapAngle(bearing(stance, goal) - stance.yaw))),
    );
    optimise(context, [step], { phase: "locomotion", start: leg, goal, goalYaw, goals: [] }, index);
    tidyFootsteps(context.skeleton, feet, [step], context.obstacles);
    fresh.push(step);
    feet[foot] = { foot, x: step.x, y: 0, z: step.z, yaw: step.yaw };
    context.lastFoot = foot;
    after = { clip: step.clip, step: step.step };
  }
  prepareEntry(context, entry, index, fresh, beforeLocomotion, earlier);
  context.feet = beforeLocomotion;
  context.lastFoot = beforeFoot;
  for (const s of fresh) lay(context, s, index, null);
  for (const t of context.plan.traces) if (t.first < 0) t.first = firstStep;
}

/** Enter Task Preparation: further steps where they are needed, and the last three re-optimised [TaskLoco §5.5]. */
function prepareEntry(
  context: Context,
  entry: Aim,
  index: number,
  fresh: DraftStep[],
  before: Feet,
  earlier: number,
): void {
  const { walks, feet } = context;
  const walked = fresh.length;
  const steps = approach(
    context.library,
    feet,
    context.lastFoot,
    { stanceFoot: entry.stanceFoot, stance: entry.stance },
    context.carrying,
    context.obstacles,
    context.skeleton,
    (k) => context.feetWished.get(`${index}:${earlier + walked + k}`),
  );
  for (const s of steps) feet[s.foot] = { foot: s.foot, x: s.x, y: 0, z: s.z, yaw: s.yaw };
  fresh.push(...steps);
  if (steps.length > 0) context.lastFoot = steps[steps.length - 1].foot;
  const extra = steps.length;
  if (fresh.length === 0) return;
  const count = Math.min(3, Math.max(extra, Math.min(fresh.length, 3)));
  const window = fresh.slice(fresh.length - Math.max(count, Math.min(extra, fresh.length)));
  // The feet as they are before the window.
  const from: Feet = { ...before };
  for (const s of fresh.slice(0, fresh.length - window.length))
    from[s.foot] = { foot: s.foot, x: s.x, y: 0, z: s.z, yaw: s.yaw };
  const goals = window.slice(-3).map((s, k, list) => {
    if (k === list.length - 1) return { x: entry.aim.x, z: entry.aim.z };
    const laid = entry.before[entry.before.length - list.length + k];
    // The capture's own way in, where the walk comes the same way.
    return laid && groundDistance(laid, s) < 0.4 * walks.length
      ? { x: laid.x, z: laid.z }
      : { x: s.x, z: s.z };
  });
  const saved = context.feet;
  context.feet = from;
  const start = midPose(from.left, from.right);
  optimise(
    context,
    window,
    { phase: "enterPreparation", start, goal: entry.aim, goalYaw: entry.aim.yaw, goals },
    index,
  );
  shareOut(window, entry.aim);
  tidyFootsteps(context.skeleton, from, window, context.obstacles);
  context.feet = saved;
}

/**
 * What the optimiser has left between the last step and its place is shared over the steps, growing to the last: walking bears
 * a few centimetres a step, an entry that begins askew does not.
 */
function shareOut(steps: DraftStep[], aim: GroundPose): void {
  const n = steps.length;
  const last = steps[n - 1];
  const x = aim.x - last.x;
  const z = aim.z - last.z;
  const turn = wrapAngle(aim.yaw - last.yaw);
  steps.forEach((s, i) => {
    const f = (i + 1) / n;
    s.x += f * x;
    s.z += f * z;
    s.yaw = wrapAngle(s.yaw + f * turn);
  });
}

/** PlanTaskEntryPhase: the template between the feet that are there and its own places at the task. */
function planEntry(context: Context, entry: Entry, index: number): void {
  const n = entry.steps.length;
  if (n === 0) return;
  const laid = entry.steps;
  const chained = chainFrom(context.library, entry.template, context.feet);
  // How far the feet are turned against the template's own stance is shared over its steps, so that it ends facing as it
  // did: Table 2 gives the enter phase no orientation term that would see to it.
  const before = otherFoot(laid[0].foot);
  const turned = wrapAngle(entry.stance[before].yaw - context.feet[before].yaw);
  const steps = laid.map((s, i) => {
    const f = (i + 1) / n;
    const c = chained[i];
    return {
      ...s,
      desired: [s.desired[0], s.desired[1], wrapAngle(s.desired[2] + turned / n)] as DraftStep["desired"],
      x: c.x + f * (s.x - c.x),
      z: c.z + f * (s.z - c.z),
      yaw: wrapAngle(c.yaw + f * wrapAngle(s.yaw - c.yaw)),
    };
  });
  const goals = laid.slice(-3).map((s) => ({ x: s.x, z: s.z }));
  const stance = context.feet[otherFoot(steps[0].foot)];
  optimise(
    context,
    steps,
    { phase: "enter", start: stance, goal: entry.task.frame, goalYaw: laid[n - 1].yaw, goals },
    index,
  );
  shareWhatIsLeft(context, steps, laid, entry);
  tidyFootsteps(context.skeleton, context.feet, steps, context.obstacles);
  for (const s of steps) lay(context, s, index, null);
}

/** How far from its place at the task the body may be left by the optimiser, metres, before the steps share the rest. */
const LEFT_OVER = 0.05;

/**
 * Eq. 15 draws the last footsteps to their places but trades them against the template; a hand or a seat needs the body
 * where it was. What is left beyond a few centimetres is shared over the steps, growing to the last.
 */
function shareWhatIsLeft(
  context: Context,
  steps: DraftStep[],
  laid: readonly DraftStep[],
  entry: Entry,
): void {
  const end: Feet = { ...context.feet };
  const wanted: Feet = { ...entry.stance };
  for (const s of steps) end[s.foot] = { foot: s.foot, x: s.x, y: 0, z: s.z, yaw: s.yaw };
  for (const s of laid) wanted[s.foot] = { foot: s.foot, x: s.x, y: 0, z: s.z, yaw: s.yaw };
  const a = midPose(end.left, end.right);
  const b = midPose(wanted.left, wanted.right);
  const d = groundDistance(a, b);
  const turn = wrapAngle(b.yaw - a.yaw);
  const part = d > LEFT_OVER ? 1 - LEFT_OVER / d : 0;
  if (part === 0 && Math.abs(turn) < 0.08) return;
  const free = steps.filter((s) => !pivotEnd(s.category)).length;
  let k = 0;
  for (const s of steps) {
    if (!pivotEnd(s.category)) k++;
    // Both feet stand in the end: the last two free steps carry all of it.
    const f = Math.min(1, k / Math.max(1, free - 1));
    s.x += f * part * (b.x - a.x);
    s.z += f * part * (b.z - a.z);
    s.yaw = wrapAngle(s.yaw + f * turn);
  }
  placePivots(context.skeleton.foot, context.feet, steps, new Uint8Array(steps.length));
}

/** Runs the optimiser on a phase and notes what it did. */
function optimise(context: Context, steps: DraftStep[], goal: PhaseGoal, index: number): void {
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

function lay(context: Context, step: DraftStep, index: number, from: number | null): void {
  appendStep(context.library, context.timeline, step, index, from);
  context.feet[step.foot] = { foot: step.foot, x: step.x, y: step.y, z: step.z, yaw: step.yaw };
  context.lastFoot = step.foot;
}

function lastSegment(context: Context): WalkWish["after"] {
  const s = context.timeline.steps[context.timeline.steps.length - 1];
  return s ? { clip: s.clip, step: s.step } : null;
}

/** Whether a via-point has been reached: near it, or beyond the line square to the leg through it. */
function passed(from: GroundPoint, via: GroundPoint, here: GroundPoint, near: number): boolean {
  if (groundDistance(here, via) < near) return true;
  const dx = via.x - from.x;
  const dz = via.z - from.z;
  return (here.x - via.x) * dx + (here.z - via.z) * dz > 0;
}

/** The foot on the side of the turn opens it; straight on, the right goes first. */
function towards(feet: Feet, course: number): Foot {
  const turn = wrapAngle(course - midPose(feet.left, feet.right).yaw);
  return turn > 0.2 ? "left" : "right";
}

/** The stance that a plan begins with: feet beside each other, toes a little out. */
export function standingFeet(at: GroundPose, skeleton: Skeleton): Feet {
  const half = 0.095 * (skeleton.legLength / 0.93);
  const out = 0.12;
  const c = Math.cos(at.yaw);
  const s = Math.sin(at.yaw);
  return {
    left: { foot: "left", x: at.x + c * half, y: 0, z: at.z - s * half, yaw: wrapAngle(at.yaw + out) },
    right: { foot: "right", x: at.x - c * half, y: 0, z: at.z + s * half, yaw: wrapAngle(at.yaw - out) },
  };
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
