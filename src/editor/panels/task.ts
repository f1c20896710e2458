/** The task chosen: where, which way, how; and what the planner did for it. */
import { html, type TemplateResult } from "lit";
import type { SceneTask } from "../../core/scene/types.ts";
import type { Editor } from "../editor.ts";
import { TASK_ICONS, TASK_WORDS } from "../icons.ts";
import { type RowsOf, schemaRows } from "../parts/schema-rows.ts";
import { onlyId } from "../selection.ts";
import type { PanelTab } from "./panel-tab.ts";
import { competition, objective } from "./planner-story.ts";

function chosen(e: Editor): SceneTask | null {
  const s = e.store.getState();
  const id = onlyId(s.selection, "task");
  return s.scene.tasks.find((t) => t.id === id) ?? null;
}

export const taskTab: PanelTab = {
  id: "task",
  order: 10,
  label: (e) => TASK_WORDS[chosen(e)?.category ?? "write"].split(" ")[0],
  shown: (e) => chosen(e) !== null,
  draw(e) {
    const task = chosen(e);
    return task ? draw(e, task) : html``;
  },
};

function draw(e: Editor, t: SceneTask): TemplateResult {
  const s = e.store.getState();
  const index = s.scene.order.indexOf(t.id);
  const time = s.plan?.tasks.find((p) => p.id === t.id);
  const set: RowsOf["set"] = (key, value) => {
    const changed = { ...t, [key]: value };
    // Position and facing carry the furniture along.
    if (key === "position" || key === "yaw")
      e.edit((scene, c) => c.placeTask(scene, t.id, changed.position, changed.yaw));
    else e.edit((scene, c) => c.changeTask(scene, t.id, { [key]: value }));
  };
  const natural = time ? time.end - time.contact : 0;
  return html`
    <section class="section">
      <div class="subject"><span class="glyph">${TASK_ICONS[t.category]}</span><div><h2>${TASK_WORDS[t.category]}</h2><span class="note">Task ${index + 1} of ${s.scene.order.length}${time ? ` · ${time.start.toFixed(2)} to ${time.end.toFixed(2)} s` : ""}</span></div></div>
      ${schemaRows(e, "task", { values: { ...t }, planned: { duration: natural }, of: t.category, set })}
      <div class="actions"><button class="plain" @click=${() => e.scene.duplicate()}>Duplicate</button><button class="plain danger" @click=${() => e.scene.remove()}>Delete</button></div>
    </section>
    ${competition(e, index)} ${objective(e, index)}
  `;
}
