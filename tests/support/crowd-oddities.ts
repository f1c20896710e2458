/** Small scenes that crowds trip over, drawn from a seed: each kind once or more in tests, any number of them in long ones. */
import { cosine, sine } from "../../src/core/crowd/elementary.ts";
import { wallObstacles, wallsOfPolygon } from "../../src/core/crowd/polygon-walls.ts";
import type { CrowdWorld } from "../../src/core/crowd/types.ts";
import { createRandom, type Random } from "../../src/core/math/random.ts";
import { pillar, walker, wall } from "./crowd-scenes.ts";

const ODD = {
  /** One door just wide enough, both ways. */
  narrowDoor(r: Random, w: CrowdWorld) {
    const half = r.between(0.34, 0.5);
    w.obstacles.push(wall(-12, 12, -0.15, 0.15));
    w.obstacles.splice(0, 1, ...wallObstacles(w.obstacles[0], 0.5, half));
    const n = 1 + r.below(4);
    for (let k = 0; k < n; k++) {
      w.agents.push(walker(r.between(-0.2, 0.2) + (k % 2) * 0.8, -3 - k, r.between(-1, 1), 6));
      w.agents.push(walker(r.between(-0.2, 0.2) - (k % 2) * 0.8, 3 + k, r.between(-1, 1), -6));
    }
  },
  /** Straight towards the goal is a dead end. */
  deadEnd(r: Random, w: CrowdWorld) {
    const half = r.between(1, 2);
    const deep = r.between(2, 5);
    w.obstacles.push(
      wall(-half - 0.2, half + 0.2, deep, deep + 0.2),
      wall(-half - 0.2, -half, 0, deep),
      wall(half, half + 0.2, 0, deep),
    );
    const n = 1 + r.below(4);
    for (let k = 0; k < n; k++)
      w.agents.push(
        walker(r.between(-half + 0.4, half - 0.4), deep - 0.6 - 0.8 * k, r.between(-1, 1), deep + 5),
      );
  },
  /** All want the same place. */
  oneGoal(r: Random, w: CrowdWorld) {
    const n = 4 + r.below(12);
    for (let k = 0; k < n; k++) {
      const a = (6.28 * k) / n;
      w.agents.push(
        walker(r.between(5, 7) * cosine(a), r.between(5, 7) * sine(a), 0, 0, r.between(0.8, 1.5)),
      );
    }
  },
  /** A wall with several gaps, some too narrow for anyone. */
  gaps(r: Random, w: CrowdWorld) {
    let x = -8;
    const gaps = [0.2, 0.5, r.between(0.7, 1), 0.25, r.between(0.7, 1.2), 0.28];
    for (const gap of gaps) {
      const next = x + r.between(1.2, 2.4);
      w.obstacles.push(wall(x, next, 0, 0.25));
      x = next + gap;
    }
    w.obstacles.push(wall(x, x + 2, 0, 0.25));
    for (let k = 0; k < 6; k++)
      w.agents.push(walker(-7 + 2.3 * k, k % 2 ? -4 : 4, r.between(-6, 6), k % 2 ? 5 : -5));
  },
  /** Two blocks of walkers head on. */
  groups(r: Random, w: CrowdWorld) {
    const rows = 1 + r.below(4);
    const columns = 1 + r.below(5);
    const apart = r.between(0.75, 1.1);
    for (let a = 0; a < rows; a++)
      for (let b = 0; b < columns; b++) {
        const x = (b - columns / 2) * apart;
        w.agents.push(walker(x, -5 - a * apart, x, 12), walker(x + 0.1, 5 + a * apart, x + 0.1, -12));
      }
  },
  /** They touch as it begins. */
  inContact(r: Random, w: CrowdWorld) {
    const n = 2 + r.below(4);
    for (let k = 0; k < n; k++)
      w.agents.push(walker(0.31 * k, r.between(-0.05, 0.05), r.between(-6, 6), k % 2 ? 8 : -8));
  },
  /** A corridor that bends twice, walked both ways. */
  zigzag(r: Random, w: CrowdWorld) {
    const wide = r.between(1, 1.6);
    w.obstacles.push(
      wall(-9, -wide, -1, 3),
      wall(wide, 9, -6, -1 - wide + 1),
      wall(-9, 2, 3, 3.3),
      wall(wide, 9, 0, 3 - wide),
    );
    for (let k = 0; k < 3; k++) {
      w.agents.push(walker(r.between(-0.4, 0.4), -3 - k, 4 + k, 5));
      w.agents.push(walker(4 + k, 5 + r.between(0, 0.5), r.between(-0.4, 0.4), -6));
    }
  },
  /** Polygons, turned walls and pillars at random angles. */
  polygons(r: Random, w: CrowdWorld) {
    for (let k = 0; k < 5; k++) {
      const [x, z, size] = [r.between(-5, 5), r.between(-3, 3), r.between(0.4, 1.1)];
      const corners = 3 + r.below(4);
      w.obstacles.push(
        ...wallsOfPolygon(
          Array.from({ length: corners }, (_, c): [number, number] => {
            const a = (6.28 * c) / corners;
            const far = size * (c % 2 ? r.between(0.4, 1) : 1);
            return [x + far * cosine(a), z + far * sine(a)];
          }),
        ),
      );
    }
    for (let k = 0; k < 8; k++)
      w.agents.push(walker(-6 + 1.6 * k, k % 2 ? -6.5 : 6.5, 6 - 1.6 * k, k % 2 ? 6.5 : -6.5));
  },
  /** A slow row in front of quick ones, between walls. */
  overtaking(r: Random, w: CrowdWorld) {
    const half = r.between(1, 2);
    w.obstacles.push(wall(-14, 20, half, half + 0.3), wall(-14, 20, -half - 0.3, -half));
    for (let k = 0; k < 3; k++) w.agents.push(walker(-6 - 1.2 * k, r.between(-0.4, 0.4), 16, 0, 0.5));
    for (let k = 0; k < 3; k++)
      w.agents.push(walker(-10.5 - 1.2 * k, r.between(-0.4, 0.4), 16, 0, r.between(1.3, 1.7)));
  },
  /** Through a slalom of pillars close together, crossing ways. */
  pillars(r: Random, w: CrowdWorld) {
    const step = r.between(1, 1.4);
    for (let a = -3; a <= 3; a++)
      for (let b = -2; b <= 2; b++)
        w.obstacles.push(pillar(step * (a + (b & 1) / 2), step * b, r.between(0.1, 0.2)));
    for (let k = 0; k < 8; k++) {
      const a = (6.28 * k) / 8;
      w.agents.push(walker(7 * cosine(a), 6 * sine(a), -7 * cosine(a), -6 * sine(a)));
    }
  },
};

export type Oddity = keyof typeof ODD;
export const ODDITIES = Object.keys(ODD) as Oddity[];

/** Seconds by which those who begin in contact have parted. */
export const PARTED: Partial<Record<Oddity, number>> = { inContact: 3 };

/** An odd scene of a kind from a seed. */
export function drawOddity(kind: Oddity, seed: number): CrowdWorld {
  const w: CrowdWorld = { name: `${kind} ${seed}`, obstacles: [], agents: [], repairs: [] };
  ODD[kind](createRandom(seed * 1301 + 5), w);
  return w;
}
