/** How long a change of style takes: the gap of each end effector over the difference of its pace, and which of them decides. */

import { blendLength, EFFECTOR_NAMES, FIXED_BLEND } from "../../core/styles/blend-length.ts";
import { cutLoop, type LoopSequence, loopRow } from "../../core/styles/loop.ts";
import { EFFECTORS, ROW } from "../../core/styles/rows.ts";
import { el, svgEl } from "../../embed/dom.ts";
import type { Style } from "../../studio/styles.ts";
import { chartWidth } from "../kit/chart.ts";
import { choice, fillValues, type MountFigure, slider } from "../kit/figure.ts";
import { fixed } from "../kit/numbers.ts";
import { capture } from "./captures.ts";

const STYLES: readonly Style[] = ["walking", "jogging", "balancing", "energetic", "tired"];
const WORDS = ["Walking", "Jogging", "Balancing", "Energetic", "Tired"];
const NAMES = ["Head", "Left hand", "Right hand", "Left foot", "Right foot"];
/** Of the drawing, where there is room for it. */
const WIDE = 900;

export const mount: MountFigure = ({ box, parameters }) => {
  const width = chartWidth(box, WIDE);
  const from = choice(parameters, "from", 0, "From", WORDS);
  const to = choice(parameters, "to", 2, "To", WORDS);
  const phase = slider(
    parameters,
    { name: "phase", value: 0, min: 0, max: 95, step: 5 },
    "Phase of the stride",
    "%",
    0,
  );
  const svg = svgEl("svg", { viewBox: `0 0 ${width} 190`, class: "chart", role: "img" });
  const finding = el("p", { class: "finding", role: "status" });
  box.append(
    el(
      "div",
      { class: "pane padded" },
      el("h4", {}, "Gap between the two styles, and difference of pace"),
      svg,
    ),
    el("div", { class: "controls" }, from, to, phase),
    finding,
  );
  const loops = new Map<Style, LoopSequence>();
  const loopOf = (s: Style): LoopSequence => {
    let l = loops.get(s);
    if (!l) {
      l = cutLoop(capture(s).clip, s);
      loops.set(s, l);
    }
    return l;
  };
  const draw = (): void => {
    const a = loopOf(STYLES[Math.round(parameters.get("from"))]);
    const b = loopOf(STYLES[Math.round(parameters.get("to"))]);
    const p = parameters.get("phase") / 100;
    const fa = p * a.frames;
    const fb = p * b.frames;
    const rowA = new Float64Array(ROW);
    const rowB = new Float64Array(ROW);
    loopRow(rowA, 0, a, fa);
    loopRow(rowB, 0, b, fb);
    const length = blendLength(a, fa, b, fb);
    const gaps = NAMES.map((_, i) => {
      const e = EFFECTORS + 3 * i;
      return Math.hypot(rowA[e] - rowB[e], rowA[e + 1] - rowB[e + 1], rowA[e + 2] - rowB[e + 2]);
    });
    // Beside the longest bar its numbers have room.
    const scale = (width - (width < WIDE ? 262 : 340)) / Math.max(0.3, ...gaps);
    svg.replaceChildren(
      ...NAMES.flatMap((name, i) => {
        const y = 16 + 34 * i;
        const decides = i === length.effector;
        const pace = Math.abs(a.travel[i] - b.travel[i]);
        return [
          svgEl("text", { x: 90, y: y + 13, "text-anchor": "end", class: decides ? "strong" : "" }, name),
          svgEl("rect", {
            x: 100,
            y,
            width: Math.max(1, scale * gaps[i]),
            height: 18,
            rx: 4,
            fill: "var(--ink)",
            opacity: decides ? 1 : 0.3,
          }),
          svgEl(
            "text",
            { x: 108 + scale * gaps[i], y: y + 13, class: decides ? "strong" : "" },
            `${fixed(100 * gaps[i], 1)} cm, ${fixed(1000 * pace, 2)} mm a frame`,
          ),
        ];
      }),
    );
    const seconds = length.frames / 60;
    const same = a === b;
    finding.textContent = same
      ? "The same style on both sides: nothing has to be blended."
      : `${NAMES[length.effector]} decides: ${fixed(100 * length.gap, 1)} cm over ${fixed(1000 * length.pace, 2)} mm a frame, held to one pass of the longer loop, make ${fixed(length.frames, 0)} frames or ${fixed(seconds, 2)} s. A fixed blend would take ${fixed(FIXED_BLEND, 2)} s.`;
    svg.setAttribute("aria-label", finding.textContent);
    fillValues({
      "blend.gap": `${fixed(100 * length.gap, 1)} cm`,
      "blend.pace": `${fixed(1000 * length.pace, 2)} mm`,
      "blend.frames": fixed(length.frames, 0),
      "blend.seconds": `${fixed(seconds, 2)} s`,
      "blend.who": EFFECTOR_NAMES[length.effector],
    });
  };
  parameters.watch(["from", "to", "phase"], draw);
  draw();
};
