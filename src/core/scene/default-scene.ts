/** The room a first visitor sees: a whiteboard, a table with a box, a second table, a stool. */
import { parseScene } from "./schema.ts";
import type { Scene } from "./types.ts";

/** A fresh copy of the first scene. */
export function defaultScene(): Scene {
  return parseScene({
    version: 1,
    seed: 1,
    start: { position: [0.1, -0.9], yaw: 0.3 },
    tasks: [
      { id: "write", category: "write", position: [0.35, 1.42, 2.3], yaw: 0, duration: 3 },
      { id: "lift", category: "lift", position: [-2.05, 0.88, 0.55], yaw: -1.5708 },
      { id: "place", category: "place", position: [2.15, 0.88, 0.1], yaw: 1.5708 },
      { id: "sit", category: "sit", position: [-0.75, 0.46, -1.55], yaw: 2.6 },
    ],
    props: [
      { id: "board", kind: "board", position: [0.35, 1.5, 2.3], yaw: 0 },
      { id: "table-1", kind: "table", position: [-2.22, 0, 0.55], yaw: -1.5708 },
      { id: "box-1", kind: "box", position: [-2.05, 0.88, 0.55], yaw: -1.5708 },
      { id: "table-2", kind: "table", position: [2.32, 0, 0.1], yaw: 1.5708 },
      { id: "stool-1", kind: "stool", position: [-0.75, 0, -1.55], yaw: 2.6 },
    ],
  });
}
