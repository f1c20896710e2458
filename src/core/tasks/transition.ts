/** Which templates a transition may use: queries, competition, and laying them in the world [TaskLoco §4.2]. */
import { type GroundPose, toLocal, toWorld } from "../math/frame2.ts";
import type { Effort, TaskCategory } from "../scene/task-types.ts";
import type { Library, Template } from "../templates/types.ts";
import { type DraftStep, type Feet, footPose, otherFoot, stanceBefore, templateSteps } from "./draft.ts";
import type { Candidate } from "./plan-types.ts";
import type { Obstacle } from "./route.ts";
import { collisions } from "./tidy.ts";

/** What an obstacle in the way of a template costs, in the metrics' units (w_d times centimetres): more than a metre. */
const COLLISION_COST = 0.12;
/** Hips this near an obstacle count as in it, metres. */
const HIP_RADIUS = 0.12;

export interface Competitor {
  template: Template;
  distance: number;
}

/** A task's frame in a capture: its ground place and yaw. */
export function sourceTaskFrame(library: Library, template: Template): GroundPose {
  const task = library.clips[template.clip].tasks[template.task];
  return { x: task.position[0], z: task.position[2], yaw: task.yaw };
}

/** A template as it lies when its task's frame is laid on `frame`: steps, and the stance before them. */
export function layInTaskFrame(
  library: Library,
  template: Template,
  frame: GroundPose,
): { steps: DraftStep[]; stance: Feet; before: GroundPose[] } {
  const source = sourceTaskFrame(library, template);
  const clip = library.clips[template.clip];
  const lay = (p: GroundPose) => toWorld(frame, toLocal(source, p));
  const steps = templateSteps(library, template).map((s) => ({ ...s, ...lay(s) }));
  const stance = stanceBefore(clip, template.first);
  const laid: Feet = {
    left: { ...stance.left, ...lay(footPose(stance.left)) },
    right: { ...stance.right, ...lay(footPose(stance.right)) },
  };
  const before: GroundPose[] = [];
  for (let i = Math.max(0, template.first - 3); i < template.first; i++)
    before.push(lay(footPose(clip.steps[i].to)));
  return { steps, stance: laid, before };
}

/** A template's steps chained from the present feet: each as far from the one before it as in the capture. */
export function chainFrom(library: Library, template: Template, feet: Feet): DraftStep[] {
  const steps = templateSteps(library, template);
  if (steps.length === 0) return steps;
  let before: GroundPose = footPose(feet[otherFoot(steps[0].foot)]);
  for (const s of steps) {
    const p = toWorld(before, { x: s.desired[0], z: s.desired[1], yaw: s.desired[2] });
    s.x = p.x;
    s.z = p.z;
    s.yaw = p.yaw;
    before = p;
  }
  return steps;
}

/**
 * Ranks competitors by their distance, what stands in their way, and how badly their first stance fits the feet;
 * the winner first.
 *
 * @param lay places a template's footsteps in the world.
 */
export function compete(
  library: Library,
  competitors: readonly Competitor[],
  lay: (template: Template) => DraftStep[],
  obstacles: readonly Obstacle[],
  extra: (template: Template) => number,
): { winner: Template | null; list: Candidate[] } {
  const rows = competitors.map((c) => ({
    template: c.template,
    distance: c.distance,
    cost:
      c.distance + COLLISION_COST * collisions(lay(c.template), obstacles, HIP_RADIUS) + extra(c.template),
  }));
  rows.sort((a, b) => a.cost - b.cost || (a.template.id < b.template.id ? -1 : 1));
  return {
    winner: rows[0]?.template ?? null,
    list: rows.map((r, i) => ({
      template: r.template.id,
      distance: r.cost,
      chosen: i === 0,
      steps: library.clips[r.template.clip].steps
        .slice(r.template.first, r.template.last)
        .map((s) => ({ foot: s.foot, category: s.category })),
    })),
  };
}

/** The parts of a scene's task that the planner reads. */
export interface TaskGoal {
  id: string;
  category: TaskCategory;
  effort: Effort;
  frame: GroundPose;
  height: number;
  duration: number | null;
  hand: "left" | "right";
}
