/**
 * Contacts of bodies in a track, counted over a grid, so that hundreds among hundreds take seconds. It shares no code with the
 * planner: circles and boxes are measured here once more.
 */
import type { CrowdTrack } from "../../src/core/crowd/simulate.ts";
import type { CrowdWorld, Obstacle } from "../../src/core/crowd/types.ts";

export interface Contacts {
  /** Times that two bodies, or a body and an obstacle, came to overlap by more than the depth asked about. */
  bodies: number;
  obstacles: number;
  /** Deepest of each, metres. */
  deepestBodies: number;
  deepestObstacles: number;
  /** Mean speed on the way over the speed wanted: the largest of all agents. */
  quickest: number;
  /** Mean seconds until the last goal, of those who came there; and the last. */
  meanSeconds: number;
  lastSeconds: number;
}

const CELL = 2;
/** Radius of a body's circles and how far the shoulders are from the middle, metres [Footsteps Figure 1c]. */
const RADIUS = 0.15;
const ACROSS = [-0.15, 0, 0.15];

const key = (a: number, b: number): number => (a + 32768) * 65536 + (b + 32768);
const cell = (v: number): number => Math.floor(v / CELL);

/** Distance from a point to the rim of an obstacle, negative inside. */
function toRim(o: Obstacle, x: number, z: number): number {
  const dx = x - o.x;
  const dz = z - o.z;
  if (o.round) return Math.hypot(dx, dz) - o.halfX;
  const u = Math.abs(o.cos * dx - o.sin * dz) - o.halfX;
  const w = Math.abs(o.sin * dx + o.cos * dz) - o.halfZ;
  return u > 0 || w > 0 ? Math.hypot(Math.max(0, u), Math.max(0, w)) : Math.max(u, w);
}

/** Obstacles by the cells that they come within a body's reach of; those larger than 100 cells are asked everywhere. */
function obstaclesByCell(world: CrowdWorld): { cells: Map<number, number[]>; large: number[] } {
  const cells = new Map<number, number[]>();
  const large: number[] = [];
  world.obstacles.forEach((o, i) => {
    const reach = (o.round ? o.halfX : Math.hypot(o.halfX, o.halfZ)) + 0.4;
    const [a0, a1, b0, b1] = [cell(o.x - reach), cell(o.x + reach), cell(o.z - reach), cell(o.z + reach)];
    if ((a1 - a0 + 1) * (b1 - b0 + 1) > 100) {
      large.push(i);
      return;
    }
    for (let a = a0; a <= a1; a++)
      for (let b = b0; b <= b1; b++) {
        const k = key(a, b);
        const list = cells.get(k);
        if (list) list.push(i);
        else cells.set(k, [i]);
      }
  });
  return { cells, large };
}

/** Counts the contacts of a track that are deeper than `depth` metres, from `since` seconds on. */
export function countContacts(track: CrowdTrack, world: CrowdWorld, depth = 0.05, since = 0): Contacts {
  const out: Contacts = {
    bodies: 0,
    obstacles: 0,
    deepestBodies: 0,
    deepestObstacles: 0,
    quickest: 0,
    meanSeconds: 0,
    lastSeconds: 0,
  };
  const { cells, large } = obstaclesByCell(world);
  const agents = world.agents.length;
  let before = new Set<number>();
  const walked = new Float64Array(agents);
  const frames = new Int32Array(agents);
  track.positions.forEach((row, f) => {
    const now = new Set<number>();
    const byCell = new Map<number, number[]>();
    const circles = row.map((p, i): [number, number][] | null => {
      const u = track.facing[f][i];
      if (!p || !u) return null;
      const k = key(cell(p[0]), cell(p[1]));
      const list = byCell.get(k);
      if (list) list.push(i);
      else byCell.set(k, [i]);
      return ACROSS.map((s): [number, number] => [p[0] + s * u[1], p[1] - s * u[0]]);
    });
    row.forEach((p, i) => {
      const own = circles[i];
      if (!p || !own) return;
      const last = f > 0 ? track.positions[f - 1][i] : null;
      if (last) walked[i] += Math.hypot(p[0] - last[0], p[1] - last[1]);
      frames[i] = f + 1;
      const [a, b] = [cell(p[0]), cell(p[1])];
      if (f * track.dt < since) return;
      for (const list of [cells.get(key(a, b)) ?? [], large])
        for (const o of list) {
          const deep = RADIUS - Math.min(...own.map(([x, z]) => toRim(world.obstacles[o], x, z)));
          if (deep > out.deepestObstacles) out.deepestObstacles = deep;
          if (deep <= depth) continue;
          const id = (agents + o) * 65536 + i;
          now.add(id);
          if (!before.has(id)) out.obstacles++;
        }
      for (let da = -1; da <= 1; da++)
        for (let db = -1; db <= 1; db++)
          for (const k of byCell.get(key(a + da, b + db)) ?? []) {
            const other = circles[k];
            if (k <= i || !other) continue;
            let near = Number.POSITIVE_INFINITY;
            for (const [x, z] of own)
              for (const [u, w] of other) near = Math.min(near, Math.hypot(x - u, z - w));
            const deep = 2 * RADIUS - near;
            if (deep > out.deepestBodies) out.deepestBodies = deep;
            if (deep <= depth) continue;
            const id = k * 65536 + i;
            now.add(id);
            if (!before.has(id)) out.bodies++;
          }
    });
    before = now;
  });
  let arrived = 0;
  for (let i = 0; i < agents; i++) {
    const seconds = frames[i] * track.dt;
    const wanted = Math.max(...world.agents[i].goals.map((g) => g.speed));
    if (seconds > 0) out.quickest = Math.max(out.quickest, walked[i] / seconds / wanted);
    if (frames[i] >= track.positions.length && track.arrived < agents) continue;
    arrived++;
    out.meanSeconds += seconds;
    out.lastSeconds = Math.max(out.lastSeconds, seconds);
  }
  out.meanSeconds /= Math.max(1, arrived);
  return out;
}
