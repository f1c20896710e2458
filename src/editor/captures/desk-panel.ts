/** The desk's side panel: what to label next, the clip, the model. */
import { html, nothing, type TemplateResult } from "lit";
import { unsafeSVG } from "lit/directives/unsafe-svg.js";
import { learningCurve } from "../../plots/learning-curve.ts";
import { download } from "../formats/download.ts";
import { sole } from "../parts/sole.ts";
import type { Capture } from "./capture.ts";
import { clipTab } from "./clip-tab.ts";
import { csvOf } from "./label-files.ts";
import type { CaptureSession } from "./session.ts";

export type DeskTab = "labels" | "clip" | "model";
const TABS: [DeskTab, string][] = [
  ["labels", "Labels"],
  ["clip", "Clip"],
  ["model", "Model"],
];

export function deskPanel(s: CaptureSession): TemplateResult {
  return html`
    <div class="tabs" role="tablist">
      ${TABS.map(([id, label]) => html`<button role="tab" aria-selected=${s.tab === id} @click=${() => s.setTab(id)}>${label}</button>`)}
    </div>
    <div class="body" role="tabpanel" aria-label=${TABS.find(([id]) => id === s.tab)?.[1] ?? ""}>
      ${progress(s)}
      ${s.tab === "labels" ? labelsTab(s) : s.tab === "clip" ? clipTab(s) : modelTab(s)}
    </div>
    ${
      s.tab === "labels" && s.current
        ? html`<footer class="desk-foot"><button class="outline" @click=${() => s.skip()}>Skip</button><button class="primary" @click=${() => void s.confirm()}>Confirm and next</button></footer>`
        : nothing
    }
  `;
}

function progress(s: CaptureSession): TemplateResult | typeof nothing {
  const p = s.progress;
  if (!p) return nothing;
  return html`<section class="section" role="status">
    <header><h3>${p.label} ${p.name}</h3><span>${Math.round(100 * p.share)} %</span></header>
    <div class="bar-row"><div class="bar"><i style="width:${(100 * p.share).toFixed(1)}%"></i></div><button class="icon" aria-label="Cancel" @click=${() => s.cancel()}>×</button></div>
  </section>`;
}

/** What to do when there is no capture yet. */
function empty(s: CaptureSession): TemplateResult {
  return html`<section class="section empty">
    <div class="prints">${sole("Walk", "left")}${sole("Walk")}${sole("TurnAndStep")}</div>
    <h2>No capture yet</h2>
    <p class="note">Drop BVH files on the page. They stay on this computer.</p>
    <div class="actions"><button class="primary" @click=${() => s.pickFiles()}>Open BVH files</button></div>
  </section>${publicSection(s)}`;
}

function labelsTab(s: CaptureSession): TemplateResult {
  if (s.captures.length === 0) return empty(s);
  const open = s.openSegments();
  const most = Math.max(1e-6, ...open.map((x) => x.foreign));
  const last = s.sureness.at(-1);
  return html`
    <section class="section"><header><h3>Next to label</h3><span>distance</span></header>
      <div class="list">${open.slice(0, 6).map((x) => {
        const c = s.captures.find((y) => y.key === x.key) as Capture;
        const here = c === s.current && x.first === s.stretch.first;
        return html`<button aria-current=${here} @click=${() => s.show(c, { first: x.first, last: x.last })}><span>${s.captures.length > 1 ? `${x.key}, ` : ""}${x.first} to ${x.last}</span><span class="bar quiet"><i style="width:${((100 * x.foreign) / most).toFixed(0)}%"></i></span><span>${x.foreign.toFixed(2)}</span></button>`;
      })}</div>
      ${open.length === 0 ? html`<p class="note">Every segment is labelled.</p>` : nothing}
    </section>
    <section class="section"><header><h3>Labels the oracle is sure of</h3><span>percent</span></header>
      ${last ? unsafeSVG(surenessSvg(s)) : nothing}
      ${s.sureness.length > 1 ? html`<p class="note">${change(s)}</p>` : nothing}
    </section>
    <section class="section"><header><h3>Files</h3></header>
      <div class="actions">
        <button class="outline" @click=${() => s.current && download(`${s.current.key}.csv`, csvOf(s.current), "text/csv")}>Export labels</button>
        <button class="plain" @click=${() => s.pickFiles()}>Open files</button>
      </div>
    </section>`;
}

function change(s: CaptureSession): string {
  const [before, now] = s.sureness.slice(-2);
  const by = 100 * (now.sure - before.sure);
  return `${by >= 0 ? "Up" : "Down"} ${Math.abs(by).toFixed(1)} % by the last segment.`;
}

function surenessSvg(s: CaptureSession): string {
  const points = s.sureness.map((p): [number, number] => [p.segments, 100 * p.sure]);
  const last = points[points.length - 1][1];
  const low = Math.min(50, Math.floor(Math.min(...points.map((p) => p[1])) / 25) * 25);
  return learningCurve({
    width: 270,
    height: 120,
    range: [low, 100],
    xName: "segments labelled",
    last: `${last.toFixed(1)} %`,
    finding: `The oracle is sure of ${last.toFixed(1)} percent of labels after ${points[points.length - 1][0]} segments.`,
    series: [{ name: "", dashed: false, points }],
  });
}

function modelTab(s: CaptureSession): TemplateResult {
  const labelled = s.captures.reduce((n, c) => n + c.edits.confirmed.reduce((a, b) => a + b, 0), 0);
  return html`<section class="section"><header><h3>Oracle</h3><span>${s.examples.toLocaleString("en")} examples</span></header>
      <p class="note">It began with the studio's own captures, made like captured ones. ${labelled > 0 ? `You have added ${labelled.toLocaleString("en")} frames.` : "Confirm a segment, and it learns from you."}</p>
      <div class="actions"><button class="outline" @click=${() => void s.saveModel()}>Export model</button><button class="plain" @click=${() => s.pickFiles()}>Open a model</button></div>
    </section>${publicSection(s)}`;
}

function publicSection(s: CaptureSession): TemplateResult {
  return html`<section class="section"><header><h3>Public captures</h3><span>fetched at a click</span></header>
    ${s.publicList.map(
      (p, i) =>
        html`<div class="public"><button class="outline" @click=${() => void s.fetchPublic(p)}>Fetch ${p.name}</button>${
          // Those of one home say whose they are once, after the last.
          p.licence === s.publicList[i + 1]?.licence ? nothing : html`<p class="note">${p.licence}</p>`
        }</div>`,
    )}
  </section>`;
}
