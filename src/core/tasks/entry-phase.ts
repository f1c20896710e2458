/**
 * The enter phase [TaskLoco Algorithm 1, PlanTaskEntryPhase; §4.2]: which capture comes to the task, where it lies, and its steps
 * between the feet that are there and its own places.
 */
import { CLIP_RATE } from "../capture/clip.ts";
import { wrapAngle } from "../math/angle.ts";
import { bearing, type GroundPose, groundDistance, midPose, toLocal } from "../math/frame2.ts";
import { type EntryQuery, retrieveEntry } from "../templates/retrieve.ts";
import type { Library, Template } from "../templates/types.ts";
import { type DraftStep, type Feet, otherFoot } from "./draft.ts";
import { pivotEnd, placePivots } from "./pivots.ts";
import { type Aim, CLEARANCE, COMPETITORS, type Context, lay, optimise, type Place } from "./plan-context.ts";
import { findRoute, type GroundPoint } from "./route.ts";
import { tidyFootsteps, wayOut } from "./tidy.ts";
import { chainFrom, compete, layInTaskFrame, type TaskGoal } from "./transition.ts";

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

export interface Entry extends Aim {
  template: Template;
  /** Its steps, laid in the task's frame. */
  steps: DraftStep[];
  task: TaskGoal;
}

/** Chooses the entry by eqs. 9 and 10, from where the route comes in. */
export function chooseEntry(
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

/** PlanTaskEntryPhase: the template between the feet that are there and its own places at the task. */
export function planEntry(context: Context, entry: Entry, index: number): void {
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
