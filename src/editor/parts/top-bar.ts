/** The bar at the top: the scene's name with its menu, what is kept, undo, theme, help, Export and Share. */

import { html, nothing, type TemplateResult } from "lit";
import type { Editor } from "../editor.ts";
import { ICONS } from "../icons.ts";
import { exportSwitches } from "./export-switches.ts";
import { openHelp } from "./help-sheet.ts";
import { menuRows } from "./menu-rows.ts";
import { openSceneMenu, sceneMenu } from "./scene-menu.ts";

const SAVED = {
  saved: "Saved",
  saving: "Saving",
  off: "Not kept: this browser's storage is closed",
} as const;

export function topBar(e: Editor): TemplateResult {
  const s = e.store.getState();
  const light = s.theme === "light";
  return html`
    <span class="mark" aria-hidden="true"></span><strong>Stepwright</strong>
    <button class="scene-name" aria-haspopup="dialog" aria-expanded=${s.menu === "scenes"} @click=${() => void openSceneMenu(e)}><span>${s.name}</span> ${ICONS.chevron}</button>
    ${s.menu === "scenes" ? sceneMenu(e) : nothing}
    <span class="quiet" role="status">${SAVED[s.saved]}</span>
    <span class="space"></span>
    <button class="icon" aria-label="Undo" title="Undo (Ctrl Z)" ?disabled=${!s.canUndo} @click=${() => e.scene.undo()}>${ICONS.undo}</button>
    <button class="icon" aria-label="Redo" title="Redo (Ctrl Y)" ?disabled=${!s.canRedo} @click=${() => e.scene.redo()}>${ICONS.redo}</button>
    <span class="separator wide"></span>
    <button class="icon wide" aria-label=${light ? "Dark theme" : "Light theme"} title=${light ? "Dark theme" : "Light theme"} @click=${() => e.toggleTheme()}>${light ? ICONS.light : ICONS.dark}</button>
    <button class="icon wide" aria-label="Keys and help" title="Keys and help (?)" @click=${() => openHelp(e)}>${ICONS.help}</button>
    <span class="separator"></span>
    <button class="button wide" aria-haspopup="dialog" aria-expanded=${s.menu === "export"} @click=${() => e.setMenu("export")}>Export</button>
    ${
      s.menu === "export"
        ? html`<div class="menu export" role="dialog" aria-label="Export">${exportSwitches(e)}${menuRows(e.registry.exports, (f) => void e.files.save(f))}</div>`
        : nothing
    }
    <button class="button primary" @click=${() => void e.files.share()}>${ICONS.share}Share</button>
  `;
}
