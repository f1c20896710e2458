/** The strip of gait curves under the stage, and the facts over it. */
import { html, nothing, type TemplateResult } from "lit";
import { unsafeHTML } from "lit/directives/unsafe-html.js";
import { type GaitCurveData, gaitFinding, gaitPlot, insideShare } from "../plots/gait-curves.ts";
import type { GaitRange } from "../studio/gait-range.ts";
import type { Walked } from "../workers/studio-protocol.ts";
import type { PageState } from "./main.ts";

const JOINTS = [
  { key: "hip", joint: "Hip", up: "flexed", down: "extended", domain: [-40, 60] },
  { key: "knee", joint: "Knee", up: "flexed", down: "straight", domain: [-5, 115] },
  { key: "ankle", joint: "Ankle", up: "toe up", down: "toe down", domain: [-60, 35] },
] as const;

/** The three joints' curves of a walk that has a steady gait. */
export function jointPlots(walk: Walked): GaitCurveData[] {
  const { gait, range } = walk;
  if (!gait) return [];
  return JOINTS.map(({ key, joint, up, down, domain }) => ({
    joint,
    up,
    down,
    domain,
    mean: gait[key].mean,
    sd: gait[key].sd,
    real: range ? range.curves[key] : null,
    toeOff: gait.facts.stance,
  }));
}

export function curves(state: PageState, setTable: (table: boolean) => void): TemplateResult {
  const { walk } = state;
  if (!walk) return html`<p class="quiet">The first walk is being made.</p>`;
  if (!walk.gait)
    return html`<p class="quiet">No steady gait in this performance: nothing to lay over the real range.</p>`;
  const plots = jointPlots(walk);
  return html`
    <header>
      <h3>Gait cycle</h3>
      <span class="quiet">${walk.range ? rangeWords(walk.range) : ""}</span>
      <span class="space"></span>
      <button class="plain small" aria-pressed=${String(state.table)} @click=${() => setTable(!state.table)}>Table</button>
    </header>
    ${
      state.table
        ? table(walk, plots)
        : html`<div class="joints" role="group" aria-label="Curves of hip, knee and ankle" tabindex="0">${plots.map(
            (p) =>
              html`<figure><figcaption><strong>${p.joint}</strong> <span>${insideWords(p)}</span></figcaption>${unsafeHTML(gaitPlot(p))}</figure>`,
          )}</div>`
    }
  `;
}

const insideWords = (p: GaitCurveData): string => {
  const inside = insideShare(p);
  return inside === null ? "degrees" : `${Math.round(100 * inside)} % inside`;
};

function rangeWords(range: GaitRange): string {
  const what = range.kind === "run" ? "runners" : "walkers";
  const speed = {
    slow: "under 0.85 m/s",
    comfortable: "0.85 to 1.35 m/s",
    quick: "over 1.35 m/s",
    jog: "under 2.4 m/s",
    run: "over 2.4 m/s",
  }[range.name];
  return `Grey: ${range.walkers} kinds of real ${what}, ${speed}, one spread either side`;
}

function table(walk: Walked, plots: readonly GaitCurveData[]): TemplateResult {
  const phases = [0, 10, 20, 30, 40, 50, 60, 70, 80, 90, 100];
  const said = (v: number) => `${v.toFixed(0)}`.replace("-", "\u2212");
  return html`<div class="scroll"><table>
    <caption>${plots.map(gaitFinding).join(" ")} ${walk.range ? "Real: mean ± spread." : ""}</caption>
    <thead><tr><th scope="col">Degrees at</th>${phases.map((p) => html`<th scope="col">${p} %</th>`)}</tr></thead>
    <tbody>${plots.map(
      (
        p,
      ) => html`<tr><th scope="row">${p.joint}</th>${phases.map((k) => html`<td>${said(p.mean[k])}</td>`)}</tr>
        ${
          p.real
            ? html`<tr class="quiet"><th scope="row">real</th>${phases.map((k) => {
                const i = Math.round(((p.real?.mean.length ?? 1) - 1) * (k / 100));
                return html`<td>${said(p.real?.mean[i] ?? 0)} ± ${said(p.real?.sd[i] ?? 0)}</td>`;
              })}</tr>`
            : nothing
        }`,
    )}</tbody>
  </table></div>`;
}

export interface FactRow {
  name: string;
  value: string;
  /** Beyond two spreads of the real ones. */
  out: boolean;
}

/** The gait's facts in words, those beyond the real range marked. */
export function factRows(walk: Walked): FactRow[] {
  const { gait, range } = walk;
  if (!gait) return [];
  const f = gait.facts;
  const row = (name: string, key: keyof GaitRange["facts"] | null, value: number, text: string): FactRow => {
    const real = key && range ? range.facts[key] : null;
    const out = real !== null && Math.abs(value - real[0]) > 2 * Math.max(real[1], 0.02 * Math.abs(real[0]));
    return { name, value: text, out };
  };
  const percent = (v: number) => `${Math.round(100 * v)} %`;
  return [
    row("Speed", null, f.speed, `${f.speed.toFixed(2)} m/s`),
    row("Step", "stepLength", f.stepLength, `${f.stepLength.toFixed(2)} m`),
    row("Cadence", "cadence", f.cadence, `${f.cadence.toFixed(0)} a minute`),
    row("Stance", "stance", f.stance, percent(f.stance)),
    f.flight > 0
      ? row("Flight", null, f.flight, percent(f.flight))
      : row("Both feet", "doubleSupport", f.doubleSupport, percent(f.doubleSupport)),
    row("Rise and fall", "pelvisVertical", f.pelvisVertical, `${(100 * f.pelvisVertical).toFixed(1)} cm`),
  ];
}
