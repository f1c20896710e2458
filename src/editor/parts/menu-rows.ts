/** Rows of a menu, a line between its hundreds; arrows walk them. */
import { html, nothing, type TemplateResult } from "lit";

export function menuRows<T extends { label: string; order: number; shortcut?: string }>(
  entries: readonly T[],
  run: (entry: T) => void,
): TemplateResult {
  return html`<div role="menu" class="rows" @keydown=${walk}>${entries.map((x, i) => {
    const before = entries[i - 1];
    const line = before && Math.floor(x.order / 100) !== Math.floor(before.order / 100);
    return html`${line ? html`<hr />` : nothing}<button role="menuitem" @click=${() => run(x)}>${x.label}${x.shortcut ? html` <span class="kbd">${x.shortcut}</span>` : nothing}</button>`;
  })}</div>`;
}

/** Up and down go from row to row, Home and End to the ends. */
function walk(ev: KeyboardEvent): void {
  const rows = [...(ev.currentTarget as HTMLElement).querySelectorAll<HTMLElement>("[role=menuitem]")];
  const at = rows.indexOf(document.activeElement as HTMLElement);
  const to = { ArrowDown: at + 1, ArrowUp: at - 1, Home: 0, End: rows.length - 1 }[ev.key];
  if (to === undefined) return;
  ev.preventDefault();
  rows[(to + rows.length) % rows.length]?.focus();
}
