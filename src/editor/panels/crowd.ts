/** The crowd's tab: running, what is selected of it, and what the picked walker plans. */
import { html, nothing, type TemplateResult } from "lit";
import { unsafeSVG } from "lit/directives/unsafe-svg.js";
import { CROWD_GAITS, type CrowdGait } from "../../core/scene/types.ts";
import { ENERGY_TERMS, type EnergyStep, energyFinding, energyPlot } from "../../plots/energy-terms.ts";
import { type CrowdSession, crowdSession } from "../crowd/crowd-session.ts";
import type { Editor } from "../editor.ts";
import { numberField } from "../parts/number-field.ts";
import { changeOf } from "../tools/crowd.ts";
import type { PanelTab } from "./panel-tab.ts";

const CODES: Record<string, string> = { walk: "W", start: "S", stop: "H", stand: "R", shift: "A" };

export const crowdTab: PanelTab = {
  id: "crowd",
  label: () => "Crowd",
  order: 45,
  shown: (e) => e.store.getState().scene.crowd !== null || e.store.getState().tool === "crowd",
  draw,
};

function draw(e: Editor): TemplateResult {
  const session = crowdSession(e);
  if (!session.hasCrowd)
    return html`<section class="section"><header><h3>No crowd yet</h3></header><p class="note">Drag an area on the floor: walkers begin in it and go to its goal.</p></section>`;
  return html`${running(session)} ${chosen(e)} ${walker(e, session)} ${
    session.repairs.length > 0
      ? html`<section class="section"><header><h3>Put right</h3></header>${session.repairs.slice(0, 6).map((r) => html`<p class="note">${r}</p>`)}</section>`
      : nothing
  }`;
}

const fact = (what: string, value: string): TemplateResult =>
  html`<div class="row"><span>${what}</span><span class="quiet">${value}</span></div>`;

function running(s: CrowdSession): TemplateResult {
  const f = s.figures;
  return html`<section class="section crowd-run">
    <header><h3>Crowd</h3><span>${s.ready ? `${s.left} of ${s.agents} on their way` : "Making ready"}</span></header>
    <div class="actions">
      <button class="button" @click=${() => s.setRunning(!s.running)} ?disabled=${!s.ready}>${s.running ? "Pause" : "Run"}</button>
      <button class="button" @click=${() => s.restart()}>From the start</button>
    </div>
    <div class="list facts">
      ${fact("Clock", `${s.seconds.toFixed(1)} s`)}
      ${
        f && f.plans > 0
          ? html`${fact("Plans made", String(f.plans))}${fact("Nodes a plan looks at", (f.expanded / f.plans).toFixed(0))}${fact("Nodes a plan makes", (f.generated / f.plans).toFixed(0))}`
          : nothing
      }
    </div>
    ${s.picked < 0 ? html`<p class="note">Click a walker to see what it plans.</p>` : nothing}
  </section>`;
}

/** Speed and gait, the same for an area and a walker. */
function stepping(
  e: Editor,
  speed: number,
  gait: CrowdGait,
  set: (change: { speed?: number; gait?: CrowdGait }) => void,
): TemplateResult {
  return html`<div class="row">Speed ${numberField(e, "Speed", "", speed.toFixed(2), "m/s", (v) => set({ speed: Math.max(0.05, Math.min(5, v)) }))}</div>
    <label class="row">Gait <span class="field"><select aria-label="Gait" .value=${gait} @change=${(ev: Event) => set({ gait: (ev.target as HTMLSelectElement).value as CrowdGait })}>${CROWD_GAITS.map(
      (g) =>
        html`<option value=${g} ?selected=${g === gait}>${g === "usual" ? "As usual" : g[0].toUpperCase() + g.slice(1)}</option>`,
    )}</select></span></label>`;
}

function chosen(e: Editor): TemplateResult | typeof nothing {
  const { selection, scene } = e.store.getState();
  const one = selection.length === 1 ? selection[0] : null;
  if (one?.kind === "crowd-region") {
    const r = scene.crowd?.regions[one.index];
    if (!r) return nothing;
    return html`<section class="section"><header><h3>Area ${one.index + 1}</h3><span>${((r.bounds[1] - r.bounds[0]) * (r.bounds[3] - r.bounds[2])).toFixed(1)} m²</span></header>
      <div class="row">Walkers ${numberField(e, "Walkers", "", String(r.count), "", (v) => changeOf.region(e, one.index, { count: Math.max(0, Math.min(2000, Math.round(v))) }))}</div>
      ${stepping(e, r.speed, r.gait, (c) => changeOf.region(e, one.index, c))}</section>`;
  }
  if (one?.kind === "crowd-agent") {
    const a = scene.crowd?.agents[one.index];
    if (!a) return nothing;
    return html`<section class="section"><header><h3>Walker ${one.index + 1}</h3></header>
      ${stepping(e, a.speed, a.gait, (c) => changeOf.walker(e, one.index, c))}</section>`;
  }
  return nothing;
}

function walker(e: Editor, s: CrowdSession): TemplateResult | typeof nothing {
  if (s.picked < 0) return nothing;
  const { story } = s;
  if (!story)
    return html`<section class="section"><header><h3>Walker ${s.picked + 1}</h3><span>arrived, or about to step</span></header></section>`;
  const steps: EnergyStep[] = story.steps.map((q) => ({
    code: CODES[q.kind],
    terms: [q.fixed, q.speed, q.bend, q.nearness],
  }));
  const table = e.tables.has("energy");
  return html`<section class="section">
    <header><h3>Plan of walker ${s.picked + 1}</h3><span>${story.expanded} nodes looked at</span></header>
    <p class="note">${energyFinding(steps)}</p>
    ${
      table
        ? html`<table class="plot-table"><thead><tr><th>Step</th>${ENERGY_TERMS.map((t) => html`<th>${t}</th>`)}</tr></thead><tbody>${steps.map((q) => html`<tr><td>${q.code}</td>${q.terms.map((v) => html`<td>${v.toFixed(2)}</td>`)}</tr>`)}</tbody></table>`
        : html`<div>${unsafeSVG(energyPlot(steps))}</div>`
    }
    <p class="note">J/kg each. W walks, S starts, H halts, R rests, A steps aside.</p><button class="button small" aria-pressed=${table} @click=${() => e.toggleTable("energy")}>Table</button>
    <p class="note">${story.generated} footsteps were thought of, ${story.judgements} looked at among the others.</p>
  </section>`;
}
