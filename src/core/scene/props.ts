/** Furniture: what belongs to a task, and what a walker may not enter. */
import { groundDistance, toLocal } from "../math/frame2.ts";
import type { Obstacle } from "../tasks/route.ts";
import type { Scene, SceneProp, SceneTask } from "./types.ts";

/**
 * The props that go with a task when it is moved: the board written on, the table a box stands on and the box, the
 * stool sat on. Found by place; none for tasks in the open.
 */
export function propsOfTask(scene: Scene, task: SceneTask): SceneProp[] {
  const kinds = {
    write: ["board"],
    lift: ["table", "box"],
    place: ["table"],
    sit: ["stool"],
    stand: [],
    turn: [],
  }[task.category] as string[];
  const at = { x: task.position[0], z: task.position[2], yaw: 0 };
  return kinds.flatMap((kind) => {
    const near = scene.props
      .filter((p) => p.kind === kind)
      .map((p) => {
        const local = toLocal({ x: p.position[0], z: p.position[2], yaw: p.yaw }, at);
        const inside = Math.abs(local.x) <= p.size[0] / 2 + 0.25 && Math.abs(local.z) <= p.size[2] / 2 + 0.25;
        return { p, inside, d: groundDistance(at, { x: p.position[0], z: p.position[2] }) };
      })
      .filter((x) => x.inside)
      .sort((a, b) => a.d - b.d);
    return near.length > 0 ? [near[0].p] : [];
  });
}

/** What stands in the way on the ground. Boxes on tables and boards hung high count by what is under them. */
export function obstacles(scene: Scene): Obstacle[] {
  const out: Obstacle[] = [];
  for (const p of scene.props) {
    const at = { id: p.id, x: p.position[0], z: p.position[2] };
    if (p.kind === "stool" || p.kind === "pillar")
      out.push({ kind: "disc", ...at, radius: Math.max(p.size[0], p.size[2]) / 2 });
    else if (p.kind === "box" && p.position[1] > 0.6) continue;
    else
      out.push({
        kind: "box",
        ...at,
        yaw: p.yaw,
        halfWidth: p.size[0] / 2,
        halfDepth: Math.max(0.02, p.size[2] / 2),
      });
  }
  return out;
}
