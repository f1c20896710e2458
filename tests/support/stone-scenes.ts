/** Scenes of stones for judging motion: an obstacle course and a flight of stairs. */
import { parseScene } from "../../src/core/scene/schema.ts";
import { groundHeight } from "../../src/core/scene/terrain.ts";
import type { Scene, Terrain } from "../../src/core/scene/types.ts";

/** Half the distance between the feet across the way, metres. */
const HALF_WIDTH = 0.09;

/** A stretch of even steps: how many, and what each adds to the way: lateral, forward (metres), turn (radians). */
interface Stretch {
  steps: number;
  lateral?: number;
  forward?: number;
  turn?: number;
  /** Height over the ground of its stones, by turns. */
  heights?: readonly number[];
}

/** Footsteps of stretches one after another, feet by turns from the left one, the last two side by side. */
function stonesOf(stretches: readonly Stretch[], terrain: Terrain): Scene["stones"] {
  const at = { x: 0, z: 0, yaw: 0 };
  let left = true;
  const out: Scene["stones"] = [];
  const lay = (height: number): void => {
    const side = left ? HALF_WIDTH : -HALF_WIDTH;
    const x = at.x + side * Math.cos(at.yaw);
    const z = at.z - side * Math.sin(at.yaw);
    const y = groundHeight(terrain, x, z) + height;
    out.push({
      id: `stone-${out.length + 1}`,
      position: [x, y, z],
      yaw: at.yaw,
      foot: left ? "left" : "right",
      time: null,
    });
    left = !left;
  };
  for (const { steps, lateral = 0, forward = 0, turn = 0, heights = [0] } of stretches) {
    for (let k = 0; k < steps; k++) {
      at.yaw += turn;
      at.x += lateral * Math.cos(at.yaw) + forward * Math.sin(at.yaw);
      at.z += forward * Math.cos(at.yaw) - lateral * Math.sin(at.yaw);
      lay(heights[k % heights.length]);
    }
  }
  lay(0);
  return out;
}

/** Flat but for a ramp of 6 degrees up and down between 9 m and 15 m ahead. */
function ramp(): Terrain {
  const cells: [number, number] = [1, 80];
  const size: [number, number] = [16, 40];
  const rise = 3 * Math.tan((6 * Math.PI) / 180);
  const heights: number[] = [];
  for (let j = 0; j <= cells[1]; j++) {
    const z = -size[1] / 2 + (j * size[1]) / cells[1];
    const h = rise * Math.max(0, Math.min(1, (z - 9) / 3, (15 - z) / 3));
    heights.push(h, h);
  }
  return { kind: "heightfield", size, cells, heights };
}

/** Walk, run, walk over a slope, stones of three heights, side steps, steps backward. */
export function courseScene(): Scene {
  const terrain = ramp();
  const stones = stonesOf(
    [
      { steps: 1, forward: 0.4 },
      { steps: 4, forward: 0.65 },
      { steps: 1, forward: 0.85 },
      { steps: 3, forward: 1 },
      { steps: 1, forward: 0.75 },
      { steps: 11, forward: 0.6 },
      { steps: 6, forward: 0.5, heights: [0.1, 0.15, 0.22, 0.18, 0.1, 0] },
      { steps: 1, forward: 0.3 },
      { steps: 6, lateral: 0.16 },
      { steps: 6, forward: -0.3 },
    ],
    terrain,
  );
  return parseScene({ version: 1, start: { position: [0, 0], yaw: 0 }, terrain, stones });
}

/** Eight steps up and eight down, each 0.16 m high and 0.3 m deep, a foot a step. */
export function stairsScene(): Scene {
  const high = 0.16;
  const deep = 0.3;
  const flight = 8;
  const first = 0.6;
  const heights = [
    ...Array.from({ length: flight }, (_, k) => (k + 1) * high),
    flight * high,
    ...Array.from({ length: flight }, (_, k) => (flight - 1 - k) * high),
  ];
  let left = true;
  let z = 0;
  const stones = [
    ...heights.map((y, k) => {
      z = first + k * deep;
      return { y, z };
    }),
    { y: 0, z: z + 0.5 },
    { y: 0, z: z + 0.5 },
  ].map((s, k) => {
    const foot = left ? "left" : "right";
    left = !left;
    return {
      id: `stone-${k + 1}`,
      position: [foot === "left" ? HALF_WIDTH : -HALF_WIDTH, s.y, s.z],
      yaw: 0,
      foot,
    };
  });
  return parseScene({ version: 1, start: { position: [0, 0], yaw: 0 }, stones });
}
