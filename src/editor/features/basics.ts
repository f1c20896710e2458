/** What every scene has: selecting, the room and the character, undo, time, the scene's own files. */

import { parseScene } from "../../core/scene/schema.ts";
import type { Editor } from "../editor.ts";
import { pictureExport } from "../formats/picture.ts";
import { sceneExport, sceneImport } from "../formats/scene-json.ts";
import { videoExport } from "../formats/video.ts";
import { ARROWS, type KeyBinding } from "../keys.ts";
import { characterLayer } from "../layers/character.ts";
import type { MenuEntry } from "../menus.ts";
import { sceneTab } from "../panels/scene.ts";
import { openHelp } from "../parts/help-sheet.ts";
import { useClipboard } from "../session/clipboard.ts";
import { selectTool } from "../tools/select.ts";
import type { Feature } from "./feature.ts";

const some = (e: Editor): boolean => e.store.getState().selection.length > 0;

const QUARTER = Math.PI / 2;
/** Arrows wherever the focus is on the page; handles have their own. Not shown one by one in the sheet. */
const nudges: readonly KeyBinding[] = Object.entries(ARROWS).flatMap(([key, [x, z]]) =>
  (
    [
      ["", 0.05],
      ["Alt+", 0.01],
      ["Shift+", 0.25],
    ] as const
  ).map(
    ([held, by]): KeyBinding => ({
      keys: [held + key],
      label: "",
      group: "Selected",
      when: some,
      run: (e) => e.scene.nudge(x * by, z * by, 0),
    }),
  ),
);

const keys: readonly KeyBinding[] = [
  { keys: [], shown: "arrows", label: "Nudge 5 cm", group: "Selected" },
  { keys: [], shown: "Alt arrows, Shift arrows", label: "Nudge 1 cm, 25 cm", group: "Selected" },
  ...nudges,
  {
    keys: ["R"],
    label: "Turn 15°",
    group: "Selected",
    when: some,
    run: (e) => e.scene.nudge(0, 0, QUARTER / 6),
  },
  {
    keys: ["Shift+R"],
    shown: "Shift R",
    label: "Turn back 15°",
    group: "Selected",
    when: some,
    run: (e) => e.scene.nudge(0, 0, -QUARTER / 6),
  },
  { keys: [], shown: "Tab, Shift Tab", label: "Next, previous", group: "Selected" },
  { keys: [], shown: "Shift click, Shift drag", label: "Add to the selection", group: "Selected" },
  { keys: [], shown: "Ctrl C, Ctrl X, Ctrl V", label: "Copy, cut, paste", group: "Selected" },
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
  { keys: [], shown: "arrows, Enter", label: "Move the tool's cross, press", group: "Tools" },
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
  { keys: ["?"], label: "Help", group: "Scene", run: openHelp },
];

const menu: readonly MenuEntry[] = [
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
  exports: [sceneExport, pictureExport, videoExport],
  keys,
  menu,
  start(e) {
    useClipboard(e);
    void e.files.openLink();
  },
};
