/** The task itself: its capture played on after the last footstep of the entry, stretched to the length asked for. */
import { CLIP_RATE } from "../capture/clip.ts";
import type { TaskCategory } from "../scene/task-types.ts";
import type { Library, Template } from "../templates/types.ts";
import type { PlannedTask } from "./plan-types.ts";
import { appendHold, type Timeline, timeOfSource } from "./timeline.ts";
import type { TaskGoal } from "./transition.ts";

/** Frames of standing shown for a `stand` without a length. */
const STAND_FRAMES = 90;
/** A stretch slows a capture at most this much; a longer hold waits in its stillest part. */
const SLOWEST = 3;

/** Source times (seconds) between which a task may be stretched: the still part of it. */
function stillPart(category: TaskCategory, contact: number, end: number): [number, number] {
  switch (category) {
    case "sit": {
      // Settling after contact and the rise before the end keep their time.
      const a = Math.min(contact + 1, (contact + end) / 2);
      return [a, Math.max(a + 0.1, end - 1.5)];
    }
    case "lift":
    case "place":
      return [end - 0.1, end];
    default:
      return [contact, end];
  }
}

/**
 * Appends the hold of a task and notes its times.
 *
 * @param entry the template whose capture performs it; null for standing where one is.
 * @param firstSegment first segment that leads to the task.
 * @param final whether the plan ends with it: a sitter then stays seated.
 * @param carrying whether a box is held: one who stands then keeps the arms that hold it.
 */
export function holdAtTask(
  library: Library,
  timeline: Timeline,
  tasks: PlannedTask[],
  entry: Template | null,
  task: TaskGoal,
  index: number,
  firstSegment: number,
  final: boolean,
  carrying: boolean,
): void {
  const before = timeline.cursor / CLIP_RATE;
  if (!entry) {
    const wanted = Math.round((task.duration ?? STAND_FRAMES / CLIP_RATE) * CLIP_RATE);
    if (carrying) standOn(library, timeline, wanted, index);
    else standIdle(library, timeline, wanted, index);
    tasks.push({
      id: task.id,
      start: before,
      contact: before,
      end: timeline.cursor / CLIP_RATE,
      clip: -1,
      clipTask: -1,
    });
    return;
  }
  const source = library.clips[entry.clip];
  const shown = source.tasks[entry.task];
  const lastStep =
    entry.last > entry.first ? source.steps[entry.last - 1].end : Math.round(shown.start * CLIP_RATE);
  const end = Math.max(lastStep, Math.round(shown.end * CLIP_RATE));
  const [a, b] = stillPart(task.category, shown.contact, shown.end).map((t) =>
    Math.max(lastStep, Math.min(end, Math.round(t * CLIP_RATE))),
  );
  const natural = shown.end - shown.contact;
  const extra = task.duration === null ? 0 : Math.round((task.duration - natural) * CLIP_RATE);
  appendHold(timeline, entry.clip, lastStep, a, a - lastStep, index);
  const middle = b - a;
  const stretched = Math.max(Math.min(middle, 6), middle + extra);
  const most = middle * SLOWEST;
  const seatedTo = final && task.category === "sit" ? b : end;
  if (middle > 0) {
    appendHold(timeline, entry.clip, a, b, Math.min(stretched, most), index);
    if (stretched > most) appendHold(timeline, entry.clip, b - 1, b, stretched - most, index);
  } else if (extra > 0) {
    appendHold(timeline, entry.clip, Math.max(0, b - 1), Math.max(1, b), extra, index);
  }
  if (seatedTo > b) appendHold(timeline, entry.clip, b, seatedTo, seatedTo - b, index);
  const at = (seconds: number) =>
    timeOfSource(timeline.segments, firstSegment, entry.clip, Math.round(seconds * CLIP_RATE));
  const contact = at(shown.contact) ?? before;
  const finish = timeline.cursor / CLIP_RATE;
  tasks.push({
    id: task.id,
    start: Math.min(contact, at(shown.start) ?? before),
    contact,
    end: final && task.category === "sit" ? finish : Math.max(contact, at(shown.end) ?? finish),
    clip: entry.clip,
    clipTask: entry.task,
  });
}

/** Frames before a first step in which a body already shifts its weight. */
const SHIFT = 24;

/** Standing as captures begin: arms down, both feet flat, breathing; slowed, and begun again where it is not long enough. */
function standIdle(library: Library, timeline: Timeline, frames: number, index: number): void {
  const clip = library.clips.findIndex((c) => c.steps.length > 0 && c.steps[0].start >= 2 * SHIFT);
  if (clip < 0) {
    standOn(library, timeline, frames, index);
    return;
  }
  const calm = library.clips[clip].steps[0].start - SHIFT;
  for (let left = frames; left > 0; ) {
    const now = Math.min(left, SLOWEST * calm);
    appendHold(timeline, clip, 0, Math.max(1, Math.round(Math.min(calm, now))), now, index);
    left -= now;
  }
}

/** Standing as the capture shown stands, until its next step; beyond that its last instant is held. */
function standOn(library: Library, timeline: Timeline, frames: number, index: number): void {
  const last = timeline.segments[timeline.segments.length - 1];
  const clip = last?.clip ?? 0;
  const source = library.clips[clip];
  const begin = last ? last.to : 0;
  const nextStep = source.steps.find((s) => s.start >= begin);
  const room = Math.max(1, (nextStep ? nextStep.start - SHIFT : source.clip.frames - 1) - begin);
  const moving = Math.min(frames, SLOWEST * room);
  appendHold(timeline, clip, begin, begin + Math.min(room, moving), moving, index);
  if (frames > moving) appendHold(timeline, clip, begin + room - 1, begin + room, frames - moving, index);
}
