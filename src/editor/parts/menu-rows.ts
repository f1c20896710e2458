/** Rows of a menu, a line between its hundreds. */
import { html, nothing, type TemplateResult } from "lit";

export function menuRows<T extends { label: string; order: number; shortcut?: string }>(
  entries: readonly T[],
  run: (entry: T) => void,
): TemplateResult[] {
  return entries.map((x, i) => {
    const before = entries[i - 1];
    const line = before && Math.floor(x.order / 100) !== Math.floor(before.order / 100);
    return html`${line ? html`<hr />` : nothing}<button role="menuitem" @click=${() => run(x)}>${x.label}${x.shortcut ? html` <span class="kbd">${x.shortcut}</span>` : nothing}</button>`;
  });
}
