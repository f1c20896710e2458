/**
 * The part of the body that meets a task, and when: the hand at the board, both hands at the box, the seat.
 *
 * A capture shows where the hand (or the hips) was in its own task's frame; laid on the scene's task it is where it must
 * be. Towards contact the body is led there by minimum jerk [Flash and Hogan 1985], after the end it is let go.
 */

import { CLIP_RATE } from "../capture/clip.ts";
import type { SidecarTask } from "../capture/sidecar.ts";
import type { GroundPose } from "../math/frame2.ts";
import { minimumJerk } from "../math/interpolate.ts";
import type { Plan } from "../tasks/plan-types.ts";
import type { TaskGoal } from "../tasks/transition.ts";
import type { Library } from "../templates/types.ts";

export interface TaskWindow {
  task: TaskGoal;
  /** Index in plan.tasks. */
  index: number;
  /** Clip and task of the library that perform it. */
  clip: number;
  /** The capture's task frame and height, the plan's task frame and height. */
  source: GroundPose & { y: number };
  target: GroundPose & { y: number };
  /** Plan frames: leading begins, contact, let go begins, over. */
  from: number;
  contact: number;
  end: number;
  over: number;
  /** Source frame of contact. */
  sourceContact: number;
  /** Source frames that show the task: other parts of the same capture may be played near by. */
  sourceFrom: number;
  sourceEnd: number;
}

/** Seconds of leading before contact and of letting go after, by category. */
const LEAD = { write: 0.7, lift: 0.8, place: 0.9, sit: 0.9, stand: 0, turn: 0 } as const;
const RELEASE = { write: 0.5, lift: 0.9, place: 0.6, sit: 0.8, stand: 0, turn: 0 } as const;

/** The windows of a plan's tasks, in order. */
export function taskWindows(
  library: Library,
  plan: Plan,
  goals: ReadonlyMap<string, TaskGoal>,
): TaskWindow[] {
  const out: TaskWindow[] = [];
  plan.tasks.forEach((t, index) => {
    const task = goals.get(t.id);
    if (!task || t.clip < 0 || LEAD[task.category] === 0) return;
    const shown = library.clips[t.clip].tasks[t.clipTask];
    const contact = Math.round(t.contact * CLIP_RATE);
    const end = Math.max(contact + 1, Math.round(t.end * CLIP_RATE));
    out.push({
      task,
      index,
      clip: t.clip,
      source: { x: shown.position[0], z: shown.position[2], yaw: shown.yaw, y: shown.position[1] },
      target: { ...task.frame, y: task.height },
      from: contact - Math.round(LEAD[task.category] * CLIP_RATE),
      contact,
      end,
      over: end + Math.round(RELEASE[task.category] * CLIP_RATE),
      sourceContact: Math.round(shown.contact * CLIP_RATE),
      sourceFrom: Math.round((shown.contact - 2) * CLIP_RATE),
      sourceEnd: Math.round((shown.end + 0.2) * CLIP_RATE),
    });
  });
  return out;
}

/** Whether a segment's source frame shows the window's task. */
export function shows(w: TaskWindow, clip: number, source: number): boolean {
  return clip === w.clip && source >= w.sourceFrom && source <= w.sourceEnd;
}

/** How firmly a window holds at a frame: 0 outside, 1 from contact to end. */
export function windowWeight(w: TaskWindow, frame: number): number {
  if (frame <= w.from || frame >= w.over) return 0;
  if (frame < w.contact) return minimumJerk((frame - w.from) / (w.contact - w.from));
  if (frame <= w.end) return 1;
  return 1 - minimumJerk((frame - w.end) / (w.over - w.end));
}

/** A point of the capture, laid from its task's frame onto the scene's: out[o..o+2]. */
export function mapByTask(
  out: Float64Array,
  o: number,
  w: TaskWindow,
  x: number,
  y: number,
  z: number,
): void {
  const turn = w.target.yaw - w.source.yaw;
  const c = Math.cos(turn);
  const s = Math.sin(turn);
  const dx = x - w.source.x;
  const dz = z - w.source.z;
  out[o] = w.target.x + c * dx + s * dz;
  out[o + 1] = w.target.y + (y - w.source.y);
  out[o + 2] = w.target.z - s * dx + c * dz;
}

/** Arms that have been let go still come down for so long, seconds. */
const COMES_DOWN = 0.4;

/** Whether arms or hips are led to a task, or come back from one, anywhere between two frames of a capture. */
export function ledBetween(tasks: readonly SidecarTask[], from: number, to: number): boolean {
  return tasks.some(
    (t) =>
      LEAD[t.category] > 0 &&
      (t.contact - LEAD[t.category]) * CLIP_RATE < to &&
      (t.end + RELEASE[t.category] + COMES_DOWN) * CLIP_RATE > from,
  );
}
