/** The panel's paths: the styles painted along each, changed, added at the playhead, taken away. */
import { html, nothing, type TemplateResult } from "lit";
import type { ScenePath } from "../../core/scene/types.ts";
import { STYLES } from "../../studio/styles.ts";
import { styleColour } from "../../view/tokens.ts";
import type { Editor } from "../editor.ts";
import { ref } from "../selection.ts";

const PLAIN = "walking";

/** The styles of a path from its start on. */
function spansOf(path: ScenePath): { at: number; style: string }[] {
  return path.styles.length > 0 && path.styles[0].at <= 0
    ? path.styles
    : [{ at: 0, style: PLAIN }, ...path.styles];
}

export function pathSection(e: Editor): TemplateResult | typeof nothing {
  const { scene } = e.store.getState();
  if (scene.paths.length === 0) return nothing;
  return html`<section class="section">
    <header><h3>Paths</h3><span>${scene.paths.length}</span></header>
    ${scene.paths.map((path, i) => {
      const spans = spansOf(path);
      const paint = (styles: { at: number; style: string }[]) =>
        e.edit((s, c) => c.paintPath(s, path.id, styles));
      return html`<div class="path">
        <div class="path-bar" aria-hidden="true">
          ${spans.map(
            (s, k) =>
              html`<i style=${`flex-grow:${Math.max(0.001, (spans[k + 1]?.at ?? 1) - s.at)};background:${styleColour(s.style)}`}></i>`,
          )}
        </div>
        ${spans.map(
          (s, k) => html`<div class="row">
            <label>From ${Math.round(100 * s.at)} %
              <select aria-label=${`Path ${i + 1}, style from ${Math.round(100 * s.at)} %`} @change=${(
                ev: Event,
              ) => {
                const style = (ev.target as HTMLSelectElement).value;
                paint(spans.map((x, n) => (n === k ? { at: x.at, style } : x)));
              }}>
                ${STYLES.map((name) => html`<option value=${name} ?selected=${name === s.style}>${name}</option>`)}
              </select>
            </label>
            ${
              k > 0
                ? html`<button class="quiet" aria-label=${`Remove the change at ${Math.round(100 * s.at)} %`} @click=${() => paint(spans.filter((_, n) => n !== k))}>Remove</button>`
                : nothing
            }
          </div>`,
        )}
        <div class="row">
          <button @click=${() => {
            const at = e.plan.shareOfWay();
            const now = [...spans].reverse().find((x) => x.at <= at)?.style ?? PLAIN;
            const next = STYLES[(STYLES.indexOf(now as (typeof STYLES)[number]) + 1) % STYLES.length];
            paint([...spans, { at: Math.max(0.02, Math.min(0.98, at)), style: next }]);
          }}>Change style here</button>
          <button @click=${() => {
            e.scene.select([ref("path", path.id)]);
            e.scene.remove();
          }}>Delete path</button>
        </div>
      </div>`;
    })}
    <p class="note">A change begins at the playhead. Tasks wait while there is a path.</p>
  </section>`;
}
