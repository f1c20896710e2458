/** Going to tasks and doing them: where the body stands for each, how it comes and goes, what is written into the score. */
import type { SidecarTask } from "../../core/capture/sidecar.ts";
import { wrapAngle } from "../../core/math/angle.ts";
import { bearing, type GroundPose, groundDistance, toLocal, toWorld } from "../../core/math/frame2.ts";
import type { Effort, TaskCategory } from "../../core/scene/task-types.ts";
import type { WriteEvent } from "../score.ts";
import {
  look,
  middle,
  openTowards,
  other,
  shuffleTo,
  sideOf,
  sideStepTo,
  step,
  turnIn,
  type Walker,
  wait,
  walkTo,
} from "./walker.ts";

const DEG = Math.PI / 180;

export interface Goal {
  category: TaskCategory;
  effort?: Effort;
  x: number;
  z: number;
  yaw: number;
  /** Height of the point, box or seat, metres. */
  y?: number;
  hand?: "left" | "right";
  /** Seconds of writing or sitting. */
  hold?: number;
  /** A small step forward or back at the task. */
  adjust?: number;
  /** Bow of the way there, share of its length. */
  curve?: number;
}

/** Where the ankles' middle stands for a task, metres in the task's frame. */
export function standFor(goal: Goal, scale: number): GroundPose {
  const frame = { x: goal.x, z: goal.z, yaw: goal.yaw };
  switch (goal.category) {
    case "write": {
      const side = goal.hand === "left" ? -1 : 1;
      return toWorld(frame, { x: 0.17 * scale * side, z: -0.47 * scale, yaw: 0 });
    }
    case "lift":
    case "place":
      return toWorld(frame, { x: 0, z: -0.345 * scale, yaw: 0 });
    case "sit":
      return toWorld(frame, { x: 0, z: 0.33 * scale, yaw: 0 });
    default:
      return frame;
  }
}

const previous: WeakMap<Walker, Goal> = new WeakMap();

/** Goes to a task and does it. */
export function perform(w: Walker, goal: Goal, next: Goal | null): void {
  go(w, goal, next);
  act(w, goal, next);
  previous.set(w, goal);
}

function target(goal: Goal): [number, number, number] {
  return [goal.x, goal.y ?? 1, goal.z];
}

function go(w: Walker, goal: Goal, next: Goal | null): void {
  const place = standFor(goal, w.scale);
  const last = previous.get(w);
  const from = middle(w);
  const way = groundDistance(from, place);
  const course = way > 0.15 ? bearing(from, place) : place.yaw;
  const local = toLocal(from, place);
  const pivots = goal.category === "write" || goal.category === "sit" || goal.category === "turn";
  const leaves =
    last === undefined ||
    last.category === "write" ||
    last.category === "sit" ||
    last.category === "turn" ||
    last.category === "stand";
  look(w, target(goal), 0.02);
  if (goal.category === "turn") {
    openTowards(w, course, leaves && !w.carrying);
    turnAt(w, goal, course);
    return;
  }
  const facing = Math.abs(wrapAngle(place.yaw - from.yaw));
  if (goal.effort === 0 && goal.category === "write" && tapInPassing(w, goal, next, way, course)) return;
  if (
    way < 0.95 * w.scale &&
    facing < 28 * DEG &&
    Math.abs(local.x) > 1.2 * Math.abs(local.z) &&
    Math.abs(local.x) > 0.1
  ) {
    const short = goal.effort === 0 ? Math.min(1, Math.max(0.3, 1 - 0.35 / Math.abs(local.x))) : 1;
    const at = {
      x: from.x + short * (place.x - from.x),
      z: from.z + short * (place.z - from.z),
      yaw: place.yaw,
    };
    sideStepTo(w, at);
    return;
  }
  if (way < 0.45 * w.scale && facing < 25 * DEG) {
    shuffleTo(w, place, local.x > 0 ? "left" : "right");
    return;
  }
  openTowards(w, course, leaves && !w.carrying);
  if (goal.curve) {
    const stop = { x: place.x - Math.sin(course) * 0.9, z: place.z - Math.cos(course) * 0.9 };
    if (way > 2) walkTo(w, stop, null, goal.curve);
  }
  const adjust = goal.adjust ?? (goal.category === "sit" ? -0.13 : 0);
  const stop = toWorld(place, { x: 0, z: -adjust * w.scale, yaw: 0 });
  turnIn(w, stop, { pivots: pivots && !w.carrying, both: goal.category === "sit" });
  if (adjust !== 0) shuffleTo(w, place, w.lastFoot ? other(w.lastFoot) : "right");
}

