/** Cut, copy and paste through the system's clipboard, so that things travel between scenes and windows. */
import { copyThings, pasteThings, readFragment } from "../../core/scene/clipboard.ts";
import type { Editor } from "../editor.ts";
import { ref } from "../selection.ts";

/** Metres that pasted things stand beside where they were copied. */
const ASIDE = 0.5;

/** Whether the event is a field's own. */
const inField = (ev: Event): boolean =>
  (ev.target as Element | null)?.closest?.("input, textarea, select, dialog") != null;

function copy(e: Editor, ev: ClipboardEvent): boolean {
  const { scene, selection } = e.store.getState();
  if (inField(ev) || selection.length === 0) return false;
  const fragment = copyThings(scene, new Set(selection.map((r) => r.id)));
  ev.clipboardData?.setData("text/plain", JSON.stringify(fragment));
  ev.preventDefault();
  return true;
}

function paste(e: Editor, ev: ClipboardEvent): void {
  if (inField(ev)) return;
  try {
    const fragment = readFragment(ev.clipboardData?.getData("text/plain") ?? "");
    if (!fragment) return;
    ev.preventDefault();
    const pasted = pasteThings(e.store.getState().scene, fragment, ASIDE, ASIDE);
    if (!e.edit(() => pasted.scene)) return;
    const own = [
      ...pasted.tasks.map((id) => ref("task", id)),
      ...pasted.paths.map((id) => ref("path", id)),
      ...pasted.stones.map((id) => ref("stone", id)),
    ];
    // Furniture that came with a task moves with it.
    e.scene.select(own.length > 0 ? own : pasted.props.map((id) => ref("prop", id)));
  } catch (error) {
    e.fail(`What was pasted: ${error instanceof Error ? error.message : String(error)}`);
  }
}

export function useClipboard(e: Editor): void {
  window.addEventListener("copy", (ev) => {
    if (copy(e, ev)) e.say("Copied.", false);
  });
  window.addEventListener("cut", (ev) => {
    if (copy(e, ev)) e.scene.remove();
  });
  window.addEventListener("paste", (ev) => paste(e, ev));
}
