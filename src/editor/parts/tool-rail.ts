/** Tools at the viewport's left: what the features registered, the choices of the one at hand, then snap. */

import { html, nothing, type TemplateResult } from "lit";
import type { Editor } from "../editor.ts";
import { ICONS } from "../icons.ts";
import type { Tool } from "../tools/tool.ts";
import { exportSwitches } from "./export-switches.ts";
import { openHelp } from "./help-sheet.ts";
import { menuRows } from "./menu-rows.ts";
import { legendRows } from "./overlay.ts";
import { speeds } from "./timeline.ts";

/** Tools that narrow windows keep under "More": labels, and those that stand between the tens. */
const second = (t: Tool): boolean => t.order >= 50 || t.order % 10 !== 0;

export function toolRail(e: Editor): TemplateResult {
  const s = e.store.getState();
  const { current } = e.tools;
  return html`<div class="rail" role="toolbar" aria-orientation="vertical" aria-label="Tools">
    ${e.tools.all.map(
      (t) =>
        html`<button aria-label=${t.label} data-tip=${t === current && t.choices ? nothing : `${t.label}  ${t.key}`} aria-pressed=${t === current} class=${second(t) ? "wide" : ""} @click=${() => e.tools.use(t === current ? "select" : t.id)}>${t.icon}<span class="word">${t.label}</span></button>`,
    )}
    <button class="narrow" aria-label="More" aria-haspopup="dialog" aria-expanded=${s.menu === "more"} @click=${() => e.setMenu("more")}>${ICONS.more}<span class="word">More</span></button>
    <hr />
    <button class="wide" aria-label="Snap to 5 cm and 15°" data-tip="Snap to 5 cm and 15°  X" aria-pressed=${s.snap} @click=${() => e.set({ snap: !s.snap })}>${ICONS.snap}<span class="word">Snap</span></button>
  </div>
  ${s.menu === "more" ? more(e) : nothing}
  ${
    current.choices
      ? html`<div class="rail choices" role="toolbar" aria-orientation="vertical" aria-label="${current.label}: which">
        ${current.choices.map((c) => html`<button aria-label="Add: ${c.label}" data-tip="Add: ${c.label.toLowerCase()}  ${c.key}" aria-pressed=${c.id === s.choice} @click=${() => e.tools.use(current.id, c.id)}>${c.icon}<span class="word">${c.short ?? c.label}</span></button>`)}
      </div>`
      : nothing
  }`;
}

/** What narrow windows have no room for: files, theme, help, snapping, the legend. */
function more(e: Editor): TemplateResult {
  const s = e.store.getState();
  const act = (label: string, run: () => void): TemplateResult =>
    html`<button @click=${() => {
      e.set({ menu: null });
      run();
    }}>${label}</button>`;
  return html`<div class="menu more" role="dialog" aria-label="More">
    <div class="legend-rows">${legendRows(e)}</div>
    <hr />
    ${e.tools.all.filter(second).map((t) => act(t.label, () => e.tools.use(t.id)))}
    ${act("Fit the view", () => e.frameScene())}
    ${act(s.loop ? "Looping is on: turn it off" : "Play in a loop", () => e.playback.toggleLoop())}
    <div class="export-options"><div class="row"><span>Speed</span>${speeds(e)}</div></div>
    <hr />
    ${act(s.snap ? "Snapping is on: turn it off" : "Snap to 5 cm and 15°", () => e.set({ snap: !s.snap }))}
    ${act(s.theme === "light" ? "Dark theme" : "Light theme", () => e.toggleTheme())}
    ${act("Keys and help", () => openHelp(e))}
    <hr />
    ${exportSwitches(e)}${menuRows(e.registry.exports, (f) => void e.files.save(f))}
  </div>`;
}
