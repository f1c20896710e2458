/** The editor page. */
import { defaultScene } from "../core/scene/default-scene.ts";
import { crowdSession } from "./crowd/crowd-session.ts";
import { Editor } from "./editor.ts";
import { FIRST_NAME } from "./examples.ts";
import { pageKey } from "./keys.ts";
import { ref } from "./selection.ts";
import type { LogEntry } from "./session/plan-session.ts";
import { loadName, loadScene } from "./session/storage.ts";

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
      /** What lies on the graphics card, counted. */
      graphics(): { geometries: number; textures: number; programs: number };
      /** Whether the room is drawn: not, to measure the rest; on again, at once and in full. */
      draw(on: boolean): void;
      crowd(): {
        seconds: number;
        agents: number;
        left: number;
        ready: boolean;
        picked: number;
        nodes: number;
      };
      pickWalker(agent: number): void;
      /** The scene's crowd run to its end in its worker: a hash of all trajectories. */
      crowdHash(seconds: number): Promise<string>;
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
  const edges = document.createElement("div");
  edges.className = "edges";
  viewport.append(overlay, chips);
  find("#app").append(edges);
  find(".top-bar").textContent = "";
  const kept = await loadScene();
  const scene = kept ?? defaultScene();
  const name = kept ? ((await loadName()) ?? "Scene") : FIRST_NAME;
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
        edges,
        canvas: find("#stage"),
      },
      scene,
      name,
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
    graphics: () => editor.stage.graphics(),
    draw: (on) => {
      editor.stage.hold(!on);
      if (on) editor.stage.drawNow();
    },
    crowd: () => {
      const { seconds, agents, left, ready, picked, story } = crowdSession(editor);
      return { seconds, agents, left, ready, picked, nodes: story?.x.length ?? 0 };
    },
    pickWalker: (agent) => editor.scene.select([ref("crowd-walker", String(agent), agent)]),
    crowdHash: (seconds) => crowdSession(editor).hash(seconds),
  };
}

void start();
