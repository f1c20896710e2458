/**
 * A number with its unit: typed, stepped with the arrows (Shift 10, Alt 0.1), or scrubbed on its letter. A scrub is one entry
 * of the history; what is not a number is said under the field's name and changes nothing.
 */
import { html, type TemplateResult } from "lit";
import type { Editor } from "../editor.ts";

/** One arrow press, and one pixel of a scrub, in the unit shown. */
const STEPS: Record<string, number> = { "°": 1, s: 0.01, m: 0.01, "": 0.01 };

/** The number of a text, with a comma or a true minus as people write them; NaN for none. */
export function readNumber(text: string): number {
  const plain = text.trim().replace("\u2212", "-").replace(",", ".");
  return plain === "" ? Number.NaN : Number(plain);
}

export function numberField(
  e: Editor,
  label: string,
  axis: string,
  value: string,
  unit: string,
  set: (v: number) => void,
): TemplateResult {
  const step = STEPS[unit] ?? 1;
  const key = (ev: KeyboardEvent): void => {
    const way = ev.key === "ArrowUp" ? 1 : ev.key === "ArrowDown" ? -1 : 0;
    if (!way) return;
    ev.preventDefault();
    const by = way * step * (ev.shiftKey ? 10 : ev.altKey ? 0.1 : 1);
    set(readNumber((ev.target as HTMLInputElement).value) + by);
  };
  const change = (ev: Event): void => {
    const input = ev.target as HTMLInputElement;
    const v = readNumber(input.value);
    e.set({ error: null });
    if (Number.isFinite(v)) set(v);
    else e.fail(`${label}: a number is needed, found ${JSON.stringify(input.value)}.`);
    // What was refused is outlined and stands until it is put right or left.
    const refused = e.store.getState().error !== null;
    input.closest(".field")?.classList.toggle("bad", refused);
    input.setAttribute("aria-invalid", String(refused));
  };
  const scrub = (ev: PointerEvent): void => {
    if (ev.button !== 0) return;
    ev.preventDefault();
    const from = readNumber(value);
    e.tools.run(
      {
        move: (p) =>
          set(from + Math.round(p.event.clientX - ev.clientX) * step * (p.event.shiftKey ? 10 : 1)),
      },
      ev,
    );
  };
  return html`<label class="field"><span class="axis" @pointerdown=${scrub}>${axis}</span><input inputmode="decimal" autocomplete="off" aria-label=${label} .value=${value} @keydown=${key} @change=${change} @blur=${(
    ev: Event,
  ) => {
    const input = ev.target as HTMLInputElement;
    if (input.getAttribute("aria-invalid") !== "true") return;
    input.value = value;
    input.setAttribute("aria-invalid", "false");
    input.closest(".field")?.classList.remove("bad");
  }} @focus=${(ev: Event) => (ev.target as HTMLInputElement).select()} /><span class="unit" @pointerdown=${scrub}>${unit}</span></label>`;
}
