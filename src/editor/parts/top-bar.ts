/** The bar at the top: scene, undo, theme, help, export. */
import { html, nothing, type TemplateResult } from "lit";
import type { Editor } from "../editor.ts";
import { ICONS } from "../icons.ts";

/** Rows of a menu, a line between its hundreds. */
function grouped<T extends { label: string; order: number; shortcut?: string }>(
  entries: readonly T[],
  run: (entry: T) => void,
): TemplateResult[] {
  return entries.map(
    (x, i) =>
      html`${i > 0 && Math.floor(x.order / 100) !== Math.floor(entries[i - 1].order / 100) ? html`<hr />` : nothing}<button role="menuitem" @click=${() => run(x)}>${x.label}${x.shortcut ? html` <span class="kbd">${x.shortcut}</span>` : nothing}</button>`,
  );
}

export function topBar(e: Editor): TemplateResult {
  const s = e.store.getState();
  return html`
    <span class="mark" aria-hidden="true"></span><strong>Stepwright</strong>
    <button class="scene-name" aria-haspopup="menu" aria-expanded=${s.menu === "scenes"} @click=${() => e.setMenu("scenes")}><span>Scenes</span> ${ICONS.chevron}</button>
    ${
      s.menu === "scenes"
        ? html`<div class="menu" role="menu" style="left: 130px">${grouped(
            e.registry.menu.filter((m) => m.menu === "scenes" && m.shown?.(e) !== false),
            (m) => m.run(e),
          )}</div>`
        : nothing
    }
    <span class="quiet" role="status">${s.saved === "saved" ? "Saved" : s.saved === "saving" ? "Saving" : "Not kept: this browser's storage is closed"}</span>
    <span class="space"></span>
    <button class="icon" aria-label="Undo" title="Undo (Ctrl Z)" ?disabled=${!s.canUndo} @click=${() => e.scene.undo()}>${ICONS.undo}</button>
    <button class="icon" aria-label="Redo" title="Redo (Ctrl Y)" ?disabled=${!s.canRedo} @click=${() => e.scene.redo()}>${ICONS.redo}</button>
    <span class="separator"></span>
    <button class="icon" aria-label=${s.theme === "light" ? "Dark theme" : "Light theme"} @click=${() => e.toggleTheme()}>${s.theme === "light" ? ICONS.dark : ICONS.light}</button>
    <button class="icon" aria-label="Keys and help" title="Keys and help (?)" @click=${() => e.set({ help: true })}>${ICONS.help}</button>
    <span class="separator"></span>
    <button class="button primary" aria-haspopup="menu" aria-expanded=${s.menu === "export"} @click=${() => e.setMenu("export")}>Export</button>
    ${
      s.menu === "export"
        ? html`<div class="menu" role="menu" style="right: 12px">${grouped(e.registry.exports, (f) => void e.files.save(f))}</div>`
        : nothing
    }
  `;
}
