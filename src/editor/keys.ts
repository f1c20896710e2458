/** Keys of the whole page; those of a marker are the marker's own. */
import { TASK_CATEGORIES } from "../core/scene/task-types.ts";
import type { Editor } from "./editor.ts";

/** Handles a key; fields keep theirs. */
export function pageKey(e: Editor, ev: KeyboardEvent): void {
  const target = ev.target as HTMLElement;
  if (target.closest("input, select, textarea, dialog")) return;
  const key = ev.key.toLowerCase();
  const control = ev.ctrlKey || ev.metaKey;
  const act = (f: () => void) => {
    ev.preventDefault();
    f();
  };
  if (control) {
    if (key === "z") act(() => (ev.shiftKey ? e.redo() : e.undo()));
    else if (key === "y") act(() => e.redo());
    else if (key === "d") act(() => e.duplicate());
    else if (key === "s") act(() => e.exportScene());
    else if (key === "o") act(() => e.openFile());
    return;
  }
  if (key === " ") {
    // A button that has the focus keeps its space bar; markers do not need it.
    if (target.closest("button:not(.marker), [role=button]")) return;
    act(() => e.togglePlay());
  } else if (key === ",") e.stepFrame(-1);
  else if (key === ".") e.stepFrame(1);
  else if (key === "delete" || key === "backspace") act(() => e.remove());
  else if (key === "v") e.setTool("select");
  else if (key === "l") e.setTool("path");
  else if (key === "f") e.frameScene();
  else if (key === "p") e.setColouring(e.store.getState().colouring === "phase" ? "category" : "phase");
  else if (key === "?") e.setHelp(true);
  else if (key === "escape") {
    e.setTool("select");
    e.setMenu("none");
  } else if (/^[1-6]$/.test(key)) e.setTool(TASK_CATEGORIES[Number(key) - 1]);
}
