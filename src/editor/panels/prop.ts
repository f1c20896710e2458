/** The furniture chosen: where, which way, how large. */
import { html, type TemplateResult } from "lit";
import type { SceneProp } from "../../core/scene/types.ts";
import type { Editor } from "../editor.ts";
import { ICONS } from "../icons.ts";
import { numberField } from "../parts/number-field.ts";
import { onlyId } from "../selection.ts";
import { PROP_WORDS } from "../things/props.ts";
import type { PanelTab } from "./panel-tab.ts";

function chosen(e: Editor): SceneProp | null {
  const s = e.store.getState();
  const id = onlyId(s.selection, "prop");
  return s.scene.props.find((p) => p.id === id) ?? null;
}

const text = (v: number, digits = 2): string => v.toFixed(digits).replace("-", "\u2212");
const with3 = (v: readonly [number, number, number], k: number, to: number): [number, number, number] => {
  const out: [number, number, number] = [v[0], v[1], v[2]];
  out[k] = to;
  return out;
};

function triple(
  e: Editor,
  p: SceneProp,
  label: string,
  field: "position" | "size",
  names: readonly [string, string, string],
): TemplateResult {
  return html`<div class="row"><span>${label}</span><div class="fields">${names.map((axis, k) =>
    numberField(e, `${label} ${axis}`, axis, text(p[field][k]), "m", (v) =>
      e.edit((scene, c) => c.changeProp(scene, p.id, { [field]: with3(p[field], k, v) })),
    ),
  )}</div></div>`;
}

export const propTab: PanelTab = {
  id: "prop",
  order: 30,
  label: (e) => PROP_WORDS[chosen(e)?.kind ?? "table"],
  shown: (e) => chosen(e) !== null,
  draw(e) {
    const p = chosen(e);
    if (!p) return html``;
    return html`<section class="section">
      <div class="subject"><span class="glyph">${ICONS.prop}</span><div><h2>${PROP_WORDS[p.kind]}</h2><span class="note">Tasks find the furniture under them by its place.</span></div></div>
      ${triple(e, p, "Position", "position", ["x", "y", "z"])}
      <div class="row"><span>Facing</span>${numberField(e, "Facing", "", text((p.yaw * 180) / Math.PI, 1), "°", (v) => e.edit((scene, c) => c.changeProp(scene, p.id, { yaw: (v * Math.PI) / 180 })))}</div>
      ${triple(e, p, "Size", "size", ["w", "h", "d"])}
      <div class="actions"><button class="plain" @click=${() => e.scene.duplicate()}>Duplicate</button><button class="plain danger" @click=${() => e.scene.remove()}>Delete</button></div>
    </section>`;
  },
};
