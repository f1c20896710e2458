/** The joint of a loop: the frames after its end faded into those after its start. The reader chooses how many frames are blended. */

import { forwardKinematics } from "../../core/skeleton/forward-kinematics.ts";
import { J, JOINT_COUNT } from "../../core/skeleton/joints.ts";
import { cutLoop } from "../../core/styles/loop.ts";
import { el } from "../../embed/dom.ts";
import type { Style } from "../../studio/styles.ts";
import { Chart, chartWidth } from "../kit/chart.ts";
import { choice, fillValues, type MountFigure, slider } from "../kit/figure.ts";
import { fixed } from "../kit/numbers.ts";
import { wornCapture } from "./captures.ts";

const STYLES: readonly Style[] = ["walking", "energetic", "distressed"];
const JOINTS = [J.leftHand, J.head, J.rightFoot] as const;
const JOINT_WORDS = ["Left hand", "Head", "Right foot"];
/** Of the drawing, where there is room for it. */
const WIDE = 900;
/** Frames shown before and after the joint. */
const BEFORE = 20;
const AFTER = 50;

/** The weight of the frames after the start, i frames into a blend of n [Express §5.2]: from 0 to 1, level at both ends. */
const weight = (i: number, n: number): number => 1 - (Math.cos(((i + 0.5) * Math.PI) / n) / 2 + 0.5);

export const mount: MountFigure = ({ box, parameters }) => {
  const width = chartWidth(box, WIDE);
  const style = choice(parameters, "loopstyle", 0, "Capture", ["Walking", "Energetic", "Distressed"]);
  const joint = choice(parameters, "joint", 0, "Height of", JOINT_WORDS);
  const length = slider(
    parameters,
    { name: "blend", value: 20, min: 1, max: 40, step: 1 },
    "Frames blended",
    "",
    0,
  );
  const chart = new Chart({
    width,
    height: 240,
    x: [-BEFORE, AFTER],
    y: [0, 1],
    xName: "Frames from the loop's start",
    yName: "Height, cm",
    label: "Height of a joint across the joint of the loop",
    right: width < WIDE ? 12 : 110,
  });
  const weights = new Chart({
    width,
    height: 120,
    x: [-BEFORE, AFTER],
    y: [0, 1],
    xName: "",
    yName: "Weight w of the loop's own start",
    label: "Blend weight over the frames",
    right: width < WIDE ? 12 : 110,
  });
  const finding = el("p", { class: "finding", role: "status" });
  box.append(
    el("div", { class: "pane padded" }, chart.svg, weights.svg),
    el("div", { class: "controls" }, style, joint, length),
    finding,
  );
  const draw = (): void => {
    const name = STYLES[Math.round(parameters.get("loopstyle"))];
    const { clip } = wornCapture(name, 21);
    const loop = cutLoop(clip, name);
    const which = JOINTS[Math.round(parameters.get("joint"))];
    const n = Math.round(parameters.get("blend"));
    const places = new Float64Array(3 * JOINT_COUNT);
    const world = new Float64Array(4 * JOINT_COUNT);
    const height = (f: number): number => {
      const at = Math.max(0, Math.min(clip.frames - 1, f));
      forwardKinematics(
        places,
        world,
        clip.skeleton,
        clip.root,
        3 * at,
        clip.rotations,
        4 * JOINT_COUNT * at,
      );
      return 100 * places[3 * which + 1];
    };
    const { from, to } = loop.source;
    // What goes on after the end, and what the loop begins with.
    const going = Array.from({ length: BEFORE + AFTER }, (_, i): [number, number] => [
      i - BEFORE,
      height(to + i - BEFORE),
    ]);
    const starting = Array.from({ length: AFTER }, (_, i): [number, number] => [i, height(from + i)]);
    const blended = Array.from({ length: AFTER }, (_, i): [number, number] => {
      const w = i < n ? weight(i, n) : 1;
      return [i, (1 - w) * going[BEFORE + i][1] + w * starting[i][1]];
    });
    const all = [...going, ...starting].map((p) => p[1]);
    const pad = 0.1 * (Math.max(...all) - Math.min(...all)) + 0.2;
    chart.setBounds([-BEFORE, AFTER], [Math.min(...all) - pad, Math.max(...all) + pad]);
    chart.content.replaceChildren(
      chart.curve(going, { class: "quiet", "stroke-width": 1.4, "stroke-dasharray": "4 3" }),
      chart.curve(starting, { class: "quiet", "stroke-width": 1.4 }),
      chart.curve([...going.slice(0, BEFORE), ...blended], { class: "ink", "stroke-width": 2.2 }),
    );
    weights.content.replaceChildren(
      weights.curve(
        Array.from({ length: AFTER }, (_, i): [number, number] => [i, i < n ? weight(i, n) : 1]),
        { class: "ink", "stroke-width": 1.8 },
      ),
    );
    const jump = Math.abs(starting[0][1] - going[BEFORE][1]);
    const worst = Math.max(
      ...blended.slice(1).map((p, i) => Math.abs(p[1] - blended[i][1])),
      Math.abs(blended[0][1] - going[BEFORE - 1][1]),
    );
    finding.textContent = `Uncut, the ${JOINT_WORDS[Math.round(parameters.get("joint"))].toLowerCase()} would jump by ${fixed(10 * jump, 1)} mm. Blended over ${n} frames it never moves more than ${fixed(10 * worst, 1)} mm a frame. The loop has ${loop.strides} ${loop.strides === 1 ? "stride" : "strides"} in ${loop.frames} frames.`;
    chart.setFinding(finding.textContent);
    fillValues({ "loop.frames": String(loop.frames), "loop.jump": fixed(10 * jump, 1) });
  };
  parameters.watch(["loopstyle", "joint", "blend"], draw);
  draw();
};
