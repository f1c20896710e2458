/** The editor page. */
import { defaultScene } from "../core/scene/default-scene.ts";
import { Editor } from "./editor.ts";
import { pageKey } from "./keys.ts";
import type { LogEntry } from "./session/plan-session.ts";
import { loadScene } from "./session/storage.ts";

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
  window.stepwright = {
    log: () => editor.plan.log,
    state: () => editor.store.getState(),
    frames: () => {
      const m = editor.plan.motion.current;
      return m ? { current: m.frames, filled: m.filled } : null;
    },
    feetAt: (frame) => {
      const m = editor.plan.motion.current;
      return m && frame < m.filled
        ? { root: [...m.root.subarray(3 * frame, 3 * frame + 3)], contacts: m.contacts[frame] }
        : null;
    },
    seek: (time) => editor.playback.seek(time),
    restartPlanner: () => editor.plan.restart(),
  };
}

void start();
