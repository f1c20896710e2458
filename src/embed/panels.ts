/** The panels under an element's picture: what the planner did, as plots and small tables. Loaded when first asked for. */
import type { QualityFigures } from "../core/motion/types.ts";
import { STEP_CATEGORIES } from "../core/steps/types.ts";
import type { Plan } from "../core/tasks/plan-types.ts";
import { objectiveFinding, objectivePlot } from "../plots/objective.ts";
import { CATEGORY_COLOURS, CATEGORY_WORDS } from "../view/tokens.ts";
import { el, svgEl } from "./dom.ts";

type Draw = (plan: Plan, quality: QualityFigures | null, task: number) => HTMLElement;

const PANELS: Record<string, Draw> = { steps, objective, templates, quality };

/** Index of the task being come to, or done, at a time. */
export function taskAt(plan: Plan, time: number): number {
  const i = plan.tasks.findIndex((t) => time <= t.end);
  return i < 0 ? plan.tasks.length - 1 : i;
}

/** Draws the panels named into `box`; names that are not known are left out. */
export function drawPanels(
  box: HTMLElement,
  names: readonly string[],
  plan: Plan,
  quality: QualityFigures | null,
  time: number,
): void {
  const task = taskAt(plan, time);
  box.replaceChildren(...names.flatMap((n) => PANELS[n]?.(plan, quality, task) ?? []));
}

function section(title: string, ...children: (Node | string)[]): HTMLElement {
  return el("section", {}, el("h3", {}, title), ...children);
}

function table(rows: readonly (readonly [Node | string, string])[]): HTMLTableElement {
  return el("table", {}, ...rows.map(([a, b]) => el("tr", {}, el("td", {}, a), el("td", {}, b))));
}

function swatch(colour: string): SVGSVGElement {
  const svg = svgEl("svg", { class: "swatch", viewBox: "0 0 10 10", "aria-hidden": "true" });
  svg.append(svgEl("rect", { width: 10, height: 10, rx: 3, fill: colour }));
  return svg;
}

function steps(plan: Plan): HTMLElement {
  const rows = STEP_CATEGORIES.map((c): [Node, string] => [
    el("span", {}, swatch(CATEGORY_COLOURS[c].fill), CATEGORY_WORDS[c]),
    String(plan.steps.filter((s) => s.category === c).length),
  ]);
  return section(`${plan.steps.length} footsteps`, table(rows));
}

function objective(plan: Plan, _: QualityFigures | null, task: number): HTMLElement {
  const traces = plan.traces.filter((t) => t.task === task && t.terms.length > 1);
  const trace = traces.find((t) => t.phase === "enter") ?? traces[0];
  const data = {
    rows: trace?.terms ?? [],
    names: ["Total", "Template", "Spacing", "Heading", "Goal", "Line"],
  };
  const finding = el("p", {}, objectiveFinding(data));
  if (!trace) return section("Objective while fitting", finding);
  const plot = el("template");
  plot.innerHTML = objectivePlot(data);
  return section("Objective while fitting", plot.content, finding);
}

function templates(plan: Plan, _: QualityFigures | null, task: number): HTMLElement {
  const lists = plan.candidates.filter((c) => c.task === task);
  const list = (lists.find((c) => c.phase === "enter") ?? lists[0])?.list ?? [];
  const rows = list
    .slice(0, 6)
    .map((c): [Node, string] => [
      el(
        "span",
        {},
        ...c.steps.slice(0, 8).map((s) => swatch(CATEGORY_COLOURS[s.category].fill)),
        c.chosen ? " chosen" : "",
      ),
      c.distance.toFixed(2),
    ]);
  return section("Templates that competed", rows.length > 0 ? table(rows) : el("p", {}, "None here."));
}

function quality(_: Plan, q: QualityFigures | null): HTMLElement {
  const mm = (v: number | null | undefined) =>
    v === null || v === undefined ? "\u2013" : `${v.toFixed(1)} mm`;
  return section(
    "Quality",
    table([
      ["Feet slide", mm(q?.skate)],
      ["Under the floor", mm(q?.penetration)],
      ["Over the floor", mm(q?.float)],
      ["Hand to target", mm(q?.reach)],
      ["Footsteps met", mm(q?.footstepError?.position)],
    ]),
  );
}
