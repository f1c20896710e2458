/**
 * The plan while it is being made: where the feet are, the steps laid so far, and the clips they come from.
 */

import type { GroundPose } from "../math/frame2.ts";
import { toLocal } from "../math/frame2.ts";
import type { Foot, Footstep, Phase, StepCategory } from "../steps/types.ts";
import type { Library, LibraryClip, Template } from "../templates/types.ts";

/** A step that is laid but not yet timed. */
export interface DraftStep extends Footstep {
  category: StepCategory;
  phase: Phase;
  template: string | null;
  clip: number;
  step: number;
  /** Desired displacement in the frame of the footstep before it: lateral, forward, yaw [TaskLoco eq. 12]. */
  desired: [number, number, number];
}

export interface Feet {
  left: Footstep;
  right: Footstep;
}

export const otherFoot = (foot: Foot): Foot => (foot === "left" ? "right" : "left");

export function footPose(f: Footstep): GroundPose {
  return { x: f.x, z: f.z, yaw: f.yaw };
}

/** Where both feet of a clip rest just before its step `index`. */
export function stanceBefore(clip: LibraryClip, index: number): Feet {
  let left = clip.initialStance[0];
  let right = clip.initialStance[1];
  for (let i = 0; i < index; i++) {
    const s = clip.steps[i];
    if (s.foot === "left") left = s.to;
    else right = s.to;
  }
  return { left, right };
}

/** Last frame at which an earlier step of the clip lands; 0 for the first. */
export function previousLanding(clip: LibraryClip, index: number): number {
  let frame = 0;
  for (let i = 0; i < index; i++) frame = Math.max(frame, clip.steps[i].end);
  return frame;
}

/**
 * A template's steps as drafts with their desired displacements; places are the capture's own.
 *
 * The footstep "before" a step is the one planned before it, whatever its foot; before the first it is the
 * stance foot's [reading of TaskLoco eq. 12 in docs/taskloco-planner.md].
 */
export function templateSteps(library: Library, template: Template): DraftStep[] {
  return clipSteps(
    library.clips[template.clip],
    template.clip,
    template.first,
    template.last,
    template.phase,
    template.id,
  );
}

/** Steps first..last-1 of a clip as drafts. */
export function clipSteps(
  source: LibraryClip,
  clip: number,
  first: number,
  last: number,
  phase: Phase,
  template: string | null,
): DraftStep[] {
  const out: DraftStep[] = [];
  if (first >= last) return out;
  const stance = stanceBefore(source, first);
  let before = footPose(stance[otherFoot(source.steps[first].foot)]);
  for (let i = first; i < last; i++) {
    const s = source.steps[i];
    const d = toLocal(before, footPose(s.to));
    out.push({
      foot: s.foot,
      x: s.to.x,
      y: 0,
      z: s.to.z,
      yaw: s.to.yaw,
      category: s.category,
      phase,
      template,
      clip,
      step: i,
      desired: [d.x, d.z, d.yaw],
    });
    before = footPose(s.to);
  }
  return out;
}
