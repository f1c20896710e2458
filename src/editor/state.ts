/** The editor's state: one store; the scene itself lives in its history. A feature's own state is kept by the feature. */
import { createStore } from "zustand/vanilla";
import type { QualityFigures } from "../core/motion/types.ts";
import type { Scene } from "../core/scene/types.ts";
import type { Plan } from "../core/tasks/plan-types.ts";
import type { FootprintMode } from "../view/footprints.ts";
import type { Theme } from "../view/tokens.ts";
import type { Ref } from "./selection.ts";

export interface EditorState {
  scene: Scene;
  /** What the user calls the scene. */
  name: string;
  selection: readonly Ref[];
  /** Id of the tool at hand, and of its choice ("write" of the task tool) where it has choices. */
  tool: string;
  choice: string | null;
  theme: Theme;
  /** Id of the panel's tab. */
  tab: string;
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
  /** Places at 5 cm, turns at 15 degrees. */
  snap: boolean;
  canUndo: boolean;
  canRedo: boolean;
  saved: "saved" | "saving" | "off";
  /** Id of the menu that is open. */
  menu: string | null;
  /** Height of the bottom sheet on narrow windows. */
  sheet: "peek" | "half" | "full";
  toast: { text: string; undo: boolean; warns: boolean } | null;
  status: string | null;
  /** Work that takes longer: what, how far (0 to 1), and a fact; null for none. */
  progress: { name: string; share: number; fact: string } | null;
  hoverStep: number;
  error: string | null;
}

export type Store = ReturnType<typeof createEditorStore>;

export function createEditorStore(scene: Scene, name: string, theme: Theme) {
  return createStore<EditorState>(() => ({
    scene,
    name,
    selection: [],
    tool: "select",
    choice: null,
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
    snap: true,
    canUndo: false,
    canRedo: false,
    saved: "saved",
    menu: null,
    sheet: "half",
    toast: null,
    progress: null,
    status: "Loading captures",
    hoverStep: -1,
    error: null,
  }));
}
