/** What a tool is: the viewport's pointer and keys go to the one at hand. */
import type { TemplateResult } from "lit";
import type { Editor } from "../editor.ts";

/** A pointer over the viewport. */
export interface ToolPointer {
  event: PointerEvent;
  /** CSS pixels of the viewport. */
  x: number;
  y: number;
  /** The world's x, z under the pointer at a height over the ground, metres; null beyond 40 m. */
  level(height: number): [number, number] | null;
}

/**
 * From a pointer down to its up. The host holds the mark: everything edited meanwhile is one entry of the history; Escape,
 * a second finger or a lost pointer put the scene back to the mark.
 */
export interface Gesture {
  /** True for gestures that leave the scene alone (a box, a scrub): the history is not touched. */
  plain?: boolean;
  move(p: ToolPointer): void;
  /** The pointer was let go. @returns false to give the edits up as well. */
  up?(p: ToolPointer): boolean | undefined;
  /** After the scene is back at the mark. */
  cancel?(): void;
  /** A key while it lasts (Escape is the host's). @returns whether the key was used. */
  key?(ev: KeyboardEvent): boolean;
}

/** One of a tool's kinds: "Write" of the task tool. Shown beside the rail while the tool is at hand. */
export interface ToolChoice {
  id: string;
  label: string;
  icon: TemplateResult;
  /** Shown under the icon where fingers are used; left out: the label. */
  short?: string;
  /** Key that takes tool and choice up at once. */
  key: string;
}

export interface Tool {
  id: string;
  /** A noun: "Path". */
  label: string;
  icon: TemplateResult;
  /** One key, as the help sheet shows it: "P". */
  key: string;
  /** Place in the rail; select is 0, task 10, path 20, stones 30, crowd 40, label 50. */
  order: number;
  choices?: readonly ToolChoice[];
  /** CSS cursor over the viewport. */
  cursor?: string;
  enter?(e: Editor): void;
  leave?(e: Editor): void;
  /**
   * Pointer down on the canvas. Edits belong to the gesture: what is edited here lies before its mark.
   *
   * @returns a gesture when the tool takes it; null leaves it to the camera.
   */
  down?(e: Editor, p: ToolPointer): Gesture | null;
  /** Pointer moves with no button down. */
  hover?(e: Editor, p: ToolPointer): void;
  /** A key that no gesture used. @returns whether it was used. */
  keydown?(e: Editor, ev: KeyboardEvent): boolean;
}
