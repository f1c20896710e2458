/** The scene document as a file; a result document opens its scene, with its footsteps beside the plan. */
import { readSceneOrResult } from "../../core/scene/result-schema.ts";
import { serializeScene } from "../../core/scene/schema.ts";
import { compareSession } from "../compare/session.ts";
import type { ExportFormat, ImportFormat } from "./format.ts";

export const sceneExport: ExportFormat = {
  id: "scene",
  label: "Scene (JSON)",
  file: ".json",
  type: "application/json",
  order: 200,
  shortcut: "Ctrl S",
  make: (e) => serializeScene(e.store.getState().scene),
};

export const sceneImport: ImportFormat = {
  id: "scene",
  label: "Scene or result",
  endings: [".json"],
  async open(e, files) {
    const file = files[files.length - 1];
    const { scene, result } = readSceneOrResult(await file.text(), file.name);
    const name = file.name.replace(/\.json$/i, "");
    // A result without steps, as of a crowd, has nothing to compare.
    if (result && result.footsteps.length > 2) compareSession(e).result(result, name);
    else e.scene.replace(scene, name);
  },
};
