/** SteerSuite test cases dropped on the page: read, shown and run as any crowd. */
import { readSteerCase } from "../../core/crowd/steer-case.ts";
import { sceneOfWorld } from "../../core/crowd/to-scene.ts";
import type { ImportFormat } from "./format.ts";

export const steerImport: ImportFormat = {
  id: "steersuite",
  label: "SteerSuite case",
  endings: [".xml"],
  async open(e, files) {
    const file = files[files.length - 1];
    const world = readSteerCase(await file.text(), file.name);
    e.scene.replace(sceneOfWorld(world), file.name);
    e.frameScene();
    if (world.repairs.length > 0) e.say(world.repairs[0], false);
  },
};
