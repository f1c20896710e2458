/** The Stones tab: the chosen stone, the ground, what the blend does for the step shown [Barycentric Figures 3, 6, 8]. */
import { html, nothing, type TemplateResult } from "lit";
import { unsafeSVG } from "lit/directives/unsafe-svg.js";
import type { StepChoice } from "../../core/blending/types.ts";
import { changeStone, hills, setTerrain, stairs } from "../../core/scene/stone-commands.ts";
import type { SceneStone, Terrain } from "../../core/scene/types.ts";
import { footSpacePlot, weightBar } from "../../plots/foot-space.ts";
import { landingErrorFinding, landingErrorPlot } from "../../plots/landing-error.ts";
import type { Editor } from "../editor.ts";
import { stoneView } from "../layers/stones.ts";
import { dial } from "../parts/dial.ts";
import { numberField } from "../parts/number-field.ts";
import { passed, shownNumber } from "../parts/schema-rows.ts";
import { onlyId } from "../selection.ts";
import { STONE_ICON } from "../tools/stones.ts";
import type { PanelTab } from "./panel-tab.ts";

const DEGREE = Math.PI / 180;

export const stonesTab: PanelTab = {
  id: "stones",
  label: () => "Stones",
  order: 30,
  shown(e) {
    const { scene, tool } = e.store.getState();
    return scene.stones.length > 0 || scene.terrain.kind !== "flat" || tool === "stones";
  },
  draw: (e) => html`${stoneSection(e)}${blendSection(e)}${errorSection(e)}${groundSection(e)}`,
};

function stoneSection(e: Editor): TemplateResult {
  const { scene, selection, plan } = e.store.getState();
  const id = onlyId(selection, "stone");
  const stone = scene.stones.find((s) => s.id === id);
  if (!stone)
    return html`<section class="section"><header><h3>Stones</h3><span>${scene.stones.length}</span></header>
      <p class="note">With the Stones tool (S), click on the floor: each click is the next stone. Feet alternate by themselves; Q chooses one.</p></section>`;
  const [x, y, z] = stone.position;
  const set = (change: Partial<Omit<SceneStone, "id">>) => e.edit((s) => changeStone(s, stone.id, change));
  const order = scene.order.filter((k) => scene.stones.some((s) => s.id === k));
  const step = plan?.blend ? plan.steps[plan.blend.first + order.indexOf(stone.id)] : undefined;
  const own = stone.time !== null;
  const first = plan?.blend ? (plan.steps[plan.blend.first]?.lift ?? 0) : 0;
  return html`<section class="section">
    <div class="subject"><span class="glyph">${STONE_ICON}</span><div><h2>Stone ${order.indexOf(stone.id) + 1}</h2><span class="note">${step ? `${step.foot === "left" ? "Left" : "Right"} foot, at ${step.land.toFixed(2)} s` : "No step reaches it yet"}</span></div></div>
    <div class="row"><span>Position</span><div class="fields">
      ${numberField(e, "Left", "x", shownNumber(x, "m"), "m", (v) => set({ position: [v, y, z] }))}
      ${numberField(e, "Height", "y", shownNumber(y, "m"), "m", (v) => set({ position: [x, v, z] }))}
      ${numberField(e, "Forward", "z", shownNumber(z, "m"), "m", (v) => set({ position: [x, y, v] }))}
    </div></div>
    <div class="row"><span>Facing</span><div class="fields turning">
      ${dial(e, stone.yaw, (yaw) => set({ yaw }))}
      ${numberField(e, "Facing", "", shownNumber(stone.yaw, "°"), "°", (v) => set({ yaw: v * DEGREE }))}
    </div></div>
    <div class="row"><span>Foot</span><div class="segments" role="group" aria-label="Foot">
      ${([null, "left", "right"] as const).map(
        (f) =>
          html`<button aria-pressed=${stone.foot === f} @click=${() => set({ foot: f })}>${f === null ? "Either" : f === "left" ? "Left" : "Right"}</button>`,
      )}
    </div></div>
    <div class="switch-row"><span>At a time of its own</span><button class="switch" role="switch" aria-checked=${own} aria-label="At a time of its own" @click=${() => set({ time: own ? null : Math.max(0, (step?.land ?? first) - first) })}></button></div>
    ${own ? html`<div class="row"><span title="Seconds after the first step">After start</span>${numberField(e, "Seconds after the first step", "", shownNumber(stone.time ?? 0, "s"), "s", (v) => set({ time: Math.max(0, v) }))}</div>` : nothing}
    <div class="actions"><button class="plain" @click=${() => e.scene.duplicate()}>Duplicate</button><button class="plain danger" @click=${() => e.scene.remove()}>Delete</button></div>
  </section>`;
}

/** The choice of the step under way or last made at the time shown, and the last of the other foot. */
function choicesNow(e: Editor): { live: StepChoice | null; index: number; other: StepChoice | null } {
  const { plan, time } = e.store.getState();
  const choices = plan?.blend?.choices ?? [];
  let index = choices.findLastIndex((c) => c.lift <= time);
  if (index < 0 && choices.length > 0) index = 0;
  const live = choices[index] ?? null;
  const other = live ? (choices.slice(0, index).findLast((c) => c.foot !== live.foot) ?? null) : null;
  return { live, index, other };
}

