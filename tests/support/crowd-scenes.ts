/** Crowds drawn from a seed, of the kinds that crowds get stuck in, and what went wrong in a track. */
import { bodyGap } from "../../src/core/crowd/bodies.ts";
import { cosine, sine } from "../../src/core/crowd/elementary.ts";
import { obstacleGap } from "../../src/core/crowd/ground.ts";
import type { CrowdTrack } from "../../src/core/crowd/simulate.ts";
import {
  BODY_RADIUS,
  type CrowdAgent,
  type CrowdWorld,
  type Obstacle,
  SHOULDER,
} from "../../src/core/crowd/types.ts";
import { createRandom, type Random } from "../../src/core/math/random.ts";

export const wall = (x0: number, x1: number, z0: number, z1: number): Obstacle => ({
  x: (x0 + x1) / 2,
  z: (z0 + z1) / 2,
  halfX: (x1 - x0) / 2,
  halfZ: (z1 - z0) / 2,
  cos: 1,
  sin: 0,
  round: false,
});

export const pillar = (x: number, z: number, radius: number): Obstacle => ({
  x,
  z,
  halfX: radius,
  halfZ: radius,
  cos: 1,
  sin: 0,
  round: true,
});

export function walker(x: number, z: number, gx: number, gz: number, speed = 1.3): CrowdAgent {
  const n = Math.sqrt((gx - x) ** 2 + (gz - z) ** 2) || 1;
  return {
    x,
    z,
    dirX: (gx - x) / n,
    dirZ: (gz - z) / n,
    goals: [{ x: gx, z: gz, box: null, speed, patience: 1e9 }],
  };
}

export const worldOf = (agents: CrowdAgent[], obstacles: Obstacle[] = []): CrowdWorld => ({
  name: "test",
  obstacles,
  agents,
  repairs: [],
});

/** A free place in a box; null after many trials. */
function place(
  r: Random,
  w: CrowdWorld,
  [x0, x1, z0, z1]: readonly [number, number, number, number],
  apart = 0.8,
): [number, number] | null {
  for (let k = 0; k < 300; k++) {
    const x = r.between(x0, x1);
    const z = r.between(z0, z1);
    if (w.agents.some((a) => (a.x - x) ** 2 + (a.z - z) ** 2 < apart * apart)) continue;
    if (w.obstacles.some((o) => obstacleGap(o, x, z) < 0.4)) continue;
    return [x, z];
  }
  return null;
}