/** A quick touch on the way: one foot ahead beside the point, body half turned, and on. */
function tapInPassing(w: Walker, goal: Goal, next: Goal | null, way: number, course: number): boolean {
  if (!next || way < 0.9 * w.scale) return false;
  const onward = bearing(goal, next);
  if (Math.abs(wrapAngle(onward - course)) > 70 * DEG) return false;
  const across = wrapAngle(goal.yaw - course);
  if (Math.abs(across) < 30 * DEG || Math.abs(across) > 125 * DEG) return false;
  openTowards(w, course, !w.carrying);
  const side = goal.hand === "left" ? -1 : 1;
  const stand = toWorld(
    { x: goal.x, z: goal.z, yaw: goal.yaw },
    { x: 0.05 * side, z: -0.5 * w.scale, yaw: 0 },
  );
  // The foot on the board's side is ahead, so that the hips can open to it.
  const near = across > 0 ? "left" : "right";
  const before = {
    x: stand.x - Math.sin(course) * 0.3 * w.scale,
    z: stand.z - Math.cos(course) * 0.3 * w.scale,
  };
  walkTo(w, before, other(near));
  const centre = { x: stand.x, z: stand.z, yaw: course + 0.4 * across };
  step(
    w,
    near,
    "turnStep",
    toWorld(centre, { x: sideOf(near) * 0.09 * w.scale, z: 0.08 * w.scale, yaw: 0.1 * across }),
    1.05,
  );
  step(
    w,
    other(near),
    "walk",
    toWorld(
      { ...centre, yaw: course + 0.3 * across },
      { x: sideOf(other(near)) * 0.1 * w.scale, z: -0.05 * w.scale, yaw: 0.1 * across },
    ),
    1.05,
  );
  return true;
}

/** Turns on a spot by turning steps, inner foot first, ending on one foot with the other free to go on. */
function turnAt(w: Walker, goal: Goal, course: number): void {
  const turn = wrapAngle(goal.yaw - course);
  const inner = turn > 0 ? "left" : "right";
  const before = {
    x: goal.x - Math.sin(course) * 0.3 * w.scale,
    z: goal.z - Math.cos(course) * 0.3 * w.scale,
  };
  if (groundDistance(middle(w), before) > 0.3 * w.scale)
    walkTo(w, before, Math.abs(turn) > 25 * DEG ? other(inner) : null, goal.curve ?? 0);
  let foot = w.lastFoot ? other(w.lastFoot) : inner;
  let yaw = course;
  const n = Math.max(1, Math.ceil(Math.abs(turn) / (58 * DEG)));
  for (let k = n; k >= 1; k--) {
    yaw += wrapAngle(goal.yaw - yaw) / k;
    const m = middle(w);
    const f = 1 / k;
    const centre = { x: m.x + f * (goal.x - m.x), z: m.z + f * (goal.z - m.z), yaw };
    step(
      w,
      foot,
      "turnStep",
      toWorld(centre, { x: sideOf(foot) * 0.095 * w.scale, z: 0, yaw: sideOf(foot) * 0.1 }),
    );
    foot = other(foot);
  }
  if (Math.abs(turn) > 100 * DEG) {
    // The foot left behind turns with the body on its ball.
    const yawNow = w.feet[foot].yaw;
    const rest = wrapAngle(goal.yaw - yawNow);
    if (Math.abs(rest) > 20 * DEG) step(w, foot, "toePivot", { ...w.feet[foot], yaw: yawNow + 0.75 * rest });
  }
}

