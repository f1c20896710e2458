/** How motions are exported: frames a second, and whether the character travels. */
import { html, type TemplateResult } from "lit";
import { EXPORT_RATES } from "../../core/motion/export-clip.ts";
import type { Editor } from "../editor.ts";
import { exportOptions } from "../formats/motion.ts";

export function exportSwitches(e: Editor): TemplateResult {
  const set = (change: Partial<typeof exportOptions>): void => {
    Object.assign(exportOptions, change);
    e.redraw();
  };
  return html`<div class="export-options">
    <label class="row"><span>Rate</span><span class="field"><select aria-label="Frames a second" @change=${(ev: Event) => set({ rate: Number((ev.target as HTMLSelectElement).value) })}>${EXPORT_RATES.map((r) => html`<option value=${r} ?selected=${r === exportOptions.rate}>${r} Hz</option>`)}</select></span></label>
    <div class="row"><span>Hips</span><div class="segments" role="group" aria-label="Hips">
      <button aria-pressed=${!exportOptions.inPlace} @click=${() => set({ inPlace: false })}>Travel</button>
      <button aria-pressed=${exportOptions.inPlace} @click=${() => set({ inPlace: true })}>In place</button>
    </div></div>
  </div><hr />`;
}
