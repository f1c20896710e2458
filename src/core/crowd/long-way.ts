/**
 * The long way to a goal: A* over the grid from the goal outward, with straight sight between corners (Theta*), so that ways are
 * as short as they look [Footsteps §4, long-term path planning].
 *
 * What is kept is a field: from every cell near the way, the next corner and the distance from there. A step's worth is
 * then known anywhere, and the local goal is the corner in sight.
 */
import { cellOf, clearWay, type Ground } from "./ground.ts";

export interface LongWay {
  goalX: number;
  goalZ: number;
  /** Cell -> index in corners; corners: x, z, distance to the goal. */
  cornerOf: Map<number, number>;
  corners: number[];
  /** The search as far as it has gone: it goes on when another start asks. */
  cost: Map<number, number>;
  parent: Map<number, number>;
  cornerIndex: Map<number, number>;
  /** Cells that are open. */
  open: Set<number>;
  from: number;
  /** Nothing more can be found. */
  exhausted: boolean;
}

/** Ways are looked for until they are this much longer than the shortest, metres: walkers leave their way. */
const SLACK = 4;
/** Narrow cells are this much longer, so that a way with room is taken where there is one. */
const NARROW = 1.5;
const MOST_CELLS = 120_000;
/** Farthest that a corner is looked from, metres. */
const SIGHT = 14;

/** The field of a goal, nothing found yet. */
export function createLongWay(ground: Ground, goalX: number, goalZ: number): LongWay {
  const way: LongWay = {
    goalX,
    goalZ,
    cornerOf: new Map(),
    corners: [goalX, goalZ, 0],
    cost: new Map(),
    parent: new Map(),
    cornerIndex: new Map(),
    open: new Set(),
    exhausted: false,
    from: freeCell(ground, goalX, goalZ),
  };
  if (way.from >= 0) {
    way.cost.set(way.from, 0);
    way.parent.set(way.from, way.from);
    way.cornerIndex.set(way.from, 0);
    way.open.add(way.from);
  }
  return way;
}

/**
 * Carries a field on until it covers a start and the ways near to it. Bounded: never more than a fixed number of cells, and
 * no more than a box around start and goal, unless the way leads out of it.
 */
export function extendLongWay(ground: Ground, way: LongWay, startX: number, startZ: number): void {
  if (way.cornerOf.size === 0 && clearWay(ground, way.goalX, way.goalZ, startX, startZ, 2)) return;
  const target = freeCell(ground, startX, startZ);
  if (way.from < 0 || target < 0 || way.exhausted || way.cornerOf.has(target)) return;
  const { columns, rows, free } = ground;
  const { cost, parent, cornerIndex, open, cornerOf, corners } = way;
  const px = (c: number): number => ground.x0 + ((c % columns) + 0.5) * ground.cell;
  const pz = (c: number): number => ground.z0 + (Math.floor(c / columns) + 0.5) * ground.cell;
  const far = (a: number, b: number): number => {
    const dx = px(a) - px(b);
    const dz = pz(a) - pz(b);
    return Math.sqrt(dx * dx + dz * dz);
  };
  // What is open is sorted anew for this start; what is closed stays right, as the straight distance never overestimates.
  const heap = createHeap();
  for (const c of open) push(heap, (cost.get(c) ?? 0) + far(c, target), c);
  let most = Number.POSITIVE_INFINITY;
  let looked = 0;
  while (heap.size > 0 && looked < MOST_CELLS) {
    if (heap.keys[0] > most) break;
    const c = pop(heap);
    if (cornerOf.has(c)) continue;
    looked++;
    // Sight to the parent was taken for granted; it is looked at once, here.
    let p = parent.get(c) ?? c;
    if (p !== c && !clearWay(ground, px(p), pz(p), px(c), pz(c), free[c] >= 2 ? 2 : 1)) {
      let best = Number.POSITIVE_INFINITY;
      eachNeighbour(ground, c, (n) => {
        if (!cornerOf.has(n)) return;
        const g = (cost.get(n) ?? 0) + weightOf(free[c]) * far(n, c);
        if (g < best) {
          best = g;
          p = n;
        }
      });
      if (best === Number.POSITIVE_INFINITY) {
        open.delete(c);
        continue;
      }
      parent.set(c, p);
      if (best > (cost.get(c) ?? 0) + 1e-9) {
        cost.set(c, best);
        push(heap, best + far(c, target), c);
        continue;
      }
    }
    let corner = cornerIndex.get(p);
    if (corner === undefined) {
      corner = corners.length / 3;
      cornerIndex.set(p, corner);
      corners.push(px(p), pz(p), cost.get(p) ?? 0);
    }
    cornerOf.set(c, corner);
    open.delete(c);
    if (c === target) most = (cost.get(c) ?? 0) + SLACK;
    // Corners are at most some metres apart: sight is costly to look at.
    const from = far(p, c) > SIGHT ? c : p;
    const g = cost.get(from) ?? 0;
    eachNeighbour(ground, c, (n) => {
      if (cornerOf.has(n)) return;
      const next = g + weightOf(free[n]) * far(from, n);
      if (next >= (cost.get(n) ?? Number.POSITIVE_INFINITY)) return;
      cost.set(n, next);
      parent.set(n, from);
      open.add(n);
      push(heap, next + far(n, target), n);
    });
  }

  if (!cornerOf.has(target)) way.exhausted = true;

  function eachNeighbour(g: Ground, c: number, visit: (n: number) => void): void {
    const ci = c % columns;
    const ck = Math.floor(c / columns);
    for (let dk = -1; dk <= 1; dk++)
      for (let di = -1; di <= 1; di++) {
        if (di === 0 && dk === 0) continue;
        const i = ci + di;
        const k = ck + dk;
        if (i < 0 || k < 0 || i >= columns || k >= rows) continue;
        const n = k * columns + i;
        if (g.free[n] === 0) continue;
        // No cutting of corners.
        if (di !== 0 && dk !== 0 && (g.free[ck * columns + i] === 0 || g.free[k * columns + ci] === 0))
          continue;
        visit(n);
      }
  }
}

const weightOf = (level: number): number => (level === 1 ? NARROW : 1);

/** The nearest cell to a point in which a body has room; -1 when none is within 3 m. */
function freeCell(ground: Ground, x: number, z: number): number {
  for (let r = 0; r <= 12; r++) {
    let best = -1;
    let least = Number.POSITIVE_INFINITY;
    for (let k = -r; k <= r; k++)
      for (let i = -r; i <= r; i++) {
        if (Math.max(Math.abs(i), Math.abs(k)) !== r) continue;
        const c = cellOf(ground, x + i * ground.cell, z + k * ground.cell);
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
