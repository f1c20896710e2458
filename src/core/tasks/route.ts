/**
 * Routes round furniture: not in [TaskLoco], which walks in an empty room.
 *
 * A visibility graph over the obstacles' corners, pushed out by the walker's clearance, searched with A*
 * (straight-line heuristic). Rooms have tens of corners, so the whole graph is built for each query.
 */

/** What a body may not enter, on the ground, metres: a box turned by yaw (half sizes) or a disc. */
export type Obstacle =
  | { kind: "box"; id: string; x: number; z: number; yaw: number; halfWidth: number; halfDepth: number }
  | { kind: "disc"; id: string; x: number; z: number; radius: number };

export interface GroundPoint {
  x: number;
  z: number;
}

/** Signed distance from a point to an obstacle's outline: negative inside. */
export function obstacleDistance(o: Obstacle, x: number, z: number): number {
  if (o.kind === "disc") return Math.hypot(x - o.x, z - o.z) - o.radius;
  const c = Math.cos(o.yaw);
  const s = Math.sin(o.yaw);
  const u = Math.abs(c * (x - o.x) - s * (z - o.z)) - o.halfWidth;
  const v = Math.abs(s * (x - o.x) + c * (z - o.z)) - o.halfDepth;
  return Math.hypot(Math.max(u, 0), Math.max(v, 0)) + Math.min(Math.max(u, v), 0);
}

/** The nearest point at least `clearance` outside every obstacle (pushed out at most 12 times). Mutates `p`. */
export function pushOut(p: GroundPoint, obstacles: readonly Obstacle[], clearance: number): boolean {
  for (let round = 0; round < 12; round++) {
    let moved = false;
    for (const o of obstacles) {
      const d = obstacleDistance(o, p.x, p.z);
      if (d >= clearance - 1e-9) continue;
      const h = 1e-5;
      let gx = obstacleDistance(o, p.x + h, p.z) - obstacleDistance(o, p.x - h, p.z);
      let gz = obstacleDistance(o, p.x, p.z + h) - obstacleDistance(o, p.x, p.z - h);
      const g = Math.hypot(gx, gz);
      if (g < 1e-12) {
        gx = 0;
        gz = 1;
      } else {
        gx /= g;
        gz /= g;
      }
      p.x += gx * (clearance - d + 1e-4);
      p.z += gz * (clearance - d + 1e-4);
      moved = true;
    }
    if (!moved) return true;
  }
  return obstacles.every((o) => obstacleDistance(o, p.x, p.z) >= clearance - 1e-3);
}

/** Corners to walk round, `clearance` outside the outline. */
function corners(o: Obstacle, clearance: number): GroundPoint[] {
  if (o.kind === "disc") {
    // An octagon whose sides stay outside the disc.
    const r = (o.radius + clearance) / Math.cos(Math.PI / 8);
    return Array.from({ length: 8 }, (_, k) => ({
      x: o.x + r * Math.sin((k * Math.PI) / 4),
      z: o.z + r * Math.cos((k * Math.PI) / 4),
    }));
  }
  const c = Math.cos(o.yaw);
  const s = Math.sin(o.yaw);
  // As far out along both sides, so that the way along a side keeps the clearance too.
  const k = clearance;
  return [
    [1, 1],
    [1, -1],
    [-1, -1],
    [-1, 1],
  ].map(([su, sv]) => {
    const u = su * (o.halfWidth + k);
    const v = sv * (o.halfDepth + k);
    return { x: o.x + c * u + s * v, z: o.z - s * u + c * v };
  });
}

/** Whether the straight way from a to b keeps `clearance` from the obstacle. */
function clearOf(o: Obstacle, a: GroundPoint, b: GroundPoint, clearance: number): boolean {
  const length = Math.hypot(b.x - a.x, b.z - a.z);
  // Sphere tracing along the segment: each probe frees as much way as its distance.
  let t = 0;
  for (let guard = 0; guard < 200; guard++) {
    const f = length > 0 ? Math.min(1, t / length) : 1;
    const d = obstacleDistance(o, a.x + f * (b.x - a.x), a.z + f * (b.z - a.z)) - clearance;
    if (d < -1e-6) return false;
    if (f >= 1) return true;
    t += Math.max(d, 0.02);
  }
  return true;
}

/**
 * Via-points from `start` to `goal`, without the start, ending with the goal; the straight way when nothing can
 * be found (`blocked` is then true).
 *
 * An obstacle nearer to the start or the goal than `clearance` is kept at just under that distance instead: people
 * stand closer to the table they use than to the one they pass.
 */
export function findRoute(
  start: GroundPoint,
  goal: GroundPoint,
  obstacles: readonly Obstacle[],
  clearance: number,
): { points: GroundPoint[]; blocked: boolean } {
  const margins = obstacles.map((o) =>
    Math.max(
      -1,
      Math.min(
        clearance,
        obstacleDistance(o, start.x, start.z) - 0.01,
        obstacleDistance(o, goal.x, goal.z) - 0.01,
      ),
    ),
  );
  const free = (a: GroundPoint, b: GroundPoint) => obstacles.every((o, i) => clearOf(o, a, b, margins[i]));
  if (free(start, goal)) return { points: [{ x: goal.x, z: goal.z }], blocked: false };
  const nodes: GroundPoint[] = [start, goal];
  for (const o of obstacles) {
    for (const p of corners(o, clearance * 1.02)) {
      if (
        obstacles.every(
          (other, i) => obstacleDistance(other, p.x, p.z) >= Math.min(margins[i], clearance) - 1e-6,
        )
      )
        nodes.push(p);
    }
  }
  const n = nodes.length;
  const cost = new Float64Array(n).fill(Number.POSITIVE_INFINITY);
  const from = new Int32Array(n).fill(-1);
  const closed = new Uint8Array(n);
  cost[0] = 0;
  const heuristic = (i: number) => Math.hypot(nodes[i].x - goal.x, nodes[i].z - goal.z);
  for (;;) {
    let best = -1;
    for (let i = 0; i < n; i++) {
      if (
        !closed[i] &&
        cost[i] < Number.POSITIVE_INFINITY &&
        (best < 0 || cost[i] + heuristic(i) < cost[best] + heuristic(best))
      )
        best = i;
    }
    if (best < 0) return { points: [{ x: goal.x, z: goal.z }], blocked: true };
    if (best === 1) break;
    closed[best] = 1;
    for (let j = 1; j < n; j++) {
      if (closed[j]) continue;
      const c = cost[best] + Math.hypot(nodes[j].x - nodes[best].x, nodes[j].z - nodes[best].z);
      if (c < cost[j] - 1e-12 && free(nodes[best], nodes[j])) {
        cost[j] = c;
        from[j] = best;
      }
    }
  }
  const points: GroundPoint[] = [];
  for (let i = 1; i > 0; i = from[i]) points.push({ x: nodes[i].x, z: nodes[i].z });
  return { points: points.reverse(), blocked: false };
}
