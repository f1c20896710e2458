/** From a scene document to a plan: tasks in their order, furniture, and what has begun. */
import { wrapAngle } from "../math/angle.ts";
import { obstacles } from "../scene/props.ts";
import type { Scene, SceneTask } from "../scene/types.ts";
import type { Skeleton } from "../skeleton/skeleton.ts";
import type { Library } from "../templates/types.ts";
import { applyEdits, feetWished } from "./edits.ts";
import { keepBegun } from "./keep.ts";
import { planTasks } from "./plan.ts";
import type { Plan } from "./plan-types.ts";
import type { TaskGoal } from "./transition.ts";

/** The scene's tasks in playing order. */
export function orderedTasks(scene: Scene): SceneTask[] {
  const byId = new Map(scene.tasks.map((t) => [t.id, t]));
  return scene.order.flatMap((id) => byId.get(id) ?? []);
}

/** Tasks as the planner reads them. */
export function goalsOf(scene: Scene): TaskGoal[] {
  return orderedTasks(scene).map((t) => ({
    id: t.id,
    category: t.category,
    effort: t.effort,
    frame: { x: t.position[0], z: t.position[2], yaw: wrapAngle(t.yaw) },
    height: t.position[1],
    duration: t.duration,
    hand: t.hand,
  }));
}

export interface PlanSceneOptions {
  /** An earlier plan of the same scene that is being played, and how far; null to plan from the start. */
  playing?: { plan: Plan; now: number; goals: readonly TaskGoal[] } | null;
  trace?: boolean;
}

/** Whether a task asks for the same thing. */
function same(a: TaskGoal | undefined, b: TaskGoal | undefined): boolean {
  return (
    a !== undefined &&
    b !== undefined &&
    a.category === b.category &&
    a.effort === b.effort &&
    a.hand === b.hand &&
    a.duration === b.duration &&
    Math.abs(a.frame.x - b.frame.x) +
      Math.abs(a.frame.z - b.frame.z) +
      Math.abs(a.height - b.height) +
      Math.abs(wrapAngle(a.frame.yaw - b.frame.yaw)) <
      1e-9
  );
}

/**
 * Plans a scene's tasks. While an earlier plan is played, the steps begun are kept; when a task already done has
 * changed, the plan starts afresh.
 */
export function planScene(
  scene: Scene,
  library: Library,
  skeleton: Skeleton,
  options: PlanSceneOptions = {},
): Plan {
  const goals = goalsOf(scene);
  const start = { x: scene.start.position[0], z: scene.start.position[1], yaw: wrapAngle(scene.start.yaw) };
  const playing = options.playing ?? null;
  const common = { library, skeleton, start, obstacles: obstacles(scene), trace: options.trace ?? false };
  const warnings: string[] = [];
  scene.tasks.forEach((t, i) => {
    if (t.category === "write" && t.position[1] > reachHeight(skeleton)) {
      warnings.push(
        `tasks[${i}].position: too high to reach: ${t.position[1].toFixed(2)} m, ${reachHeight(skeleton).toFixed(2)} m at most.`,
      );
    }
  });
  const wished = feetWished(
    scene.edits,
    goals.map((g) => g.id),
  );
  let plan: Plan | null = null;
  let begun = 0;
  if (playing && playing.now > 0) {
    const kept = keepBegun(playing.plan, playing.now);
    const unchanged = kept.done.every(
      (d, i) =>
        goals[i]?.id === d.id &&
        same(
          goals[i],
          playing.goals.find((g) => g.id === d.id),
        ),
    );
    if (unchanged && kept.done.length < goals.length) {
      begun = kept.steps.length;
      plan = planTasks({
        ...common,
        feetWished: wished,
        kept,
        keptTask: goals[kept.done.length - 1] ?? null,
        tasks: goals.slice(kept.done.length),
      });
    }
  }
  plan ??= planTasks({ ...common, feetWished: wished, kept: null, keptTask: null, tasks: goals });
  applyEdits(plan, scene.edits, skeleton, begun);
  plan.warnings.unshift(...warnings);
  return plan;
}

/** Highest point that a hand reaches standing flat, metres. */
function reachHeight(skeleton: Skeleton): number {
  return skeleton.height * 1.22;
}
