/** The help sheet: every key, with a search field. */
import { html, render } from "lit";
import type { Editor } from "../editor.ts";

export const KEYS: readonly (readonly [string, string])[] = [
  ["Play or pause", "Space"],
  ["Frame back, ahead", ", ."],
  ["Select tool", "V"],
  ["Draw a path", "L"],
  ["Add: write, lift, place", "1 2 3"],
  ["Add: sit, stand, turn", "4 5 6"],
  ["Next, previous task", "Tab, Shift Tab"],
  ["Move the task 5 cm", "arrows"],
  ["... 1 cm, 25 cm", "Alt, Shift"],
  ["Turn by 15°, back", "R, Shift R"],
  ["Duplicate", "Ctrl D"],
  ["Delete", "Delete"],
  ["Undo, redo", "Ctrl Z, Ctrl Y"],
  ["Give a drag up", "Escape"],
  ["Frame the scene", "F"],
  ["Open a scene file", "Ctrl O"],
  ["Save the scene file", "Ctrl S"],
  ["Colours: category, phase", "P"],
  ["This sheet", "?"],
];

let dialog: HTMLDialogElement | null = null;
let search = "";

/** Opens or closes the sheet as the state says. */
export function helpSheet(e: Editor): void {
  const { help } = e.store.getState();
  if (!help && !dialog?.open) return;
  if (!dialog) {
    dialog = document.createElement("dialog");
    dialog.setAttribute("aria-label", "Keys and help");
    dialog.addEventListener("close", () => e.setHelp(false));
    dialog.addEventListener("click", (ev) => {
      if (ev.target === dialog) dialog?.close();
    });
    document.body.append(dialog);
  }
  const sheet = dialog;
  const draw = () => {
    const rows = KEYS.filter(([what, key]) => `${what} ${key}`.toLowerCase().includes(search.toLowerCase()));
    render(
      html`<div class="help">
        <h2>Keys</h2>
        <label class="field" style="margin-top: 10px"><span>Find</span><input type="search" .value=${search} @input=${(
          ev: Event,
        ) => {
          search = (ev.target as HTMLInputElement).value;
          draw();
        }} /></label>
        <dl>${rows.map(([what, key]) => html`<div><dt>${what}</dt><dd class="kbd">${key}</dd></div>`)}</dl>
        <p class="note">Drag a task: the footsteps change as it moves, and the character follows the new plan from the step it is in.</p>
      </div>`,
      sheet,
    );
  };
  draw();
  if (help && !dialog.open) dialog.showModal();
  if (!help && dialog.open) dialog.close();
}
