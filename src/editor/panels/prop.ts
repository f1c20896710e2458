/** The furniture chosen: where, which way, how large. */
import { html } from "lit";
import type { SceneProp } from "../../core/scene/types.ts";
import type { Editor } from "../editor.ts";
import { ICONS } from "../icons.ts";
import { schemaRows } from "../parts/schema-rows.ts";
import { onlyId } from "../selection.ts";
import { PROP_WORDS } from "../things/props.ts";
import type { PanelTab } from "./panel-tab.ts";

function chosen(e: Editor): SceneProp | null {
  const s = e.store.getState();
  const id = onlyId(s.selection, "prop");
  return s.scene.props.find((p) => p.id === id) ?? null;
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
      <div class="subject"><span class="glyph">${ICONS[p.kind]}</span><div><h2>${PROP_WORDS[p.kind]}</h2><span class="note">Tasks find the furniture under them by its place.</span></div></div>
      ${schemaRows(e, "prop", {
        values: { ...p },
        set: (key, value) => void e.edit((scene, c) => c.changeProp(scene, p.id, { [key]: value })),
      })}
      <div class="actions"><button class="plain" @click=${() => e.scene.duplicate()}>Duplicate</button><button class="plain danger" @click=${() => e.scene.remove()}>Delete</button></div>
    </section>`;
  },
};
