/**
 * A performance beside its plan [TaskLoco §7, ground truth]: what was performed, and the scene that asks for the same. Or a plan that
 * was kept as a result document beside the one that is made now.
 */
import type { SidecarTask } from "../../core/capture/sidecar.ts";
import { midPose } from "../../core/math/frame2.ts";
import { footstepsOf, type ResultDocument } from "../../core/scene/result.ts";
import { parseScene } from "../../core/scene/schema.ts";
import type { Scene } from "../../core/scene/types.ts";
import type { Proportions } from "../../core/skeleton/skeleton.ts";
import type { Footstep } from "../../core/steps/types.ts";
import type { Capture } from "../captures/capture.ts";

export interface Performance {
  name: string;
  height: number;
  proportions: Proportions | null;
  /** At 60 Hz: frames x 3, and frames x JOINT_COUNT x 4. */
  frames: number;
  root: Float32Array;
  rotations: Float32Array;
  start: [Footstep, Footstep];
  /** Up to the end of the last task: what follows is another task's. */
  steps: Footstep[];
  tasks: SidecarTask[];
}

/** What is shown beside the plan. */
export interface Shown {
  kind: "performance" | "result";
  /** At 60 Hz, as a performance has them; no frames: footsteps alone. */
  frames: number;
  root: Float32Array;
  rotations: Float32Array;
  start: readonly Footstep[];
  steps: readonly Footstep[];
  /** Seconds at which each task was touched. */
  contacts: readonly number[];
  /** Ids that the scene has as long as this is of it. */
  ids: readonly string[];
}

/** A performance as it is shown beside its plan. */
export const shownOf = (p: Performance): Shown => ({
  kind: "performance",
  frames: p.frames,
  root: p.root,
  rotations: p.rotations,
  start: p.start,
  steps: p.steps,
  contacts: p.tasks.map((t) => t.contact),
  ids: p.tasks.map((_, i) => performedId(i)),
});

/** The footsteps of a result as they are shown beside the plan that is made now. */
export const shownResult = (r: ResultDocument): Shown => ({
  kind: "result",
  frames: 0,
  root: new Float32Array(0),
  rotations: new Float32Array(0),
  ...footstepsOf(r),
  contacts: r.timing.tasks.map((t) => t.contact),
  ids: r.scene.order,
});

const performedId = (i: number): string => `performed-${i + 1}`;

/** What a capture shows. @throws Error that says what has to be marked first. */
export function performanceOf(c: Capture): Performance {
  const { clip, steps, tasks } = c;
  if (tasks.length === 0)
    throw new Error(`${c.key}: mark what is done in it first, under Tasks: a turn at least.`);
  const last = Math.max(...tasks.map((t) => t.end)) * clip.rate;
  const shown = (steps ?? []).filter((s) => s.start < last);
  const first = (foot: Footstep["foot"]): Footstep => {
    const found = (steps ?? []).find((s) => s.foot === foot);
    if (!found) throw new Error(`${c.key}: the ${foot} foot takes no step in it.`);
    return found.from;
  };
  return {
    name: c.key,
    height: clip.height,
    proportions: null,
    frames: clip.frames,
    root: clip.root,
    rotations: clip.rotations,
    start: [first("left"), first("right")],
    steps: shown.map((s) => s.to),
    tasks: [...tasks].sort((a, b) => a.contact - b.contact),
  };
}

/** The scene that asks for what was performed: from where the feet stood, to the same places, facing the same ways. */
export function sceneOf(p: Performance): Scene {
  const start = midPose(...p.start);
  return parseScene({
    version: 1,
    character: { height: p.height, ...(p.proportions ? { proportions: p.proportions } : {}) },
    start: { position: [start.x, start.z], yaw: start.yaw },
    tasks: p.tasks.map((t, i) => ({
      id: performedId(i),
      category: t.category,
      effort: t.effort,
      position:
        t.category === "turn" || t.category === "stand" ? [t.position[0], 0, t.position[2]] : t.position,
      yaw: t.yaw,
      ...(t.hand === "both" ? {} : { hand: t.hand }),
    })),
  });
}
