/** A performance and its plan side by side: captures of one's own, or the studio's left-out sequence [TaskLoco §7, ground truth]. */
import { html, type TemplateResult } from "lit";
import { compareLayer } from "../compare/layer.ts";
import { compareSession } from "../compare/session.ts";
import type { Editor } from "../editor.ts";
import type { PanelTab } from "../panels/panel-tab.ts";
import type { Feature } from "./feature.ts";

const row = (label: string, value: string): TemplateResult =>
  html`<div class="row" style="grid-template-columns: 1fr auto; min-height: 28px"><span>${label}</span><span>${value}</span></div>`;

/** How the two that are compared are called. */
const WORDS = {
  performance: {
    title: "Performed and planned",
    note: "The blue figure and the white footprints are the performance; the plan of the same tasks is made without it.",
    first: "performed",
    second: "planned",
  },
  result: {
    title: "The file's plan and this one",
    note: "The white footprints are those of the file; the coloured ones are planned now.",
    first: "in the file",
    second: "planned now",
  },
} as const;

const besideTab: PanelTab = {
  id: "beside",
  label: () => "Beside",
  order: 55,
  shown: (e) => compareSession(e).shown !== null,
  draw: (e: Editor) => {
    const session = compareSession(e);
    const f = session.figures();
    const w = WORDS[session.shown?.kind ?? "performance"];
    return html`<section class="section"><header><h3>${w.title}</h3></header>
      <p class="note">${w.note}</p>
      ${
        f
          ? html`${row(`Footsteps ${w.first}`, String(f.performed))}${row(`Footsteps ${w.second}`, String(f.planned))}
            ${row("To the nearest planned, median", `${(100 * f.distance).toFixed(0)} cm`)}
            ${row("Nine of ten within", `${(100 * f.distance90).toFixed(0)} cm`)}
            ${f.seconds ? html`${row(`First to last task, ${w.first}`, `${f.seconds.performed.toFixed(1)} s`)}${row(`First to last task, ${w.second}`, `${f.seconds.planned.toFixed(1)} s`)}` : ""}`
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
