/** The panel at the side: the scene as a list, the task chosen, and what the planner did. */
import { html, nothing, type TemplateResult } from "lit";
import { unsafeSVG } from "lit/directives/unsafe-svg.js";
import { TERM_NAMES } from "../../core/optimize/phase-weights.ts";
import type { SceneTask } from "../../core/scene/types.ts";
import { STEP_CATEGORIES } from "../../core/steps/types.ts";
import { objectiveFinding, objectivePlot } from "../../plots/objective.ts";
import { transitionGraph } from "../../plots/transition-graph.ts";
import { CATEGORY_COLOURS, CATEGORY_WORDS } from "../../view/tokens.ts";
import type { Editor } from "../editor.ts";
import { TASK_ICONS, TASK_WORDS } from "../icons.ts";
import { pathSection } from "./paths.ts";

const degrees = (r: number): string => ((r * 180) / Math.PI).toFixed(1).replace("-", "\u2212");

export function panel(e: Editor): TemplateResult {
  const s = e.store.getState();
  const task = s.scene.tasks.find((t) => t.id === s.selected) ?? null;
  const tab = s.tab === "task" && !task ? "scene" : s.tab;
  return html`
    <div class="tabs" role="tablist">
      <button role="tab" aria-selected=${tab === "scene"} @click=${() => e.setTab("scene")}>Scene</button>
      ${task ? html`<button role="tab" aria-selected=${tab === "task"} @click=${() => e.setTab("task")}>${TASK_WORDS[task.category].split(" ")[0]}</button>` : nothing}
      <button role="tab" aria-selected=${tab === "plan"} @click=${() => e.setTab("plan")}>Plan</button>
    </div>
    <div class="body" role="tabpanel" tabindex="-1">${tab === "task" && task ? taskTab(e, task) : tab === "plan" ? planTab(e) : sceneTab(e)}</div>
    <footer><span>${s.plan ? `Planned in ${s.planMs.toFixed(1)} ms` : (s.status ?? "")}</span><span>${s.plan ? `${s.plan.steps.length} footsteps` : ""}</span></footer>
  `;
}

function sceneTab(e: Editor): TemplateResult {
  const s = e.store.getState();
  const { height, proportions } = s.scene.character;
  const tasks = s.scene.order.flatMap((id) => s.scene.tasks.find((t) => t.id === id) ?? []);
  return html`
    ${pathSection(e)}
    <section class="section">
      <header><h3>Tasks</h3><span>${tasks.length}</span></header>
      <div class="list">
        ${tasks.map((t, i) => {
          const time = s.plan?.tasks.find((p) => p.id === t.id);
          return html`<button aria-current=${t.id === s.selected} @click=${() => e.select(t.id, true)}>${TASK_ICONS[t.category]} ${i + 1}. ${TASK_WORDS[t.category]} <span class="quiet">${time ? `${time.contact.toFixed(2)} s` : ""}</span></button>`;
        })}
      </div>
      ${tasks.length === 0 ? html`<p class="note">Nothing to do yet. Pick a task at the left and click on the floor.</p>` : nothing}
    </section>
    <section class="section">
      <header><h3>Character</h3><span>${height.toFixed(2)} m</span></header>
      <label class="row">Height <input type="range" min="1.5" max="2" step="0.01" .value=${String(height)} @input=${(ev: Event) => e.setBuild(Number((ev.target as HTMLInputElement).value), proportions.leg, false)} @change=${(ev: Event) => e.setBuild(Number((ev.target as HTMLInputElement).value), proportions.leg, true)} /></label>
      <label class="row">Legs <input type="range" min="0.85" max="1.15" step="0.01" .value=${String(proportions.leg)} @input=${(ev: Event) => e.setBuild(height, Number((ev.target as HTMLInputElement).value), false)} @change=${(ev: Event) => e.setBuild(height, Number((ev.target as HTMLInputElement).value), true)} /></label>
      <p class="note">Each build has templates of its own: a taller character side-steps where a shorter one turns.</p>
    </section>
    ${s.plan && s.plan.warnings.length > 0 ? html`<section class="section">${s.plan.warnings.map((w) => html`<p class="error">${w}</p>`)}</section>` : nothing}
  `;
}

function numberField(
  e: Editor,
  label: string,
  axis: string,
  value: string,
  unit: string,
  set: (v: number) => void,
): TemplateResult {
  return html`<label class="field"><span>${axis}</span><input inputmode="decimal" aria-label=${label} .value=${value} @keydown=${(
    ev: KeyboardEvent,
  ) => {
    const step = ev.key === "ArrowUp" ? 1 : ev.key === "ArrowDown" ? -1 : 0;
    if (!step) return;
    ev.preventDefault();
    const input = ev.target as HTMLInputElement;
    set(
      Number(input.value.replace("\u2212", "-")) +
        step * (ev.shiftKey ? 10 : ev.altKey ? 0.1 : 1) * (unit === "°" ? 1 : 0.01),
    );
  }} @change=${(ev: Event) => {
    const v = Number((ev.target as HTMLInputElement).value.replace("\u2212", "-").replace(",", "."));
    if (Number.isFinite(v)) set(v);
    else
      e.fail(`${label}: a number is needed, found ${JSON.stringify((ev.target as HTMLInputElement).value)}.`);
  }} /><span>${unit}</span></label>`;
}

