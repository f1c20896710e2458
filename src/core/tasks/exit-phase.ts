/** The exit phase [TaskLoco Algorithm 1, PlanTaskExitPhase]: how the task that is left is left. */
import { CLIP_RATE } from "../capture/clip.ts";
import { wrapAngle } from "../math/angle.ts";
import { bearing, type GroundPose, groundDistance, midPose, toLocal } from "../math/frame2.ts";
import { retrieveExit } from "../templates/retrieve.ts";
import type { Template } from "../templates/types.ts";
import { type DraftStep, otherFoot } from "./draft.ts";
import type { PhaseGoal } from "./optimise-phase.ts";
import { type Aim, COMPETITORS, type Context, lay, optimise, type Place } from "./plan-context.ts";
import type { GroundPoint } from "./route.ts";
import { tidyFootsteps } from "./tidy.ts";
import { chainFrom, compete, type TaskGoal } from "./transition.ts";

/** PlanTaskExitPhase: ends early where a step comes inside the enter radius or walks past the entry's stance. */
export function planExit(
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
    (t) => wrongFoot(t) + turnLack(context, t, toward),
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

/** Radians by which a template may turn less or more than there is to turn, and what every further one costs, as `compete` counts. */
const TURN_LACK = 0.8;
const TURN_COST = 0.2;

/**
 * What it costs that a template turns elsewhere. Round furniture the way out is another than the way to the next task, and a left turn
 * that is laid over a right one would spin the foot.
 */
function turnLack(context: Context, t: Template, toward: GroundPoint): number {
  const { steps } = context.library.clips[t.clip];
  const foot = steps[t.last - 1]?.foot;
  if (!foot) return 0;
  let turn = 0;
  for (let i = t.first; i < t.last; i++)
    if (steps[i].foot === foot) turn += wrapAngle(steps[i].to.yaw - steps[i].from.yaw);
  const wanted = bearing(midPose(context.feet.left, context.feet.right), toward) - context.feet[foot].yaw;
  return TURN_COST * Math.max(0, Math.abs(wrapAngle(turn - wanted)) - TURN_LACK);
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
