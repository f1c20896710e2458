/** Seeded scenes for the planner: 2 to 6 tasks in 8 x 8 m, furniture in the way. */
import { createRandom } from "../../src/core/math/random.ts";
import { parseScene } from "../../src/core/scene/schema.ts";
import { TASK_CATEGORIES } from "../../src/core/scene/task-types.ts";
import type { Scene } from "../../src/core/scene/types.ts";

const HEIGHTS = { write: 1.35, lift: 0.87, place: 0.87, sit: 0.46, stand: 0, turn: 0 } as const;

/** Uniform yaw, every ordered pair of categories in turn, 30 % low effort, a quarter of the distances under 1 m. */
export function randomScene(seed: number): Scene {
  const r = createRandom(seed);
  const n = 2 + r.below(5);
  const pair = seed % 36;
  const tasks: object[] = [];
  const props: object[] = [];
  let x = r.between(-3.5, 3.5);
  let z = r.between(-3.5, 3.5);
  for (let i = 0; i < n; i++) {
    const category = TASK_CATEGORIES[i === 0 ? Math.floor(pair / 6) : i === 1 ? pair % 6 : r.below(6)];
    const yaw = r.between(-Math.PI, Math.PI);
    const d = r.next() < 0.25 ? r.between(0.15, 1) : r.between(1, 4);
    const a = r.between(-Math.PI, Math.PI);
    x = Math.max(-4, Math.min(4, x + d * Math.sin(a)));
    z = Math.max(-4, Math.min(4, z + d * Math.cos(a)));
    tasks.push({
      id: `t${i}`,
      category,
      effort: category === "write" && r.next() < 0.3 ? 0 : 1,
      position: [x, HEIGHTS[category], z],
      yaw,
    });
    if (category === "sit") props.push({ id: `stool${i}`, kind: "stool", position: [x, 0, z], yaw });
    if (category === "lift" || category === "place") {
      props.push({
        id: `table${i}`,
        kind: "table",
        position: [x + 0.17 * Math.sin(yaw), 0, z + 0.17 * Math.cos(yaw)],
        yaw,
      });
    }
  }
  const way = r.below(3);
  for (let k = 0; k < way; k++) {
    const px = r.between(-3.5, 3.5);
    const pz = r.between(-3.5, 3.5);
    const clear = (tasks as { position: number[] }[]).every(
      (t) => Math.hypot(t.position[0] - px, t.position[2] - pz) > 1.3,
    );
    if (clear && Math.hypot(px, pz) > 0.8)
      props.push({
        id: `way${k}`,
        kind: r.next() < 0.5 ? "pillar" : "table",
        position: [px, 0, pz],
        yaw: r.between(0, 3),
      });
  }
  return parseScene({
    version: 1,
    seed,
    start: { position: [0, 0], yaw: r.between(-Math.PI, Math.PI) },
    tasks,
    props,
  });
}
