/** The panel's sliders and switches. */
import { html, type TemplateResult } from "lit";
import { unsafeHTML } from "lit/directives/unsafe-html.js";
import { passed } from "../editor/parts/schema-rows.ts";
import { layerLine } from "../plots/layer-line.ts";
import { LAYERS, type Layer } from "../studio/score.ts";
import { STYLES, type Style } from "../studio/styles.ts";
import type { WalkSettings } from "../studio/walk-score.ts";
import type { Walked } from "../workers/studio-protocol.ts";
import type { PageState } from "./main.ts";
import { MOOD, PERSON, type Slider, START, VARIATION } from "./settings.ts";

interface Acts {
  settle(s: WalkSettings): void;
  takeStyle(s: Style): void;
}

export function controls(state: PageState, acts: Acts): TemplateResult {
  const { settings } = state;
  return html`
    <div class="section">
      <header><h3>Person</h3><button class="plain small" @click=${() => acts.takeStyle("walking")}>Reset</button></header>
      <label class="row"><span>Manner</span>
        <select class="field" .value=${state.style} @change=${(e: Event) => acts.takeStyle((e.target as HTMLSelectElement).value as Style)}>
          ${state.style === "own" ? html`<option value="own" selected>Own</option>` : ""}
          ${STYLES.map((s) => html`<option value=${s} ?selected=${s === state.style}>${s.charAt(0).toUpperCase()}${s.slice(1)}</option>`)}
        </select>
      </label>
      ${PERSON.map((s) => row(s, settings, acts))}
      <div class="row"><span>Gait</span>
        <div class="segments" role="group" aria-label="Gait">
          ${(["walk", "run"] as const).map(
            (g) =>
              html`<button aria-pressed=${String((g === "run") === settings.run)} @click=${() => acts.settle(toGait(settings, g === "run"))}>${g === "walk" ? "Walk" : "Run"}</button>`,
          )}
        </div>
      </div>
    </div>
    <div class="section"><header><h3>Mood</h3></header>${MOOD.map((s) => row(s, settings, acts))}</div>
    <div class="section"><header><h3>Variation</h3></header>${VARIATION.map((s) => row(s, settings, acts))}</div>
  `;
}

/** Walking or running at a speed that fits it. */
function toGait(s: WalkSettings, run: boolean): WalkSettings {
  if (run === s.run) return s;
  return {
    ...s,
    run,
    bouncing: false,
    stepLength: null,
    speed: run ? Math.max(2.4, s.speed) : Math.min(1.6, s.speed),
    width: run ? 0.07 : START.width,
  };
}

function row(slider: Slider, settings: WalkSettings, acts: Acts): TemplateResult {
  const value = slider.read(settings);
  const digits = slider.step < 0.1 ? 2 : slider.step < 1 ? 1 : 0;
  const word = slider.says?.(settings) ?? null;
  const change = (text: string) => {
    const wanted = Number(text);
    if (!Number.isFinite(wanted)) return;
    acts.settle(slider.write(settings, Math.max(slider.min, Math.min(slider.max, wanted))));
  };
  const id = `slider-${slider.id}`;
  return html`<div class="row slider">
    <label for=${id}>${slider.label}</label>
    <input id=${id} type="range" min=${slider.min} max=${slider.max} step=${slider.step} style=${passed(value, slider.min, slider.max)} .value=${String(value)}
      @input=${(e: Event) => change((e.target as HTMLInputElement).value)} />
    <span class="field">
      ${
        word
          ? html`<span class="word" title=${`${value.toFixed(digits)} ${slider.unit}`}>${word}</span>`
          : html`<input type="number" aria-label=${`${slider.label}, ${slider.unit}`} min=${slider.min} max=${slider.max} step=${slider.step}
              .value=${value.toFixed(digits)} @change=${(e: Event) => change((e.target as HTMLInputElement).value)} />`
      }<span class="unit">${word ? "" : slider.unit}</span>
    </span>
  </div>`;
}

const NAMES: Record<Layer, string> = {
  roll: "Foot roll",
  balance: "Balance",
  rhythm: "Rhythm",
  lean: "Lean",
  knees: "Knees",
  flight: "Flight",
  gaze: "Gaze",
  tasks: "Tasks",
  alive: "Alive",
};

/** A switch a layer, with what the layer does beside it. */
export function layerRows(
  walk: Walked | null,
  settings: WalkSettings,
  settle: (s: WalkSettings) => void,
): TemplateResult[] {
  return LAYERS.map((layer) => {
    const on = !settings.without.includes(layer);
    const track = walk?.tracks.find((t) => t.layer === layer);
    const flip = () =>
      settle({
        ...settings,
        without: on ? [...settings.without, layer] : settings.without.filter((l) => l !== layer),
      });
    return html`<div class="layer">
      <label><input type="checkbox" role="switch" .checked=${on} @change=${flip} /> ${NAMES[layer]}</label>
      <span title=${track?.says ?? ""}>${track ? unsafeHTML(layerLine(track.lines, track.says, track.unit)) : ""}</span>
    </div>`;
  });
}
