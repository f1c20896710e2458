/** The example scenes of the Scenes menu. */
import alongTheBoard from "../../assets/scenes/along-the-board.json";
import figureEight from "../../assets/scenes/figure-eight.json";
import movingBoxes from "../../assets/scenes/moving-boxes.json";
import onePathFourStyles from "../../assets/scenes/one-path-four-styles.json";
import roundTheTable from "../../assets/scenes/round-the-table.json";
import { defaultScene } from "../core/scene/default-scene.ts";
import { parseScene } from "../core/scene/schema.ts";
import type { Scene } from "../core/scene/types.ts";

export interface Example {
  name: string;
  scene(): Scene;
}

export const EXAMPLES: readonly Example[] = [
  { name: "Two tables", scene: defaultScene },
  { name: "Along the board", scene: () => parseScene(alongTheBoard) },
  { name: "Moving boxes", scene: () => parseScene(movingBoxes) },
  { name: "Round the table", scene: () => parseScene(roundTheTable) },
  { name: "One path, four styles", scene: () => parseScene(onePathFourStyles) },
  { name: "Figure eight", scene: () => parseScene(figureEight) },
];
