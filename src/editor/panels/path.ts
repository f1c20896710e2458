/** The Path tab: styles to paint with, the change that is chosen, the path itself, and what can be switched off. */
import { html, nothing, type TemplateResult } from "lit";
import { unsafeSVG } from "lit/directives/unsafe-svg.js";
import { BLEND_STARTS, EFFECTOR_NAMES, FIXED_BLEND } from "../../core/styles/blend-length.ts";
import type { PathOptions } from "../../core/styles/synthesise-path.ts";
import { blendLengthsSvg } from "../../plots/blend-lengths.ts";
import { swatchSvg } from "../../plots/style-pattern.ts";
import type { Editor } from "../editor.ts";
import { markFloor, pathNear } from "../layers/path-bands.ts";
import { numberField } from "../parts/number-field.ts";
import { deskOf, type PathDesk, stretchesOf } from "../paths/path-desk.ts";
import { ref } from "../selection.ts";
import type { PanelTab } from "./panel-tab.ts";

/** How near to a path a style is let go to be painted there, metres; how far a pointer goes before it drags, pixels. */
const DROP_REACH = 0.5;
const CLICK = 4;

const capital = (s: string): string => s[0].toUpperCase() + s.slice(1);
const EFFECTOR_WORDS: Record<(typeof EFFECTOR_NAMES)[number], string> = {
  head: "head",
  leftHand: "left hand",
  rightHand: "right hand",
  leftFoot: "left foot",
  rightFoot: "right foot",
};

export const pathTab: PanelTab = {
  id: "path",
  label: () => "Path",
  order: 12,
  shown: (e) => e.store.getState().scene.paths.length > 0 || e.store.getState().tool === "path",
  draw(e) {
    const desk = deskOf(e);
    const { scene } = e.store.getState();
    return html`${scene.paths.length === 0 ? empty() : nothing}
      ${palette(e, desk)} ${scene.paths.length > 0 ? html`${change(e, desk)} ${paths(e, desk)} ${refinements(desk)}` : nothing}`;
  },
};

const empty = (): TemplateResult =>
  html`<section class="section"><p class="note">Draw on the floor, or set points one by one. The character walks along the path; styles are painted on it.</p></section>`;

/** Drags a style onto a path; a click paints the chosen stretch, or the one under the playhead. */
function dragStyle(e: Editor, desk: PathDesk, style: string, ev: PointerEvent): void {
  if (ev.button !== 0 || e.tools.busy) return;
  const start = [ev.clientX, ev.clientY];
  let far = false;
  const onPath = (level: [number, number] | null) => (level ? pathNear(e, level, DROP_REACH) : null);
  e.tools.run(
    {
      plain: true,
      move(p) {
        far ||= Math.hypot(p.event.clientX - start[0], p.event.clientY - start[1]) > CLICK;
        if (!far) return;
        const level = p.level(0);
        markFloor(e, onPath(level) ? level : null);
      },
      up(p) {
        markFloor(e, null);
        const place = far ? onPath(p.level(0)) : null;
        if (place) desk.change({ path: place.id, at: place.at }, style);
        else if (!far) paintHere(desk, style);
        return true;
      },
      cancel: () => markFloor(e, null),
    },
    ev,
  );
}

function paintHere(desk: PathDesk, style: string): void {
  const stretch = desk.current();
  if (stretch) desk.paint(stretch, style);
}

function palette(e: Editor, desk: PathDesk): TemplateResult {
  const stretch = desk.current();
  const path = e.store.getState().scene.paths.find((p) => p.id === stretch?.path);
  const now = path && stretch ? stretchesOf(path)[stretch.index]?.style : null;
  const pick = (): void => {
    const input = document.createElement("input");
    input.type = "file";
    input.accept = ".bvh";
    input.multiple = true;
    input.onchange = () => {
      for (const file of input.files ?? []) void desk.add(file);
    };
    input.click();
  };
  return html`<section class="section">
    <header><h3>Styles</h3><span>drag onto the path</span></header>
    <div class="list styles">
      ${desk.styles.map((style) => {
        const facts = desk.facts.get(style);
        return html`<div class="style-row">
          <button aria-pressed=${style === now} aria-label="${capital(style)}: paint" title="Click paints ${stretch ? "the chosen stretch" : "the path"}; drag puts a change on the path" @pointerdown=${(ev: PointerEvent) => dragStyle(e, desk, style, ev)} @keydown=${(
            ev: KeyboardEvent,
          ) => {
            if (ev.key !== "Enter" && ev.key !== " ") return;
            ev.preventDefault();
            ev.stopPropagation();
            paintHere(desk, style);
          }}>${unsafeSVG(swatchSvg(desk.look(style), 64, 16))}<span>${capital(style)}</span><span class="quiet">${facts ? `${facts.speed.toFixed(2)} m/s` : ""}</span></button>
          ${desk.own.includes(style) ? html`<button class="forget" aria-label="Remove the style ${style}" title="Remove this style" @click=${() => desk.forget(style)}>×</button>` : nothing}
        </div>`;
      })}
    </div>
    <div class="actions"><button class="outlined" @click=${pick}>Add a style from BVH</button></div>
    ${desk.progress ? html`<p class="note" role="status">${desk.progress}</p>` : nothing}
  </section>`;
}

