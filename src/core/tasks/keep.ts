/**
 * Re-planning in mid-stride: the steps already begun stay as they are [DESIGN of live editing]; what follows is new.
 */
import { CLIP_RATE } from "../capture/clip.ts";
import type { Footstep } from "../steps/types.ts";
import type { Feet } from "./draft.ts";
import type { Plan, PlannedSegment, PlannedStep, PlannedTask } from "./plan-types.ts";

export interface Kept {
  /** The stance that the whole plan begins with: left, right. */
  start: [Footstep, Footstep];
  steps: PlannedStep[];
  segments: PlannedSegment[];
  /** Frame at which the new part begins. */
  cursor: number;
  feet: Feet;
  /** Tasks whose contact has been made, in order. */
  done: PlannedTask[];
  /** Foot that landed last, null when both have stood since. */
  lastFoot: PlannedStep["foot"] | null;
}

/**
 * The part of a plan that has begun at `now` seconds.
 *
 * A task that has made contact is played to its end; one that has not is left at once, in the stance it found.
 */
export function keepBegun(plan: Plan, now: number): Kept {
  const frame = Math.floor(now * CLIP_RATE);
  const done = plan.tasks.filter((t) => t.contact <= now);
  const holdUntil = done.length > 0 ? Math.ceil(done[done.length - 1].end * CLIP_RATE - 1e-6) : 0;
  const segments: PlannedSegment[] = [];
  let steps = 0;
  let cursor = 0;
  for (const s of plan.segments) {
    const begun = s.step >= 0 ? plan.steps[s.step].lift * CLIP_RATE <= frame + 1 : s.start <= frame;
    if (!begun && s.start + 1 >= holdUntil) {
      // A segment whose double support has begun but whose foot still rests is cut there.
      if (s.start <= frame) {
        const frames = frame + 1 - s.start;
        const source = Math.max(1, Math.round((frames * (s.to - s.from)) / s.frames));
        segments.push({ ...s, to: s.from + source, frames, step: -1 });
        cursor = s.start + frames;
      }
      break;
    }
    if (s.step < 0 && s.start + s.frames > Math.max(holdUntil, frame + 1)) {
      const frames = Math.max(holdUntil, frame + 1) - s.start;
      const source = Math.max(1, Math.round((frames * (s.to - s.from)) / s.frames));
      segments.push({ ...s, to: s.from + source, frames });
      cursor = s.start + frames;
      break;
    }
    segments.push(s);
    if (s.step >= 0) steps = s.step + 1;
    cursor = s.start + s.frames;
  }
  const kept = plan.steps.slice(0, steps);
  const feet: Feet = { left: plan.start[0], right: plan.start[1] };
  for (const s of kept) feet[s.foot] = footstepOf(s);
  const last = segments[segments.length - 1];
  return {
    start: plan.start,
    steps: kept,
    segments,
    cursor,
    feet,
    done,
    lastFoot: last && last.step >= 0 ? plan.steps[last.step].foot : null,
  };
}

/** The footstep of a planned step. */
export function footstepOf(s: PlannedStep): Footstep {
  return { foot: s.foot, x: s.x, y: s.y, z: s.z, yaw: s.yaw };
}
