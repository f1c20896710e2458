/** Messages between the page and the worker that walks by wish. */
import type { Terrain } from "../core/scene/types.ts";
import type { Proportions } from "../core/skeleton/skeleton.ts";

export type WalkRequest =
  | {
      type: "start";
      height: number;
      proportions: Proportions;
      place: { x: number; z: number; yaw: number };
      terrain: Terrain;
    }
  /** The wanted velocity in the character's own frame: lateral and forward m/s, turn rad/s. */
  | { type: "wish"; lateral: number; forward: number; turn: number }
  | { type: "stop" };

export type WalkResponse =
  | { type: "ready" }
  /** One frame: the hips' place, local rotations, where the root is and faces. */
  | { type: "pose"; root: Float32Array; rotations: Float32Array; place: [number, number, number] }
  | { type: "failed"; message: string };
