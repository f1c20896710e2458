/** A scene document's crowd as a world: agents, regions, and props as obstacles. */
import { createRandom } from "../math/random.ts";
import type { CrowdGait, Scene } from "../scene/types.ts";
import { cosine, sine } from "./elementary.ts";
import { obstacleGap } from "./ground.ts";
import { repairWorld } from "./repairs.ts";
import { type CrowdGoal, type CrowdWorld, type Gait, limping, type Obstacle } from "./types.ts";

/** The crowd of a scene; regions are filled from the scene's seed without overlap. @throws Error when it has none. */
export function crowdOfScene(scene: Scene, name: string): CrowdWorld {
  if (!scene.crowd) throw new Error(`${name}: crowd: there is none in this scene.`);
  const r = createRandom(scene.seed);
  const obstacles: Obstacle[] = scene.props.map((p) => ({
    x: p.position[0],
    z: p.position[2],
    halfX: p.size[0] / 2,
    halfZ: p.kind === "pillar" ? p.size[0] / 2 : p.size[2] / 2,
    cos: cosine(p.yaw),
    sin: sine(p.yaw),
    round: p.kind === "pillar",
  }));
  const world: CrowdWorld = {
    name,
    obstacles,
    agents: [],
    surfaces: scene.crowd.surfaces.map((s) => ({ bounds: ordered(s.bounds), cost: s.cost })),
    repairs: [],
  };
  const goals = (list: readonly (readonly [number, number])[], speed: number): CrowdGoal[] =>
    list.map(([x, z]) => ({ x, z, box: null, speed, patience: 1e9 }));
  for (const a of scene.crowd.agents)
    world.agents.push({
      x: a.position[0],
      z: a.position[1],
      dirX: sine(a.yaw),
      dirZ: cosine(a.yaw),
      goals: goals(a.goals, a.speed),
      gait: gaitOf(a.gait),
    });
  scene.crowd.regions.forEach((region, i) => {
    const [x0, x1, z0, z1] = ordered(region.bounds);
    for (let k = 0; k < region.count; k++) {
      let placed = false;
      for (let trial = 0; trial < 400 && !placed; trial++) {
        const x = r.between(x0, x1);
        const z = r.between(z0, z1);
        if (obstacles.some((o) => obstacleGap(o, x, z) < 0.35)) continue;
        if (world.agents.some((a) => (a.x - x) ** 2 + (a.z - z) ** 2 < 0.5)) continue;
        const [gx, gz] = region.goals[0] ?? [x, z + 1];
        const n = Math.sqrt((gx - x) ** 2 + (gz - z) ** 2) || 1;
        world.agents.push({
          x,
          z,
          dirX: (gx - x) / n,
          dirZ: (gz - z) / n,
          goals: goals(region.goals, region.speed),
          gait: gaitOf(region.gait),
        });
        placed = true;
      }
      if (!placed) {
        world.repairs.push(`${name}: crowd.regions[${i}]: ${k} of ${region.count} have room.`);
        break;
      }
    }
  });
  repairWorld(world, name);
  return world;
}

function gaitOf(gait: CrowdGait): Partial<Gait> {
  if (gait === "usual") return {};
  return limping(gait === "left leg hurts" ? 0 : 1);
}

function ordered([x0, x1, z0, z1]: readonly [number, number, number, number]): [
  number,
  number,
  number,
  number,
] {
  return [Math.min(x0, x1), Math.max(x0, x1), Math.min(z0, z1), Math.max(z0, z1)];
}