function taskTab(e: Editor, t: SceneTask): TemplateResult {
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
      <div class="actions"><button class="plain" @click=${() => e.duplicate()}>Duplicate</button><button class="plain danger" @click=${() => e.remove()}>Delete</button></div>
    </section>
    ${competition(e, index)} ${objective(e, index)}
  `;
}

/** The templates that competed for coming to a task. */
function competition(e: Editor, index: number): TemplateResult {
  const s = e.store.getState();
  const rows = s.plan?.candidates.filter((c) => c.task === index) ?? [];
  const enter = rows.find((r) => r.phase === "enter") ?? rows[0];
  if (!enter) return html``;
  const most = Math.max(...enter.list.map((c) => c.distance), 1e-6);
  return html`<section class="section">
    <header><h3>Templates that competed</h3><span>cost</span></header>
    <div class="competitors">
      ${enter.list.map(
        (c, i) => html`<div class=${c.chosen ? "chosen" : ""} title=${c.template}>
          <span>${i + 1}</span>
          <span class="feet" role="img" aria-label=${c.steps.map((x) => CATEGORY_WORDS[x.category]).join(", ")}>${c.steps.slice(0, 11).map((x) => html`<i class=${x.foot} style="background: ${CATEGORY_COLOURS[x.category].fill}"></i>`)}</span>
          <span class="track"><span style="width: ${(100 * c.distance) / most}%"></span></span><em>${c.distance.toFixed(2)}</em>
        </div>`,
      )}
    </div>
  </section>`;
}

function objective(e: Editor, index: number): TemplateResult {
  const s = e.store.getState();
  const traces = s.plan?.traces.filter((t) => t.task === index && t.terms.length > 1) ?? [];
  const trace = traces.find((t) => t.phase === "enter") ?? traces[0];
  if (!trace) return html``;
  const data = { rows: trace.terms, names: ["Total", "Template", "Spacing", "Heading", "Goal", "Line"] };
  return html`<section class="section">
    <header><h3>Objective while fitting</h3><span>${trace.terms.length - 1} iterations</span></header>
    ${
      e.tables.has("objective")
        ? html`<table class="data"><tr><th>total</th>${TERM_NAMES.map((n) => html`<th>${n}</th>`)}</tr>${trace.terms.map((r) => html`<tr>${r.map((v) => html`<td>${v.toFixed(3)}</td>`)}</tr>`)}</table>`
        : html`<div>${unsafeSVG(objectivePlot(data))}</div>`
    }
    <p class="note">${objectiveFinding(data)} <button class="plain" @click=${() => e.toggleTable("objective")}>${e.tables.has("objective") ? "Plot" : "Table"}</button></p>
  </section>`;
}

function planTab(e: Editor): TemplateResult {
  const s = e.store.getState();
  const counts = STEP_CATEGORIES.map((c) => s.plan?.steps.filter((x) => x.category === c).length ?? 0);
  return html`
    <section class="section">
      <header><h3>Footprints</h3></header>
      <div class="row">Colours <div class="segments">
        <button aria-pressed=${s.colouring === "category"} @click=${() => e.setColouring("category")}>Category</button>
        <button aria-pressed=${s.colouring === "phase"} @click=${() => e.setColouring("phase")}>Phase</button>
      </div></div>
      <div class="row">Shown <div class="segments">
        <button aria-pressed=${s.showBefore} @click=${() => e.setShowBefore(true)}>As laid</button>
        <button aria-pressed=${!s.showBefore} @click=${() => e.setShowBefore(false)}>Optimised</button>
      </div></div>
      <p class="note">${s.showBefore ? "Where the templates put the feet, before the optimiser joined them." : s.colouring === "phase" ? "Exit, locomotion and enter, from dark over light to black." : "Each colour is a kind of step."}</p>
    </section>
    <section class="section">
      <header><h3>Steps by category</h3><span>${s.plan?.steps.length ?? 0}</span></header>
      <div class="list">${STEP_CATEGORIES.map((c, i) => html`<div class="row" style="grid-template-columns: 20px 1fr 40px; min-height: 24px"><span class="swatch" style="background: ${CATEGORY_COLOURS[c].fill}"></span>${CATEGORY_WORDS[c]}<span style="text-align: right">${counts[i]}</span></div>`)}</div>
    </section>
    ${competition(e, Math.max(0, e.currentTask()))} ${objective(e, Math.max(0, e.currentTask()))}
    ${
      s.transitions
        ? html`<section class="section"><header><h3>Which step follows which</h3><span>in the captures</span></header><div>${unsafeSVG(transitionGraph({ counts: s.transitions, colours: STEP_CATEGORIES.map((c) => CATEGORY_COLOURS[c].fill), codes: STEP_CATEGORIES.map((c) => CATEGORY_COLOURS[c].code) }))}</div></section>`
        : nothing
    }
  `;
}
