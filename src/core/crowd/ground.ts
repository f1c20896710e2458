/** Obstacles by place, and the grid that long ways are found on. */
import type { CrowdWorld, Obstacle, Surface } from "./types.ts";

export interface Ground {
  obstacles: Obstacle[];
  /** The same, OBSTACLE numbers each: x, z, half sizes, cosine, sine, round. */
  flat: Float64Array;
  /** Lookup by cells of 2 m: `items` from `starts[cell]` to `starts[cell + 1]` are the obstacles within a metre of the cell. */
  lookX0: number;
  lookZ0: number;
  lookColumns: number;
  lookRows: number;
  starts: Int32Array;
  items: Int32Array;
  /** Side of a cell of the grid of ways, metres, and cells a metre: exact, for sides are powers of two. */
  cell: number;
  perMetre: number;
  /** Grid of ways: origin, cells, and whether a walker's middle may be there. */
  x0: number;
  z0: number;
  columns: number;
  rows: number;
  free: Uint8Array;
  surfaces: Surface[];
  /** The surface of each cell: 0 for plain floor, else 1 + its index; null without surfaces. */
  surface: Uint8Array | null;
}

const OBSTACLE = 7;
const LOOKUP = 2;
/** Side of a cell of the grid of ways, metres; and where the world is wide, with more ways than one, and hundreds go different ones. */
const CELL = 0.25;
const WIDE_CELL = 0.5;
const WIDE = 1600;
const MANY_GOALS = 60;
/** A walker's middle keeps this far from walls on long ways; where that closes a way, as much as a body needs. */
const CLEAR = 0.36;
const TIGHT = 0.2;
/** On the border of two cells it keeps as far as makes no gap under 0.45 m a way: in that a body that turns would hardly fit. */
const BETWEEN = 0.225;
const ACROSS = [
  [1, 0],
  [0, 1],
] as const;
/** With half a cell's diagonal more, no wall is near anywhere in a cell, whatever way a body faces and wherever its foot is. */
const OPEN = 0.45;
/** Steps that lead no farther than this need not be looked at one moment after the other where no wall is near all around. */
export const ROAM = 0.8;
/** Endless walls must not make an endless grid: they count this far beyond those who walk and their goals, metres. */
const BEYOND = 30;

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

interface Bounds {
  minX: number;
  maxX: number;
  minZ: number;
  maxZ: number;
}

function boundsOf(world: CrowdWorld): Bounds {
  const b: Bounds = {
    minX: Number.POSITIVE_INFINITY,
    maxX: Number.NEGATIVE_INFINITY,
    minZ: Number.POSITIVE_INFINITY,
    maxZ: Number.NEGATIVE_INFINITY,
  };
  const cover = (x: number, z: number): void => {
    b.minX = Math.min(b.minX, x);
    b.maxX = Math.max(b.maxX, x);
    b.minZ = Math.min(b.minZ, z);
    b.maxZ = Math.max(b.maxZ, z);
  };
  for (const a of world.agents) {
    cover(a.x, a.z);
    for (const g of a.goals) cover(g.x, g.z);
  }
  if (b.minX > b.maxX) cover(0, 0);
  const { minX, maxX, minZ, maxZ } = b;
  for (const o of world.obstacles) {
    const [r, s] = halfExtents(o);
    for (const f of [-1, 1])
      cover(
        Math.max(minX - BEYOND, Math.min(maxX + BEYOND, o.x + f * r)),
        Math.max(minZ - BEYOND, Math.min(maxZ + BEYOND, o.z + f * s)),
      );
  }
  return b;
}

const halfExtents = (o: Obstacle): [number, number] =>
  o.round
    ? [o.halfX, o.halfX]
    : [
        Math.abs(o.halfX * o.cos) + Math.abs(o.halfZ * o.sin),
        Math.abs(o.halfX * o.sin) + Math.abs(o.halfZ * o.cos),
      ];

