/**
 * Planned footsteps that the user moved, turned, pinned or re-timed, or whose plants they hold or let go (`edits` of the scene document): laid over a finished
 * plan, and the footsteps about them answered for by the same objective that placed them [TaskLoco §5, eqs. 11-16].
 *
 * An edited footstep is held where it was put; two before and two after it are optimised again with the edited ones and
 * everything farther away pinned. The prior of each is the displacement that the plan gave it, so a plan without edits is
 * what it was. The stance in which a task is done is never moved: hands and seat need it.
 */
import { CLIP_RATE } from "../capture/clip.ts";
import { wrapAngle } from "../math/angle.ts";
import { type GroundPose, groundDistance, toLocal } from "../math/frame2.ts";
import { pivotPlace } from "../motion/sole.ts";
import { createFootstepWorkspace, optimizeFootsteps } from "../optimize/optimize-footsteps.ts";
import { PHASE_WEIGHTS } from "../optimize/phase-weights.ts";
import type { FootstepEdit } from "../scene/types.ts";
import type { Skeleton } from "../skeleton/skeleton.ts";
import type { Foot, Footstep } from "../steps/types.ts";
import { type Feet, footPose, otherFoot } from "./draft.ts";
import { pivotEnd } from "./pivots.ts";
import type { Plan, PlannedSegment, PlannedStep } from "./plan-types.ts";
import { TIDY } from "./tidy.ts";

/** Footsteps optimised again on either side of an edited one. */
const AROUND = 2;
/** Farther than this from where the planner now puts it, metres, an edit that is not pinned has lost its footstep. */
const LOST = 0.7;
/** ... and one that is pinned. */
const LOST_PINNED = 1.6;
/** Least and most that a step's time may be stretched. */
const STRETCH: readonly [number, number] = [0.5, 2.5];

/** Index in the plan of the step that an edit means; -1 when the plan has none such. */
export function stepOfEdit(
  edit: Pick<FootstepEdit, "task" | "step">,
  steps: readonly PlannedStep[],
  taskIds: readonly string[],
): number {
  if (edit.task === null) return edit.step < steps.length ? edit.step : -1;
  const task = taskIds.indexOf(edit.task);
  if (task < 0) return -1;
  let k = 0;
  for (let i = 0; i < steps.length; i++) if (steps[i].task === task && k++ === edit.step) return i;
  return -1;
}

/** How an edit would name a step of a plan: the task it leads to, and its count among the steps that do. */
export function nameOfStep(plan: Plan, index: number): { task: string | null; step: number } {
  const task = plan.steps[index].task;
  const id = plan.tasks[task]?.id ?? null;
  if (id === null) return { task: null, step: index };
  let step = 0;
  for (let i = 0; i < index; i++) if (plan.steps[i].task === task) step++;
  return { task: id, step };
}

/** Feet that edits ask for, by "task index:step", for the planner's locomotion. */
export function feetWished(
  edits: readonly FootstepEdit[],
  taskIds: readonly string[],
): ReadonlyMap<string, Foot> {
  const out = new Map<string, Foot>();
  for (const e of edits) {
    const task = e.task === null ? -1 : taskIds.indexOf(e.task);
    if (e.foot !== null && task >= 0) out.set(`${task}:${e.step}`, e.foot);
  }
  return out;
}

/**
 * Whether footsteps that have begun by `now` seconds differ between two lists of edits: then what is playing cannot be kept.
 */
export function editsOfBegun(
  plan: Plan,
  before: readonly FootstepEdit[],
  after: readonly FootstepEdit[],
  now: number,
): boolean {
  if (before === after) return false;
  const ids = plan.tasks.map((t) => t.id);
  const begun = (edits: readonly FootstepEdit[]) =>
    edits.filter((e) => {
      const i = stepOfEdit(e, plan.steps, ids);
      // The step before an edited one moves with it.
      const first = Math.max(0, i - AROUND);
      return i >= 0 && plan.steps[first].lift <= now + 1 / CLIP_RATE;
    });
  return JSON.stringify(begun(before)) !== JSON.stringify(begun(after));
}

/**
 * Lays edits over a plan: `plan.steps`, `segments`, `tasks`, `duration` and `warnings` are mutated.
 *
 * @param fixed steps at the plan's beginning that have begun and stay as they are.
 */
