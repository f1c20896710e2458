/** What floats over the viewport: figures, legend, toast, loading. */
import { html, nothing, type TemplateResult } from "lit";
import { STEP_CATEGORIES } from "../../core/steps/types.ts";
import { CATEGORY_COLOURS, CATEGORY_WORDS } from "../../view/tokens.ts";
import type { Editor } from "../editor.ts";

const mm = (v: number | null | undefined): string =>
  v === null || v === undefined ? "–" : `${v.toFixed(1)} mm`;

export function overlayChips(e: Editor): TemplateResult {
  const s = e.store.getState();
  const q = s.quality;
  return html`
    ${q ? html`<div class="chip quality" title="Skate: how far a planted foot slides. Reach: how far hand, box or seat is from its target. Balance: time with the zero-moment point within 5 cm of the feet."><span>Skate <b>${mm(q.skate)}</b></span><span>Reach <b>${mm(q.reach)}</b></span><span class="wide">Balance <b>${q.balanceWithin50mm === null ? "–" : `${Math.round(100 * q.balanceWithin50mm)} %`}</b></span></div>` : nothing}
    ${
      s.colouring === "category"
        ? html`<div class="chip legend">${STEP_CATEGORIES.map((c) => html`<span><i class="swatch" style="background: ${CATEGORY_COLOURS[c].fill}"></i>${CATEGORY_WORDS[c]}</span>`)}</div>`
        : html`<div class="chip legend"><span><i class="swatch" style="background: #474d55"></i>Exit</span><span><i class="swatch" style="background: #a3a8ae"></i>Locomotion</span><span><i class="swatch" style="background: #16191d"></i>Enter</span></div>`
    }
    ${s.status ? html`<div class="chip loading" role="status">${s.status}</div>` : nothing}
    ${s.toast ? html`<div class="toast" role="status">${s.toast.text} ${s.toast.undo ? html`<button @click=${() => e.scene.undo()}>Undo</button>` : nothing}</div>` : nothing}
  `;
}
