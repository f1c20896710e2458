/** One best-first search over steps: the reader drags goal and pillar and sees the nodes that were looked at, and the steps found. */
import { el, svgEl } from "../../embed/dom.ts";
import { fillValues, type MountFigure, slider } from "../kit/figure.ts";
import { Floor } from "../kit/floor.ts";
import { fixed } from "../kit/numbers.ts";
import { searchSteps } from "./pendulum-walk.ts";

export const mount: MountFigure = ({ box, parameters }) => {
  const floor = new Floor(
    { x: 0, z: 1.9, width: 5.2, aspect: 0.9 },
    "A search over footsteps, seen from above",
  );
  const most = slider(
    parameters,
    { name: "nodes", value: 150, min: 1, max: 300, step: 1 },
    "Nodes at most, N",
    "",
    0,
  );
  const speed = slider(
    parameters,
    { name: "speed", value: 1.3, min: 0.5, max: 1.8, step: 0.05 },
    "Speed wanted",
    "m/s",
  );
  floor.handle(parameters, "goal", [-0.1, 3.6], "The goal");
  floor.handle(parameters, "pillar", [0.1, 1.7], "The pillar", 7);
  const finding = el("p", { class: "finding", role: "status" });
  box.append(el("div", { class: "pane" }, floor.svg), el("div", { class: "controls" }, most, speed), finding);
  const draw = (): void => {
    const goal: [number, number] = [parameters.get("goal.x"), parameters.get("goal.z")];
    const pillar: [number, number] = [parameters.get("pillar.x"), parameters.get("pillar.z")];
    const run = searchSteps({
      goal,
      pillar,
      speed: parameters.get("speed"),
      most: Math.round(parameters.get("nodes")),
    });
    floor.back.replaceChildren(
      svgEl("circle", {
        cx: floor.px(pillar[0]),
        cy: floor.py(pillar[1]),
        r: floor.length(0.3),
        class: "ink",
        fill: "var(--line)",
      }),
      ...run.tree.map(([ax, az, bx, bz]) =>
        floor.line(
          [
            [ax, az],
            [bx, bz],
          ],
          { class: "quiet", "stroke-width": 0.7, opacity: 0.55 },
        ),
      ),
      ...run.path.map((s) => floor.line(s.way, { class: "ink", "stroke-width": 2.2 })),
    );
    floor.prints.replaceChildren(
      ...run.path.map((s, i) =>
        floor.print(s.print, {
          fill: s.print.foot === "left" ? "var(--left)" : "var(--right)",
          title: `Step ${i + 1}: ${fixed(s.energy[0] + s.energy[1] + s.energy[2], 2)} J/kg`,
        }),
      ),
    );
    const spent = run.path.reduce((sum, s) => sum + s.energy[0] + s.energy[1] + s.energy[2], 0);
    finding.textContent = run.found
      ? `${run.expanded} nodes were expanded and ${run.generated} kept to find ${run.path.length} steps that cost ${fixed(spent, 1)} J/kg. A search looks three seconds ahead.`
      : "Nothing is free, not even standing.";
    fillValues({ "search.expanded": String(run.expanded), "search.steps": String(run.path.length) });
  };
  parameters.watch(["goal", "pillar", "nodes", "speed"], draw);
  draw();
};