function blendSection(e: Editor): TemplateResult | typeof nothing {
  const blend = e.store.getState().plan?.blend;
  if (!blend) return nothing;
  const { live, other } = choicesNow(e);
  const names = blend.names.map((n) => n.replace(/^cycle-/, ""));
  const plot = (side: 0 | 1) => {
    const foot = side === 0 ? "left" : "right";
    const c = live?.foot === foot ? live : other;
    return footSpacePlot({
      ...blend.feet[side],
      names,
      title: side === 0 ? "Left foot" : "Right foot",
      hit: c,
    });
  };
  return html`<section class="section">
    <header><h3>Clips blended</h3><span>${live ? `${live.clips.length} of ${names.length}` : ""}</span></header>
    <div class="two-plots">${unsafeSVG(plot(0))}${unsafeSVG(plot(1))}</div>
    ${
      live
        ? html`<div class="list facts">${live.clips
            .map((c, k) => ({ name: names[c], w: live.weights[k] }))
            .sort((a, b) => b.w - a.w)
            .map(
              (x) =>
                html`<div class="row"><span>${x.name}</span><span class="quiet">${(100 * x.w).toFixed(0)} %</span></div>`,
            )}</div>
          <div>${unsafeSVG(weightBar(live))}</div>`
        : nothing
    }
    <label class="row"><span>Follows</span><span class="between">footsteps <input type="range" min="0" max="1" step="0.05" aria-label="From footsteps to root: lambda 4" style=${passed(e.plan.lambda4, 0, 1)} .value=${String(e.plan.lambda4)} @input=${(ev: Event) => e.plan.follow(Number((ev.target as HTMLInputElement).value))} /> root</span></label>
    <p class="note">${
      e.plan.lambda4 === 0
        ? "The feet land on the stones. Towards root, the clips that fit the body's speed count for more; up to beta the stones are still met."
        : `λ₄ = ${e.plan.lambda4.toFixed(2)}. ${live && e.plan.lambda4 > live.beta ? "Beyond beta the landing slides to the root's own (diamond)." : "Within beta: this stone is met."}`
    }</p>
  </section>`;
}

function errorSection(e: Editor): TemplateResult | typeof nothing {
  const blend = e.store.getState().plan?.blend;
  if (!blend || blend.choices.length === 0) return nothing;
  const data = {
    errors: blend.choices.map((c) => c.before),
    feet: blend.choices.map((c) => c.foot),
    now: choicesNow(e).index,
  };
  return html`<section class="section">
    <header><h3>Landing before correction</h3><span>${data.errors.length} steps</span></header>
    ${
      e.tables.has("landing")
        ? html`<table class="data"><tr><th>step</th><th>foot</th><th>mm</th><th>triangle cm²</th></tr>${blend.choices.map((c, k) => html`<tr><td>${k + 1}</td><td>${c.foot}</td><td>${(1000 * c.before).toFixed(0)}</td><td>${(1e4 * c.area).toFixed(0)}</td></tr>`)}</table>`
        : html`<div>${unsafeSVG(landingErrorPlot(data))}</div>`
    }
    <p class="note">${landingErrorFinding(data)} <button class="plain" @click=${() => e.toggleTable("landing")}>${e.tables.has("landing") ? "Plot" : "Table"}</button></p>
    <div class="switch-row"><span>Columns on the floor, ten times as tall</span><button class="switch" role="switch" aria-checked=${stoneView.columns} aria-label="Columns on the floor, ten times as tall" @click=${() => {
      stoneView.columns = !stoneView.columns;
      e.layers.update("look");
      e.redraw();
    }}></button></div>
  </section>`;
}

const GROUNDS: readonly { id: string; label: string; make(): Terrain }[] = [
  { id: "flat", label: "Flat", make: () => ({ kind: "flat" }) },
  { id: "slope", label: "Slope", make: () => ({ kind: "slope", angle: 8 * DEGREE, yaw: 0 }) },
  { id: "stairs", label: "Stairs", make: () => stairs(0.16, 5) },
  { id: "hills", label: "Hills", make: () => hills(0.3, 3) },
];

function groundSection(e: Editor): TemplateResult {
  const { terrain } = e.store.getState().scene;
  const now = terrain.kind === "heightfield" ? (terrain.cells[0] === 1 ? "stairs" : "hills") : terrain.kind;
  return html`<section class="section">
    <header><h3>Ground</h3><span>${terrain.kind === "heightfield" ? `${terrain.cells[0]} × ${terrain.cells[1]} cells` : ""}</span></header>
    <div class="segments" role="group" aria-label="Ground">
      ${GROUNDS.map((g) => html`<button aria-pressed=${now === g.id} @click=${() => e.edit((s) => setTerrain(s, g.make()))}>${g.label}</button>`)}
    </div>
    ${
      terrain.kind === "slope"
        ? html`<div class="row"><span>Slope</span>${numberField(e, "Slope", "", shownNumber(terrain.angle, "°"), "°", (v) => e.edit((s) => setTerrain(s, { ...terrain, angle: Math.max(-25, Math.min(25, v)) * DEGREE })))}</div>
          <div class="row"><span>Uphill</span><div class="fields turning">
            ${dial(e, terrain.yaw, (yaw) => e.edit((s) => setTerrain(s, { ...terrain, yaw })))}
            ${numberField(e, "Uphill towards", "", shownNumber(terrain.yaw, "°"), "°", (v) => e.edit((s) => setTerrain(s, { ...terrain, yaw: v * DEGREE })))}
          </div></div>`
        : nothing
    }
  </section>`;
}
