/** A performance and its plan side by side: captures of one's own, or the studio's left-out sequence [TaskLoco §7, ground truth]. */
import { html, type TemplateResult } from "lit";
import { compareLayer } from "../compare/layer.ts";
import { compareSession } from "../compare/session.ts";
import type { Editor } from "../editor.ts";
import type { PanelTab } from "../panels/panel-tab.ts";
import type { Feature } from "./feature.ts";

const row = (label: string, value: string): TemplateResult =>
  html`<div class="row" style="grid-template-columns: 1fr auto; min-height: 28px"><span>${label}</span><span>${value}</span></div>`;

const besideTab: PanelTab = {
  id: "beside",
  label: () => "Beside",
  order: 55,
  shown: (e) => compareSession(e).shown !== null,
  draw: (e: Editor) => {
    const session = compareSession(e);
    const f = session.figures();
    return html`<section class="section"><header><h3>Performed and planned</h3></header>
      <p class="note">The blue figure and the white footprints are the performance; the plan of the same tasks is made without it.</p>
      ${
        f
          ? html`${row("Footsteps performed", String(f.performed))}${row("Footsteps planned", String(f.planned))}
            ${row("To the nearest planned, median", `${(100 * f.distance).toFixed(0)} cm`)}
            ${row("Nine of ten within", `${(100 * f.distance90).toFixed(0)} cm`)}
            ${f.seconds ? html`${row("First to last task, performed", `${f.seconds.performed.toFixed(1)} s`)}${row("First to last task, planned", `${f.seconds.planned.toFixed(1)} s`)}` : ""}`
          : html`<p class="note">No plan yet.</p>`
      }
      <div class="actions"><button class="outline" @click=${() => session.close()}>Show the plan alone</button></div>
    </section>`;
  },
};

export const comparison: Feature = {
  id: "comparison",
  tabs: [besideTab],
  layers: [(e) => compareLayer(e, compareSession(e))],
  menu: [
    {
      menu: "scenes",
      label: "A left-out performance beside its plan",
      order: 250,
      run: (e) => compareSession(e).leftOut(),
    },
  ],
};
