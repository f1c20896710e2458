/**
 * Exact nearest neighbours, fast: bounds that can be proven leave most examples unlooked at, and never change an answer.
 *
 * Examples come in the order of their frames, so neighbours in memory are neighbours in space: sixteen of them share a
 * box. All are also known by their first few coordinates in an orthonormal basis (principal axes of the examples) and by the length
 * of the rest; for two vectors, |a - b|^2 >= |a_p - b_p|^2 + (|a_r| - |b_r|)^2 holds for any orthonormal projection, and a box's
 * nearest point bounds all in it. What passes is measured in full, stopping early. The answer for the frame before, moved on by a
 * frame, is where the search begins [Oracle §4 asks for an approximate search here; this one is exact].
 */
import { createRandom } from "../math/random.ts";

/** Coordinates kept by projection, and one more for the length of the rest. */
const AXES = 12;
const ROW = AXES + 1;
const BLOCK = 16;
/** Coordinates summed between two looks at the bound. */
const STRIDE = 24;

export interface NearestIndex {
  data: Float32Array;
  count: number;
  size: number;
  mean: Float64Array;
  /** AXES x size, orthonormal rows. */
  basis: Float64Array;
  /** count x ROW: coordinates and length of the rest. */
  short: Float32Array;
  /** Least and largest of each coordinate in each block: blocks x ROW. */
  low: Float32Array;
  high: Float32Array;
}

/** Makes the index of `count` rows of `size` numbers; the rows are kept, not copied. */
export function createNearestIndex(data: Float32Array, count: number, size: number): NearestIndex {
  const mean = new Float64Array(size);
  for (let i = 0; i < count; i++) for (let k = 0; k < size; k++) mean[k] += data[i * size + k];
  for (let k = 0; k < size; k++) mean[k] /= Math.max(1, count);
  const basis = principalAxes(data, count, size, mean);
  const blocks = Math.ceil(count / BLOCK);
  const index: NearestIndex = {
    data,
    count,
    size,
    mean,
    basis,
    short: new Float32Array(count * ROW),
    low: new Float32Array(blocks * ROW).fill(Number.POSITIVE_INFINITY),
    high: new Float32Array(blocks * ROW).fill(Number.NEGATIVE_INFINITY),
  };
  const row = new Float64Array(ROW);
  for (let i = 0; i < count; i++) {
    project(row, index, data, i * size);
    const b = Math.floor(i / BLOCK) * ROW;
    for (let k = 0; k < ROW; k++) {
      index.short[i * ROW + k] = row[k];
      const kept = index.short[i * ROW + k];
      index.low[b + k] = Math.min(index.low[b + k], kept);
      index.high[b + k] = Math.max(index.high[b + k], kept);
    }
  }
  return index;
}

/** First coordinates of a row and the length of what they leave. */
function project(out: Float64Array, index: NearestIndex, data: Float32Array, at: number): void {
  const { size, mean, basis } = index;
  let all = 0;
  for (let k = 0; k < size; k++) {
    const d = data[at + k] - mean[k];
    all += d * d;
  }
  let kept = 0;
  for (let a = 0; a < AXES; a++) {
    let s = 0;
    const row = a * size;
    for (let k = 0; k < size; k++) s += basis[row + k] * (data[at + k] - mean[k]);
    out[a] = s;
    kept += s * s;
  }
  out[AXES] = Math.sqrt(Math.max(0, all - kept));
}

/** Leading axes of the examples by orthogonal iteration over a sample; any orthonormal rows keep the bound true. */
function principalAxes(data: Float32Array, count: number, size: number, mean: Float64Array): Float64Array {
  const r = createRandom(1);
  const basis = new Float64Array(AXES * size);
  for (let i = 0; i < basis.length; i++) basis[i] = r.normal();
  const step = Math.max(1, Math.floor(count / 1500));
  const next = new Float64Array(AXES * size);
  orthonormalise(basis, size);
  for (let round = 0; round < 6; round++) {
    next.fill(0);
    for (let i = 0; i < count; i += step) {
      const at = i * size;
      for (let a = 0; a < AXES; a++) {
        let s = 0;
        for (let k = 0; k < size; k++) s += basis[a * size + k] * (data[at + k] - mean[k]);
        for (let k = 0; k < size; k++) next[a * size + k] += s * (data[at + k] - mean[k]);
      }
    }
    basis.set(next);
    orthonormalise(basis, size);
  }
  return basis;
}

/** Gram-Schmidt, twice for accuracy; a row that vanishes becomes zero, which keeps the bound. */
function orthonormalise(basis: Float64Array, size: number): void {
  for (let a = 0; a < AXES; a++) {
    for (let pass = 0; pass < 2; pass++) {
      for (let b = 0; b < a; b++) {
        let s = 0;
        for (let k = 0; k < size; k++) s += basis[a * size + k] * basis[b * size + k];
        for (let k = 0; k < size; k++) basis[a * size + k] -= s * basis[b * size + k];
      }
    }
    let n = 0;
    for (let k = 0; k < size; k++) n += basis[a * size + k] ** 2;
    const f = n > 1e-20 ? 1 / Math.sqrt(n) : 0;
    for (let k = 0; k < size; k++) basis[a * size + k] *= f;
  }
}