export function applyEdits(
  plan: Plan,
  edits: readonly FootstepEdit[],
  skeleton: Skeleton,
  fixed: number,
): void {
  if (edits.length === 0) return;
  const { steps } = plan;
  const ids = plan.tasks.map((t) => t.id);
  const held = new Uint8Array(steps.length).fill(1, 0, Math.min(fixed, steps.length));
  for (let i = 0; i < steps.length; i++) if (inTaskStance(plan, i)) held[i] = 1;
  const prior = displacements(plan);
  const moved: number[] = [];
  edits.forEach((edit, n) => {
    const i = stepOfEdit(edit, steps, ids);
    if (i < 0) {
      plan.warnings.push(`edits[${n}]: the plan has no such footstep now; the edit waits.`);
      return;
    }
    if (i < fixed) return;
    const s = steps[i];
    if (edit.plant !== "auto") s.plant = edit.plant;
    if (edit.foot !== null && edit.foot !== s.foot) {
      plan.warnings.push(
        `edits[${n}].foot: this step belongs to a template, so its foot stays. Steps of the way between can be swapped.`,
      );
      return;
    }
    if (edit.position !== null || edit.yaw !== null) {
      const [x, y, z] = edit.position ?? [s.x, s.y, s.z];
      const far = groundDistance(s, { x, z });
      if (far > (edit.pinned ? LOST_PINNED : LOST)) {
        plan.warnings.push(
          `edits[${n}]: the plan now comes ${far.toFixed(2)} m from this footstep; the edit waits.`,
        );
        return;
      }
      if (edit.yaw !== null) s.yaw = wrapAngle(edit.yaw);
      if (!pivotEnd(s.category)) {
        s.x = x;
        s.y = y;
        s.z = z;
      }
      held[i] = 1;
      moved.push(i);
    }
  });
  const before = steps.map(footPose);
  for (const i of moved) answerAround(plan, i, held, prior, skeleton);
  for (const [n, edit] of edits.entries()) {
    const i = stepOfEdit(edit, steps, ids);
    if (i >= fixed && moved.includes(i)) holdInReach(plan, i, n, held, skeleton);
  }
  followPivots(plan, before, moved, skeleton);
  for (const edit of edits) {
    const i = stepOfEdit(edit, steps, ids);
    if (i >= fixed && edit.lift !== null && edit.land !== null) retime(plan, i, edit.land - edit.lift);
  }
  for (const edit of edits) {
    const i = stepOfEdit(edit, steps, ids);
    if (i >= fixed && edit.rest !== null) holdFor(plan, i, edit.rest);
  }
}

/** Whether a step is one of the last two before its task is done: the stance of the task. */
function inTaskStance(plan: Plan, index: number): boolean {
  const { task, foot } = plan.steps[index];
  let later = 0;
  for (let i = index + 1; i < plan.steps.length && plan.steps[i].task === task; i++) {
    if (plan.steps[i].foot === foot) return false;
    later++;
  }
  return task >= 0 && later <= 1;
}

/** Each step seen from the footstep before it, whatever its foot, as the plan has them: lateral, forward, yaw. */
function displacements(plan: Plan): Float64Array {
  const out = new Float64Array(3 * plan.steps.length);
  plan.steps.forEach((s, i) => {
    const before = i > 0 ? plan.steps[i - 1] : feetBefore(plan, 0)[otherFoot(s.foot)];
    const d = toLocal(footPose(before), footPose(s));
    out[3 * i] = d.x;
    out[3 * i + 1] = d.z;
    out[3 * i + 2] = d.yaw;
  });
  return out;
}

/** Where both feet are before step `index`. */
function feetBefore(plan: Plan, index: number): Feet {
  const feet: Feet = { left: plan.start[0], right: plan.start[1] };
  for (let i = 0; i < index; i++) feet[plan.steps[i].foot] = plan.steps[i];
  return feet;
}

const pose3 = (f: Footstep): Float64Array => Float64Array.of(f.x, f.z, f.yaw);

