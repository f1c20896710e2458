/** Clean-up judged by hand-checked labels, as captured and with injected skate: slides of plants, popping, and when plants begin and end. */
import { parseBvh } from "../../src/core/capture/bvh-parse.ts";
import type { Clip } from "../../src/core/capture/clip.ts";
import { importBvhFile } from "../../src/core/capture/import.ts";
import { cleanBvh } from "../../src/core/cleanup/clean-bvh.ts";
import { plantSlides, slideP95 } from "../../src/core/cleanup/slides.ts";
import { trackOf } from "../../src/core/contacts/motion-track.ts";
import { askOracle, type Oracle } from "../../src/core/contacts/oracle.ts";
import { quatYaw } from "../../src/core/math/quaternion.ts";
import { paceOf } from "../../src/core/quality/kind.ts";
import { poppingOf } from "../../src/core/quality/smoothness.ts";
import { JOINT_COUNT } from "../../src/core/skeleton/joints.ts";
import { atSourceRate, labelledClips, type Skate, skating } from "../support/labelled.ts";
import { figure } from "./measure.ts";
import type { Figure } from "./types.ts";

const KINDS: [kind: Skate, name: string][] = [
  ["none", "as captured"],
  ["drift", "with a drift"],
  ["blend", "with a blended shift"],
];

/** @param starting the starting oracle for each clip, none of which has seen that clip. */
export function clean(
  figures: Figure[],
  starting: readonly Oracle[],
  progress: (text: string) => void,
): void {
  const clips = labelledClips();
  for (const [kind, name] of KINDS) {
    progress(`contacts: clean, ${name} ...`);
    const before: number[] = [];
    const byHand: number[] = [];
    const byOracle: number[] = [];
    const pops = { before: 0, byHand: 0, byOracle: 0 };
    const edges = { all: 0, kept: 0 };
    clips.forEach((c, i) => {
      const file = skating(parseBvh(c.text, c.name), kind, i + 1);
      const { clip } = importBvhFile(file);
      const asked = (motion: Clip): Uint8Array =>
        atSourceRate(askOracle(starting[i], trackOf(motion)).labels, c);
      const hand = cleanBvh(file, clip, c.labels).file;
      const oracle = cleanBvh(file, clip, askOracle(starting[i], trackOf(clip)).labels).file;
      before.push(...plantSlides(file, clip, c.labels));
      byHand.push(...plantSlides(hand, clip, c.labels));
      byOracle.push(...plantSlides(oracle, clip, c.labels));
      const cleaned = importBvhFile(oracle).clip;
      pops.before = Math.max(pops.before, popping(clip));
      pops.byHand = Math.max(pops.byHand, popping(importBvhFile(hand).clip));
      pops.byOracle = Math.max(pops.byOracle, popping(cleaned));
      countEdges(edges, asked(c.clip), asked(cleaned));
    });
    for (const [who, values, popped] of [
      ["labels by hand", byHand, pops.byHand],
      ["starting oracle", byOracle, pops.byOracle],
    ] as const) {
      const add = (what: string, unit: string, value: number, goal: number, was: number): void => {
        const f = figure(
          `contacts, clean, ${name}, ${who}: ${what}`,
          unit,
          [value],
          `<= ${goal}`,
          (v) => v <= goal,
        );
        f.peer = "before";
        f.peerMedian = was;
        f.ratio = f.median / f.peerMedian;
        figures.push(f);
      };
      add("slide of a plant, p95", "mm", slideP95(values), 2, slideP95(before));
      add("popping", "", popped, 1.5, pops.before);
    }
    figures.push(
      figure(
        `contacts, clean, ${name}, starting oracle: begins and ends of plants within a frame of the capture's`,
        "%",
        [(100 * edges.kept) / edges.all],
        ">= 95 %",
        (v) => v >= 95,
      ),
    );
  }
}

const popping = (clip: Clip): number => {
  const yaws = Float64Array.from({ length: clip.frames }, (_, f) =>
    quatYaw(clip.rotations, 4 * JOINT_COUNT * f),
  );
  const { kind } = paceOf(clip.root, yaws, clip.frames, clip.rate);
  const found = poppingOf(clip.rotations, clip.frames, kind);
  if (!found) throw new Error(`${clip.name} is too short to judge.`);
  return found.popping;
};

/** Begins and ends of plants of the capture, and those that the cleaned motion has within one of the source's frames. */
function countEdges(to: { all: number; kept: number }, captured: Uint8Array, cleaned: Uint8Array): void {
  const changes = (labels: Uint8Array, bit: number, f: number): number =>
    f < 1 || f >= labels.length ? 0 : ((labels[f] >> bit) & 1) - ((labels[f - 1] >> bit) & 1);
  for (let bit = 0; bit < 4; bit++) {
    for (let f = 1; f < captured.length; f++) {
      const way = changes(captured, bit, f);
      if (way === 0) continue;
      to.all++;
      if ([f - 1, f, f + 1].some((g) => changes(cleaned, bit, g) === way)) to.kept++;
    }
  }
}
