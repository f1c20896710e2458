/**
 * Timing of a plan: "the timing of the footstep plan is preserved from the original template" [TaskLoco §6].
 *
 * Steps become segments of their captures, each from the landing of the step before to its own landing, laid end
 * to end in frames of 1/60 s. Holds (the tasks themselves) may be stretched to the length that the scene asks for.
 */
import { CLIP_RATE } from "../capture/clip.ts";
import type { Library } from "../templates/types.ts";
import { type DraftStep, previousLanding } from "./draft.ts";
import type { PlannedSegment, PlannedStep } from "./plan-types.ts";

/** Longest both feet rest before a walking step, frames: a pause of the capture is not walked into. */
const LONGEST_LEAD = 20;
/** Longest lead of any other step. */
const LONGEST_PAUSE = 50;

export interface Timeline {
  steps: PlannedStep[];
  segments: PlannedSegment[];
  /** Frame at which the next segment begins. */
  cursor: number;
}

/**
 * Lays a step at the end of the timeline.
 *
 * @param from source frame its segment begins at, or null for the landing before it.
 */
export function appendStep(
  library: Library,
  timeline: Timeline,
  draft: DraftStep,
  task: number,
  from: number | null,
): void {
  const source = library.clips[draft.clip];
  const step = source.steps[draft.step];
  const longest =
    draft.category === "Walk" || draft.category === "TurnAndStep" ? LONGEST_LEAD : LONGEST_PAUSE;
  const begin =
    from ?? Math.max(Math.min(previousLanding(source, draft.step), step.start), step.start - longest);
  const first = Math.min(begin, step.start);
  const frames = Math.max(1, step.end - first);
  timeline.segments.push({
    clip: draft.clip,
    from: first,
    to: first + frames,
    start: timeline.cursor,
    frames,
    step: timeline.steps.length,
    task,
  });
  const { desired, ...rest } = draft;
  timeline.steps.push({
    ...rest,
    task,
    lift: (timeline.cursor + (step.start - first)) / CLIP_RATE,
    land: (timeline.cursor + frames) / CLIP_RATE,
  });
  timeline.cursor += frames;
}

/** Lays frames `from` to `to` of a clip without a step, stretched to `frames`. */
export function appendHold(
  timeline: Timeline,
  clip: number,
  from: number,
  to: number,
  frames: number,
  task: number,
): void {
  if (to <= from || frames <= 0) return;
  timeline.segments.push({ clip, from, to, start: timeline.cursor, frames, step: -1, task });
  timeline.cursor += frames;
}

/** Plan time (seconds) at which source frame `frame` of `clip` is shown by the segments from index `first` on; null when it is not. */
export function timeOfSource(
  segments: readonly PlannedSegment[],
  first: number,
  clip: number,
  frame: number,
): number | null {
  for (let i = first; i < segments.length; i++) {
    const s = segments[i];
    if (s.clip === clip && frame >= s.from && frame <= s.to) {
      return (s.start + ((frame - s.from) * s.frames) / (s.to - s.from)) / CLIP_RATE;
    }
  }
  return null;
}
