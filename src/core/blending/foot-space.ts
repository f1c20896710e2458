/**
 * A foot's parametric space Omega_f [Barycentric §4.1, Figure 3]: landing points with the root kept in place, their
 * Delaunay triangulation, the walk to the triangle of a query, and the projection of what lies outside the hull.
 *
 * Triangulation by delaunator; layout of its arrays: triangle t has the corners triangles[3t .. 3t+2], half-edge e runs
 * from triangles[e] to the next corner of its triangle, halfedges[e] is its twin or -1 on the hull.
 */
import Delaunator from "delaunator";

export interface FootSpace {
  /** Landing points p_i, lateral and forward by turns, metres; one a clip. */
  points: Float64Array;
  triangles: Int32Array;
  halfedges: Int32Array;
  /** Corners of the hull in order. */
  hull: Int32Array;
}

/** What a query met. */
export interface Located {
  triangle: number;
  /** Barycentric weights of the triangle's three corners, none negative, sum 1. */
  weights: Float64Array;
  /** The point that was weighed: the query, or its projection on the hull. */
  x: number;
  z: number;
  /** Distance from the query to the hull, metres; 0 within. */
  outside: number;
}

export const createLocated = (): Located => ({
  triangle: 0,
  weights: new Float64Array(3),
  x: 0,
  z: 0,
  outside: 0,
});

/**
 * Triangulates landing points.
 *
 * @param points lateral and forward by turns, metres, at least three that are not on one line.
 * @throws RangeError when they span no triangle.
 */
export function createFootSpace(points: Float64Array): FootSpace {
  const d = new Delaunator(points);
  if (d.triangles.length === 0)
    throw new RangeError(
      `landing points: three that are not on one line are needed, found ${points.length / 2}.`,
    );
  return {
    points,
    triangles: Int32Array.from(d.triangles),
    halfedges: Int32Array.from(d.halfedges),
    hull: Int32Array.from(d.hull),
  };
}

/** Twice the signed area of a, b, q: of one sign for all edges of the triangle that q is in. */
const side = (ax: number, az: number, bx: number, bz: number, x: number, z: number): number =>
  (bx - ax) * (z - az) - (bz - az) * (x - ax);

/**
 * The triangle of a query and its weights [Barycentric eq. 1], walking from triangle `from` across the edges that the
 * query is beyond; a query outside is projected orthogonally on the hull [§5].
 *
 * No allocation. @param out written; out.weights are in the order of the triangle's corners.
 */
export function locate(out: Located, space: FootSpace, x: number, z: number, from: number): void {
  const { points, triangles, halfedges } = space;
  const count = triangles.length / 3;
  let t = from >= 0 && from < count ? from : 0;
  // A visibility walk in a Delaunay triangulation cannot turn round for ever; the bound is for rounding alone.
  for (let guard = 0; guard <= count; guard++) {
    let next = -1;
    let onHull = false;
    for (let k = 0; k < 3; k++) {
      const a = triangles[3 * t + k];
      const b = triangles[3 * t + ((k + 1) % 3)];
      // delaunator's triangles run clockwise with z to the right of x as it sees them: inside is where this is <= 0.
      if (side(points[2 * a], points[2 * a + 1], points[2 * b], points[2 * b + 1], x, z) > 0) {
        const twin = halfedges[3 * t + k];
        if (twin < 0) onHull = true;
        else {
          next = (twin / 3) | 0;
          break;
        }
      }
    }
    if (next >= 0) {
      t = next;
      continue;
    }
    if (onHull) {
      project(out, space, x, z);
      return;
    }
    break;
  }
  out.triangle = t;
  out.x = x;
  out.z = z;
  out.outside = 0;
  barycentric(out.weights, space, t, x, z);
}

/** Barycentric coordinates of a point in triangle t, clipped at 0 and normalised against rounding. */
export function barycentric(out: Float64Array, space: FootSpace, t: number, x: number, z: number): void {
  const { points, triangles } = space;
  const a = 2 * triangles[3 * t];
  const b = 2 * triangles[3 * t + 1];
  const c = 2 * triangles[3 * t + 2];
  const area = side(points[a], points[a + 1], points[b], points[b + 1], points[c], points[c + 1]);
  let u = side(points[b], points[b + 1], points[c], points[c + 1], x, z) / area;
  let v = side(points[c], points[c + 1], points[a], points[a + 1], x, z) / area;
  let w = 1 - u - v;
  u = Math.max(u, 0);
  v = Math.max(v, 0);
  w = Math.max(w, 0);
  const sum = u + v + w;
  out[0] = u / sum;
  out[1] = v / sum;
  out[2] = w / sum;
}

/** Nearest point of the hull; its triangle is the one inside that edge. */
function project(out: Located, space: FootSpace, x: number, z: number): void {
  const { points, hull, triangles, halfedges } = space;
  let best = Number.POSITIVE_INFINITY;
  let ea = 0;
  let eb = 0;
  for (let k = 0; k < hull.length; k++) {
    const a = hull[k];
    const b = hull[(k + 1) % hull.length];
    const dx = points[2 * b] - points[2 * a];
    const dz = points[2 * b + 1] - points[2 * a + 1];
    const along = ((x - points[2 * a]) * dx + (z - points[2 * a + 1]) * dz) / (dx * dx + dz * dz);
    const u = along < 0 ? 0 : Math.min(along, 1);
    const px = points[2 * a] + u * dx;
    const pz = points[2 * a + 1] + u * dz;
    const d = (x - px) * (x - px) + (z - pz) * (z - pz);
    if (d < best) {
      best = d;
      ea = a;
      eb = b;
      out.x = px;
      out.z = pz;
    }
  }
  out.outside = Math.sqrt(best);
  for (let e = 0; e < triangles.length; e++) {
    if (halfedges[e] >= 0) continue;
    const a = triangles[e];
    const b = triangles[e % 3 === 2 ? e - 2 : e + 1];
    if ((a === ea && b === eb) || (a === eb && b === ea)) {
      out.triangle = (e / 3) | 0;
      break;
    }
  }
  barycentric(out.weights, space, out.triangle, out.x, out.z);
}

/** Area of triangle t, square metres. */
export function triangleArea(space: FootSpace, t: number): number {
  const { points, triangles } = space;
  const [a, b, c] = [0, 1, 2].map((k) => 2 * triangles[3 * t + k]);
  return Math.abs(side(points[a], points[a + 1], points[b], points[b + 1], points[c], points[c + 1])) / 2;
}
