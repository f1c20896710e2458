/** Walls with a door and polygons as the boxes that crowds know. */
import type { Obstacle } from "./types.ts";

/**
 * A wall with a gap in it: the one or two boxes that are left of it.
 *
 * @param wall the whole of it. @param at the door's middle along the wall's x, 0 to 1. @param radius half the door's width, metres.
 */
export function wallObstacles(wall: Obstacle, at: number, radius: number): Obstacle[] {
  const middle = (at - 0.5) * 2 * wall.halfX;
  const parts: Obstacle[] = [];
  for (const [from, to] of [
    [-wall.halfX, Math.min(wall.halfX, middle - radius)],
    [Math.max(-wall.halfX, middle + radius), wall.halfX],
  ]) {
    if (to <= from) continue;
    const along = (from + to) / 2;
    // A box's own x axis is (cos, -sin) on the ground.
    parts.push({
      ...wall,
      x: wall.x + wall.cos * along,
      z: wall.z - wall.sin * along,
      halfX: (to - from) / 2,
    });
  }
  return parts;
}

/** Height of a row of boxes inside a polygon, metres: what is left beside its edge is too narrow for a body. */
const ROW = 0.3;
/** Rows at most: inside a larger polygon they are higher, and what they leave open lies behind its edges. */
const MOST_ROWS = 60;

type Point = readonly [number, number];

/**
 * A polygon, of any shape, as boxes: its edges without thickness, where distances from outside are exact; and rows of boxes
 * within, so that nobody's way or place is there.
 *
 * @param corners x, z in order, two (a line) or more.
 */
export function wallsOfPolygon(corners: readonly Point[]): Obstacle[] {
  const out: Obstacle[] = [];
  const edges = corners
    .map((a, i): [Point, Point] => [a, corners[(i + 1) % corners.length]])
    .slice(0, corners.length === 2 ? 1 : undefined);
  for (const [a, b] of edges) {
    const dx = b[0] - a[0];
    const dz = b[1] - a[1];
    const length = Math.sqrt(dx * dx + dz * dz);
    if (length === 0) continue;
    out.push({
      x: (a[0] + b[0]) / 2,
      z: (a[1] + b[1]) / 2,
      halfX: length / 2,
      halfZ: 0,
      cos: dx / length,
      sin: -dz / length,
      round: false,
    });
  }
  const zs = corners.map((c) => c[1]);
  const low = Math.min(...zs);
  const high = Math.max(...zs);
  const rows = Math.min(MOST_ROWS, Math.ceil((high - low) / ROW));
  for (let r = 0; r < rows; r++)
    out.push(...rowWithin(edges, low + ((high - low) * r) / rows, low + ((high - low) * (r + 1)) / rows));
  return out;
}

/** Boxes of a row that no edge passes through and that lie inside. */
function rowWithin(edges: readonly (readonly [Point, Point])[], z0: number, z1: number): Obstacle[] {
  const crossed: [number, number][] = [];
  for (const [a, b] of edges) {
    const from = Math.max(z0, Math.min(a[1], b[1]));
    const to = Math.min(z1, Math.max(a[1], b[1]));
    if (from > to) continue;
    const at = (z: number): number =>
      b[1] === a[1] ? a[0] : a[0] + ((b[0] - a[0]) * (z - a[1])) / (b[1] - a[1]);
    const xs = a[1] === b[1] ? [a[0], b[0]] : [at(from), at(to)];
    crossed.push([Math.min(...xs), Math.max(...xs)]);
  }
  crossed.sort((p, q) => p[0] - q[0]);
  const out: Obstacle[] = [];
  const z = (z0 + z1) / 2;
  let end = Number.NEGATIVE_INFINITY;
  for (const [x0, x1] of crossed) {
    if (x0 > end && end > Number.NEGATIVE_INFINITY && isInside(edges, (end + x0) / 2, z))
      out.push({
        x: (end + x0) / 2,
        z,
        halfX: (x0 - end) / 2,
        halfZ: (z1 - z0) / 2,
        cos: 1,
        sin: 0,
        round: false,
      });
    end = Math.max(end, x1);
  }
  return out;
}

/** Whether a point is inside: an odd number of edges to its right. */
function isInside(edges: readonly (readonly [Point, Point])[], x: number, z: number): boolean {
  let inside = false;
  for (const [a, b] of edges)
    if (a[1] > z !== b[1] > z && x < a[0] + ((b[0] - a[0]) * (z - a[1])) / (b[1] - a[1])) inside = !inside;
  return inside;
}
