/** A lane of the timeline: a strip of SVG under the ruler that shares its time scale. */
import type { Editor } from "../editor.ts";
import type { Gesture } from "../tools/tool.ts";

export interface LaneFrame {
  /** Pixels of the whole timeline. */
  width: number;
  /** Height given to this lane, pixels. */
  height: number;
  /** Seconds to pixels. */
  x(seconds: number): number;
  /** Pixels to seconds, held inside the motion. */
  seconds(x: number): number;
}

export interface Lane {
  id: string;
  /** Place from the top: tasks 10, path styles 20, feet 30, labels 40. */
  order: number;
  shown(e: Editor): boolean;
  /** Left out where the timeline has no room for every lane. */
  spare?: boolean;
  /** Height it would like, pixels; lanes share what there is. */
  height(e: Editor): number;
  /** SVG markup, its own top at y = 0; the first 58 pixels are for its name. */
  draw(e: Editor, frame: LaneFrame): string;
  /** Pointer down on the lane's markup. @returns a gesture when it takes it; null scrubs. */
  down?(e: Editor, target: Element, frame: LaneFrame, ev: PointerEvent): Gesture | null;
  /** Pointer over the lane's markup, or null when it left. */
  hover?(e: Editor, target: Element | null): void;
  keydown?(e: Editor, target: Element, ev: KeyboardEvent): boolean;
}
