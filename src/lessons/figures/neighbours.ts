/** One frame asked of the oracle: the nearest labelled windows, their votes, and the labels after hysteresis. */

import { featuresOf } from "../../core/contacts/features.ts";
import { type MotionTrack, trackOf } from "../../core/contacts/motion-track.ts";
import { createNearestSearch, findNearest } from "../../core/contacts/nearest.ts";
import { askOracle, labelsOf, type Oracle, PAPER_ORACLE, trainOracle } from "../../core/contacts/oracle.ts";
import { el, svgEl } from "../../embed/dom.ts";
import type { Style } from "../../studio/styles.ts";
import { Chart, chartWidth } from "../kit/chart.ts";
import { choice, fillValues, type MountFigure, slider } from "../kit/figure.ts";
import { fixed } from "../kit/numbers.ts";
import { wornCapture } from "./captures.ts";
import { contactRows, mistakes } from "./contact-rows.ts";

const TRAINING: readonly Style[] = ["walking", "energetic", "distressed"];
const ASKED: readonly Style[] = ["tired", "walking", "jogging"];
/** One frame in so many is remembered: neighbours in time say the same. */
const EVERY = 3;
const FROM = 1.5;
const SHOWN = 4;
const LEFT_TOE = 1;
/** Of the drawing, where there is room for it. */
const WIDE = 600;
/** Toe's height in a row of the paper's features: 21 x (knee, ankle, toe) of two legs, x y z. */
const TOE_HEIGHT = 7;
const ROW = 18;

interface Asked {
  track: MotionTrack;
  contacts: Uint8Array;
  features: Float32Array;
}

