/** Rows of the inspector made from the scene's schema: a field that the schema gains appears here by itself. */
import { html, nothing, type TemplateResult } from "lit";
import { type Field, fieldsOf, type ThingName } from "../../core/scene/fields.ts";
import type { Editor } from "../editor.ts";
import { dial } from "./dial.ts";
import { numberField } from "./number-field.ts";

type Value = number | string | boolean | null | readonly number[];

export interface RowsOf {
  /** What the thing has now, by field. */
  values: Readonly<Record<string, unknown>>;
  /** What the plan has where a value is null. */
  planned?: Readonly<Record<string, Value | undefined>>;
  /** Its kind or category: fields that are for others are left out. */
  of?: string;
  /** Fields shown elsewhere. */
  except?: readonly string[];
  /** Words shown over a choice, by value. */
  hints?: Readonly<Record<string, string>>;
  /** Changes a field; `done` is false while a slider is still held. */
  set(key: string, value: Value, done: boolean): void;
}

const DEGREE = Math.PI / 180;
/** Most choices that stand side by side. */
const SEGMENTS = 4;

/** A number of the document as people read it, in its unit. */
export function shownNumber(value: number, unit: Field["unit"]): string {
  return (unit === "°" ? value / DEGREE : value).toFixed(unit === "°" ? 1 : 2).replace("-", "\u2212");
}

const fromShown = (value: number, unit: Field["unit"]): number => (unit === "°" ? value * DEGREE : value);

export function schemaRows(e: Editor, thing: ThingName, rows: RowsOf): TemplateResult[] {
  return fieldsOf(thing)
    .filter((f) => !rows.except?.includes(f.key))
    .filter((f) => f.only === null || rows.of === undefined || f.only.includes(rows.of))
    .map((f) => row(e, f, rows));
}

function row(e: Editor, f: Field, rows: RowsOf): TemplateResult {
  const own = rows.values[f.key] as Value;
  const value = own ?? rows.planned?.[f.key] ?? null;
  if (f.slider) return slider(f, Number(value), rows);
  return html`<div class="row"><span>${f.label}</span>${control(e, f, value, rows)}</div>`;
}

function control(e: Editor, f: Field, value: Value, rows: RowsOf): TemplateResult | typeof nothing {
  const set = (v: Value): void => rows.set(f.key, v, true);
  if (f.kind === "switch")
    return segments(
      f,
      [
        { value: false, word: "No" },
        { value: true, word: "Yes" },
      ],
      value,
      rows,
      set,
    );
  if (f.kind === "choice")
    return f.options.length <= SEGMENTS ? segments(f, f.options, value, rows, set) : menu(f, value, set);
  if (f.kind === "numbers") {
    const list = (value ?? []) as readonly number[];
    return html`<div class="fields">${f.axes.map((axis, k) =>
      numberField(e, `${f.label} ${axis}`, axis, shownNumber(list[k] ?? 0, f.unit), f.unit, (v) =>
        set(list.map((x, i) => (i === k ? fromShown(v, f.unit) : x))),
      ),
    )}</div>`;
  }
  const number = html`${numberField(e, f.label, "", value === null ? "" : shownNumber(Number(value), f.unit), f.unit, (v) => set(fromShown(v, f.unit)))}`;
  // Angles of the document are facings.
  return f.unit === "°" && value !== null
    ? html`<div class="fields turning">${dial(e, Number(value), set)}${number}</div>`
    : number;
}

function segments(
  f: Field,
  options: readonly { value: string | number | boolean; word: string }[],
  value: Value,
  rows: RowsOf,
  set: (v: Value) => void,
): TemplateResult {
  return html`<div class="segments" role="group" aria-label=${f.label}>${options.map(
    (o) =>
      html`<button aria-pressed=${o.value === value} title=${rows.hints?.[String(o.value)] ?? nothing} @click=${() => o.value !== value && set(o.value)}>${o.word}</button>`,
  )}</div>`;
}

function menu(f: Field, value: Value, set: (v: Value) => void): TemplateResult {
  const chosen = (ev: Event): void => {
    const at = (ev.target as HTMLSelectElement).selectedIndex;
    set(f.options[at].value);
  };
  return html`<span class="field"><select aria-label=${f.label} @change=${chosen}>${f.options.map((o) => html`<option ?selected=${o.value === value}>${o.word}</option>`)}</select></span>`;
}

/** The part of a slider's line that is ink. */
export const passed = (value: number, least: number, most: number): string =>
  `--passed: ${((100 * (value - least)) / (most - least)).toFixed(1)}%`;

function slider(f: Field, value: number, rows: RowsOf): TemplateResult {
  const to = (ev: Event, done: boolean): void =>
    rows.set(f.key, Number((ev.target as HTMLInputElement).value), done);
  const [least, most] = f.slider as readonly [number, number];
  return html`<label class="row">${f.label} <input type="range" min=${least} max=${most} step="0.01" style=${passed(value, least, most)} .value=${String(value)} @input=${(ev: Event) => to(ev, false)} @change=${(ev: Event) => to(ev, true)} /></label>`;
}
