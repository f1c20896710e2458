/**
 * Kinds of things in the viewport: each can be listed, selected, moved, turned, removed and copied in the same way, by
 * mouse, touch, keys and numbers. A kind is registered by a feature; markers, list, nudging and deleting follow from it.
 */
import type { TemplateResult } from "lit";
import type { Scene } from "../../core/scene/types.ts";
import type { Editor } from "../editor.ts";
import type { Ref } from "../selection.ts";
import type { Gesture, ToolPointer } from "../tools/tool.ts";

/** One thing, as it is shown. */
export interface Thing {
  ref: Ref;
  /** "Lift the box" */
  label: string;
  /** A quiet fact beside it in the list: "5.15 s". */
  fact?: string | undefined;
  icon: TemplateResult;
  /** Where its handle stands, metres. */
  position: readonly [number, number, number];
  /** Radians; null for things without a facing. */
  yaw: number | null;
}

export interface ThingKind {
  kind: string;
  /** "Tasks": head of its list in the Scene tab. */
  title: string;
  /** What one is called in sentences: "task". */
  noun: string;
  /** Place of its list. */
  order: number;
  /**
   * How its handle is drawn over the viewport: "selected" shows one only while the thing is selected, "none" never; both are
   * picked in the stage itself.
   */
  handle: "ball" | "dot" | "selected" | "none";
  /** All of them, in the order of the plan. */
  list(e: Editor): Thing[];
  /** Whether handles are shown now; left out: always. */
  shown?(e: Editor): boolean;
  /** Whether the Scene tab lists them; left out: yes. */
  listed?: boolean;
  /** A scene with the thing at a place and yaw. */
  place(scene: Scene, r: Ref, position: readonly [number, number, number], yaw: number): Scene;
  /** A scene without them. */
  remove(scene: Scene, refs: readonly Ref[]): Scene;
  /** A scene with copies beside the originals, and what the copies are. */
  duplicate?(scene: Scene, refs: readonly Ref[]): { scene: Scene; refs: Ref[] };
  /** Tab of the panel that shows it. */
  tab?: string;
  /** Words beside the pointer while it hovers. */
  hint?: string;
  /** A drag moves it only once it is selected; before that the camera turns, and a click selects. For large things. */
  clickFirst?: boolean;
  /** For things picked in the stage: a drag that begins on one. */
  grab?(e: Editor, r: Ref, p: ToolPointer): Gesture | null;
  /** A double click on its handle. */
  activate?(e: Editor, r: Ref): void;
  /** A key while it is selected and its handle has the focus. @returns whether it was used. */
  keydown?(e: Editor, r: Ref, ev: KeyboardEvent): boolean;
}
