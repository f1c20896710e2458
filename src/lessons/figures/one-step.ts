/** The pendulum's steps with one action repeated: the reader turns speed, time and angle, and sees the parabolas and the energy. */
import { el, svgEl } from "../../embed/dom.ts";
import { fillValues, type MountFigure, pointOut, slider } from "../kit/figure.ts";
import { Floor } from "../kit/floor.ts";
import { fixed } from "../kit/numbers.ts";
import { walkOf } from "./pendulum-walk.ts";

const TERMS = ["Standing", "Speed", "Bend"] as const;
const KEYS = ["e1", "e2", "e3"] as const;

export const mount: MountFigure = ({ box, parameters }) => {
  const floor = new Floor(
    { x: 0, z: 1.95, width: 4.7, aspect: 1.02 },
    "Steps of the pendulum, seen from above",
  );
  const speed = slider(parameters, { name: "v", value: 1.2, min: 0.4, max: 2, step: 0.05 }, "Speed v", "m/s");
  const turn = slider(parameters, { name: "theta", value: 14, min: 0, max: 60, step: 1 }, "Turn φ", "°", 0);
  const time = slider(
    parameters,
    { name: "T", value: 0.5, min: 0.35, max: 0.8, step: 0.05 },
    "Step time T",
    "s",
  );
  const bars = svgEl("svg", { viewBox: "0 0 320 112", class: "chart", role: "img" });
  const finding = el("p", { class: "finding", role: "status" });
  box.append(
    el(
      "div",
      { class: "panes" },
      el("div", { class: "pane" }, floor.svg),
      el(
        "div",
        { class: "stacked" },
        el("div", { class: "controls" }, speed, turn, time),
        el("div", { class: "pane padded" }, el("h4", {}, "Energy of a step, J/kg"), bars),
        finding,
      ),
    ),
  );
  const draw = (): void => {
    const action = {
      speed: parameters.get("v"),
      turn: (parameters.get("theta") * Math.PI) / 180,
      duration: parameters.get("T"),
      count: 7,
    };
    const steps = walkOf(action);
    floor.back.replaceChildren(
      ...steps.flatMap((s) => [
        floor.line(s.way, { class: "ink", "stroke-width": 2 }),
        // From the foot to the apex of its parabola.
        floor.line([[s.print.x, s.print.z], s.way[s.way.length >> 1]], {
          class: "quiet",
          "stroke-dasharray": "2 3",
        }),
      ]),
    );
    floor.prints.replaceChildren(
      ...steps.map((s) =>
        floor.print(s.print, { fill: s.print.foot === "left" ? "var(--left)" : "var(--right)" }),
      ),
    );
    floor.front.replaceChildren(
      ...steps.map((s) =>
        svgEl("circle", { cx: floor.px(s.way[0][0]), cy: floor.py(s.way[0][1]), r: 3.5, fill: "var(--ink)" }),
      ),
    );
    const last = steps[steps.length - 1];
    if (!last) {
      finding.textContent = "No leg reaches so far: strides end at 1.10 m.";
      bars.replaceChildren();
      return;
    }
    const scale = 190 / Math.max(2.4, ...last.energy);
    bars.replaceChildren(
      ...last.energy.flatMap((e, i) => {
        const row = svgEl("g");
        row.append(
          svgEl("text", { x: 66, y: 24 + 32 * i, "text-anchor": "end" }, TERMS[i]),
          svgEl("rect", {
            x: 74,
            y: 11 + 32 * i,
            width: Math.max(1, scale * e),
            height: 18,
            rx: 4,
            fill: "var(--ink)",
            opacity: 0.85 - 0.25 * i,
          }),
          svgEl("text", { x: 80 + scale * e, y: 24 + 32 * i, class: "strong" }, fixed(e, 2)),
        );
        row.addEventListener("pointerenter", () => pointOut(KEYS[i], true));
        row.addEventListener("pointerleave", () => pointOut(KEYS[i], false));
        return row;
      }),
    );
    const sum = last.energy.reduce((a, b) => a + b, 0);
    const length = action.speed * Math.cos(action.turn) * action.duration;
    const [vy, a] = [
      action.speed * Math.sin(action.turn),
      (action.speed * Math.sin(action.turn)) / action.duration,
    ];
    finding.textContent = `A step covers ${fixed(length, 2)} m and costs ${fixed(sum, 2)} J/kg, ${fixed(sum / length, 2)} a metre.`;
    bars.setAttribute("aria-label", finding.textContent);
    fillValues({
      "step.e1": fixed(last.energy[0], 2),
      "step.e2": fixed(last.energy[1], 2),
      "step.e3": fixed(last.energy[2], 2),
      "step.e": fixed(sum, 2),
      "step.a": fixed(a, 2),
      "step.vy": fixed(vy, 2),
      "step.T": fixed(action.duration, 2),
    });
  };
  parameters.watch(["v", "theta", "T"], draw);
  draw();
};