function task(goal: Goal, start: number, contact: number, end: number): SidecarTask {
  const round = (t: number) => Math.round(t * 60) / 60;
  return {
    category: goal.category,
    effort: goal.effort ?? 1,
    position: [
      goal.x,
      goal.y ??
        (goal.category === "write"
          ? 1.35
          : goal.category === "sit"
            ? 0.46
            : goal.category === "turn"
              ? 0
              : 0.87),
      goal.z,
    ],
    yaw: goal.yaw,
    start: round(start),
    contact: round(contact),
    end: round(end),
    hand: goal.category === "write" ? (goal.hand ?? "right") : "both",
  };
}

function act(w: Walker, goal: Goal, next: Goal | null): void {
  const t = w.time;
  switch (goal.category) {
    case "write": {
      if (goal.effort === 0) {
        // The hand is already coming as the foot lands.
        const contact = t + 0.2;
        w.events.push({
          type: "write",
          task: task(goal, t - 0.35, contact, contact + 0.2),
          strokes: [
            {
              times: [contact, contact + 0.2],
              points: [
                [0, 0],
                [0.004, 0.002],
              ],
            },
          ],
        });
        w.time = contact + 0.12;
        break;
      }
      const contact = t + 0.42;
      const strokes = circles(w, contact, goal.hold ?? 2);
      const last = strokes[strokes.length - 1];
      const end = last.times[last.times.length - 1];
      w.events.push({ type: "write", task: task(goal, t - 0.2, contact, end), strokes });
      w.time = end + 0.15;
      w.lastFoot = null;
      break;
    }
    case "lift": {
      const start = t + 0.02;
      const contact = start + 0.85;
      const end = contact + 0.95;
      w.events.push({
        type: "lift",
        task: task(goal, start, contact, end),
        mass: 10,
        size: [0.36, 0.26, 0.28],
      });
      w.time = end + 0.02;
      w.lastFoot = null;
      w.carrying = true;
      break;
    }
    case "place": {
      const start = t + 0.02;
      const contact = start + 0.9;
      const end = contact + 0.75;
      w.events.push({ type: "place", task: task(goal, start, contact, end) });
      w.time = end + 0.05;
      w.lastFoot = null;
      w.carrying = false;
      break;
    }
    case "sit": {
      const start = t + 0.05;
      const contact = start + 1.05;
      const off = contact + (goal.hold ?? 2.6);
      const rise = next ? off - 0.55 : null;
      w.events.push({ type: "sit", task: task(goal, start, contact, off), rise });
      w.gaze.push({ time: contact + 0.4, target: null });
      w.time = off + (next ? 0.75 : 0.6);
      w.lastFoot = null;
      break;
    }
    default: {
      w.events.push({
        type: "note",
        task: task(goal, t - 0.3, t, t + (goal.category === "stand" ? 1.2 : 0.03)),
      });
      if (goal.category === "stand") wait(w, 1.2);
    }
  }
}

/** Circles on the board at about 0.7 a second, beginning at the point itself. */
function circles(w: Walker, contact: number, hold: number): WriteEvent["strokes"] {
  const strokes: WriteEvent["strokes"] = [];
  let t = contact;
  let cx = 0;
  const count = Math.max(1, Math.round(hold / 1.35));
  for (let k = 0; k < count; k++) {
    const r = 0.05 + 0.025 * w.random.next();
    const d = 1.15 + 0.15 * w.random.next();
    const times: number[] = [];
    const points: [number, number][] = [];
    const n = Math.round(d * 60);
    for (let i = 0; i <= n; i++) {
      const u = i / n;
      const a = 2 * Math.PI * (u * u * (3 - 2 * u) * 0.5 + 0.5 * u);
      times.push(t + i / 60);
      points.push([cx + r * Math.sin(a), r * (Math.cos(a) - 1)]);
    }
    strokes.push({ times, points });
    t += n / 60 + 0.25;
    cx += 0.06;
  }
  return strokes;
}
