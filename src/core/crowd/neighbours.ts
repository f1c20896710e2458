/** Who is near whom: a spatial hash of everybody's place, made anew each tick, and what a walker sees of them. */
import { MOST_OTHERS } from "./judge.ts";
import { boundAt, type Sight } from "./sight.ts";
import { S } from "./state.ts";
import type { Gait } from "./types.ts";

const CELL = 3.5;
const BUCKETS = 4096;

export interface Neighbours {
  /** First walker in each bucket and the next one after each, -1 for none; the cell each is in. */
  heads: Int32Array;
  nexts: Int32Array;
  cellX: Int32Array;
  cellZ: Int32Array;
  /** Places now: x, z. */
  places: Float64Array;
  /** The answer of `look`: nearest first, and how near they count. */
  seen: Int32Array;
  gaps: Float64Array;
}

export const createNeighbours = (walkers: number): Neighbours => ({
  heads: new Int32Array(BUCKETS),
  nexts: new Int32Array(walkers),
  cellX: new Int32Array(walkers),
  cellZ: new Int32Array(walkers),
  places: new Float64Array(2 * walkers),
  seen: new Int32Array(MOST_OTHERS + 1),
  gaps: new Float64Array(MOST_OTHERS + 1),
});

const bucketOf = (i: number, k: number): number =>
  ((Math.imul(i, 73856093) ^ Math.imul(k, 19349663)) >>> 0) & (BUCKETS - 1);

/** Everyone who is here into cells, where they are now. */
export function placeAll(
  n: Neighbours,
  sight: Sight,
  people: readonly { here: boolean }[],
  tick: number,
): void {
  n.heads.fill(-1);
  for (let i = people.length - 1; i >= 0; i--) {
    if (!people[i].here) continue;
    const o = boundAt(sight, i, tick);
    const x = sight.bound[o];
    const z = sight.bound[o + 1];
    n.places[2 * i] = x;
    n.places[2 * i + 1] = z;
    n.cellX[i] = Math.floor(x / CELL);
    n.cellZ[i] = Math.floor(z / CELL);
    const b = bucketOf(n.cellX[i], n.cellZ[i]);
    n.nexts[i] = n.heads[b];
    n.heads[b] = i;
  }
}

/**
 * Fills `seen` with the others in a walker's visual field, nearest first, at most MOST_OTHERS: all within its radius, behind
 * the back only those close by [Footsteps §3.3]. Returns how many.
 */
export function look(n: Neighbours, walker: number, states: Float64Array, s: number, gait: Gait): number {
  const { seen, gaps, places } = n;
  const x = states[s + S.x];
  const z = states[s + S.z];
  const faceX = states[s + S.faceX];
  const faceZ = states[s + S.faceZ];
  const cx = Math.floor(x / CELL);
  const cz = Math.floor(z / CELL);
  const r = Math.ceil(gait.sight / CELL);
  const far2 = gait.sight * gait.sight;
  const behind2 = gait.sightBehind * gait.sightBehind;
  let count = 0;
  for (let a = cx - r; a <= cx + r; a++)
    for (let b = cz - r; b <= cz + r; b++)
      for (let k = n.heads[bucketOf(a, b)]; k >= 0; k = n.nexts[k]) {
        if (k === walker || n.cellX[k] !== a || n.cellZ[k] !== b) continue;
        const dx = places[2 * k] - x;
        const dz = places[2 * k + 1] - z;
        const d2 = dx * dx + dz * dz;
        if (d2 > far2) continue;
        const front = dx * faceX + dz * faceZ;
        if (front < -0.5 && d2 > behind2) continue;
        // Who is in front counts as nearer.
        const d = Math.sqrt(d2) + (front < 0 ? 0.6 : 0);
        if (count === MOST_OTHERS && d >= gaps[count - 1]) continue;
        let at = count < MOST_OTHERS ? count++ : count - 1;
        while (at > 0 && gaps[at - 1] > d) {
          gaps[at] = gaps[at - 1];
          seen[at] = seen[at - 1];
          at--;
        }
        gaps[at] = d;
        seen[at] = k;
      }
  return count;
}