/** Optimises the footsteps about an edited one; the rest of the window stays. */
function answerAround(
  plan: Plan,
  index: number,
  held: Uint8Array,
  prior: Float64Array,
  skeleton: Skeleton,
): void {
  const { steps } = plan;
  const first = Math.max(0, index - AROUND);
  // One more at the end, pinned: what follows must still be reached.
  const last = Math.min(steps.length - 1, index + AROUND + 1);
  const n = last - first + 1;
  const feet = feetBefore(plan, first);
  const current = first > 0 ? steps[first - 1] : feet[otherFoot(steps[0].foot)];
  const previous = feet[otherFoot(current.foot)];
  const x = new Float64Array(3 * n);
  const pinned = new Uint8Array(n);
  for (let k = 0; k < n; k++) {
    const s = steps[first + k];
    x.set([s.x, s.z, s.yaw], 3 * k);
    pinned[k] = held[first + k] || first + k > index + AROUND || pivotEnd(s.category) ? 1 : 0;
  }
  const m = Math.min(3, n);
  const goals = new Float64Array(2 * m);
  for (let k = 0; k < m; k++) goals.set([x[3 * (n - m + k)], x[3 * (n - m + k) + 1]], 2 * k);
  const [wd, ws] = PHASE_WEIGHTS.locomotion;
  optimizeFootsteps(
    {
      n,
      previous: pose3(previous),
      current: pose3(current),
      desired: prior.slice(3 * first, 3 * (last + 1)),
      start: Float64Array.of(current.x, current.z),
      goal: Float64Array.of(steps[last].x, steps[last].z),
      goalYaw: 0,
      goals,
      // The way's own line and bearing no longer hold once the user leads it elsewhere; places do, lightly.
      weights: [wd, ws, 0, 0.1, 0],
      pinned,
    },
    x,
    createFootstepWorkspace(n),
  );
  for (let k = 0; k < n; k++) {
    if (pinned[k]) continue;
    const s = steps[first + k];
    s.x = x[3 * k];
    s.z = x[3 * k + 1];
    s.yaw = wrapAngle(x[3 * k + 2]);
  }
  keepApart(plan, first, last, pinned, skeleton);
}

/** Footsteps that the answer laid across the other foot are moved to their own side. */
function keepApart(plan: Plan, first: number, last: number, pinned: Uint8Array, skeleton: Skeleton): void {
  const least = TIDY.apart * skeleton.legLength;
  const feet = feetBefore(plan, first);
  for (let i = first; i <= last; i++) {
    const s = plan.steps[i];
    const stance = footPose(feet[otherFoot(s.foot)]);
    const side = s.foot === "left" ? 1 : -1;
    const local = toLocal(stance, footPose(s));
    const across = local.x * side;
    if (!pinned[i - first] && Math.abs(local.yaw) < 1.2 && across < least && Math.abs(local.z) < 0.6) {
      const push = (least - across) * side;
      s.x += Math.cos(stance.yaw) * push;
      s.z -= Math.sin(stance.yaw) * push;
    }
    feet[s.foot] = s;
  }
}

/** Pivots stay on the end that they turn about, where the footstep they turn from or their own yaw has changed. */
function followPivots(
  plan: Plan,
  before: readonly GroundPose[],
  moved: readonly number[],
  skeleton: Skeleton,
): void {
  const last: Record<Foot, number> = { left: -1, right: -1 };
  plan.steps.forEach((s, i) => {
    const end = pivotEnd(s.category);
    const k = last[s.foot];
    const from = k >= 0 ? plan.steps[k] : plan.start[s.foot === "left" ? 0 : 1];
    const changed = k >= 0 && (groundDistance(from, before[k]) > 0 || from.yaw !== before[k].yaw);
    if (end && (changed || moved.includes(i))) {
      const place = pivotPlace(skeleton.foot, from, s.yaw, end);
      s.x = place.x;
      s.z = place.z;
    }
    last[s.foot] = i;
  });
}

/** Draws `s` to within `longest` of `stance`. @returns how far it was, or 0 when it was near enough. */
function drawIn(s: PlannedStep, stance: Footstep, longest: number): number {
  const d = groundDistance(stance, s);
  if (d <= longest + 1e-6) return 0;
  s.x = stance.x + ((s.x - stance.x) * longest) / d;
  s.z = stance.z + ((s.z - stance.z) * longest) / d;
  return d;
}

