/** Polar gradient bands: the clips' velocities in the plane, and which of them take part for the velocity that the reader drags. */

import { createRootSpace, rootWeights } from "../../core/blending/polar-bands.ts";
import { el, svgEl } from "../../embed/dom.ts";
import type { MountFigure } from "../kit/figure.ts";
import { Floor } from "../kit/floor.ts";
import { fixed } from "../kit/numbers.ts";
import { askLandingPoints } from "../landing-points.ts";

export const mount: MountFigure = async ({ box, parameters }) => {
  const wait = el("p", { class: "finding" }, "Rendering the clips");
  box.append(wait);
  const data = await askLandingPoints();
  wait.remove();
  const fastest = Math.max(...data.velocities.map((v) => v.z));
  const floor = new Floor(
    { x: 0, z: fastest / 2 - 0.5, width: 5.2, aspect: 0.95 },
    "Velocities of the clips: ahead upwards, to the left leftwards, metres a second",
    440,
    "m/s",
  );
  floor.handle(parameters, "v", [0.3, 1.4], "The velocity wanted");
  const finding = el("p", { class: "finding", role: "status" });
  box.append(el("div", { class: "pane" }, floor.svg), finding);
  const roots = createRootSpace(data.velocities);
  const weights = new Float64Array(data.velocities.length);
  const draw = (): void => {
    const [x, z] = [parameters.get("v.x"), parameters.get("v.z")];
    rootWeights(weights, roots, x, z, 0);
    const heavy = [...weights].map((w, i) => ({ w, i })).sort((a, b) => b.w - a.w);
    floor.back.replaceChildren(
      ...[0.5, 1, 1.5, 2, 2.5, 3].map((r) =>
        svgEl("circle", {
          cx: floor.px(0),
          cy: floor.py(0),
          r: floor.length(r),
          fill: "none",
          class: "axis",
        }),
      ),
      ...heavy
        .filter((h) => h.w > 0.01)
        .map((h) =>
          floor.line(
            [
              [x, z],
              [data.velocities[h.i].x, data.velocities[h.i].z],
            ],
            { class: "ink", "stroke-width": Math.round(10 * (0.5 + 3 * h.w)) / 10, opacity: 0.5 },
          ),
        ),
    );
    floor.front.replaceChildren(
      ...data.velocities.map((v, i) => {
        const dot = svgEl("circle", {
          cx: floor.px(v.x),
          cy: floor.py(v.z),
          r: 3 + 9 * Math.sqrt(weights[i]),
          fill: weights[i] > 0.01 ? "var(--ink)" : "var(--paper)",
          class: "ink",
          "stroke-width": 1.4,
        });
        dot.append(
          svgEl(
            "title",
            {},
            `${data.names[i]}: ${fixed(v.x, 2)}, ${fixed(v.z, 2)} m/s, ${fixed((v.yaw * 180) / Math.PI, 0)} °/s`,
          ),
        );
        return dot;
      }),
    );
    const names = heavy
      .filter((h) => h.w >= 0.05)
      .map((h) => `${data.names[h.i]} ${fixed(100 * h.w, 0)} %`)
      .join(", ");
    finding.textContent = `At ${fixed(Math.hypot(x, z), 2)} m/s: ${names}. Clips that turn stand aside while no turn is wanted.`;
  };
  parameters.watch(["v"], draw);
  draw();
};
