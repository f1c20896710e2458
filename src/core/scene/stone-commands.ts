/** Commands on stones and terrain: each gives a new scene. */
import { wrapAngle } from "../math/angle.ts";
import type { Foot } from "../steps/types.ts";
import { freeId } from "./commands.ts";
import { groundHeight } from "./terrain.ts";
import type { Scene, SceneStone, Terrain } from "./types.ts";

/** A step this far off the way the character faces is a side or back step: the facing stays, radians. */
const ASIDE = (65 * Math.PI) / 180;

/** The yaw suggested for a stone at (x, z): along the way from the stone two before, unless that is a side or back step. */
export function suggestedYaw(scene: Scene, x: number, z: number): number {
  const stones = scene.stones;
  const before = stones.at(-2)?.position ?? [scene.start.position[0], 0, scene.start.position[1]];
  const facing = stones.at(-1)?.yaw ?? scene.start.yaw;
  const dx = x - before[0];
  const dz = z - before[2];
  if (Math.hypot(dx, dz) < 0.25) return facing;
  const way = Math.atan2(dx, dz);
  return Math.abs(wrapAngle(way - facing)) > ASIDE ? facing : way;
}

/** A bed deeper than this holds water: stones stand up out of it to the banks' level, metres. */
const DEEP = 0.2;

/** Height at which a stone is laid: on the ground, or at the banks' level over a bed. */
export function stoneHeight(terrain: Terrain, x: number, z: number): number {
  const ground = groundHeight(terrain, x, z);
  return ground < -DEEP ? 0 : ground;
}

/** Adds a stone on the ground at (x, z), last in the order; foot and time are left to the planner. */
export function addStone(scene: Scene, x: number, z: number): { scene: Scene; id: string } {
  const id = freeId(scene, "stone");
  const stone: SceneStone = {
    id,
    position: [x, stoneHeight(scene.terrain, x, z), z],
    yaw: wrapAngle(suggestedYaw(scene, x, z)),
    foot: null,
    time: null,
  };
  return { scene: { ...scene, stones: [...scene.stones, stone], order: [...scene.order, id] }, id };
}

/** A stone's fields changed. */
export function changeStone(scene: Scene, id: string, change: Partial<Omit<SceneStone, "id">>): Scene {
  return { ...scene, stones: scene.stones.map((s) => (s.id === id ? { ...s, ...change } : s)) };
}

/** A stone moved over the ground and turned: it keeps its height over the ground. */
export function placeStone(
  scene: Scene,
  id: string,
  position: readonly [number, number, number],
  yaw: number,
): Scene {
  const stone = scene.stones.find((s) => s.id === id);
  if (!stone) return scene;
  const over = position[1] - stoneHeight(scene.terrain, stone.position[0], stone.position[2]);
  const y = stoneHeight(scene.terrain, position[0], position[2]) + over;
  return changeStone(scene, id, { position: [position[0], y, position[2]], yaw: wrapAngle(yaw) });
}

export function removeStones(scene: Scene, ids: readonly string[]): Scene {
  return {
    ...scene,
    stones: scene.stones.filter((s) => !ids.includes(s.id)),
    order: scene.order.filter((id) => !ids.includes(id)),
  };
}

/** The foot that a stone asks for, the next one round: either, left, right. */
export const nextFoot = (foot: Foot | null): Foot | null =>
  foot === null ? "left" : foot === "left" ? "right" : null;

/** The ground changed; stones keep their height over it. */
export function setTerrain(scene: Scene, terrain: Terrain): Scene {
  return {
    ...scene,
    terrain,
    stones: scene.stones.map((s) => {
      const [x, y, z] = s.position;
      const over = y - stoneHeight(scene.terrain, x, z);
      return { ...s, position: [x, stoneHeight(terrain, x, z) + over, z] };
    }),
  };
}

/** Metres that a stair's tread is deep, and how many cells of the field make it. */
const TREAD = 0.32;

/**
 * Ground with stairs up along +z from `from`, and level ground after them.
 *
 * @param rise metres a step; @param steps how many.
 */
export function stairs(rise: number, steps: number, from = 0.6): Terrain {
  const size: [number, number] = [6, 12];
  const cells: [number, number] = [1, 480];
  const heights: number[] = [];
  for (let j = 0; j <= cells[1]; j++) {
    const z = (j / cells[1] - 0.5) * size[1];
    const k = Math.max(0, Math.min(steps, Math.floor((z - from) / TREAD + 1)));
    heights.push(k * rise, k * rise);
  }
  return { kind: "heightfield", size, cells, heights };
}

/** Rolling ground: waves of a height and a length, metres. */
export function hills(height: number, length: number): Terrain {
  const size: [number, number] = [10, 10];
  const cells: [number, number] = [40, 40];
  const heights: number[] = [];
  for (let j = 0; j <= cells[1]; j++)
    for (let i = 0; i <= cells[0]; i++) {
      const x = (i / cells[0] - 0.5) * size[0];
      const z = (j / cells[1] - 0.5) * size[1];
      heights.push(
        (height / 2) * (Math.sin((2 * Math.PI * z) / length) + 0.5 * Math.sin((2 * Math.PI * x) / length)),
      );
    }
  return { kind: "heightfield", size, cells, heights };
}

/** A bed across the way, `deep` metres deep from z = `from` to `to`, with banks of 0.4 m. */
export function riverBed(deep: number, from: number, to: number): Terrain {
  const size: [number, number] = [8, 10];
  const cells: [number, number] = [1, 100];
  const heights: number[] = [];
  for (let j = 0; j <= cells[1]; j++) {
    const z = (j / cells[1] - 0.5) * size[1];
    const u = Math.max(0, Math.min(1, (z - from) / 0.4, (to - z) / 0.4));
    const h = -deep * u * u * (3 - 2 * u);
    heights.push(h, h);
  }
  return { kind: "heightfield", size, cells, heights };
}
