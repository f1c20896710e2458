/** Numbers for the cells of a grid of which only some are ever touched: kept in tiles of 16 x 16, made when first written. */

const SIDE = 16;
const AREA = SIDE * SIDE;

export interface Tiles {
  columns: number;
  across: number;
  tiles: (Tile | undefined)[];
}

/** For each cell: the corner that it sees (-1: not closed yet), cost so far, and parent cell. */
interface Tile {
  corner: Int32Array;
  cost: Float64Array;
  parent: Int32Array;
}

export function createTiles(columns: number, rows: number): Tiles {
  const across = Math.ceil(columns / SIDE);
  return { columns, across, tiles: new Array<Tile | undefined>(across * Math.ceil(rows / SIDE)) };
}

function tileOf(t: Tiles, i: number, k: number): Tile {
  const at = (k >> 4) * t.across + (i >> 4);
  let tile = t.tiles[at];
  if (!tile) {
    tile = {
      corner: new Int32Array(AREA).fill(-1),
      cost: new Float64Array(AREA).fill(Number.POSITIVE_INFINITY),
      parent: new Int32Array(AREA).fill(-1),
    };
    t.tiles[at] = tile;
  }
  return tile;
}

/** The corner of the cell at column i, row k; -1 when it has none. */
export function cornerAt(t: Tiles, i: number, k: number): number {
  const tile = t.tiles[(k >> 4) * t.across + (i >> 4)];
  return tile === undefined ? -1 : tile.corner[((k & 15) << 4) | (i & 15)];
}

export function setCorner(t: Tiles, i: number, k: number, corner: number): void {
  tileOf(t, i, k).corner[((k & 15) << 4) | (i & 15)] = corner;
}

export function costAt(t: Tiles, i: number, k: number): number {
  const tile = t.tiles[(k >> 4) * t.across + (i >> 4)];
  return tile === undefined ? Number.POSITIVE_INFINITY : tile.cost[((k & 15) << 4) | (i & 15)];
}

export function parentAt(t: Tiles, i: number, k: number): number {
  const tile = t.tiles[(k >> 4) * t.across + (i >> 4)];
  return tile === undefined ? -1 : tile.parent[((k & 15) << 4) | (i & 15)];
}

export function setCost(t: Tiles, i: number, k: number, cost: number, parent: number): void {
  const tile = tileOf(t, i, k);
  const at = ((k & 15) << 4) | (i & 15);
  tile.cost[at] = cost;
  tile.parent[at] = parent;
}
