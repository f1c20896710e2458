/** The bar at the top: scene, undo, theme, help, export. */
import { html, nothing, type TemplateResult } from "lit";
import type { Editor } from "../editor.ts";
import { ICONS } from "../icons.ts";

export function topBar(e: Editor): TemplateResult {
  const s = e.store.getState();
  return html`
    <span class="mark" aria-hidden="true"></span><strong>Stepwright</strong>
    <button class="scene-name" aria-haspopup="menu" aria-expanded=${s.menu === "scenes"} @click=${() => e.setMenu("scenes")}><span>Scenes</span> ${ICONS.chevron}</button>
    ${
      s.menu === "scenes"
        ? html`<div class="menu" role="menu" style="left: 130px">
          ${e.examples.map((x) => html`<button role="menuitem" @click=${() => e.openExample(x)}>${x.name}</button>`)}
          <hr />
          <button role="menuitem" @click=${() => e.newScene()}>New, empty room</button>
          <button role="menuitem" @click=${() => e.openFile()}>Open a scene file <span class="kbd">Ctrl O</span></button>
        </div>`
        : nothing
    }
    <span class="quiet" role="status">${s.saved === "saved" ? "Saved" : s.saved === "saving" ? "Saving" : "Not kept: this browser's storage is closed"}</span>
    <span class="space"></span>
    <button class="icon" aria-label="Undo" title="Undo (Ctrl Z)" ?disabled=${!s.canUndo} @click=${() => e.undo()}>${ICONS.undo}</button>
    <button class="icon" aria-label="Redo" title="Redo (Ctrl Y)" ?disabled=${!s.canRedo} @click=${() => e.redo()}>${ICONS.redo}</button>
    <span class="separator"></span>
    <button class="icon" aria-label=${s.theme === "light" ? "Dark theme" : "Light theme"} @click=${() => e.toggleTheme()}>${s.theme === "light" ? ICONS.dark : ICONS.light}</button>
    <button class="icon" aria-label="Keys and help" title="Keys and help (?)" @click=${() => e.setHelp(true)}>${ICONS.help}</button>
    <span class="separator"></span>
    <button class="button primary" aria-haspopup="menu" aria-expanded=${s.menu === "export"} @click=${() => e.setMenu("export")}>Export</button>
    ${
      s.menu === "export"
        ? html`<div class="menu" role="menu" style="right: 12px">
          <button role="menuitem" @click=${() => e.exportBvh()}>Motion, BVH at 60 Hz</button>
          <button role="menuitem" @click=${() => e.exportResult()}>Footsteps, contacts, figures (JSON)</button>
          <button role="menuitem" @click=${() => e.exportScene()}>Scene (JSON) <span class="kbd">Ctrl S</span></button>
          <button role="menuitem" @click=${() => e.exportPicture()}>Picture of the room (PNG)</button>
        </div>`
        : nothing
    }
  `;
}
