/** The editor's state: one store; the scene itself lives in its history. */
import { createStore } from "zustand/vanilla";
import type { QualityFigures } from "../core/motion/types.ts";
import type { TaskCategory } from "../core/scene/task-types.ts";
import type { Scene } from "../core/scene/types.ts";
import type { Plan } from "../core/tasks/plan-types.ts";
import type { FootprintMode } from "../view/footprints.ts";
import type { Theme } from "../view/tokens.ts";

export type Tool = "select" | "path" | TaskCategory;

export interface EditorState {
  scene: Scene;
  selected: string | null;
  tool: Tool;
  theme: Theme;
  tab: "scene" | "task" | "plan";
  plan: Plan | null;
  planMs: number;
  quality: QualityFigures | null;
  transitions: number[][] | null;
  /** Seconds. */
  time: number;
  playing: boolean;
  loop: boolean;
  speed: number;
  colouring: FootprintMode;
  /** The plan as templates laid it, before the optimiser. */
  showBefore: boolean;
  canUndo: boolean;
  canRedo: boolean;
  saved: "saved" | "saving" | "off";
  menu: "none" | "scenes" | "export";
  help: boolean;
  toast: { text: string; undo: boolean } | null;
  status: string | null;
  hoverStep: number;
  error: string | null;
}

export type Store = ReturnType<typeof createEditorStore>;

export function createEditorStore(scene: Scene, theme: Theme) {
  return createStore<EditorState>(() => ({
    scene,
    selected: null,
    tool: "select",
    theme,
    tab: "scene",
    plan: null,
    planMs: 0,
    quality: null,
    transitions: null,
    time: 0,
    playing: false,
    loop: true,
    speed: 1,
    colouring: "category",
    showBefore: false,
    canUndo: false,
    canRedo: false,
    saved: "saved",
    menu: "none",
    help: false,
    toast: null,
    status: "Loading captures",
    hoverStep: -1,
    error: null,
  }));
}