const DRAW = {
  /** Two groups meet at a door in a wall. */
  doorway(r: Random, w: CrowdWorld) {
    const half = r.between(0.36, 0.8);
    const at = r.between(-2, 2);
    w.obstacles.push(wall(-6, at - half, -0.1, 0.1), wall(at + half, 6, -0.1, 0.1));
    w.obstacles.push(wall(-6.5, -6, -9, 9), wall(6, 6.5, -9, 9));
    const each = 1 + r.below(5);
    for (const side of [-1, 1])
      for (let k = 0; k < each; k++) {
        const p = place(r, w, [-5, 5, side < 0 ? -7 : 2, side < 0 ? -2 : 7]);
        if (p) w.agents.push(walker(p[0], p[1], r.between(-3, 3), -side * 8));
      }
  },
  /** A room empties through a narrow door. */
  egress(r: Random, w: CrowdWorld) {
    const half = r.between(0.38, 0.9);
    const size = r.between(4, 7);
    w.obstacles.push(wall(-size, -half, 0, 0.2), wall(half, size, 0, 0.2));
    w.obstacles.push(wall(-size - 0.3, -size, -2 * size, 0.2), wall(size, size + 0.3, -2 * size, 0.2));
    w.obstacles.push(wall(-size, size, -2 * size - 0.3, -2 * size));
    const count = 10 + r.below(35);
    for (let k = 0; k < count; k++) {
      const p = place(r, w, [-size + 0.5, size - 0.5, -2 * size + 0.5, -0.8]);
      if (p) w.agents.push(walker(p[0], p[1], r.between(-4, 4), r.between(8, 12)));
    }
  },
  /** Two streams in a corridor. */
  corridor(r: Random, w: CrowdWorld) {
    const half = r.between(0.8, 2.5);
    w.obstacles.push(wall(-30, 30, half, half + 0.5), wall(-30, 30, -half - 0.5, -half));
    const each = Math.round(half * r.between(2, 6));
    for (const side of [-1, 1])
      for (let k = 0; k < each; k++) {
        const p = place(r, w, [side < 0 ? -16 : 4, side < 0 ? -4 : 16, -half + 0.4, half - 0.4]);
        if (p)
          w.agents.push(
            walker(p[0], p[1], -side * 20, r.between(-half + 0.4, half - 0.4), r.between(0.9, 1.5)),
          );
      }
  },
  /** All across a circle. */
  circle(r: Random, w: CrowdWorld) {
    const n = 4 + r.below(36);
    const radius = Math.max(3, n * r.between(0.18, 0.4));
    for (let k = 0; k < n; k++) {
      const a = (2 * Math.PI * k) / n + r.between(-0.02, 0.02);
      w.agents.push(walker(radius * cosine(a), radius * sine(a), -radius * cosine(a), -radius * sine(a)));
    }
  },
  /** Four streams cross at a junction of corridors. */
  junction(r: Random, w: CrowdWorld) {
    const half = r.between(1, 2.5);
    for (const a of [-1, 1])
      for (const b of [-1, 1])
        w.obstacles.push(
          wall(a < 0 ? -20 : half, a < 0 ? -half : 20, b < 0 ? -20 : half, b < 0 ? -half : 20),
        );
    const each = 1 + r.below(5);
    for (let arm = 0; arm < 4; arm++)
      for (let k = 0; k < each; k++) {
        const along = r.between(4, 12);
        const across = r.between(-half + 0.4, half - 0.4);
        const [x, z] = [
          [along, across],
          [-along, across],
          [across, along],
          [across, -along],
        ][arm];
        if (w.agents.some((a) => (a.x - x) ** 2 + (a.z - z) ** 2 < 0.7)) continue;
        const to = (arm + 1 + r.below(3)) % 4;
        const g = r.between(-half + 0.5, half - 0.5);
        const [gx, gz] = [
          [14, g],
          [-14, g],
          [g, 14],
          [g, -14],
        ][to];
        w.agents.push(walker(x, z, gx, gz));
      }
  },
  /** Everybody somewhere else, between boxes and pillars. */
  forest(r: Random, w: CrowdWorld) {
    const size = r.between(6, 12);
    const boxes = r.below(30);
    for (let k = 0; k < boxes; k++) {
      const x = r.between(-size, size);
      const z = r.between(-size, size);
      if (r.next() < 0.5) w.obstacles.push(pillar(x, z, r.between(0.15, 0.6)));
      else {
        const a = r.between(0, 3);
        const o = wall(x - r.between(0.1, 1), x + r.between(0.1, 1), z - 0.2, z + 0.2);
        w.obstacles.push({ ...o, cos: cosine(a), sin: sine(a) });
      }
    }
    const count = 2 + r.below(40);
    for (let k = 0; k < count; k++) {
      const from = place(r, w, [-size, size, -size, size]);
      const to = place(r, w, [-size, size, -size, size], 0);
      if (from && to) w.agents.push(walker(from[0], from[1], to[0], to[1], r.between(0.7, 1.6)));
    }
  },
  /** Walkers in a row through a gap, some overtaking, some coming back. */
  squeeze(r: Random, w: CrowdWorld) {
    const half = r.between(0.5, 1.1);
    w.obstacles.push(wall(-8, 8, half, half + 3), wall(-8, 8, -half - 3, -half));
    const n = 2 + r.below(5);
    for (let k = 0; k < n; k++) {
      const back = r.next() < 0.3 ? -1 : 1;
      const p = place(r, w, [back > 0 ? -14 : 9.5, back > 0 ? -9.5 : 14, -3, 3]);
      if (p) w.agents.push(walker(p[0], p[1], back * 14, r.between(-3, 3), r.between(0.8, 1.6)));
    }
  },
};

export type CrowdKind = keyof typeof DRAW;
export const CROWD_KINDS = Object.keys(DRAW) as CrowdKind[];

/** A crowd of a kind from a seed. */
export function drawCrowd(kind: CrowdKind, seed: number): CrowdWorld {
  const w: CrowdWorld = { name: `${kind} ${seed}`, obstacles: [], agents: [], repairs: [] };
  DRAW[kind](createRandom(seed * 977 + 13), w);
  return w;
}

/** Deepest overlaps over a track, metres: of bodies, of bodies and walls, of planted feet. */
export function overlaps(
  track: CrowdTrack,
  world: CrowdWorld,
): { bodies: number; walls: number; feet: number } {
  const worst = { bodies: 0, walls: 0, feet: 0 };
  const a = new Float64Array(12);
  track.positions.forEach((row, f) => {
    for (let i = 0; i < row.length; i++) {
      const p = row[i];
      const u = track.facing[f][i];
      if (!p || !u) continue;
      a.set([...p, ...u]);
      for (const s of [-SHOULDER, 0, SHOULDER])
        for (const o of world.obstacles)
          worst.walls = Math.max(worst.walls, BODY_RADIUS - obstacleGap(o, p[0] + s * u[1], p[1] - s * u[0]));
      for (let k = i + 1; k < row.length; k++) {
        const q = row[k];
        const v = track.facing[f][k];
        if (!q || !v || (p[0] - q[0]) ** 2 + (p[1] - q[1]) ** 2 > 2.3) continue;
        a.set([...q, ...v], 6);
        worst.bodies = Math.max(worst.bodies, -bodyGap(a, 0, a, 6, 1));
        for (const m of track.feet[f][i] ?? [])
          for (const n of track.feet[f][k] ?? [])
            worst.feet = Math.max(
              worst.feet,
              m[2] + n[2] - Math.sqrt((m[0] - n[0]) ** 2 + (m[1] - n[1]) ** 2),
            );
      }
    }
  });
  return worst;
}