/** The ground of a world: looked up by place from then on. */
export function createGround(world: CrowdWorld): Ground {
  const { minX, maxX, minZ, maxZ } = boundsOf(world);
  const x0 = minX - 4;
  const z0 = minZ - 4;
  const goals = new Set(world.agents.flatMap((a) => a.goals.map((g) => `${g.x},${g.z}`))).size;
  const cell = (maxX - minX) * (maxZ - minZ) > WIDE && goals > MANY_GOALS ? WIDE_CELL : CELL;
  const columns = Math.min(2000, Math.ceil((maxX - minX + 8) / cell));
  const rows = Math.min(2000, Math.ceil((maxZ - minZ + 8) / cell));
  const surfaces = world.surfaces ?? [];
  const ground: Ground = {
    obstacles: world.obstacles,
    flat: new Float64Array(world.obstacles.length * OBSTACLE),
    lookX0: x0,
    lookZ0: z0,
    lookColumns: Math.min(2000, Math.ceil((maxX - minX + 8) / LOOKUP) + 1),
    lookRows: Math.min(2000, Math.ceil((maxZ - minZ + 8) / LOOKUP) + 1),
    starts: new Int32Array(1),
    items: new Int32Array(0),
    cell,
    perMetre: 1 / cell,
    x0,
    z0,
    columns,
    rows,
    free: new Uint8Array(columns * rows),
    surfaces,
    surface: surfaces.length > 0 ? new Uint8Array(columns * rows) : null,
  };
  world.obstacles.forEach((o, i) => {
    ground.flat.set([o.x, o.z, o.halfX, o.halfZ, o.cos, o.sin, o.round ? 1 : 0], i * OBSTACLE);
  });
  sortObstacles(ground);
  const centre = new Float64Array(2);
  for (let k = 0; k < rows; k++)
    for (let i = 0; i < columns; i++) {
      const x = x0 + (i + 0.5) * cell;
      const z = z0 + (k + 0.5) * cell;
      centre[0] = x;
      centre[1] = z;
      const gap = nearestGap(ground, centre, 0);
      // 4: nor anywhere around, 3: no wall near, 2: with room to spare, 1: narrow, 0: no.
      const level = gap >= OPEN + 0.71 * cell ? 3 : gap >= CLEAR ? 2 : gap >= TIGHT ? 1 : 0;
      ground.free[k * columns + i] = level;
      if (ground.surface) ground.surface[k * columns + i] = surfaceOf(surfaces, x, z);
    }
  markBetween(ground);
  markRoam(ground);
  return ground;
}

/** 1 + the index of the last surface over a point, 0 for none; a byte holds 255 of them. */
function surfaceOf(surfaces: readonly Surface[], x: number, z: number): number {
  for (let s = Math.min(surfaces.length, 255) - 1; s >= 0; s--) {
    const [x0, x1, z0, z1] = surfaces[s].bounds;
    if (x >= x0 && x <= x1 && z >= z0 && z <= z1) return s + 1;
  }
  return 0;
}

/** Every obstacle into the cells within a metre of it: counted first, then laid out in one array. */
function sortObstacles(g: Ground): void {
  const counts = new Int32Array(g.lookColumns * g.lookRows + 1);
  const each = (visit: (cell: number, obstacle: number) => void): void => {
    g.obstacles.forEach((o, i) => {
      const [r, s] = halfExtents(o);
      const a0 = Math.max(0, Math.floor((o.x - r - 1 - g.lookX0) / LOOKUP));
      const a1 = Math.min(g.lookColumns - 1, Math.floor((o.x + r + 1 - g.lookX0) / LOOKUP));
      const b0 = Math.max(0, Math.floor((o.z - s - 1 - g.lookZ0) / LOOKUP));
      const b1 = Math.min(g.lookRows - 1, Math.floor((o.z + s + 1 - g.lookZ0) / LOOKUP));
      for (let b = b0; b <= b1; b++) for (let a = a0; a <= a1; a++) visit(b * g.lookColumns + a, i);
    });
  };
  each((cell) => {
    counts[cell + 1]++;
  });
  for (let c = 1; c < counts.length; c++) counts[c] += counts[c - 1];
  g.starts = counts.slice();
  g.items = new Int32Array(counts[counts.length - 1]);
  each((cell, i) => {
    g.items[counts[cell]++] = i;
  });
}

/** Distance from the point at `i` in `places` to the nearest obstacle within about a metre, else 1. */
export function nearestGap(g: Ground, places: Float64Array, i: number): number {
  const x = places[i];
  const z = places[i + 1];
  const a = Math.floor((x - g.lookX0) * (1 / LOOKUP));
  const b = Math.floor((z - g.lookZ0) * (1 / LOOKUP));
  if (a < 0 || b < 0 || a >= g.lookColumns || b >= g.lookRows) return 1;
  const cell = b * g.lookColumns + a;
  const { flat, items } = g;
  let best = 1;
  for (let n = g.starts[cell]; n < g.starts[cell + 1]; n++) {
    const o = items[n] * OBSTACLE;
    const dx = x - flat[o];
    const dz = z - flat[o + 1];
    if (flat[o + 6] === 1) {
      const d = Math.sqrt(dx * dx + dz * dz) - flat[o + 2];
      if (d < best) best = d < 0 ? 0 : d;
      continue;
    }
    const u = Math.abs(dx * flat[o + 4] - dz * flat[o + 5]) - flat[o + 2];
    if (u >= best) continue;
    const w = Math.abs(dx * flat[o + 5] + dz * flat[o + 4]) - flat[o + 3];
    if (w >= best) continue;
    const d = u <= 0 ? (w <= 0 ? 0 : w) : w <= 0 ? u : Math.sqrt(u * u + w * w);
    if (d < best) best = d;
  }
  return best;
}

