/** What is put right in a world before anyone walks, each with a sentence: starts that overlap, goals where nobody can stand. */
import { cosine, sine } from "./elementary.ts";
import { obstacleGap } from "./ground.ts";
import { BODY_RADIUS, type CrowdWorld, SHOULDER } from "./types.ts";

/** A body needs this much room round its middle; a goal with room this near to it is reached from there, metres. */
const ROOM = 0.36;
const NEAR_ENOUGH = 0.6;
/** How far the nearest room is looked for, and in which steps, metres; directions. */
const FARTHEST = 40;
const STEP = 0.1;
const DIRECTIONS = 32;
const WAYS = Array.from({ length: DIRECTIONS }, (_, k) => (2 * Math.PI * k) / DIRECTIONS);
const WAY_COS = WAYS.map(cosine);
const WAY_SIN = WAYS.map(sine);

/**
 * Moves goals inside walls to the nearest room and says who overlaps at the start: they part before they go on. Mutates the goals,
 * adds a sentence each to `repairs`.
 *
 * @param file what sentences begin with.
 */
export function repairWorld(world: CrowdWorld, file: string): void {
  const { agents, obstacles, repairs } = world;
  const isFree = (x: number, z: number): boolean => obstacles.every((o) => obstacleGap(o, x, z) >= ROOM);
  agents.forEach((a, i) => {
    if (obstacles.some((o) => obstacleGap(o, a.x, a.z) < BODY_RADIUS))
      repairs.push(`${file}: agent ${i + 1} starts in a wall; it walks out of it first.`);
    for (let k = i + 1; k < agents.length; k++) {
      const b = agents[k];
      const dx = b.x - a.x;
      const dz = b.z - a.z;
      if (dx * dx + dz * dz > (2 * BODY_RADIUS + 2 * SHOULDER) ** 2 || !overlap(a, b)) continue;
      repairs.push(`${file}: agents ${i + 1} and ${k + 1} overlap at the start; they part first.`);
    }
    a.goals.forEach((g, n) => {
      if (g.box || isFree(g.x, g.z)) return;
      for (let far = STEP; far <= FARTHEST; far += STEP)
        for (let w = 0; w < DIRECTIONS; w++) {
          const x = g.x + far * WAY_COS[w];
          const z = g.z + far * WAY_SIN[w];
          if (!isFree(x, z)) continue;
          if (far <= NEAR_ENOUGH) return;
          g.x = x;
          g.z = z;
          repairs.push(
            `${file}: goal ${n + 1} of agent ${i + 1} is inside a wall; it is taken to the nearest room, ${far.toFixed(1)} m away.`,
          );
          return;
        }
      repairs.push(`${file}: goal ${n + 1} of agent ${i + 1} is inside a wall without room round it.`);
    });
  });
}

interface Stand {
  x: number;
  z: number;
  dirX: number;
  dirZ: number;
}

/** Whether two bodies of three circles overlap. */
function overlap(a: Stand, b: Stand): boolean {
  for (let s = -1; s <= 1; s++)
    for (let t = -1; t <= 1; t++) {
      const dx = b.x - a.x + SHOULDER * (t * b.dirZ - s * a.dirZ);
      const dz = b.z - a.z - SHOULDER * (t * b.dirX - s * a.dirX);
      if (dx * dx + dz * dz < (2 * BODY_RADIUS) ** 2 - 1e-9) return true;
    }
  return false;
}