/** Room for searches of the k nearest; keeps the last answer, from which the next search begins. */
export interface NearestSearch {
  index: NearestIndex;
  k: number;
  /** Examples found, nearest first, and their squared distances; of equal distances the earlier example. */
  found: Int32Array;
  distance: Float64Array;
  size: number;
  query: Float64Array;
  bounds: Float64Array;
  seen: Uint8Array;
  /** Examples measured in full or in part by the last search. */
  measured: number;
}

export function createNearestSearch(index: NearestIndex, k: number): NearestSearch {
  return {
    index,
    k,
    found: new Int32Array(k).fill(-1),
    distance: new Float64Array(k),
    size: 0,
    query: new Float64Array(ROW),
    bounds: new Float64Array(Math.ceil(index.count / BLOCK)),
    seen: new Uint8Array(index.count),
    measured: 0,
  };
}

/** Float rounding in the bounds may not throw an example out: they are taken a little smaller. */
const SAFE = 1 - 1e-5;

const hints = new Int32Array(256);

/** Finds the k nearest examples to the row at `at` of `data`, into search.found and search.distance. */
export function findNearest(s: NearestSearch, data: Float32Array, at: number): void {
  const { index, query, bounds } = s;
  const { count, low, high, short } = index;
  project(query, index, data, at);
  let hinted = 0;
  for (let i = 0; i < s.size; i++) {
    for (let d = 0; d <= 1; d++) {
      const e = s.found[i] + d;
      if (e < count && hinted < hints.length) hints[hinted++] = e;
    }
  }
  s.size = 0;
  s.measured = 0;
  for (let i = 0; i < hinted; i++) consider(s, hints[i], data, at);
  const blocks = bounds.length;
  let nearest = 0;
  for (let b = 0; b < blocks; b++) {
    const o = b * ROW;
    let sum = 0;
    for (let k = 0; k < ROW; k++) {
      const q = query[k];
      const d = q < low[o + k] ? low[o + k] - q : q > high[o + k] ? q - high[o + k] : 0;
      sum += d * d;
    }
    bounds[b] = sum * SAFE;
    if (bounds[b] < bounds[nearest]) nearest = b;
  }
  // Without a good answer to begin with, the nearest box gives one.
  if (hinted === 0) scan(s, nearest, data, at);
  for (let b = 0; b < blocks; b++)
    if (s.size < s.k || bounds[b] <= s.distance[s.size - 1]) scan(s, b, data, at);
  for (let i = 0; i < touched; i++) s.seen[marks[i]] = 0;
  touched = 0;

  function scan(search: NearestSearch, block: number, rows: Float32Array, offset: number): void {
    const end = Math.min(count, (block + 1) * BLOCK);
    for (let e = block * BLOCK; e < end; e++) {
      if (search.size === search.k) {
        const worst = search.distance[search.size - 1];
        let sum = 0;
        const o = e * ROW;
        for (let k = 0; k < ROW; k++) {
          const d = query[k] - short[o + k];
          sum += d * d;
        }
        if (sum * SAFE > worst) continue;
      }
      consider(search, e, rows, offset);
    }
  }
}

let marks = new Int32Array(1024);
let touched = 0;

/** Measures an example, giving up once it is farther than the k-th, and sorts it in. */
function consider(s: NearestSearch, e: number, rows: Float32Array, at: number): void {
  if (s.seen[e]) return;
  s.seen[e] = 1;
  if (touched === marks.length) {
    const more = new Int32Array(2 * marks.length);
    more.set(marks);
    marks = more;
  }
  marks[touched++] = e;
  s.measured++;
  const { data, size } = s.index;
  const worst = s.size === s.k ? s.distance[s.k - 1] : Number.POSITIVE_INFINITY;
  const o = e * size;
  let sum = 0;
  for (let from = 0; from < size; ) {
    const to = Math.min(size, from + STRIDE);
    for (let k = from; k < to; k++) {
      const d = data[o + k] - rows[at + k];
      sum += d * d;
    }
    if (sum > worst) return;
    from = to;
  }
  let i = s.size < s.k ? s.size++ : s.k - 1;
  if (s.size === s.k && i === s.k - 1 && sum === worst && s.found[i] >= 0 && s.found[i] < e) return;
  while (i > 0 && (s.distance[i - 1] > sum || (s.distance[i - 1] === sum && s.found[i - 1] > e))) {
    s.distance[i] = s.distance[i - 1];
    s.found[i] = s.found[i - 1];
    i--;
  }
  s.distance[i] = sum;
  s.found[i] = e;
}
