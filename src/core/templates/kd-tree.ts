/** A k-d tree over typed arrays: the k nearest rows under the Euclidean metric, exact. */

export interface KdTree {
  dimensions: number;
  /** Rows in tree order: count x dimensions, and each row's index as it was given. */
  points: Float64Array;
  ids: Int32Array;
}

/**
 * Builds a balanced tree: the middle row of a span splits it along the axis of its depth.
 *
 * @param rows count x dimensions; copied.
 */
export function createKdTree(rows: Float64Array, dimensions: number): KdTree {
  const count = rows.length / dimensions;
  const ids = Int32Array.from({ length: count }, (_, i) => i);
  const build = (from: number, to: number, depth: number) => {
    if (to - from <= 1) return;
    const axis = depth % dimensions;
    const span = ids.subarray(from, to);
    // Ties go by index, so that the tree does not depend on the sort.
    span.sort((a, b) => rows[a * dimensions + axis] - rows[b * dimensions + axis] || a - b);
    const middle = (from + to) >> 1;
    build(from, middle, depth + 1);
    build(middle + 1, to, depth + 1);
  };
  build(0, count, 0);
  const points = new Float64Array(rows.length);
  for (let i = 0; i < count; i++)
    for (let k = 0; k < dimensions; k++) points[i * dimensions + k] = rows[ids[i] * dimensions + k];
  return { dimensions, points, ids };
}

/** The k nearest rows, nearest first (ties by index): index and distance. */
export function nearest(
  tree: KdTree,
  query: readonly number[],
  k: number,
): { id: number; distance: number }[] {
  const best: { id: number; distance: number }[] = [];
  const { dimensions: d, points, ids } = tree;
  const worse = (a: { id: number; distance: number }, b: { id: number; distance: number }) =>
    a.distance - b.distance || a.id - b.id;
  const visit = (from: number, to: number, depth: number) => {
    if (to <= from) return;
    const middle = (from + to) >> 1;
    let square = 0;
    for (let c = 0; c < d; c++) square += (points[middle * d + c] - query[c]) ** 2;
    const here = { id: ids[middle], distance: Math.sqrt(square) };
    if (best.length < k || worse(here, best[best.length - 1]) < 0) {
      best.push(here);
      best.sort(worse);
      if (best.length > k) best.pop();
    }
    const axis = depth % d;
    const gap = query[axis] - points[middle * d + axis];
    const near: [number, number] = gap <= 0 ? [from, middle] : [middle + 1, to];
    const far: [number, number] = gap <= 0 ? [middle + 1, to] : [from, middle];
    visit(near[0], near[1], depth + 1);
    if (best.length < k || Math.abs(gap) <= best[best.length - 1].distance) visit(far[0], far[1], depth + 1);
  };
  visit(0, ids.length, 0);
  return best;
}
