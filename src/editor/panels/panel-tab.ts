/** A tab of the side panel. */
import type { TemplateResult } from "lit";
import type { Editor } from "../editor.ts";

export interface PanelTab {
  id: string;
  /** Short word on the tab; may follow the selection. */
  label(e: Editor): string;
  /** Scene 0, the selection's own 10 to 40, plan 50, what a method did 60 and on. */
  order: number;
  shown(e: Editor): boolean;
  draw(e: Editor): TemplateResult;
}
