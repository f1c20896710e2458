/** Whether the whole motion has arrived. */
import type { Editor } from "../editor.ts";

/** A sentence while it has not; null when it has. */
export function motionMissing(e: Editor): string | null {
  const m = e.plan.motion.current;
  const s = e.store.getState();
  return m && m.filled >= m.frames && s.plan && s.quality ? null : "The motion is not finished yet.";
}
