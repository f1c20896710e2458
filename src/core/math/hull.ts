/** Convex hull of a few points of the ground and the nearest point in it, without allocation per call. */

export interface Hull {
  /** Corners in use. */
  size: number;
  /** Corners, x and z by turns, counter-clockwise in (x, z). */
  corners: Float64Array;
  /** Indices of the points by x, then z. */
  order: Int32Array;
}

/** Room for the hull of up to `capacity` points. */
export function createHull(capacity: number): Hull {
  return { size: 0, corners: new Float64Array(4 * capacity + 4), order: new Int32Array(capacity) };
}

/** Fills `hull` from `count` points (x, z pairs in `flat`); of collinear points it keeps the ends [Andrew's monotone chain]. */
export function convexHull(hull: Hull, flat: ArrayLike<number>, count: number): void {
  const { order, corners } = hull;
  for (let i = 0; i < count; i++) {
    let k = i;
    while (k > 0 && after(flat, order[k - 1], i)) {
      order[k] = order[k - 1];
      k--;
    }
    order[k] = i;
  }
  let n = 0;
  for (let pass = 0; pass < 2; pass++) {
    const base = n;
    for (let i = 0; i < count; i++) {
      const p = order[pass === 0 ? i : count - 1 - i];
      while (n - base >= 2 && turn(corners, n, flat[2 * p], flat[2 * p + 1]) <= 0) n--;
      corners[2 * n] = flat[2 * p];
      corners[2 * n + 1] = flat[2 * p + 1];
      n++;
    }
    // Each chain ends where the other begins.
    if (count > 1) n--;
  }
  hull.size = count === 0 ? 0 : Math.max(1, n);
}

function after(flat: ArrayLike<number>, a: number, b: number): boolean {
  return flat[2 * a] > flat[2 * b] || (flat[2 * a] === flat[2 * b] && flat[2 * a + 1] > flat[2 * b + 1]);
}

function turn(c: Float64Array, n: number, x: number, z: number): number {
  const ax = c[2 * n - 4];
  const az = c[2 * n - 3];
  return (c[2 * n - 2] - ax) * (z - az) - (c[2 * n - 1] - az) * (x - ax);
}

/** Distance from (x, z) to a hull that is not empty, 0 inside; the nearest point goes to out[0], out[1]. */
export function nearestInHull(out: Float64Array, hull: Hull, x: number, z: number): number {
  const { corners, size } = hull;
  let inside = size > 2;
  let best = Number.POSITIVE_INFINITY;
  for (let i = 0; i < size; i++) {
    const j = i + 1 === size ? 0 : i + 1;
    const ax = corners[2 * i];
    const az = corners[2 * i + 1];
    const ex = corners[2 * j] - ax;
    const ez = corners[2 * j + 1] - az;
    if (ex * (z - az) - ez * (x - ax) < 0) inside = false;
    const t = Math.max(0, Math.min(1, ((x - ax) * ex + (z - az) * ez) / (ex * ex + ez * ez || 1e-12)));
    const d = Math.hypot(x - ax - t * ex, z - az - t * ez);
    if (d < best) {
      best = d;
      out[0] = ax + t * ex;
      out[1] = az + t * ez;
    }
  }
  if (!inside) return best;
  out[0] = x;
  out[1] = z;
  return 0;
}