/** The chosen stretch: where it begins, and the blend that leads into it. */
function change(e: Editor, desk: PathDesk): TemplateResult | typeof nothing {
  const stretch = desk.current();
  const { scene } = e.store.getState();
  const path = scene.paths.find((p) => p.id === stretch?.path);
  const place = desk.placeAt(e.store.getState().time);
  const here = html`<button class="outlined" ?disabled=${!place} @click=${() => {
    if (!place || !path) return;
    const list = stretchesOf(path);
    const style = list[stretch?.index ?? 0]?.style ?? "walking";
    desk.change(place, desk.styles[(desk.styles.indexOf(style) + 1) % desk.styles.length]);
  }}>Change style here</button>`;
  if (!stretch || !path) return html`<section class="section"><div class="actions">${here}</div></section>`;
  const list = stretchesOf(path);
  const own = list[stretch.index];
  if (stretch.index === 0)
    return html`<section class="section">
      <header><h3>${capital(own.style)}</h3><span>from the start</span></header>
      <div class="actions">${here}</div>
    </section>`;
  const before = list[stretch.index - 1];
  const { story } = desk;
  const from = desk.timeAt(path.id, own.at);
  const blend = story?.blends
    .filter((b) => story.styles[b.from] === before.style && story.styles[b.to] === own.style)
    .sort((a, b) => Math.abs(a.start / 60 - from) - Math.abs(b.start / 60 - from))[0];
  const { adaptive } = desk.options;
  return html`<section class="section">
    <header><h3>Blend: ${before.style} to ${own.style}</h3></header>
    <div class="row"><span>Starts at</span><div class="fields">${numberField(
      e,
      "Start of the change",
      "",
      (blend ? blend.start / 60 : from).toFixed(2),
      "s",
      (v) => {
        const to = desk.placeAt(v);
        if (to && to.path === stretch.path) desk.moveChange(stretch, to.at);
      },
    )}</div></div>
    <div class="row"><span>Length</span><div class="segments" role="group" aria-label="Blend length"><button aria-pressed=${adaptive} @click=${() => desk.toggle({ adaptive: true })}>Adaptive</button><button aria-pressed=${!adaptive} @click=${() => desk.toggle({ adaptive: false })}>${FIXED_BLEND} s</button></div></div>
    ${blend ? html`<p class="note">${(blend.frames / 60).toFixed(2)} s${adaptive ? `: the ${EFFECTOR_WORDS[EFFECTOR_NAMES[blend.length.effector]]} has ${blend.length.gap.toFixed(2)} m to go` : `, where ${(blend.length.frames / 60).toFixed(2)} s would be gradual`}.</p>` : nothing}
    ${
      blend
        ? unsafeSVG(
            blendLengthsSvg({
              seconds: Array.from(blend.starts, (f) => f / 60),
              steps: (2 * blend.starts.length) / BLEND_STARTS,
              fixed: FIXED_BLEND,
              chosen: (blend.phase * BLEND_STARTS) / blend.starts.length,
              adaptive,
            }),
          )
        : nothing
    }
    <div class="actions">${here}<button class="plain danger" @click=${() => desk.removeChange(stretch)}>Remove</button></div>
  </section>`;
}

function paths(e: Editor, desk: PathDesk): TemplateResult {
  const { scene } = e.store.getState();
  const { story } = desk;
  return html`<section class="section">
    <header><h3>${scene.paths.length === 1 ? "Path" : "Paths"}</h3><span>${story ? `${story.length.toFixed(1)} m, hips within ${(100 * story.offset).toFixed(1)} cm` : ""}</span></header>
    ${scene.paths.map((p, i) => {
      const painted = stretchesOf(p);
      return html`<div class="path" role="group" aria-label="Path ${i + 1}">
        <div class="path-bar" aria-hidden="true">${painted.map((s, k) => html`<i style=${`flex-grow:${Math.max(0.001, (painted[k + 1]?.at ?? 1) - s.at)};background:${desk.look(s.style).colour}`}></i>`)}</div>
        <div class="actions">
          <button class="plain" aria-pressed=${p.smooth} @click=${() => e.edit((s, c) => c.smoothPath(s, p.id, !p.smooth))}>${p.smooth ? "Smooth" : "Straight lines"}</button>
          <button class="plain" @click=${() => e.edit((s, c) => c.reversePath(s, p.id))}>Reverse</button>
          <button class="plain danger" @click=${() => {
            e.scene.select([ref("path", p.id)]);
            e.scene.remove();
          }}>Delete path</button>
        </div>
      </div>`;
    })}
  </section>`;
}

const REFINEMENTS: readonly [keyof PathOptions, string, string][] = [
  ["feet", "Plant the feet", "Each foot keeps one place while it rests"],
  ["stride", "Shorten stride in bends", "Down to half, 1 % per 0.2° of turn in 0.1 m"],
  ["lean", "Lean into turns", "Against the centripetal force"],
  ["displacement", "Keep the sway", "The hips sway about the path as in the sample"],
  ["balance", "Keep balance", "The hips move by centimetres to bring the weight over the feet"],
];

function refinements(desk: PathDesk): TemplateResult {
  const { options } = desk;
  return html`<section class="section">
    <header><h3>Refinements</h3></header>
    ${REFINEMENTS.map(
      ([key, label, why]) =>
        html`<div class="switch-row"><span title=${why}>${label}</span><button class="switch" role="switch" aria-checked=${options[key]} aria-label=${label} @click=${() => desk.toggle({ [key]: !options[key] })}></button></div>`,
    )}
  </section>`;
}
