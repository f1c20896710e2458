/**
 * The long way to a goal: A* over the grid from the goal outward, with straight sight between corners (Theta*), so that ways are
 * as short as they look [Footsteps §4, long-term path planning].
 *
 * What is kept is a field: from every cell near the way, the next corner and the distance from there. A step's worth is
 * then known anywhere, and the local goal is the corner in sight.
 */
import { CELL, cellOf, clearWay, type Ground } from "./ground.ts";

export interface LongWay {
  goalX: number;
  goalZ: number;
  /** Cell -> index in corners; corners: x, z, distance to the goal. */
  cornerOf: Map<number, number>;
  corners: number[];
  reached: boolean;
}

/** Cells are looked at until ways are this much longer than the shortest, metres: walkers leave their way. */
const SLACK = 4;
/** Narrow cells are this much longer, so that a way with room is taken where there is one. */
const NARROW = 1.5;
const MOST_CELLS = 250_000;

/** Finds the field from a goal to a start. Bounded: never more than a fixed number of cells. */
export function findLongWay(
  ground: Ground,
  goalX: number,
  goalZ: number,
  startX: number,
  startZ: number,
): LongWay {
  const way: LongWay = { goalX, goalZ, cornerOf: new Map(), corners: [goalX, goalZ, 0], reached: false };
  if (clearWay(ground, goalX, goalZ, startX, startZ, 2)) {
    way.reached = true;
    return way;
  }
  const from = freeCell(ground, goalX, goalZ);
  const target = freeCell(ground, startX, startZ);
  if (from < 0 || target < 0) return way;
  const { columns, rows, free } = ground;
  const cost = new Map<number, number>();
  const parent = new Map<number, number>();
  const closed = new Set<number>();
  const heap = createHeap();
  const px = (c: number): number => ground.x0 + ((c % columns) + 0.5) * CELL;
  const pz = (c: number): number => ground.z0 + (Math.floor(c / columns) + 0.5) * CELL;
  const far = (ax: number, az: number, bx: number, bz: number): number =>
    Math.sqrt((ax - bx) * (ax - bx) + (az - bz) * (az - bz));
  const tx = px(target);
  const tz = pz(target);
  const cornerIndex = new Map<number, number>([[from, 0]]);
  cost.set(from, 0);
  parent.set(from, from);
  push(heap, far(px(from), pz(from), tx, tz), from);
  let most = Number.POSITIVE_INFINITY;
  while (heap.size > 0 && closed.size < MOST_CELLS) {
    const f = heap.keys[0];
    const c = pop(heap);
    if (f > most) break;
    if (closed.has(c)) continue;
    closed.add(c);
    const g = cost.get(c) ?? 0;
    if (c === target) {
      way.reached = true;
      most = f + SLACK;
    }
    const p = parent.get(c) ?? c;
    let corner = cornerIndex.get(p);
    if (corner === undefined) {
      corner = way.corners.length / 3;
      cornerIndex.set(p, corner);
      way.corners.push(px(p), pz(p), cost.get(p) ?? 0);
    }
    way.cornerOf.set(c, corner);
    const ci = c % columns;
    const ck = Math.floor(c / columns);
    for (let dk = -1; dk <= 1; dk++)
      for (let di = -1; di <= 1; di++) {
        if (di === 0 && dk === 0) continue;
        const i = ci + di;
        const k = ck + dk;
        if (i < 0 || k < 0 || i >= columns || k >= rows) continue;
        const n = k * columns + i;
        if (free[n] === 0 || closed.has(n)) continue;
        // No cutting of corners.
        if (di !== 0 && dk !== 0 && (free[ck * columns + i] === 0 || free[k * columns + ci] === 0)) continue;
        const weight = free[n] === 1 ? NARROW : 1;
        let next = g + weight * far(px(c), pz(c), px(n), pz(n));
        let by = c;
        if (clearWay(ground, px(p), pz(p), px(n), pz(n), weight === 1 ? 2 : 1)) {
          const straight = (cost.get(p) ?? 0) + weight * far(px(p), pz(p), px(n), pz(n));
          if (straight <= next) {
            next = straight;
            by = p;
          }
        }
        if (next < (cost.get(n) ?? Number.POSITIVE_INFINITY)) {
          cost.set(n, next);
          parent.set(n, by);
          push(heap, next + far(px(n), pz(n), tx, tz), n);
        }
      }
  }
  // The first corner is the goal itself.
  way.corners[0] = goalX;
  way.corners[1] = goalZ;
  return way;
}

/** The nearest cell to a point in which a body has room; -1 when none is within 3 m. */
function freeCell(ground: Ground, x: number, z: number): number {
  for (let r = 0; r <= 12; r++) {
    let best = -1;
    let least = Number.POSITIVE_INFINITY;
    for (let k = -r; k <= r; k++)
      for (let i = -r; i <= r; i++) {
        if (Math.max(Math.abs(i), Math.abs(k)) !== r) continue;
        const c = cellOf(ground, x + i * CELL, z + k * CELL);
        if (c < 0 || ground.free[c] === 0) continue;
        const d = i * i + k * k;
        if (d < least) {
          least = d;
          best = c;
        }
      }
    if (best >= 0) return best;
  }
  return -1;
}

const sight = { x: 0, z: 0, distance: 0 };

/** Distance still to go from a point, and the place to head for; a shared object that the next call changes. */
export function ahead(ground: Ground, way: LongWay, x: number, z: number): Readonly<typeof sight> {
  const straight = Math.sqrt((x - way.goalX) * (x - way.goalX) + (z - way.goalZ) * (z - way.goalZ));
  sight.x = way.goalX;
  sight.z = way.goalZ;
  sight.distance = straight;
  if (way.cornerOf.size === 0) return sight;
  const c = cellOf(ground, x, z);
  let corner = way.cornerOf.get(c);
  if (corner === undefined) {
    // Beside the field: the nearest known neighbour's.
    for (let r = 1; r <= 3 && corner === undefined; r++)
      for (let k = -r; k <= r && corner === undefined; k++)
        for (let i = -r; i <= r && corner === undefined; i++)
          corner = way.cornerOf.get(c + k * ground.columns + i);
  }
  if (corner === undefined) {
    sight.distance = straight + 3;
    return sight;
  }
  const { corners } = way;
  sight.x = corners[3 * corner];
  sight.z = corners[3 * corner + 1];
  sight.distance =
    Math.sqrt((x - sight.x) * (x - sight.x) + (z - sight.z) * (z - sight.z)) + corners[3 * corner + 2];
  return sight;
}

interface Heap {
  keys: number[];
  values: number[];
  size: number;
}

const createHeap = (): Heap => ({ keys: [], values: [], size: 0 });

function push(h: Heap, k: number, v: number): void {
  let i = h.size++;
  while (i > 0) {
    const p = (i - 1) >> 1;
    if (h.keys[p] <= k) break;
    h.keys[i] = h.keys[p];
    h.values[i] = h.values[p];
    i = p;
  }
  h.keys[i] = k;
  h.values[i] = v;
}

function pop(h: Heap): number {
  const out = h.values[0];
  h.size--;
  if (h.size > 0) {
    const k = h.keys[h.size];
    const v = h.values[h.size];
    let i = 0;
    for (;;) {
      let c = 2 * i + 1;
      if (c >= h.size) break;
      if (c + 1 < h.size && h.keys[c + 1] < h.keys[c]) c++;
      if (h.keys[c] >= k) break;
      h.keys[i] = h.keys[c];
      h.values[i] = h.values[c];
      i = c;
    }
    h.keys[i] = k;
    h.values[i] = v;
  }
  return out;
}
