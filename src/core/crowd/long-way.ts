/**
 * The long way to a goal: A* over the grid from the goal outward, with straight sight between corners (Theta*), so that ways are
 * as short as they look [Footsteps §4, long-term path planning].
 *
 * What is kept is a field: from every cell near the way, the next corner and the distance from there. A step's worth is
 * then known anywhere, and the local goal is the corner in sight.
 */
import { clearWay, costOfCell, type Ground, surfaceCost } from "./ground.ts";
import { cornerAt, costAt, createTiles, parentAt, setCorner, setCost, type Tiles } from "./tiles.ts";

export interface LongWay {
  goalX: number;
  goalZ: number;
  /** Whether the field is used: without, the goal itself is in sight from everywhere that asked. */
  bent: boolean;
  field: Tiles;
  /** x, z, distance to the goal. */
  corners: number[];
  /** Corner made of a cell. */
  cornerIndex: Map<number, number>;
  /** Cells that are open, by cost and straight distance to `target`: the search goes on when another start asks. */
  open: Heap;
  target: number;
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

/** Straight to a place, whatever is between. */
export const createStraightWay = (goalX: number, goalZ: number): LongWay => ({
  goalX,
  goalZ,
  bent: false,
  field: createTiles(0, 0),
  corners: [goalX, goalZ, 0],
  cornerIndex: new Map(),
  open: createHeap(),
  target: -1,
  exhausted: false,
  from: -1,
});

/** The field of a goal, nothing found yet. */
export function createLongWay(ground: Ground, goalX: number, goalZ: number): LongWay {
  const way: LongWay = {
    ...createStraightWay(goalX, goalZ),
    field: createTiles(ground.columns, ground.rows),
    from: freeCell(ground, goalX, goalZ),
  };
  if (way.from >= 0) {
    const { columns } = ground;
    setCost(way.field, way.from % columns, Math.floor(way.from / columns), 0, way.from);
    way.cornerIndex.set(way.from, 0);
    push(way.open, 0, way.from);
  }
  return way;
}

/**
 * Carries a field on until it covers a start and the ways near to it, or `most` cells were looked at; asked again it goes on.
 *
 * @returns whether nothing is left to do for this start.
 */
export function extendLongWay(
  ground: Ground,
  way: LongWay,
  startX: number,
  startZ: number,
  most = MOST_CELLS,
): boolean {
  if (!way.bent && ground.surface === null && clearWay(ground, way.goalX, way.goalZ, startX, startZ, 2))
    return true;
  way.bent = true;
  const target = freeCell(ground, startX, startZ);
  if (way.from < 0 || target < 0 || way.exhausted) return true;
  const { columns, rows, free, cell } = ground;
  const { field, open, cornerIndex, corners } = way;
  const ti = target % columns;
  const tk = Math.floor(target / columns);
  if (cornerAt(field, ti, tk) >= 0) return true;
  const far = (ai: number, ak: number, bi: number, bk: number): number =>
    cell * Math.sqrt((ai - bi) * (ai - bi) + (ak - bk) * (ak - bk));
  const centreX = (i: number): number => ground.x0 + (i + 0.5) * cell;
  const centreZ = (k: number): number => ground.z0 + (k + 0.5) * cell;
  const sees = (ai: number, ak: number, bi: number, bk: number, least: number): boolean =>
    clearWay(ground, centreX(ai), centreZ(ak), centreX(bi), centreZ(bk), least);
  const weight = (c: number): number => (free[c] === 1 ? NARROW : 1) * costOfCell(ground, c);
  if (way.target !== target) {
    // What is open is sorted anew for this start; what is closed stays right, as the straight distance never overestimates.
    way.target = target;
    resort(open, (c) => {
      const i = c % columns;
      const k = Math.floor(c / columns);
      return cornerAt(field, i, k) >= 0 ? -1 : costAt(field, i, k) + far(i, k, ti, tk);
    });
  }
  let enough = Number.POSITIVE_INFINITY;
  let looked = 0;
  while (open.size > 0 && looked < most) {
    if (open.keys[0] > enough) return true;
    const c = pop(open);
    const ci = c % columns;
    const ck = Math.floor(c / columns);
    if (cornerAt(field, ci, ck) >= 0) continue;
    looked++;
    // Sight to the parent was taken for granted; it is looked at once, here.
    let p = parentAt(field, ci, ck);
    if (
      p !== c &&
      !sees(p % columns, Math.floor(p / columns), ci, ck, free[c] >= 2 ? 2 : 1) &&
      !neighbours(p, ci, ck)
    ) {
      let best = Number.POSITIVE_INFINITY;
      eachNeighbour(ci, ck, (i, k) => {
        if (cornerAt(field, i, k) < 0) return;
        const g = costAt(field, i, k) + weight(c) * far(i, k, ci, ck);
        if (g < best) {
          best = g;
          p = k * columns + i;
        }
      });
      if (best === Number.POSITIVE_INFINITY) continue;
      const before = costAt(field, ci, ck);
      setCost(field, ci, ck, best, p);
      if (best > before + 1e-9) {
        push(open, best + far(ci, ck, ti, tk), c);
        continue;
      }
    }
    let corner = cornerIndex.get(p);
    const pi = p % columns;
    const pk = Math.floor(p / columns);
    if (corner === undefined) {
      corner = corners.length / 3;
      cornerIndex.set(p, corner);
      corners.push(centreX(pi), centreZ(pk), costAt(field, pi, pk));
    }
    setCorner(field, ci, ck, corner);
    if (c === target) enough = costAt(field, ci, ck) + SLACK;
    // Corners are at most some metres apart: sight is costly to look at. On another surface the way begins anew.
    const onward =
      far(pi, pk, ci, ck) > SIGHT || (ground.surface !== null && ground.surface[p] !== ground.surface[c]);
    const fi = onward ? ci : pi;
    const fk = onward ? ck : pk;
    const g = costAt(field, fi, fk);
    eachNeighbour(ci, ck, (i, k) => {
      if (cornerAt(field, i, k) >= 0) return;
      const n = k * columns + i;
      const next = g + weight(n) * far(fi, fk, i, k);
      if (next >= costAt(field, i, k)) return;
      setCost(field, i, k, next, fk * columns + fi);
      push(open, next + far(i, k, ti, tk), n);
    });
  }
  const found = cornerAt(field, ti, tk) >= 0;
  if (!found && (open.size === 0 || most >= MOST_CELLS)) way.exhausted = true;
  return found || way.exhausted;

  function neighbours(p: number, ci: number, ck: number): boolean {
    // Across the edge of a surface no straight sight is given; cells side by side still join.
    if (ground.surface === null) return false;
    return Math.abs((p % columns) - ci) <= 1 && Math.abs(Math.floor(p / columns) - ck) <= 1;
  }

  function eachNeighbour(ci: number, ck: number, visit: (i: number, k: number) => void): void {
    for (let dk = -1; dk <= 1; dk++)
      for (let di = -1; di <= 1; di++) {
        if (di === 0 && dk === 0) continue;
        const i = ci + di;
        const k = ck + dk;
        if (i < 0 || k < 0 || i >= columns || k >= rows) continue;
        if (free[k * columns + i] === 0) continue;
        // No cutting of corners.
        if (di !== 0 && dk !== 0 && (free[ck * columns + i] === 0 || free[k * columns + ci] === 0)) continue;
        visit(i, k);
      }
  }
}

/** The nearest cell to a point in which a body has room; -1 when none is within 3 m. */
function freeCell(ground: Ground, x: number, z: number): number {
  const { columns, rows, free } = ground;
  const ci = Math.floor((x - ground.x0) / ground.cell);
  const ck = Math.floor((z - ground.z0) / ground.cell);
  for (let r = 0; r <= 12; r++) {
    let best = -1;
    let least = Number.POSITIVE_INFINITY;
    for (let k = -r; k <= r; k++)
      for (let i = -r; i <= r; i++) {
        if (Math.max(Math.abs(i), Math.abs(k)) !== r) continue;
        const a = ci + i;
        const b = ck + k;
        if (a < 0 || b < 0 || a >= columns || b >= rows || free[b * columns + a] === 0) continue;
        const d = i * i + k * k;
        if (d < least) {
          least = d;
          best = b * columns + a;
        }
      }
    if (best >= 0) return best;
  }
  return -1;
}

/** Whether the field says something about a point. */
export function covers(ground: Ground, way: LongWay, x: number, z: number): boolean {
  const i = Math.floor((x - ground.x0) / ground.cell);
  const k = Math.floor((z - ground.z0) / ground.cell);
  return i >= 0 && k >= 0 && i < ground.columns && k < ground.rows && cornerAt(way.field, i, k) >= 0;
}

/** Writes the place to head for from the point at `at` in `places` and the distance still to go: x, z, distance. */
export function ahead(
  out: Float64Array,
  ground: Ground,
  way: LongWay,
  places: Float64Array,
  at: number,
): void {
  const x = places[at];
  const z = places[at + 1];
  const gx = x - way.goalX;
  const gz = z - way.goalZ;
  out[0] = way.goalX;
  out[1] = way.goalZ;
  out[2] = Math.sqrt(gx * gx + gz * gz);
  if (!way.bent) return;
  const { columns, rows } = ground;
  const i = Math.floor((x - ground.x0) * ground.perMetre);
  const k = Math.floor((z - ground.z0) * ground.perMetre);
  let corner = i < 0 || k < 0 || i >= columns || k >= rows ? -1 : cornerAt(way.field, i, k);
  // Beside the field: the nearest known neighbour's.
  for (let r = 1; r <= 3 && corner < 0; r++)
    for (let b = Math.max(0, k - r); b <= k + r && b < rows && corner < 0; b++)
      for (let a = Math.max(0, i - r); a <= i + r && a < columns && corner < 0; a++)
        corner = cornerAt(way.field, a, b);
  if (corner < 0) {
    out[2] += 3;
    return;
  }
  const { corners } = way;
  const dx = x - corners[3 * corner];
  const dz = z - corners[3 * corner + 1];
  out[0] = corners[3 * corner];
  out[1] = corners[3 * corner + 1];
  const left = Math.sqrt(dx * dx + dz * dz);
  out[2] = (ground.surface === null ? left : left * surfaceCost(ground, x, z)) + corners[3 * corner + 2];
}

/** Corners from a point to the goal, for drawing: x, z, x, z, ... with both ends. */
export function wayPoints(ground: Ground, way: LongWay, x: number, z: number): number[] {
  const points = [x, z];
  const next = new Float64Array(3);
  const here = new Float64Array(2);
  let last = Number.POSITIVE_INFINITY;
  for (let n = 0; n < 64; n++) {
    here.set(points.slice(-2));
    ahead(next, ground, way, here, 0);
    if (next[2] >= last) break;
    last = next[2];
    points.push(next[0], next[1]);
    if (next[0] === way.goalX && next[1] === way.goalZ) break;
  }
  return points;
}

interface Heap {
  keys: number[];
  values: number[];
  size: number;
}

const createHeap = (): Heap => ({ keys: [], values: [], size: 0 });

/** Gives every entry a new key; those with a negative one are dropped. */
function resort(h: Heap, keyOf: (value: number) => number): void {
  const { values, size } = h;
  const kept: number[] = [];
  for (let i = 0; i < size; i++) kept.push(values[i]);
  h.size = 0;
  for (const v of kept) {
    const k = keyOf(v);
    if (k >= 0) push(h, k, v);
  }
}

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
