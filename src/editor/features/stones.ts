/** Stones: laid on the floor and stepped on; the ground; walking by hand [Barycentric]. */
import { pillarScene, riverScene } from "../../core/scene/stone-examples.ts";
import { stoneLayer } from "../layers/stones.ts";
import { stonesTab } from "../panels/stones.ts";
import { stoneThings } from "../things/stones.ts";
import { stonesTool } from "../tools/stones.ts";
import { walkTool } from "../tools/walk.ts";
import type { Feature } from "./feature.ts";

export const stones: Feature = {
  id: "stones",
  tools: [stonesTool, walkTool],
  things: [stoneThings],
  tabs: [stonesTab],
  layers: [stoneLayer],
  keys: [
    { keys: [], shown: "Q", label: "Stone: either foot, left, right", group: "Selected" },
    { keys: [], shown: "Page Up, Page Down", label: "Lift a stone, lower it", group: "Selected" },
    { keys: [], shown: "W A S D, Q E", label: "Walk by hand, with its tool", group: "Tools" },
  ],
  menu: [
    { menu: "scenes", label: "River", order: 20, run: (e) => e.scene.replace(riverScene(), "River") },
    { menu: "scenes", label: "Pillars", order: 21, run: (e) => e.scene.replace(pillarScene(), "Pillars") },
  ],
};
