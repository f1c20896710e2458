/** What the planner did for a task: the templates that competed, and the objective falling. */
import { html, type TemplateResult } from "lit";
import { unsafeSVG } from "lit/directives/unsafe-svg.js";
import { TERM_NAMES } from "../../core/optimize/phase-weights.ts";
import { objectiveFinding, objectivePlot } from "../../plots/objective.ts";
import { CATEGORY_COLOURS, CATEGORY_WORDS } from "../../view/tokens.ts";
import type { Editor } from "../editor.ts";

/** The templates that competed for coming to a task. */
export function competition(e: Editor, index: number): TemplateResult {
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

export function objective(e: Editor, index: number): TemplateResult {
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
