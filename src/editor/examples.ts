/** The example scenes of the Scenes menu. */
import aLecture from "../../assets/scenes/a-lecture.json";
import alongTheBoard from "../../assets/scenes/along-the-board.json";
import crowdCrossing from "../../assets/scenes/crowd-crossing.json";
import crowdDoorway from "../../assets/scenes/crowd-doorway.json";
import crowdEgress from "../../assets/scenes/crowd-egress.json";
import crowdHallway from "../../assets/scenes/crowd-hallway.json";
import crowdUTurn from "../../assets/scenes/crowd-u-turn.json";
import figureEight from "../../assets/scenes/figure-eight.json";
import movingBoxes from "../../assets/scenes/moving-boxes.json";
import onePathFourStyles from "../../assets/scenes/one-path-four-styles.json";
import roundTheTable from "../../assets/scenes/round-the-table.json";
import twoBoxesAway from "../../assets/scenes/two-boxes-away.json";
import { defaultScene } from "../core/scene/default-scene.ts";
import { parseScene } from "../core/scene/schema.ts";
import { pillarScene, riverScene } from "../core/scene/stone-examples.ts";
import type { Scene } from "../core/scene/types.ts";

export interface Example {
  name: string;
  scene(): Scene;
}

/** What the scene of a first visit is called. */
export const FIRST_NAME = "Two tables";

export const EXAMPLES: readonly Example[] = [
  { name: FIRST_NAME, scene: defaultScene },
  { name: "Along the board", scene: () => parseScene(alongTheBoard) },
  { name: "Moving boxes", scene: () => parseScene(movingBoxes) },
  { name: "Round the table", scene: () => parseScene(roundTheTable) },
  { name: "A lecture", scene: () => parseScene(aLecture) },
  { name: "Two boxes away", scene: () => parseScene(twoBoxesAway) },
  { name: "River", scene: riverScene },
  { name: "Pillars", scene: pillarScene },
  { name: "Crowd: doorway", scene: () => parseScene(crowdDoorway) },
  { name: "Crowd: hallway", scene: () => parseScene(crowdHallway) },
  { name: "Crowd: leaving a room", scene: () => parseScene(crowdEgress) },
  { name: "Crowd: U-turn", scene: () => parseScene(crowdUTurn) },
  { name: "Crowd: crossing", scene: () => parseScene(crowdCrossing) },
  { name: "One path, four styles", scene: () => parseScene(onePathFourStyles) },
  { name: "Figure eight", scene: () => parseScene(figureEight) },
];
