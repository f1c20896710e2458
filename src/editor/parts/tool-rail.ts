/** Tools at the viewport's left: what the features registered, the choices of the one at hand, then snap. */
import { html, nothing, type TemplateResult } from "lit";
import type { Editor } from "../editor.ts";
import { ICONS } from "../icons.ts";

export function toolRail(e: Editor): TemplateResult {
  const s = e.store.getState();
  const { current } = e.tools;
  return html`<div class="rail" role="toolbar" aria-orientation="vertical" aria-label="Tools">
    ${e.tools.all.map(
      (t) =>
        html`<button aria-label=${t.label} data-tip="${t.label}  ${t.key}" aria-pressed=${t === current} @click=${() => e.tools.use(t === current ? "select" : t.id)}>${t.icon}<span class="word">${t.label}</span></button>`,
    )}
    <hr />
    <button aria-label="Snap to 5 cm and 15°" data-tip="Snap to 5 cm and 15°  X" aria-pressed=${s.snap} @click=${() => e.set({ snap: !s.snap })}>${ICONS.snap}<span class="word">Snap</span></button>
  </div>
  ${
    current.choices
      ? html`<div class="rail choices" role="toolbar" aria-orientation="vertical" aria-label="${current.label}: which">
        ${current.choices.map((c) => html`<button aria-label="Add: ${c.label}" data-tip="Add: ${c.label.toLowerCase()}  ${c.key}" aria-pressed=${c.id === s.choice} @click=${() => e.tools.use(current.id, c.id)}>${c.icon}</button>`)}
      </div>`
      : nothing
  }`;
}
