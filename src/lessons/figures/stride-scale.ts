/** A drawn path and how much it shortens the stride: the reader drags its points. */

import { createPath } from "../../core/styles/path.ts";
import { scaleAlong } from "../../core/styles/timeline.ts";
import { el } from "../../embed/dom.ts";
import { Chart } from "../kit/chart.ts";
import { fillValues, type MountFigure } from "../kit/figure.ts";
import { Floor } from "../kit/floor.ts";
import { fixed } from "../kit/numbers.ts";

const POINTS: readonly (readonly [number, number])[] = [
  [2.1, -0.5],
  [1.1, 1.3],
  [-0.5, 0.6],
  [-0.9, 2.1],
  [-2.1, 2.3],
];

export const mount: MountFigure = ({ box, parameters }) => {
  const floor = new Floor({ x: 0, z: 0.9, width: 5, aspect: 0.78 }, "A path on the floor, seen from above");
  const chart = new Chart({
    width: 300,
    height: 220,
    x: [0, 6],
    y: [0.4, 1],
    xName: "Way along the path, m",
    yName: "Stride, share of the recorded one",
    label: "Stride scale along the path",
  });
  const finding = el("p", { class: "finding", role: "status" });
  POINTS.forEach((p, i) => {
    floor.handle(parameters, `p${i + 1}`, p, `Point ${i + 1} of the path`, 7);
  });
  box.append(
    el(
      "div",
      { class: "panes" },
      el("div", { class: "pane" }, floor.svg),
      el("div", { class: "pane padded" }, chart.svg),
    ),
    finding,
  );
  const draw = (): void => {
    const points = POINTS.map((_, i): [number, number] => [
      parameters.get(`p${i + 1}.x`),
      parameters.get(`p${i + 1}.z`),
    ]);
    let path: ReturnType<typeof createPath>;
    try {
      path = createPath(points, true);
    } catch (error) {
      if (!(error instanceof RangeError)) throw error;
      finding.textContent = error.message;
      return;
    }
    const scale = scaleAlong(path);
    const parts: [number, number][][] = [];
    const every = 5;
    for (let r = 0; r + every < path.rows; r += every) {
      parts.push(
        Array.from({ length: every + 1 }, (_, k): [number, number] => [path.x[r + k], path.z[r + k]]),
      );
    }
    floor.back.replaceChildren(
      ...parts.map((part, i) =>
        floor.line(part, {
          class: "ink",
          "stroke-width": Math.round(10 * (1.5 + 12 * (1 - scale[i * every]))) / 10,
          "stroke-linecap": "round",
        }),
      ),
    );
    chart.setBounds([0, path.length], [0.45, 1.02]);
    chart.content.replaceChildren(
      chart.curve(
        Array.from(scale, (s, r): [number, number] => [r * path.step, s]),
        { class: "ink", "stroke-width": 1.8 },
      ),
    );
    const least = Math.min(...scale);
    const at = scale.indexOf(least) * path.step;
    finding.textContent = `The path is ${fixed(path.length, 2)} m long; in its sharpest bend, ${fixed(at, 2)} m along, strides have ${fixed(100 * least, 0)} % of their recorded length.`;
    chart.setFinding(finding.textContent);
    fillValues({ "stride.least": fixed(100 * least, 0) });
  };
  parameters.watch(
    POINTS.map((_, i) => `p${i + 1}`),
    draw,
  );
  draw();
};