export const mount: MountFigure = ({ box, parameters }) => {
  const width = chartWidth(box, WIDE);
  const asked = choice(parameters, "asked", 0, "Ask about", ["Tired", "Walking", "Jogging"]);
  const k = slider(parameters, { name: "k", value: 10, min: 1, max: 40, step: 1 }, "Neighbours, k", "", 0);
  const on = slider(
    parameters,
    { name: "on", value: 0.6, min: 0.5, max: 1, step: 0.05 },
    "Plant begins over",
  );
  const off = slider(
    parameters,
    { name: "off", value: 0.4, min: 0, max: 0.5, step: 0.05 },
    "Plant ends under",
  );
  const time = slider(
    parameters,
    { name: "time", value: 2.6, min: FROM, max: FROM + SHOWN, step: 1 / 60 },
    "Frame at",
    "s",
  );
  const windows = new Chart({
    width: chartWidth(box, 300),
    height: 200,
    x: [-10, 10],
    y: [-1.15, -0.6],
    xName: "Frames from the one asked",
    yName: "Left toe under the hips, leg lengths",
    label: "The window asked about over its nearest neighbours",
  });
  const share = new Chart({
    width,
    height: 170,
    x: [FROM, FROM + SHOWN],
    y: [0, 1],
    xName: "Time, s",
    yName: "Share of votes for: left toe is down",
    label: "Share of votes over time",
  });
  const rows = svgEl("svg", { viewBox: `0 0 ${width} 62`, class: "chart", role: "img" });
  const votes = el("p", { role: "status" });
  const finding = el("p", { class: "finding", role: "status" });
  box.append(
    el(
      "div",
      { class: "panes" },
      el("div", { class: "pane padded" }, share.svg, rows),
      el("div", { class: "pane padded" }, el("h4", {}, "The frame and its neighbours"), windows.svg, votes),
    ),
    el("div", { class: "controls" }, asked, k, on, off, time),
    finding,
  );

  const examples = TRAINING.map((s, i) => {
    const { clip, contacts } = wornCapture(s, 11 + i);
    return {
      track: trackOf(clip),
      labels: contacts,
      mask: Uint8Array.from(contacts, (_, f) => (f % EVERY === i ? 1 : 0)),
    };
  });
  const oracle: Oracle = trainOracle(examples, PAPER_ORACLE);
  const tracks = new Map<number, Asked>();
  const track = (i: number): Asked => {
    let a = tracks.get(i);
    if (!a) {
      const { clip, contacts } = wornCapture(ASKED[i], 5);
      const t = trackOf(clip);
      a = { track: t, contacts, features: featuresOf(t, PAPER_ORACLE) };
      tracks.set(i, a);
    }
    return a;
  };
  const options = () => ({
    ...PAPER_ORACLE,
    k: Math.round(parameters.get("k")),
    on: parameters.get("on"),
    off: parameters.get("off"),
  });

  let answer = askOracle({ ...oracle, options: options() }, track(0).track);
  const ask = (): void => {
    answer = askOracle({ ...oracle, options: options() }, track(Math.round(parameters.get("asked"))).track);
    label();
    look();
  };
  const x = (f: number): number => Math.round(10 * share.x(f / 60)) / 10;
  const label = (): void => {
    const { contacts, track: t } = track(Math.round(parameters.get("asked")));
    const o = options();
    const found = labelsOf(answer.share, t.frames, o);
    const from = Math.round(FROM * 60);
    const to = Math.min(t.frames, from + SHOWN * 60);
    const curve: [number, number][] = [];
    for (let f = from; f < to; f++) curve.push([f / 60, answer.share[4 * f + LEFT_TOE]]);
    const level = (v: number) =>
      share.curve(
        [
          [FROM, v],
          [FROM + SHOWN, v],
        ],
        { class: "ink", "stroke-dasharray": "5 4", "stroke-width": 1 },
      );
    share.content.replaceChildren(
      level(o.on),
      level(o.off),
      share.curve(curve, { stroke: "var(--left)", "stroke-width": 1.8 }),
      cursor,
    );
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
    const wrong = (100 * [0, 1, 2, 3].reduce((sum, b) => sum + mistakes(found, contacts, b).share, 0)) / 4;
    finding.textContent = `${fixed(wrong, 1)} % of the four labels are wrong over the whole capture, with ${oracle.index.count} remembered examples, none of them from this capture.`;
    rows.setAttribute("aria-label", finding.textContent);
    fillValues({ "oracle.wrong": fixed(wrong, 1), "oracle.examples": String(oracle.index.count) });
  };
  const cursor = svgEl("line", { class: "ink", "stroke-width": 1.5 });
  const look = (): void => {
    const a = track(Math.round(parameters.get("asked")));
    const f = Math.min(a.track.frames - 1, Math.round(parameters.get("time") * 60));
    const search = createNearestSearch(oracle.index, Math.min(options().k, oracle.index.count));
    findNearest(search, a.features, f * oracle.index.size);
    const curve = (data: Float32Array, o: number): [number, number][] =>
      Array.from({ length: 21 }, (_, i) => [i - 10, data[o + ROW * i + TOE_HEIGHT]]);
    const mine = curve(a.features, f * oracle.index.size);
    const others = [...search.found].map((i) => ({
      line: curve(oracle.index.data, i * oracle.index.size),
      down: (oracle.labels[i] >> LEFT_TOE) & 1,
    }));
    const all = [mine, ...others.map((o) => o.line)].flat().map((p) => p[1]);
    windows.setBounds([-10, 10], [Math.min(...all) - 0.01, Math.max(...all) + 0.01]);
    windows.content.replaceChildren(
      ...others.map((o) =>
        windows.curve(o.line, {
          stroke: "var(--left)",
          "stroke-width": 1,
          opacity: 0.55,
          "stroke-dasharray": o.down ? "none" : "3 3",
        }),
      ),
      windows.curve(mine, { class: "ink", "stroke-width": 2.4 }),
    );
    const down = others.filter((o) => o.down).length;
    votes.textContent = `${down} of ${others.length} say that the toe is down (full lines); the nearest is ${fixed(Math.sqrt(search.distance[0]), 2)} away.`;
    fillValues({
      "oracle.votes": String(down),
      "oracle.k": String(others.length),
      "oracle.share": fixed(down / others.length, 2),
    });
    const at = share.x(f / 60);
    for (const [name, value] of Object.entries({ x1: at, x2: at, y1: share.y(0), y2: share.y(1) }))
      cursor.setAttribute(name, String(value));
  };
  parameters.watch(["asked", "k"], ask);
  parameters.watch(["on", "off"], label);
  parameters.watch(["time"], look);
  ask();
};
