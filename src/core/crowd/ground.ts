/** Obstacles by place, and the grid that long ways are found on. */
import type { CrowdWorld, Obstacle } from "./types.ts";

export interface Ground {
  obstacles: Obstacle[];
  /** Cells of 2 m for looking up obstacles. */
  cells: Map<number, Int32Array>;
  /** Side of a cell of the grid of ways, metres. */
  cell: number;
  /** Grid of ways: origin, cells, and whether a walker's middle may be there. */
  x0: number;
  z0: number;
  columns: number;
  rows: number;
  free: Uint8Array;
}

const LOOKUP = 2;
/** Side of a cell of the grid of ways, metres; and where the world is wide, with more ways than one, and hundreds go different ones. */
const CELL = 0.25;
const WIDE_CELL = 0.5;
const WIDE = 1600;
const MANY_GOALS = 60;
/** A walker's middle keeps this far from walls on long ways; where that closes a way, as much as a body needs. */
const CLEAR = 0.36;
const TIGHT = 0.2;
/** With half a cell's diagonal more, no wall is near anywhere in a cell, whatever way a body faces. */
const OPEN = 0.315;

const key = (i: number, k: number): number => (i + 5000) * 16384 + (k + 5000);

/** Distance from a point to an obstacle, 0 inside. */
export function obstacleGap(o: Obstacle, x: number, z: number): number {
  const dx = x - o.x;
  const dz = z - o.z;
  if (o.round) return Math.max(0, Math.sqrt(dx * dx + dz * dz) - o.halfX);
  const u = Math.abs(dx * o.cos - dz * o.sin) - o.halfX;
  const w = Math.abs(dx * o.sin + dz * o.cos) - o.halfZ;
  const a = u > 0 ? u : 0;
  const b = w > 0 ? w : 0;
  return Math.sqrt(a * a + b * b);
}

export function createGround(world: CrowdWorld): Ground {
  const cells = new Map<number, number[]>();
  let minX = Number.POSITIVE_INFINITY;
  let maxX = Number.NEGATIVE_INFINITY;
  let minZ = Number.POSITIVE_INFINITY;
  let maxZ = Number.NEGATIVE_INFINITY;
  const cover = (x: number, z: number): void => {
    minX = Math.min(minX, x);
    maxX = Math.max(maxX, x);
    minZ = Math.min(minZ, z);
    maxZ = Math.max(maxZ, z);
  };
  for (const a of world.agents) {
    cover(a.x, a.z);
    for (const g of a.goals) cover(g.x, g.z);
  }
  world.obstacles.forEach((o, i) => {
    const r = o.round ? o.halfX : Math.abs(o.halfX * o.cos) + Math.abs(o.halfZ * o.sin);
    const s = o.round ? o.halfX : Math.abs(o.halfX * o.sin) + Math.abs(o.halfZ * o.cos);
    // Endless walls must not make an endless grid.
    cover(
      Math.max(minX - 30, Math.min(maxX + 30, o.x - r)),
      Math.max(minZ - 30, Math.min(maxZ + 30, o.z - s)),
    );
    cover(
      Math.max(minX - 30, Math.min(maxX + 30, o.x + r)),
      Math.max(minZ - 30, Math.min(maxZ + 30, o.z + s)),
    );
    for (let a = Math.floor((o.x - r - 1) / LOOKUP); a <= Math.floor((o.x + r + 1) / LOOKUP); a++)
      for (let b = Math.floor((o.z - s - 1) / LOOKUP); b <= Math.floor((o.z + s + 1) / LOOKUP); b++) {
        const list = cells.get(key(a, b));
        if (list) list.push(i);
        else cells.set(key(a, b), [i]);
      }
  });
  const x0 = minX - 4;
  const z0 = minZ - 4;
  const goals = new Set(world.agents.flatMap((a) => a.goals.map((g) => `${g.x},${g.z}`))).size;
  const cell = (maxX - minX) * (maxZ - minZ) > WIDE && goals > MANY_GOALS ? WIDE_CELL : CELL;
  const columns = Math.min(2000, Math.ceil((maxX - minX + 8) / cell));
  const rows = Math.min(2000, Math.ceil((maxZ - minZ + 8) / cell));
  const ground: Ground = {
    obstacles: world.obstacles,
    cells: new Map([...cells].map(([k, v]) => [k, Int32Array.from(v)])),
    cell,
    x0,
    z0,
    columns,
    rows,
    free: new Uint8Array(columns * rows),
  };
  for (let k = 0; k < rows; k++)
    for (let i = 0; i < columns; i++) {
      const x = x0 + (i + 0.5) * cell;
      const z = z0 + (k + 0.5) * cell;
      const gap = nearestGap(ground, x, z);
      // 3: no wall near, 2: with room to spare, 1: narrow, 0: no.
      const level = gap >= OPEN + 0.71 * cell ? 3 : gap >= CLEAR ? 2 : gap >= TIGHT ? 1 : 0;
      ground.free[k * columns + i] = level;
    }
  return ground;
}

/** Distance to the nearest obstacle within about a metre, else 1. */
export function nearestGap(ground: Ground, x: number, z: number): number {
  const list = ground.cells.get(key(Math.floor(x / LOOKUP), Math.floor(z / LOOKUP)));
  let best = 1;
  if (!list) return best;
  for (let i = 0; i < list.length; i++) best = Math.min(best, obstacleGap(ground.obstacles[list[i]], x, z));
  return best;
}

/** Index of the cell of a point; -1 outside. */
export function cellOf(ground: Ground, x: number, z: number): number {
  const i = Math.floor((x - ground.x0) / ground.cell);
  const k = Math.floor((z - ground.z0) / ground.cell);
  return i < 0 || k < 0 || i >= ground.columns || k >= ground.rows ? -1 : k * ground.columns + i;
}

/** Whether no wall is near a point: then nothing more need be measured. */
export function farFromWalls(ground: Ground, x: number, z: number): boolean {
  const c = cellOf(ground, x, z);
  return c >= 0 && ground.free[c] === 3;
}

/** Whether the straight way between two points stays in cells at least this free. */
export function clearWay(
  ground: Ground,
  ax: number,
  az: number,
  bx: number,
  bz: number,
  least: number,
): boolean {
  const dx = bx - ax;
  const dz = bz - az;
  const steps = Math.ceil(Math.sqrt(dx * dx + dz * dz) / (0.8 * ground.cell));
  for (let s = 0; s <= steps; s++) {
    const u = steps === 0 ? 0 : s / steps;
    const c = cellOf(ground, ax + u * dx, az + u * dz);
    if (c >= 0 && ground.free[c] < least) return false;
  }
  return true;
}
