/** Example scenes with stones: a river, a field of pillars. */
import { parseScene } from "./schema.ts";
import { riverBed } from "./stone-commands.ts";
import type { Scene } from "./types.ts";

/** Eight stones over a river, lateral and forward, metres; the last two lie side by side on the far bank. */
const RIVER: readonly [number, number][] = [
  [0.14, -0.95],
  [-0.1, -0.42],
  [0.2, 0.1],
  [-0.02, 0.62],
  [0.28, 1.1],
  [0.06, 1.62],
  [0.24, 2.14],
  [0.05, 2.14],
];
const RIVER_START = -1.5;

export function riverScene(): Scene {
  return parseScene({
    version: 1,
    start: { position: [0, RIVER_START], yaw: 0 },
    terrain: riverBed(0.5, -1.15, 1.85),
    stones: RIVER.map(([x, z], k) => ({ id: `stone-${k + 1}`, position: [x, 0, z], yaw: 0 })),
  });
}

/** Pillars of different heights in a winding row: lateral, height, forward, yaw. */
const PILLARS: readonly [number, number, number, number][] = [
  [0.12, 0.1, -1.1, 0.1],
  [-0.1, 0.2, -0.65, 0.1],
  [0.16, 0.32, -0.2, 0.15],
  [-0.02, 0.22, 0.3, 0.25],
  [0.32, 0.36, 0.72, 0.35],
  [0.2, 0.24, 1.22, 0.35],
  [0.56, 0.34, 1.6, 0.35],
  [0.48, 0.2, 2.06, 0.3],
  [0.8, 0.1, 2.4, 0.2],
  [0.66, 0, 2.86, 0.2],
  [0.85, 0, 2.86, 0.2],
];

export function pillarScene(): Scene {
  return parseScene({
    version: 1,
    start: { position: [0, -1.65], yaw: 0 },
    stones: PILLARS.map(([x, y, z, yaw], k) => ({ id: `pillar-${k + 1}`, position: [x, y, z], yaw })),
  });
}
