/**
 * The landing points of one foot, their triangles, and a stone: the reader drags the stone and sees the triangle that holds it, the
 * weights of its corners, and what happens outside of the hull and when the root has a say.
 */

import { extent } from "d3-array";
import { createFootSpace } from "../../core/blending/foot-space.ts";
import { chooseMix, createChoice, createMix } from "../../core/blending/mix.ts";
import { createRootSpace, rootWeights } from "../../core/blending/polar-bands.ts";
import { el, svgEl } from "../../embed/dom.ts";
import { chartWidth } from "../kit/chart.ts";
import { choice as choiceOf, fillValues, type MountFigure, pointOut, slider } from "../kit/figure.ts";
import { Floor } from "../kit/floor.ts";
import { fixed } from "../kit/numbers.ts";
import { askLandingPoints } from "../landing-points.ts";

/** A landing point this near to a corner may take its place, metres [Barycentric Algorithm 1]. */
const EPSILON = 0.15;

/** Metres left about the points, and units between two names. */
const AROUND = 0.3;
const APART = 18;

interface Named {
  at: readonly [number, number];
  word: string;
}

/** Names beside the points, where nothing is drawn: each at its place's height or as near as the others leave, with a line to it. */
function names(floor: Floor, points: ArrayLike<number>, list: readonly Named[]): SVGElement[] {
  let side = 0;
  for (let i = 0; i < points.length; i += 2) side = Math.max(side, floor.px(points[i]));
  const rows = list
    .map(({ at: [x, z], word }) => ({ word, x: floor.px(x), y: floor.py(z), row: floor.py(z) }))
    .sort((a, b) => a.y - b.y);
  for (let k = 1; k < rows.length; k++) rows[k].row = Math.max(rows[k].row, rows[k - 1].row + APART);
  const drift = rows.reduce((sum, r) => sum + r.row - r.y, 0) / Math.max(1, rows.length);
  return rows.flatMap(({ word, x, y, row }) => {
    const at = row - drift;
    return [
      svgEl("path", { class: "quiet", d: `M${x} ${y}L${side + 20} ${at}`, fill: "none", "stroke-width": 1 }),
      svgEl("text", { x: side + 25, y: at + 4, class: "strong plate" }, word),
    ];
  });
}

