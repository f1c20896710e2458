/** The scene: every thing in it as a list, and the character's build. */
import { html, nothing, type TemplateResult } from "lit";
import { crowdAlone } from "../crowd/crowd-session.ts";
import type { Editor } from "../editor.ts";
import { openSceneMenu } from "../parts/scene-menu.ts";
import { type RowsOf, schemaRows } from "../parts/schema-rows.ts";
import { sole } from "../parts/sole.ts";
import { hasRef } from "../selection.ts";
import type { ThingKind } from "../things/thing.ts";
import type { PanelTab } from "./panel-tab.ts";

export const sceneTab: PanelTab = {
  id: "scene",
  label: () => "Scene",
  order: 0,
  shown: () => true,
  draw: (e) => html`${e.registry.things.filter((k) => k.listed !== false).map((k) => things(e, k))}
    ${crowdAlone(e.store.getState().scene) ? nothing : character(e)}
    ${warnings(e)}`,
};

function things(e: Editor, kind: ThingKind): TemplateResult | typeof nothing {
  const { selection } = e.store.getState();
  const list = kind.list(e);
  if (list.length === 0) return kind.kind === "task" && nothingToDo(e) ? emptyState(e) : nothing;
  return html`<section class="section">
    <header><h3>${kind.title}</h3><span>${list.length}</span></header>
    <div class="list">
      ${list.map(
        (t, i) =>
          html`<button aria-current=${hasRef(selection, t.ref)} @click=${(ev: MouseEvent) => (ev.shiftKey ? e.scene.toggle(t.ref) : e.scene.select([t.ref]))}>${t.icon} ${i + 1}. ${t.label} <span class="quiet">${t.fact ?? ""}</span></button>`,
      )}
    </div>
  </section>`;
}

function nothingToDo(e: Editor): boolean {
  const { scene } = e.store.getState();
  return scene.order.length === 0 && scene.crowd === null;
}

/** A room with nothing to do: what it is, and what to press. */
function emptyState(e: Editor): TemplateResult {
  return html`<section class="section empty">
    <div class="prints">${sole("Walk", "left")}${sole("Walk")}${sole("TurnAndStep")}</div>
    <h2>No tasks in this scene</h2>
    <p class="note">Take the Task tool, then click the floor where it is to be done.</p>
    <div class="actions">
      <button class="button primary" @click=${() => e.tools.use("task")}>Add a task</button>
      <button class="button" @click=${() => void openSceneMenu(e)}>Open an example</button>
    </div>
  </section>`;
}

/** The character's build: one entry of the history a slide. */
function character(e: Editor): TemplateResult {
  const { character: now } = e.store.getState().scene;
  const set =
    (part: "character" | "proportions"): RowsOf["set"] =>
    (key, value, done) => {
      e.scene.beginGesture();
      e.edit((scene, c) =>
        c.changeBuild(
          scene,
          part === "character" ? { [key]: value } : { proportions: { ...now.proportions, [key]: value } },
        ),
      );
      if (done) e.scene.endGesture(true);
    };
  return html`<section class="section">
    <header><h3>Character</h3><span>${now.height.toFixed(2)} m</span></header>
    ${schemaRows(e, "character", { values: { ...now }, set: set("character") })}
    ${schemaRows(e, "proportions", { values: { ...now.proportions }, set: set("proportions") })}
    <p class="note">Each build has templates of its own: a taller character side-steps where a shorter one turns.</p>
  </section>`;
}

function warnings(e: Editor): TemplateResult | typeof nothing {
  const list = e.store.getState().plan?.warnings ?? [];
  if (list.length === 0) return nothing;
  return html`<section class="section">${list.map((w) => html`<p class="error">${w}</p>`)}</section>`;
}
