/** The scenes of the lessons, by name. */
import { defaultScene } from "../core/scene/default-scene.ts";
import { parseScene } from "../core/scene/schema.ts";
import type { Scene } from "../core/scene/types.ts";

/** A board and a box two metres apart: one exit, some locomotion, one enter. */
function boardAndBox(): Scene {
  return parseScene({
    version: 1,
    start: { position: [0.6, 0.2], yaw: 0.2 },
    tasks: [
      { id: "write", category: "write", position: [0.9, 1.42, 1.9], yaw: 0, duration: 1.5 },
      { id: "lift", category: "lift", position: [-1.6, 0.88, 0.6], yaw: -1.5708 },
    ],
    props: [
      { id: "board", kind: "board", position: [0.9, 1.5, 1.9], yaw: 0 },
      { id: "table", kind: "table", position: [-1.77, 0, 0.6], yaw: -1.5708 },
      { id: "box", kind: "box", position: [-1.6, 0.88, 0.6], yaw: -1.5708 },
    ],
  });
}

/** A path in three styles. */
function threeStyles(): Scene {
  return parseScene({
    version: 1,
    paths: [
      {
        id: "path",
        points: [
          [2.4, -1.4],
          [1.6, 1.0],
          [-0.4, 1.3],
          [-1.6, 0.1],
          [-2.6, 1.6],
        ],
        styles: [
          { at: 0, style: "walking" },
          { at: 0.35, style: "energetic" },
          { at: 0.7, style: "tired" },
        ],
      },
    ],
  });
}

export const LESSON_SCENES: Record<string, () => Scene> = {
  "two-tables": defaultScene,
  "board-and-box": boardAndBox,
  "three-styles": threeStyles,
};
