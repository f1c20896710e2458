/** The panel at the side: the tabs that features registered, those that have something to show. */
import { html, nothing, type TemplateResult } from "lit";
import { crowdAlone } from "../crowd/crowd-session.ts";
import type { Editor } from "../editor.ts";

const took = (ms: number): string => (ms < 1000 ? `${ms.toFixed(1)} ms` : `${(ms / 1000).toFixed(2)} s`);

export function panel(e: Editor): TemplateResult {
  const s = e.store.getState();
  const tabs = e.registry.tabs.filter((t) => t.shown(e));
  const alone = crowdAlone(s.scene);
  const tab = tabs.find((t) => t.id === s.tab) ?? tabs[0];
  return html`
    <div class="tabs" role="tablist">
      ${tabs.map((t) => html`<button role="tab" aria-selected=${t === tab} @click=${() => e.set({ tab: t.id })}>${t.label(e)}</button>`)}
    </div>
    <div class="body" role="tabpanel" tabindex="-1" aria-label=${tab.label(e)}>${tab.draw(e)}</div>
    ${alone ? nothing : html`<footer><span>${s.plan ? `Planned in ${took(s.planMs)}` : (s.status ?? "")}</span><span>${s.plan ? `${s.plan.steps.length} footsteps` : ""}</span></footer>`}
  `;
}
