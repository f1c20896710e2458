/**
 * The walk between [TaskLoco Algorithm 1, PlanLocomotionPhase; §5.5]: steps along the route, one by one, and the preparation of
 * the stance that the entry begins from.
 */
import { wrapAngle } from "../math/angle.ts";
import { bearing, type GroundPose, groundDistance, midPose } from "../math/frame2.ts";
import type { Foot } from "../steps/types.ts";
import { approach, turningStep } from "./approach.ts";
import { type DraftStep, type Feet, footPose, otherFoot } from "./draft.ts";
import { chooseWalk, layWalk, type WalkWish } from "./locomotion.ts";
import { type Aim, type Context, lay, optimise } from "./plan-context.ts";
import type { GroundPoint } from "./route.ts";
import { tidyFootsteps } from "./tidy.ts";

/** Course changes from which on a step has to turn, and how much more than its capture a step may; radians. */
const SHARP = 0.6;

const MORE_TURN = 0.45;

/** Most walking steps in one transition: a guard, some 180 m. */
const MOST_STEPS = 320;

/** PlanLocomotionPhase: walking steps along the route, then the preparation of the entry. */
export function planLocomotion(context: Context, entry: Aim, index: number): void {
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
  if (fresh.length === MOST_STEPS)
    context.plan.warnings.push(
      `tasks[${index}]: ${MOST_STEPS} steps do not lead there; it is done where they end.`,
    );
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
