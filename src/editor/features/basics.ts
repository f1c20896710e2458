/** What every scene has: selecting, the room and the character, undo, time, the scene's own files. */

import { parseScene } from "../../core/scene/schema.ts";
import type { Editor } from "../editor.ts";
import { EXAMPLES } from "../examples.ts";
import { pictureExport } from "../formats/picture.ts";
import { sceneExport, sceneImport } from "../formats/scene-json.ts";
import type { KeyBinding } from "../keys.ts";
import { characterLayer } from "../layers/character.ts";
import type { MenuEntry } from "../menus.ts";
import { sceneTab } from "../panels/scene.ts";
import { selectTool } from "../tools/select.ts";
import type { Feature } from "./feature.ts";

const some = (e: Editor): boolean => e.store.getState().selection.length > 0;

const keys: readonly KeyBinding[] = [
  { keys: [], shown: "arrows", label: "Nudge 5 cm", group: "Selected" },
  { keys: [], shown: "Alt arrows, Shift arrows", label: "Nudge 1 cm, 25 cm", group: "Selected" },
  { keys: [], shown: "R, Shift R", label: "Turn 15°, back", group: "Selected" },
  { keys: [], shown: "Tab, Shift Tab", label: "Next, previous", group: "Selected" },
  { keys: [], shown: "Shift click, Shift drag", label: "Add to the selection", group: "Selected" },
  { keys: ["Ctrl+D"], label: "Duplicate", group: "Selected", when: some, run: (e) => e.scene.duplicate() },
  {
    keys: ["Delete", "Backspace"],
    shown: "Delete",
    label: "Delete",
    group: "Selected",
    when: some,
    run: (e) => e.scene.remove(),
  },
  {
    keys: ["Escape"],
    label: "Give a drag up, let go",
    group: "Selected",
    run(e) {
      if (e.store.getState().menu !== null) e.set({ menu: null });
      else if (e.tools.current.id !== "select") e.tools.use("select");
      else e.scene.select([]);
    },
  },
  { keys: ["Space"], label: "Play, pause", group: "Time", run: (e) => e.playback.toggle() },
  { keys: [","], label: "One frame back", group: "Time", run: (e) => e.playback.stepFrame(-1) },
  { keys: ["."], label: "One frame ahead", group: "Time", run: (e) => e.playback.stepFrame(1) },
  { keys: ["N"], label: "Next footstep", group: "Time", run: (e) => e.playback.stepFootstep(1) },
  { keys: ["B"], label: "Footstep before", group: "Time", run: (e) => e.playback.stepFootstep(-1) },
  { keys: ["O"], label: "Loop", group: "Time", run: (e) => e.playback.toggleLoop() },
  { keys: ["Ctrl+Z"], label: "Undo", group: "Scene", run: (e) => e.scene.undo() },
  { keys: ["Ctrl+Y", "Ctrl+Shift+Z"], label: "Redo", group: "Scene", run: (e) => e.scene.redo() },
  { keys: ["Ctrl+O"], label: "Open a file", group: "Scene", run: (e) => e.files.pick() },
  {
    keys: ["Ctrl+S"],
    label: "Save the scene file",
    group: "Scene",
    run: (e) => void e.files.save(sceneExport),
  },
  { keys: ["X"], label: "Snap", group: "Scene", run: (e) => e.set({ snap: !e.store.getState().snap }) },
  { keys: ["F"], label: "Fit the view", group: "Scene", run: (e) => e.frameScene() },
  { keys: ["?"], label: "Help", group: "Scene", run: (e) => e.set({ help: true }) },
];

const menu: readonly MenuEntry[] = [
  ...EXAMPLES.map(
    (x, i): MenuEntry => ({
      menu: "scenes",
      label: x.name,
      order: i,
      run: (e) => e.scene.replace(x.scene(), x.name),
    }),
  ),
  {
    menu: "scenes",
    label: "New, empty room",
    order: 100,
    run: (e) => e.scene.replace(parseScene({ version: 1 }), "An empty room"),
  },
  { menu: "scenes", label: "Open a file", order: 101, shortcut: "Ctrl O", run: (e) => e.files.pick() },
];

export const basics: Feature = {
  id: "basics",
  tools: [selectTool],
  tabs: [sceneTab],
  layers: [characterLayer],
  imports: [sceneImport],
  exports: [sceneExport, pictureExport],
  keys,
  menu,
};
