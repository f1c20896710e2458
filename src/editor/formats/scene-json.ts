/** The scene document as a file. */
import { readScene, serializeScene } from "../../core/scene/schema.ts";
import type { ExportFormat, ImportFormat } from "./format.ts";

export const sceneExport: ExportFormat = {
  id: "scene",
  label: "Scene (JSON)",
  file: "scene.json",
  type: "application/json",
  order: 200,
  shortcut: "Ctrl S",
  make: (e) => serializeScene(e.store.getState().scene),
};

export const sceneImport: ImportFormat = {
  id: "scene",
  label: "Scene",
  endings: [".json"],
  async open(e, files) {
    const file = files[files.length - 1];
    e.scene.replace(readScene(await file.text(), file.name), file.name);
  },
};
