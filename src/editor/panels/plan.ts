/** The plan as a whole: how its footprints are shown, its steps by category, what follows what. */
import { html, nothing, type TemplateResult } from "lit";
import { unsafeSVG } from "lit/directives/unsafe-svg.js";
import { STEP_CATEGORIES } from "../../core/steps/types.ts";
import { transitionGraph } from "../../plots/transition-graph.ts";
import { CATEGORY_COLOURS, CATEGORY_WORDS } from "../../view/tokens.ts";
import type { Editor } from "../editor.ts";
import type { PanelTab } from "./panel-tab.ts";
import { competition, objective } from "./planner-story.ts";

export const planTab: PanelTab = {
  id: "plan",
  label: () => "Plan",
  order: 50,
  shown: () => true,
  draw: (e) => draw(e),
};

function draw(e: Editor): TemplateResult {
  const s = e.store.getState();
  const counts = STEP_CATEGORIES.map((c) => s.plan?.steps.filter((x) => x.category === c).length ?? 0);
  return html`
    <section class="section">
      <header><h3>Footprints</h3></header>
      <div class="row">Colours <div class="segments">
        <button aria-pressed=${s.colouring === "category"} @click=${() => e.showFootprints({ colouring: "category" })}>Category</button>
        <button aria-pressed=${s.colouring === "phase"} @click=${() => e.showFootprints({ colouring: "phase" })}>Phase</button>
      </div></div>
      <div class="row">Shown <div class="segments">
        <button aria-pressed=${s.showBefore} @click=${() => e.showFootprints({ showBefore: true })}>As laid</button>
        <button aria-pressed=${!s.showBefore} @click=${() => e.showFootprints({ showBefore: false })}>Optimised</button>
      </div></div>
      <p class="note">${s.showBefore ? "Where the templates put the feet, before the optimiser joined them." : s.colouring === "phase" ? "Exit, locomotion and enter, from dark over light to black." : "Each colour is a kind of step."}</p>
    </section>
    <section class="section">
      <header><h3>Steps by category</h3><span>${s.plan?.steps.length ?? 0}</span></header>
      <div class="list">${STEP_CATEGORIES.map((c, i) => html`<div class="row" style="grid-template-columns: 20px 1fr 40px; min-height: 24px"><span class="swatch" style="background: ${CATEGORY_COLOURS[c].fill}"></span>${CATEGORY_WORDS[c]}<span style="text-align: right">${counts[i]}</span></div>`)}</div>
    </section>
    ${competition(e, Math.max(0, e.plan.currentTask()))} ${objective(e, Math.max(0, e.plan.currentTask()))}
    ${
      s.transitions
        ? html`<section class="section"><header><h3>Which step follows which</h3><span>in the captures</span></header><div>${unsafeSVG(transitionGraph({ counts: s.transitions, colours: STEP_CATEGORIES.map((c) => CATEGORY_COLOURS[c].fill), codes: STEP_CATEGORIES.map((c) => CATEGORY_COLOURS[c].code) }))}</div></section>`
        : nothing
    }
  `;
}
