/** A number that is typed, stepped with the arrows (Shift 10, Alt 0.1) or scrubbed on its letter. */
import { html, type TemplateResult } from "lit";
import type { Editor } from "../editor.ts";

export function numberField(
  e: Editor,
  label: string,
  axis: string,
  value: string,
  unit: string,
  set: (v: number) => void,
): TemplateResult {
  return html`<label class="field"><span>${axis}</span><input inputmode="decimal" aria-label=${label} .value=${value} @keydown=${(
    ev: KeyboardEvent,
  ) => {
    const step = ev.key === "ArrowUp" ? 1 : ev.key === "ArrowDown" ? -1 : 0;
    if (!step) return;
    ev.preventDefault();
    const input = ev.target as HTMLInputElement;
    set(
      Number(input.value.replace("\u2212", "-")) +
        step * (ev.shiftKey ? 10 : ev.altKey ? 0.1 : 1) * (unit === "°" ? 1 : 0.01),
    );
  }} @change=${(ev: Event) => {
    const v = Number((ev.target as HTMLInputElement).value.replace("\u2212", "-").replace(",", "."));
    if (Number.isFinite(v)) set(v);
    else
      e.fail(`${label}: a number is needed, found ${JSON.stringify((ev.target as HTMLInputElement).value)}.`);
  }} /><span>${unit}</span></label>`;
}
