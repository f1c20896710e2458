/** Entries of the page's menus. */
import type { Editor } from "./editor.ts";

export interface MenuEntry {
  /** Which menu: the scene's name at the top, or the dots of the selection's panel. */
  menu: "scenes" | "selection";
  label: string;
  /** Groups are hundreds: a line stands between them. */
  order: number;
  shortcut?: string;
  shown?(e: Editor): boolean;
  run(e: Editor): void;
}
