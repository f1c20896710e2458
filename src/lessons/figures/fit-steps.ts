/**
 * One template fitted to a goal by the real objective and optimiser: the reader drags the goal, turns the weights, and sees where the
 * template laid its footsteps, where they end, and what each term costs.
 */

import { PHASE_NAMES, PHASE_WEIGHTS } from "../../core/optimize/phase-weights.ts";
import { el, svgEl } from "../../embed/dom.ts";
import { objectiveFinding, objectivePlot } from "../../plots/objective.ts";
import { CATEGORY_COLOURS } from "../../view/tokens.ts";
import { choice, fillValues, type MountFigure, pointOut, slider } from "../kit/figure.ts";
import { Floor } from "../kit/floor.ts";
import { fixed } from "../kit/numbers.ts";
import { STRATEGIES, StepFitter } from "./fit-problem.ts";

const TERMS = [
  { key: "d", name: "Template", weight: "wd" },
  { key: "s", name: "Spacing", weight: "ws" },
  { key: "o", name: "Heading", weight: "wo" },
  { key: "g", name: "Goal", weight: "wg" },
  { key: "l", name: "Line", weight: "wl" },
] as const;

export const mount: MountFigure = ({ box, parameters }) => {
  const floor = new Floor(
    { x: 0, z: 1.75, width: 4.6, aspect: 0.98 },
    "Footsteps of one template, seen from above",
  );
  const strategy = choice(
    parameters,
    "strategy",
    0,
    "Template",
    STRATEGIES.map((s) => s.name),
  );
  const phase = choice(parameters, "phase", 2, "Weights of", ["Exit", "Locomotion", "Preparation", "Enter"]);
  const weights = TERMS.map((t, i) =>
    slider(
      parameters,
      { name: t.weight, value: PHASE_WEIGHTS.enterPreparation[i], min: 0, max: 1, step: 0.05 },
      `${t.name}, w${"dsogl"[i]}`,
    ),
  );
  const facing = slider(
    parameters,
    { name: "facing", value: 0, min: -90, max: 90, step: 5 },
    "Facing at the goal",
    "°",
    0,
  );
  const goal = floor.handle(parameters, "goal", [-0.75, 2.95], "The goal");
  const arrow = svgEl("path", {
    class: "ink",
    d: "M0-13V-26M-4-21L0-26L4-21",
    fill: "none",
    "stroke-width": 2,
  });
  goal.append(arrow);
  const plot = el("div", { class: "pane padded" });
  const finding = el("p", { class: "finding", role: "status" });
  box.append(
    el("div", { class: "panes" }, el("div", { class: "pane" }, floor.svg), plot),
    el("div", { class: "controls" }, strategy, phase, ...weights, facing),
    finding,
  );
  const fit = new StepFitter();
  const draw = (): void => {
    const s = STRATEGIES[Math.round(parameters.get("strategy"))];
    const yaw = (-parameters.get("facing") * Math.PI) / 180;
    const result = fit.solve({
      strategy: s,
      goal: { x: parameters.get("goal.x"), z: parameters.get("goal.z"), yaw },
      weights: [
        parameters.get("wd"),
        parameters.get("ws"),
        parameters.get("wo"),
        parameters.get("wg"),
        parameters.get("wl"),
      ],
      phase: PHASE_NAMES[Math.round(parameters.get("phase"))],
    });
    arrow.setAttribute("transform", `rotate(${((-yaw * 180) / Math.PI).toFixed(1)})`);
    floor.back.replaceChildren(
      floor.line(
        [
          [result.line[0], result.line[1]],
          [result.line[2], result.line[3]],
        ],
        {
          class: "quiet",
          "stroke-dasharray": "2 4",
        },
      ),
    );
    floor.prints.replaceChildren(
      ...result.before.map((p) => floor.print(p)),
      ...result.start.map((p) => floor.print(p, { class: "given", fill: "var(--ink-3)" })),
      ...result.after.map((p, i) =>
        floor.print(p, { fill: CATEGORY_COLOURS[s.steps[i].category].fill, title: `Footstep ${i + 1}` }),
      ),
    );
    const rows = result.terms;
    plot.innerHTML = `<h4>Objective while fitting</h4>${objectivePlot(
      { rows, names: ["Total", ...TERMS.map((t) => t.name)] },
      320,
      230,
    )}`;
    const last = rows[rows.length - 1];
    const values: Record<string, string> = { f: fixed(last[0], 3) };
    TERMS.forEach((t, i) => {
      values[`f_${t.key}`] = fixed(last[i + 1], 3);
    });
    fillValues(values);
    const end = result.after[result.after.length - 1];
    const miss = Math.hypot(end.x - result.target.x, end.z - result.target.z);
    finding.textContent = `${objectiveFinding({ rows, names: [] })} The last footstep is ${fixed(miss, 2)} m from its goal.`;
  };
  parameters.watch(["phase"], () => {
    const w = PHASE_WEIGHTS[PHASE_NAMES[Math.round(parameters.get("phase"))]];
    TERMS.forEach((t, i) => {
      parameters.set(t.weight, w[i]);
    });
  });
  parameters.watch(["strategy", "phase", "facing", "goal", ...TERMS.map((t) => t.weight)], draw);
  weights.forEach((row, i) => {
    row.addEventListener("pointerenter", () => pointOut(TERMS[i].key, true));
    row.addEventListener("pointerleave", () => pointOut(TERMS[i].key, false));
  });
  draw();
};