/** Index of the cell of a point; -1 outside. */
export function cellOf(ground: Ground, x: number, z: number): number {
  const i = Math.floor((x - ground.x0) * ground.perMetre);
  const k = Math.floor((z - ground.z0) * ground.perMetre);
  return i < 0 || k < 0 || i >= ground.columns || k >= ground.rows ? -1 : k * ground.columns + i;
}

/** Whether no wall is near a point: then nothing more need be measured. */
export function farFromWalls(ground: Ground, x: number, z: number): boolean {
  const c = cellOf(ground, x, z);
  return c >= 0 && ground.free[c] >= 3;
}

/** Whether no wall is near anywhere within ROAM of a point. */
export function roamsFree(ground: Ground, x: number, z: number): boolean {
  const c = cellOf(ground, x, z);
  return c >= 0 && ground.free[c] === 4;
}

/**
 * Marks as narrow what lies between two closed cells where a body has room on their border: a gap whose middle is there has room in
 * neither cell's middle. The first of the two is marked, so that cells of two gaps side by side never meet through the wall between;
 * and at the gap's ends the cells that join it to what is open.
 */
function markBetween(ground: Ground): void {
  const { x0, z0, columns, rows, cell, free } = ground;
  const border = new Float64Array(2);
  const marked: number[] = [];
  /** Whether a cell is closed but has room on its border towards (di, dk). */
  const beside = (i: number, k: number, di: number, dk: number): boolean => {
    if (i < 0 || k < 0 || i + di >= columns || k + dk >= rows || free[k * columns + i] !== 0) return false;
    border[0] = x0 + (i + 0.5 + 0.5 * di) * cell;
    border[1] = z0 + (k + 0.5 + 0.5 * dk) * cell;
    return nearestGap(ground, border, 0) >= BETWEEN;
  };
  for (let k = 0; k < rows; k++)
    for (let i = 0; i < columns; i++) {
      if (free[k * columns + i] !== 0) continue;
      for (const [di, dk] of ACROSS) {
        if (free[(k + dk) * columns + i + di] !== 0 || !beside(i, k, di, dk)) continue;
        for (let along = -1; along <= 1; along++) {
          const a = i + along * dk;
          const b = k + along * di;
          if (along === 0 || beside(a, b, di, dk)) marked.push(b * columns + a);
        }
      }
    }
  for (const c of marked) free[c] = 1;
}

/** Marks the cells from which all others within ROAM are far from walls, beyond the grid none: row by row, then column by column. */
function markRoam(ground: Ground): void {
  const { columns, rows, free } = ground;
  const r = Math.floor(ROAM / ground.cell) + 1;
  const inRow = new Uint8Array(columns * rows);
  for (let k = 0; k < rows; k++)
    for (let i = 0, run = 0; i < columns; i++) {
      run = free[k * columns + i] === 3 ? run + 1 : 0;
      if (run > 2 * r) inRow[k * columns + i - r] = 1;
    }
  for (let i = 0; i < columns; i++)
    for (let k = 0, run = 0; k < rows; k++) {
      run = inRow[k * columns + i] === 1 ? run + 1 : 0;
      if (run > 2 * r) free[(k - r) * columns + i] = 4;
    }
}

/** Energy of a step at a point over that on plain floor. */
export function surfaceCost(ground: Ground, x: number, z: number): number {
  if (!ground.surface) return 1;
  const c = cellOf(ground, x, z);
  return c < 0 ? 1 : costOfCell(ground, c);
}

/** Energy of a step in a cell over that on plain floor. */
export function costOfCell(ground: Ground, cell: number): number {
  const s = ground.surface === null ? 0 : ground.surface[cell];
  return s === 0 ? 1 : ground.surfaces[s - 1].cost;
}

/** Whether the straight way between two points stays in cells at least this free, and all on one surface. */
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
  const { surface } = ground;
  const steps = Math.ceil(Math.sqrt(dx * dx + dz * dz) / (0.8 * ground.cell));
  let on = -1;
  for (let s = 0; s <= steps; s++) {
    const u = steps === 0 ? 0 : s / steps;
    const c = cellOf(ground, ax + u * dx, az + u * dz);
    if (c < 0) continue;
    if (ground.free[c] < least) return false;
    if (surface === null) continue;
    if (on >= 0 && surface[c] !== on) return false;
    on = surface[c];
  }
  return true;
}