/**
 * No leg reaches farther than it is long: neighbours are drawn in from both sides, and the edited footstep itself where
 * that is not enough, which the plan says.
 */
function holdInReach(plan: Plan, index: number, n: number, held: Uint8Array, skeleton: Skeleton): void {
  const { steps } = plan;
  const longest = TIDY.reach * skeleton.legLength;
  const first = Math.max(0, index - AROUND);
  const last = Math.min(steps.length - 1, index + AROUND + 1);
  let far = 0;
  const feet = feetBefore(plan, first);
  for (let i = first; i <= index; i++) {
    if (i === index || !held[i]) {
      const d = drawIn(steps[i], feet[otherFoot(steps[i].foot)], longest);
      if (i === index) far = d;
    }
    feet[steps[i].foot] = steps[i];
  }
  // What comes after is reached backwards, from the places that stay.
  for (let i = last - 1; i >= index; i--) {
    const next = steps.slice(i + 1, last + 1).find((s) => s.foot !== steps[i].foot);
    if (!next || (i !== index && held[i])) continue;
    const d = drawIn(steps[i], next, longest);
    if (i === index) far = Math.max(far, d);
  }
  if (far > 0)
    plan.warnings.push(
      `edits[${n}]: too far to reach in one step: ${far.toFixed(2)} m, ${longest.toFixed(2)} m at most.`,
    );
}

/** Stretches a step's segment so that its foot is in the air for `wanted` seconds; all that follows moves along. */
function retime(plan: Plan, index: number, wanted: number): void {
  const segment = plan.segments.find((s) => s.step === index);
  const step = plan.steps[index];
  const now = step.land - step.lift;
  if (!segment || now <= 0) return;
  stretchSegment(plan, segment, wanted / now);
}

/** Seconds that a foot rests after step `index`, until it lifts again; null for its last plant. */
export function restOf(steps: readonly PlannedStep[], index: number): number | null {
  const { land, foot } = steps[index];
  const lift = steps.find((s, i) => i > index && s.foot === foot)?.lift;
  return lift === undefined ? null : lift - land;
}

/**
 * Makes the plant that step `index` begins last `wanted` seconds: what happens while the foot rests takes that long, a task's hold where
 * there is one, else the other foot's steps. The last plant of a foot has no end to move.
 */
function holdFor(plan: Plan, index: number, wanted: number): void {
  const { land } = plan.steps[index];
  const rest = restOf(plan.steps, index);
  if (rest === null) return;
  const lift = land + rest;
  const within = plan.segments.filter(
    (s) => s.start / CLIP_RATE >= land - 1e-9 && (s.start + s.frames) / CLIP_RATE <= lift + 1e-9,
  );
  const holds = within.filter((s) => s.step < 0);
  const taken = holds.length > 0 ? holds : within;
  const now = taken.reduce((sum, s) => sum + s.frames, 0) / CLIP_RATE;
  if (now <= 0) return;
  const factor = (now + wanted - rest) / now;
  for (const s of taken) stretchSegment(plan, s, factor);
}

/** One segment takes `factor` times as long, within limits; everything in it and after it moves along. */
function stretchSegment(plan: Plan, segment: PlannedSegment, wanted: number): void {
  const factor = Math.max(STRETCH[0], Math.min(STRETCH[1], wanted));
  const frames = Math.max(2, Math.round(segment.frames * factor));
  const by = frames - segment.frames;
  if (by === 0) return;
  const from = segment.start / CLIP_RATE;
  const until = (segment.start + segment.frames) / CLIP_RATE;
  const real = frames / segment.frames;
  const shifted = (t: number): number =>
    t <= from ? t : t >= until - 1e-9 ? t + by / CLIP_RATE : from + (t - from) * real;
  segment.frames = frames;
  for (const s of plan.segments) if (s !== segment && s.start > segment.start) s.start += by;
  for (const s of plan.steps) {
    s.lift = shifted(s.lift);
    s.land = shifted(s.land);
  }
  for (const t of plan.tasks) {
    t.start = shifted(t.start);
    t.contact = shifted(t.contact);
    t.end = shifted(t.end);
  }
  plan.duration += by / CLIP_RATE;
}
