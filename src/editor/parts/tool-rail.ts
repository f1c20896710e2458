/** Tools at the viewport's left: select, a path, and one a task category to put down. */
import { html, type TemplateResult } from "lit";
import { TASK_CATEGORIES } from "../../core/scene/task-types.ts";
import type { Editor } from "../editor.ts";
import { ICONS, TASK_ICONS, TASK_WORDS } from "../icons.ts";

const KEYS = { write: "1", lift: "2", place: "3", sit: "4", stand: "5", turn: "6" } as const;

export function toolRail(e: Editor): TemplateResult {
  const s = e.store.getState();
  return html`<div class="rail" role="toolbar" aria-orientation="vertical" aria-label="Tools">
    <button aria-label="Select" data-tip="Select  V" aria-pressed=${s.tool === "select"} @click=${() => e.setTool("select")}>${ICONS.select}</button>
    <button aria-label="Draw a path" data-tip="Draw a path  L" aria-pressed=${s.tool === "path"} @click=${() => e.setTool(s.tool === "path" ? "select" : "path")}>${ICONS.path}</button>
    <hr />
    ${TASK_CATEGORIES.map(
      (c) =>
        html`<button aria-label="Add: ${TASK_WORDS[c]}" data-tip="Add: ${TASK_WORDS[c].toLowerCase()}  ${KEYS[c]}" aria-pressed=${s.tool === c} @click=${() => e.setTool(s.tool === c ? "select" : c)}>${TASK_ICONS[c]}</button>`,
    )}
  </div>`;
}
