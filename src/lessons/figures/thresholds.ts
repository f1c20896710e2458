/** Contacts by two thresholds, on a capture whose contacts are known: the reader looks for a pair of values that is right everywhere. */

import { detectContacts, solePoints } from "../../core/contacts/baselines.ts";
import { el, svgEl } from "../../embed/dom.ts";
import type { Style } from "../../studio/styles.ts";
import { Chart, chartWidth } from "../kit/chart.ts";
import { choice, fillValues, type MountFigure, slider } from "../kit/figure.ts";
import { fixed } from "../kit/numbers.ts";
import { wornCapture } from "./captures.ts";
import { contactRows, mistakes } from "./contact-rows.ts";

const STYLES: readonly Style[] = ["walking", "tired", "energetic", "jogging"];
/** Of the drawing, where there is room for it. */
const WIDE = 900;
const HEIGHT = 210;
/** Seconds shown, from where the walk is under way. */
const FROM = 1.5;
const SHOWN = 4;
const LEFT_TOE = 1;

export const mount: MountFigure = ({ box, parameters }) => {
  const width = chartWidth(box, WIDE);
  const style = choice(parameters, "style", 0, "Capture", ["Walking", "Tired", "Energetic", "Jogging"]);
  const height = slider(
    parameters,
    { name: "height", value: 22, min: 2, max: 80, step: 1 },
    "Height limit",
    "mm",
    0,
  );
  const speed = slider(
    parameters,
    { name: "speed", value: 22, min: 2, max: 120, step: 1 },
    "Speed limit",
    "cm/s",
    0,
  );
  const chart = new Chart({
    width,
    height: HEIGHT,
    x: [FROM, FROM + SHOWN],
    y: [0, 16],
    xName: "Time, s",
    yName: "Height of the left toe's sole, cm",
    label: "Height of the left toe over time with the height limit",
    right: 12,
  });
  const rows = svgEl("svg", { viewBox: `0 0 ${width} 62`, class: "chart", role: "img" });
  const finding = el("p", { class: "finding", role: "status" });
  box.append(
    el("div", { class: "pane padded" }, chart.svg, rows),
    el("div", { class: "controls" }, style, height, speed),
    finding,
  );
  const draw = (): void => {
    const { clip, contacts } = wornCapture(STYLES[Math.round(parameters.get("style"))], 3);
    const found = detectContacts(clip, "both", {
      height: parameters.get("height") / 1000,
      speed: parameters.get("speed") / 100,
    });
    const from = Math.round(FROM * 60);
    const to = Math.min(clip.frames, from + SHOWN * 60);
    const soles = solePoints(clip);
    const curve: [number, number][] = [];
    for (let f = from; f < to; f++)
      curve.push([f / 60, 100 * Math.min(soles[18 * f + 4], soles[18 * f + 7])]);
    const limit = parameters.get("height") / 10;
    chart.content.replaceChildren(
      chart.curve(
        [
          [FROM, limit],
          [FROM + SHOWN, limit],
        ],
        { class: "ink", "stroke-dasharray": "5 4", "stroke-width": 1.2 },
      ),
      chart.curve(curve, { stroke: "var(--left)", "stroke-width": 1.8 }),
    );
    const x = (f: number): number => Math.round(10 * chart.x(f / 60)) / 10;
    rows.replaceChildren(
      contactRows(
        [
          { name: "true", contacts, truth: null },
          { name: "found", contacts: found, truth: contacts },
        ],
        LEFT_TOE,
        from,
        to,
        x,
        6,
      ),
    );
    const shares = [0, 1, 2, 3].map((b) => mistakes(found, contacts, b).share);
    const all = (100 * shares.reduce((a, b) => a + b, 0)) / 4;
    const text = `${fixed(all, 1)} % of the four labels are wrong over the whole capture; ${fixed(100 * shares[LEFT_TOE], 1)} % of the left toe's.`;
    finding.textContent = text;
    rows.setAttribute("aria-label", text);
    fillValues({ "threshold.wrong": fixed(all, 1) });
  };
  parameters.watch(["style", "height", "speed"], draw);
  draw();
};
