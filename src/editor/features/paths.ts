/** Paths: drawn on the floor, bent, painted with styles, timed [Express]. */
import { styleImport, styleImportFor } from "../formats/style-bvh.ts";
import { pathLanes } from "../lanes/paths.ts";
import { pathBandLayer } from "../layers/path-bands.ts";
import { pathTab } from "../panels/path.ts";
import { deskOf } from "../paths/path-desk.ts";
import { pathPointThings, pathThings } from "../things/paths.ts";
import { pathTool } from "../tools/path.ts";
import type { Feature } from "./feature.ts";

export const paths: Feature = {
  id: "paths",
  tools: [pathTool],
  things: [pathThings, pathPointThings],
  tabs: [pathTab],
  lanes: pathLanes,
  layers: [pathBandLayer],
  imports: [styleImport],
  start(e) {
    deskOf(e);
    styleImportFor(e);
    // The timeline is taller while there is a walk to time; points have handles while their path is open.
    let before = "";
    const follow = () => {
      const { scene, tab, tool, choice } = e.store.getState();
      // Not while points are set: the room must not move under the pointer between two clicks.
      const setting = tool === "path" && choice === "points";
      document.documentElement.classList.toggle("with-path", scene.paths.length > 0 && !setting);
      if (before !== `${tab} ${tool}`) e.markers.draw();
      before = `${tab} ${tool}`;
    };
    e.store.subscribe(follow);
    follow();
  },
};
