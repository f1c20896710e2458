/** Clean-up judged by hand-checked labels: slides of plants before and after, as captured and with injected skate. */
import { parseBvh } from "../../src/core/capture/bvh-parse.ts";
import { importBvhFile } from "../../src/core/capture/import.ts";
import { cleanBvh } from "../../src/core/cleanup/clean-bvh.ts";
import { plantSlides, slideP95 } from "../../src/core/cleanup/slides.ts";
import { trackOf } from "../../src/core/contacts/motion-track.ts";
import { askOracle, type Oracle } from "../../src/core/contacts/oracle.ts";
import { labelledClips, type Skate, skating } from "../support/labelled.ts";
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
    clips.forEach((c, i) => {
      const file = skating(parseBvh(c.text, c.name), kind, i + 1);
      const { clip } = importBvhFile(file);
      before.push(...plantSlides(file, clip, c.labels));
      byHand.push(...plantSlides(cleanBvh(file, clip, c.labels).file, clip, c.labels));
      const { labels } = askOracle(starting[i], trackOf(clip));
      byOracle.push(...plantSlides(cleanBvh(file, clip, labels).file, clip, c.labels));
    });
    for (const [who, values] of [
      ["labels by hand", byHand],
      ["starting oracle", byOracle],
    ] as const) {
      const f = figure(
        `contacts, clean, ${name}, ${who}: slide of a plant, p95`,
        "mm",
        [slideP95(values)],
        "<= 2 mm",
        (v) => v <= 2,
      );
      f.peer = "before";
      f.peerMedian = slideP95(before);
      f.ratio = f.median / f.peerMedian;
      figures.push(f);
    }
  }
}
