/** The character from a file: which of its bones are which, to be put right where names do not say. */
import { html, nothing, type TemplateResult } from "lit";
import { JOINT_NAMES, type JointName } from "../../core/skeleton/joints.ts";
import type { Editor } from "../editor.ts";
import { ICONS } from "../icons.ts";
import type { PanelTab } from "./panel-tab.ts";

/** "leftUpperLeg" as people say it. */
const words = (joint: JointName): string => {
  const spaced = joint.replace(/([A-Z])/g, " $1").toLowerCase();
  return spaced.charAt(0).toUpperCase() + spaced.slice(1);
};

export const characterTab: PanelTab = {
  id: "character",
  order: 45,
  label: () => "Character",
  shown: (e) => e.guest.loaded !== null,
  draw: (e) => draw(e),
};

function draw(e: Editor): TemplateResult {
  const { loaded } = e.guest;
  if (!loaded) return html``;
  const found = JOINT_NAMES.filter((j) => loaded.map.has(j)).length;
  return html`<section class="section">
      <div class="subject"><span class="glyph">${ICONS.select}</span><div><h2>${loaded.name}</h2><span class="note">${found} of ${JOINT_NAMES.length} joints found${loaded.sure ? ", as the file says" : " by name"}</span></div></div>
      ${loaded.missing.length > 0 ? html`<p class="error">Not found: ${loaded.missing.map(words).join(", ")}. Say below which bones they are.</p>` : nothing}
      <div class="actions"><button class="button" @click=${() => e.guest.takeOff()}>Use the plain character</button></div>
    </section>
    <section class="section">
      <header><h3>Bones</h3><span>${loaded.bones.length} in the file</span></header>
      ${JOINT_NAMES.map((joint) => {
        const bone = loaded.map.get(joint)?.name ?? "";
        return html`<label class="row"><span>${words(joint)}</span><span class="field"><select aria-label=${words(joint)} @change=${(ev: Event) => void e.guest.choose(joint, (ev.target as HTMLSelectElement).value)}>
          <option value="" ?selected=${bone === ""}>None</option>
          ${loaded.bones.map((b) => html`<option value=${b} ?selected=${b === bone}>${b}</option>`)}
        </select></span></label>`;
      })}
    </section>`;
}
