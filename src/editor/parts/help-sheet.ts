/** The help sheet: every key of the page, read from the list that the page obeys, with a search field. */
import { html, nothing, render } from "lit";
import type { Editor } from "../editor.ts";
import { ICONS } from "../icons.ts";
import { allKeys } from "../keys.ts";

const GROUPS = ["Tools", "Selected", "Time", "Scene", "Labels"] as const;

let dialog: HTMLDialogElement | null = null;
let search = "";

/** Opens the sheet; Escape, its button and a click beside it close it. */
export function openHelp(e: Editor): void {
  if (!dialog) {
    dialog = document.createElement("dialog");
    dialog.setAttribute("aria-label", "Keys and help");
    dialog.addEventListener("click", (ev) => {
      if (ev.target === dialog) dialog?.close();
    });
    document.body.append(dialog);
  }
  const sheet = dialog;
  const draw = () => {
    const rows = allKeys(e)
      .filter((b) => b.label !== "")
      .map((b) => ({ ...b, text: b.shown ?? b.keys.map((k) => k.replaceAll("+", " ")).join(", ") }))
      .filter((b) => b.text !== "")
      .filter((b) => `${b.label} ${b.text}`.toLowerCase().includes(search.toLowerCase()));
    render(
      html`<div class="help">
        <div class="head"><h2>Help</h2><label class="field"><input type="search" aria-label="Search keys and tools" placeholder="Search keys and tools" .value=${search} @input=${(
          ev: Event,
        ) => {
          search = (ev.target as HTMLInputElement).value;
          draw();
        }} /></label><button class="icon" aria-label="Close" @click=${() => sheet.close()}>${ICONS.close}</button></div>
        <div class="groups">${GROUPS.map((group) => {
          const mine = rows.filter((r) => r.group === group);
          return mine.length === 0
            ? nothing
            : html`<section><h3>${group}</h3><dl>${mine.map((r) => html`<div><dt>${r.label}</dt><dd>${r.text.split(", ").map((k) => html`<span class="kbd">${k}</span>`)}</dd></div>`)}</dl></section>`;
        })}</div>
        <p class="note">Drag a task: the footsteps change as it moves, and the character follows the new plan from the step it is in. The <a href="./lessons/index.html">lessons</a> explain how; the <a href="./studio.html">studio</a> shows how a walk is made.</p>
      </div>`,
      sheet,
    );
  };
  draw();
  if (!sheet.open) sheet.showModal();
}
