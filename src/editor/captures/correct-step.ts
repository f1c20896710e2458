/** A step corrected by hand [TaskLoco §4.1]. */
import type { Step } from "../../core/steps/types.ts";

export type StepChange = Partial<Pick<Step, "start" | "end" | "category" | "phase">>;

/** All steps with one changed; its frames are held inside the clip and in order. Null where there is no such step. */
export function correctStep(
  steps: readonly Step[],
  index: number,
  change: StepChange,
  frames: number,
): Step[] | null {
  const before = steps[index];
  if (!before) return null;
  const s = { ...before, ...change };
  const last = frames - 1;
  s.start = Math.max(0, Math.min(last - 1, Math.round(s.start)));
  s.end = Math.max(s.start + 1, Math.min(last, Math.round(s.end)));
  s.airStart = Math.max(s.start, Math.min(s.end, s.airStart));
  s.airEnd = Math.max(s.airStart, Math.min(s.end, s.airEnd));
  return steps.map((x, i) => (i === index ? s : x));
}