export const mount: MountFigure = async ({ figure, box, parameters }) => {
  const withRoot = figure.dataset.root === "true";
  const key = withRoot ? "r" : "";
  const wait = el("p", { class: "finding" }, "Rendering the clips");
  box.append(wait);
  const data = await askLandingPoints();
  wait.remove();
  // As tall as the points of both feet; what they leave at the sides is for names.
  const [low = 0, high = 1] = extent(data.feet.flatMap((p) => [...p].filter((_, i) => i % 2 === 1)));
  const units = chartWidth(box, 680);
  const aspect = units < 680 ? 1.5 : 0.95;
  const floor = new Floor(
    { x: 0, z: (low + high) / 2, width: (high - low + AROUND) / aspect, aspect },
    "Landing points of the clips, seen from the root",
    units,
  );
  const foot = choiceOf(parameters, `${key}foot`, 0, "Foot", ["Left", "Right"]);
  const controls = el("div", { class: "controls" }, foot);
  if (withRoot)
    controls.append(
      slider(parameters, { name: "lambda4", value: 0.3, min: 0, max: 1, step: 0.01 }, "Root's share, λ₄"),
      slider(parameters, { name: "speed", value: 1.3, min: -1, max: 3.5, step: 0.05 }, "Root's speed", "m/s"),
      slider(parameters, { name: "turn", value: 0, min: -90, max: 90, step: 5 }, "Root's turn", "°/s", 0),
    );
  const finding = el("p", { class: "finding", role: "status" });
  floor.handle(parameters, `${key}stone`, [0.12, 0.55], "The stone");
  box.append(el("div", { class: "pane" }, floor.svg), controls, finding);
  const spaces = data.feet.map(createFootSpace);
  const roots = createRootSpace(data.velocities);
  const rootW = new Float64Array(data.velocities.length);
  const picked = createChoice();
  const mix = createMix();
  const draw = (): void => {
    const space = spaces[Math.round(parameters.get(`${key}foot`))];
    const p = space.points;
    const x = parameters.get(`${key}stone.x`);
    const z = parameters.get(`${key}stone.z`);
    if (withRoot)
      rootWeights(rootW, roots, 0, parameters.get("speed"), (parameters.get("turn") * Math.PI) / 180);
    picked.located.triangle = 0;
    chooseMix(
      mix,
      picked,
      space,
      x,
      z,
      withRoot ? rootW : null,
      EPSILON,
      withRoot ? parameters.get("lambda4") : 0,
    );
    const at = (i: number): [number, number] => [p[2 * i], p[2 * i + 1]];
    const edges: SVGElement[] = [];
    for (let e = 0; e < space.triangles.length; e++) {
      if (space.halfedges[e] > e) continue;
      const b = space.triangles[e % 3 === 2 ? e - 2 : e + 1];
      edges.push(
        floor.line([at(space.triangles[e]), at(b)], {
          class: "quiet",
          "stroke-width": space.halfedges[e] < 0 ? 1.6 : 0.9,
        }),
      );
    }
    const corners = [...picked.corners];
    const fill = floor.line([...corners.map(at), at(corners[0])], { class: "ink", "stroke-width": 2 });
    fill.setAttribute("fill", "color-mix(in srgb, var(--ink) 9%, transparent)");
    floor.back.replaceChildren(...edges, fill);
    const spokes = corners.map((c) =>
      floor.line([at(c), [picked.located.x, picked.located.z]], {
        class: "ink",
        "stroke-dasharray": "2 3",
        "stroke-width": 1,
      }),
    );
    const colour = Math.round(parameters.get(`${key}foot`)) === 0 ? "var(--left)" : "var(--right)";
    const dots: SVGElement[] = [];
    for (let i = 0; i < p.length / 2; i++) {
      const weight = weightOf(i);
      const dot = svgEl("circle", {
        cx: floor.px(p[2 * i]),
        cy: floor.py(p[2 * i + 1]),
        // The area follows the weight.
        r: 3 + 8 * Math.sqrt(weight),
        fill: weight > 0 ? colour : "var(--paper)",
        stroke: colour,
        "stroke-width": 1.5,
      });
      dot.append(svgEl("title", {}, `${data.names[i]}, ${fixed(100 * weight, 0)} %`));
      const k = corners.indexOf(i);
      if (k >= 0) {
        dot.addEventListener("pointerenter", () => pointOut(`w${k + 1}`, true));
        dot.addEventListener("pointerleave", () => pointOut(`w${k + 1}`, false));
      }
      dots.push(dot);
    }
    const named: Named[] = corners.map((c, k) => ({
      at: at(c),
      word: `w${"₁₂₃"[k]} = ${fixed(picked.lambda[k], 2)}`,
    }));
    const extra: SVGElement[] = [];
    if (picked.located.outside > 0)
      extra.push(
        floor.line(
          [
            [x, z],
            [picked.located.x, picked.located.z],
          ],
          { class: "ink", "stroke-width": 1.5, "stroke-dasharray": "5 4" },
        ),
      );
    if (withRoot) {
      extra.push(
        floor.line(
          [
            [picked.located.x, picked.located.z],
            [picked.rx, picked.rz],
          ],
          { class: "quiet", "stroke-width": 1.2, "stroke-dasharray": "2 4" },
        ),
        mark(picked.rx, picked.rz),
        mark(picked.x, picked.z),
      );
      named.push({ at: [picked.rx, picked.rz], word: "r" }, { at: [picked.x, picked.z], word: "lands" });
    }
    floor.front.replaceChildren(...spokes, ...dots, ...extra, ...names(floor, p, named));
    fillValues({
      [`${key}w1`]: fixed(picked.lambda[0], 2),
      [`${key}w2`]: fixed(picked.lambda[1], 2),
      [`${key}w3`]: fixed(picked.lambda[2], 2),
      [`${key}w4`]: fixed(picked.lambda4, 2),
      clips: String(data.names.length),
      beta: fixed(picked.beta, 2),
    });
    const clips = corners.map((c) => data.names[c]).join(", ");
    const miss = Math.hypot(picked.x - x, picked.z - z);
    finding.textContent =
      picked.located.outside > 0
        ? `The stone is ${fixed(100 * picked.located.outside, 1)} cm outside of the hull; its nearest point is blended from ${clips}, and the leg has to reach the rest.`
        : withRoot
          ? `With λ₄ = ${fixed(picked.lambda4, 2)} and β = ${fixed(picked.beta, 2)} the blend lands ${fixed(100 * miss, 1)} cm from the stone. ${mix.count} clips take part.`
          : `The triangle's corners are ${clips}.`;
  };
  const weightOf = (clip: number): number => {
    let sum = 0;
    for (let i = 0; i < mix.count; i++) if (mix.clips[i] === clip) sum += mix.weights[i];
    return Math.max(0, sum);
  };
  const mark = (x: number, z: number): SVGPathElement => {
    const [px, py] = [floor.px(x), floor.py(z)];
    return svgEl("path", {
      class: "ink",
      d: `M${px - 6} ${py - 6}L${px + 6} ${py + 6}M${px + 6} ${py - 6}L${px - 6} ${py + 6}`,
      "stroke-width": 2,
    });
  };
  parameters.watch([`${key}stone`, `${key}foot`, ...(withRoot ? ["lambda4", "speed", "turn"] : [])], draw);
  draw();
};
