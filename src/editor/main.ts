/** The editor page. */
import { defaultScene } from "../core/scene/default-scene.ts";
import { Editor, type LogEntry } from "./editor.ts";
import { pageKey } from "./keys.ts";
import { loadScene } from "./storage.ts";

declare global {
  interface Window {
    /** A look at the editor from outside, for tests and the curious. */
    stepwright?: {
      log(): readonly LogEntry[];
      state(): ReturnType<Editor["store"]["getState"]>;
      frames(): { current: number; filled: number } | null;
      /** Root and contacts of a frame that has arrived. */
      feetAt(frame: number): { root: number[]; contacts: number } | null;
      seek(time: number): void;
      restartPlanner(): void;
    };
  }
}

const find = <T extends HTMLElement>(selector: string): T => document.querySelector(selector) as T;

async function start(): Promise<void> {
  const viewport = find(".viewport");
  const overlay = document.createElement("div");
  overlay.className = "overlay";
  const chips = document.createElement("div");
  chips.className = "chips";
  viewport.append(overlay, chips);
  find(".top-bar").textContent = "";
  const scene = (await loadScene()) ?? defaultScene();
  const dark = matchMedia("(prefers-color-scheme: dark)").matches;
  let editor: Editor;
  try {
    editor = new Editor(
      {
        top: find(".top-bar"),
        viewport,
        panel: find(".panel"),
        timeline: find(".timeline"),
        live: find("#live"),
        canvas: find("#stage"),
      },
      scene,
      dark ? "dark" : "light",
    );
  } catch (error) {
    viewport.textContent = `This browser cannot draw the room: WebGL 2 is needed. (${error instanceof Error ? error.message : String(error)})`;
    return;
  }
  window.addEventListener("keydown", (ev) => pageKey(editor, ev));
  window.addEventListener("dragover", (ev) => ev.preventDefault());
  window.addEventListener("drop", (ev) => {
    ev.preventDefault();
    const file = ev.dataTransfer?.files[0];
    if (file) void editor.openText(file);
  });
  window.stepwright = {
    log: () => editor.log,
    state: () => editor.store.getState(),
    frames: () =>
      editor.motion.current
        ? { current: editor.motion.current.frames, filled: editor.motion.current.filled }
        : null,
    feetAt: (frame) => {
      const m = editor.motion.current;
      return m && frame < m.filled
        ? { root: [...m.root.subarray(3 * frame, 3 * frame + 3)], contacts: m.contacts[frame] }
        : null;
    },
    seek: (time) => editor.seek(time),
    restartPlanner: () => editor.restartPlanner(),
  };
}

void start();
