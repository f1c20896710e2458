/** What a figure gets: its box, the page's parameters, and a way to fill the numbers in the text. */
import { el } from "../../embed/dom.ts";
import { fixed } from "./numbers.ts";
import type { ParameterSpec, Parameters } from "./parameters.ts";

export interface FigureContext {
  /** The figure's own element, `<figure data-figure="name">`; its drawing goes into `box`. */
  figure: HTMLElement;
  box: HTMLElement;
  parameters: Parameters;
}

export type MountFigure = (context: FigureContext) => void | Promise<void>;

/** Writes numbers into the formulas and sentences that name them with `data-value`. */
export function fillValues(values: Record<string, string>): void {
  for (const [name, text] of Object.entries(values))
    for (const place of document.querySelectorAll(`[data-value="${name}"]`))
      if (place.textContent !== text) place.textContent = text;
}

/** Marks a formula's terms while the pointer is over what they stand for. */
export function pointOut(term: string, on: boolean): void {
  for (const place of document.querySelectorAll(`[data-term="${term}"]`))
    place.classList.toggle("pointed", on);
}

/** A row with a name, a slider and a field, all of one parameter. */
export function slider(
  parameters: Parameters,
  spec: ParameterSpec,
  label: string,
  unit = "",
  places = 2,
): HTMLElement {
  parameters.declare(spec);
  const bounds = { min: spec.min, max: spec.max, step: spec.step };
  const range = el("input", { type: "range", ...bounds, "aria-label": label });
  const field = el("input", { type: "text", inputmode: "decimal", "aria-label": `${label}, number` });
  const lock = parameters.locked(spec.name);
  range.disabled = lock;
  field.disabled = lock;
  const show = (): void => {
    const value = parameters.get(spec.name);
    range.value = String(value);
    // The part of the track that is passed is ink.
    range.style.setProperty("--passed", `${(100 * (value - spec.min)) / (spec.max - spec.min)}%`);
    range.setAttribute("aria-valuetext", `${fixed(value, places)} ${unit}`.trim());
    if (document.activeElement !== field) field.value = fixed(value, places);
  };
  range.addEventListener("input", () => parameters.set(spec.name, Number(range.value)));
  const typed = (): void => {
    const value = Number(field.value.replace("\u2212", "-").replace(",", "."));
    if (Number.isFinite(value)) parameters.set(spec.name, value);
    field.value = fixed(parameters.get(spec.name), places);
  };
  field.addEventListener("change", typed);
  parameters.watch([spec.name], show);
  show();
  return el(
    "div",
    { class: "slider" },
    el("span", { class: "label", "aria-hidden": "true" }, label),
    range,
    el("span", { class: "field" }, field, el("span", {}, unit)),
  );
}

/** A choice of a few: buttons of which one is pressed. The parameter is the index. */
export function choice(
  parameters: Parameters,
  name: string,
  value: number,
  label: string,
  options: readonly string[],
): HTMLElement {
  parameters.declare({ name, value, min: 0, max: options.length - 1, step: 1 });
  const buttons = options.map((text, i) => {
    const b = el("button", { type: "button" }, text);
    b.disabled = parameters.locked(name);
    b.addEventListener("click", () => parameters.set(name, i));
    return b;
  });
  const show = (): void =>
    buttons.forEach((b, i) => {
      b.setAttribute("aria-pressed", String(i === Math.round(parameters.get(name))));
    });
  parameters.watch([name], show);
  show();
  return el(
    "div",
    { class: "choice" },
    el("span", { class: "label" }, label),
    el("div", { class: "segments", role: "group", "aria-label": label }, ...buttons),
  );
}
