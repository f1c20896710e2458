/** The task chosen: where, which way, how; and what the planner did for it. */
import { html, nothing, type TemplateResult } from "lit";
import type { SceneTask } from "../../core/scene/types.ts";
import type { Editor } from "../editor.ts";
import { TASK_ICONS, TASK_WORDS } from "../icons.ts";
import { numberField } from "../parts/number-field.ts";
import { onlyId } from "../selection.ts";
import type { PanelTab } from "./panel-tab.ts";
import { competition, objective } from "./planner-story.ts";

const degrees = (r: number): string => ((r * 180) / Math.PI).toFixed(1).replace("-", "\u2212");

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
  const text = (v: number) => v.toFixed(2).replace("-", "\u2212");
  const place = (k: number) => (v: number) => {
    const p: [number, number, number] = [...t.position];
    p[k] = v;
    e.edit((scene, c) => c.placeTask(scene, t.id, p, t.yaw));
  };
  const natural = time ? time.end - time.contact : 0;
  return html`
    <section class="section">
      <div class="subject"><span class="glyph">${TASK_ICONS[t.category]}</span><div><h2>${TASK_WORDS[t.category]}</h2><span class="note">Task ${index + 1} of ${s.scene.order.length}${time ? ` · ${time.start.toFixed(2)} to ${time.end.toFixed(2)} s` : ""}</span></div></div>
      <div class="row">Position <div class="fields">${numberField(e, "Position x", "x", text(t.position[0]), "", place(0))}${numberField(e, "Height y", "y", text(t.position[1]), "", place(1))}${numberField(e, "Position z", "z", text(t.position[2]), "", place(2))}</div></div>
      <div class="row">Facing ${numberField(e, "Facing", "", degrees(t.yaw), "°", (v) => e.edit((scene, c) => c.placeTask(scene, t.id, t.position, (v * Math.PI) / 180)))}</div>
      ${
        t.category === "write"
          ? html`<div class="row">Effort <div class="segments">
              ${([0, 1] as const).map((v) => html`<button aria-pressed=${t.effort === v} @click=${() => e.edit((scene, c) => c.changeTask(scene, t.id, { effort: v }))}>${v === 0 ? "Low" : "High"}</button>`)}
            </div></div>
            <div class="row">Hand <div class="segments">
              ${(["left", "right"] as const).map((v) => html`<button aria-pressed=${t.hand === v} @click=${() => e.edit((scene, c) => c.changeTask(scene, t.id, { hand: v }))}>${v === "left" ? "Left" : "Right"}</button>`)}
            </div></div>`
          : nothing
      }
      ${t.category !== "turn" ? html`<div class="row">Hold ${numberField(e, "Hold", "", (t.duration ?? natural).toFixed(2), "s", (v) => e.edit((scene, c) => c.changeTask(scene, t.id, { duration: Math.max(0, Math.min(600, v)) })))}</div>` : nothing}
      <div class="actions"><button class="plain" @click=${() => e.scene.duplicate()}>Duplicate</button><button class="plain danger" @click=${() => e.scene.remove()}>Delete</button></div>
    </section>
    ${competition(e, index)} ${objective(e, index)}
  `;
}
