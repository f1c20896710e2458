/** A SteerSuite world as a scene, so that a case dropped on the page can be watched and changed. */
import { parseScene } from "../scene/schema.ts";
import type { Scene } from "../scene/types.ts";
import { arcTangent } from "./elementary.ts";
import type { CrowdWorld } from "./types.ts";

const HEIGHT = 1.1;
/** Walls that end nowhere are cut here, metres from the middle of all agents. */
const FARTHEST = 900;

/**
 * The scene of a world: agents with their goals, obstacles as walls and pillars.
 *
 * @throws SceneError when it has more than a scene can hold.
 */
export function sceneOfWorld(world: CrowdWorld): Scene {
  const cut = (v: number): number => Math.max(-FARTHEST, Math.min(FARTHEST, v));
  return parseScene({
    version: 1,
    props: world.obstacles.map((o, i) => ({
      id: `${o.round ? "pillar" : "wall"}-${i + 1}`,
      kind: o.round ? "pillar" : "wall",
      position: [cut(o.x), 0, cut(o.z)],
      yaw: arcTangent(o.sin, o.cos),
      size: [Math.max(0.02, 2 * o.halfX), HEIGHT, Math.max(0.02, 2 * o.halfZ)],
    })),
    crowd: {
      agents: world.agents.map((a) => ({
        position: [a.x, a.z],
        yaw: arcTangent(a.dirX, a.dirZ),
        goals: a.goals.map((g) => [g.x, g.z]),
        speed: Math.max(0.05, Math.min(5, a.goals[0]?.speed ?? 1.3)),
      })),
    },
  });
}
