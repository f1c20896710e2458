/** What floats over the viewport: figures, legend, toast, loading. */
import { html, nothing, type TemplateResult } from "lit";
import { STEP_CATEGORIES, type StepCategory } from "../../core/steps/types.ts";
import { CATEGORY_WORDS } from "../../view/tokens.ts";
import { crowdAlone, crowdSession } from "../crowd/crowd-session.ts";
import type { Editor } from "../editor.ts";
import { ICONS } from "../icons.ts";
import { sole } from "./sole.ts";

const mm = (v: number | null | undefined): string =>
  v === null || v === undefined ? "–" : `${v.toFixed(1)} mm`;

const PHASES: [string, string][] = [
  ["#474d55", "Exit"],
  ["#a3a8ae", "Locomotion"],
  ["#16191d", "Enter"],
];

/** What the colours of the footprints mean. */
export function legendRows(e: Editor): TemplateResult[] {
  return e.store.getState().colouring === "phase"
    ? PHASES.map(([fill, word]) => html`<span>${sole("Walk", "right", fill)}${word}</span>`)
    : STEP_CATEGORIES.map((c: StepCategory) => html`<span>${sole(c)}${CATEGORY_WORDS[c]}</span>`);
}

/** How the motion is, in figures. */
function qualityChip(e: Editor): TemplateResult | typeof nothing {
  const s = e.store.getState();
  const q = s.quality;
  if (crowdAlone(s.scene)) {
    const { agents, left } = crowdSession(e);
    return html`<div class="chip quality" title="Walkers of the crowd, and those who have not arrived."><span>Walkers <b>${agents}</b></span><span>On their way <b>${left}</b></span></div>`;
  }
  // A character that only stands has nothing to be judged by.
  return q && s.plan && s.plan.steps.length > 0
    ? html`<div class="chip quality" title="Skate: how far a planted foot slides. Reach: how far hand, box or seat is from its target. Balance: time with the zero-moment point within 5 cm of the feet."><span>Skate <b>${mm(q.skate)}</b></span>${q.reach === null ? nothing : html`<span>Reach <b>${mm(q.reach)}</b></span>`}<span class="wide">Balance <b>${q.balanceWithin50mm === null ? "–" : `${Math.round(100 * q.balanceWithin50mm)} %`}</b></span><span class="narrow">${s.plan.steps.length} footsteps</span></div>`
    : nothing;
}

export function overlayChips(e: Editor): TemplateResult {
  const s = e.store.getState();
  return html`
    ${qualityChip(e)}
    ${crowdAlone(s.scene) ? nothing : html`<div class="chip legend">${legendRows(e)}</div>`}
    ${s.status ? html`<div class="chip loading" role="status">${s.status}</div>` : nothing}
    ${
      s.progress
        ? html`<div class="progress" role="group" aria-label=${s.progress.name}><div><b>${s.progress.name}</b><span>${s.progress.fact}</span></div><progress max="1" value=${s.progress.share} aria-label=${s.progress.name}></progress><button class="plain" @click=${() => e.work.cancel()}>Cancel</button></div>`
        : nothing
    }
    ${
      s.toast
        ? html`<div class="toast" role="status" @pointerenter=${() => e.holdToast(true)} @pointerleave=${() => e.holdToast(false)} @focusin=${() => e.holdToast(true)} @focusout=${() => e.holdToast(false)}>
          ${s.toast.warns ? ICONS.warning : ICONS.tick}<span>${s.toast.text}</span>
          ${s.toast.undo ? html`<button class="undo" @click=${() => e.scene.undo()}>Undo</button>` : html`<button class="shut" aria-label="Close" @click=${() => e.set({ toast: null })}>${ICONS.close}</button>`}
        </div>`
        : nothing
    }
  `;
}
