/** Contact labels on hand-checked captures, each left out in turn: the oracle beside thresholds, plain and drifting; and its speed. */
import { detectContacts } from "../../src/core/contacts/baselines.ts";
import { featureSize, featuresOf } from "../../src/core/contacts/features.ts";
import { trackOf } from "../../src/core/contacts/motion-track.ts";
import { createNearestIndex, createNearestSearch, findNearest } from "../../src/core/contacts/nearest.ts";
import {
  askOracle,
  type OracleOptions,
  OWN_ORACLE,
  PAPER_ORACLE,
  trainOracle,
} from "../../src/core/contacts/oracle.ts";
import { startingOracle } from "../../src/studio/starting-oracle.ts";
import { addScore, emptyScore } from "../support/contact-score.ts";
import { atSourceRate, drifting, type LabelledClip, labelledClips } from "../support/labelled.ts";
import { studio } from "../support/library.ts";
import { hasShared } from "../support/shared.ts";
import { figure, median } from "./measure.ts";
import type { BenchModule, Figure } from "./types.ts";

const bench: BenchModule = {
  name: "contacts",
  async run(options) {
    const figures: Figure[] = [];
    if (hasShared) accuracy(figures, options.progress);
    else options.progress("contacts: no hand-checked captures beside the repository.");
    speed(figures);
    return figures;
  },
};

function accuracy(figures: Figure[], progress: (text: string) => void): void {
  const clips = labelledClips();
  const tracks = clips.map((c) => ({ track: trackOf(c.clip), labels: c.labels }));
  type Labeller = (clip: LabelledClip["clip"], i: number) => Uint8Array;
  const leftOut = (o: OracleOptions): Labeller => {
    const oracles = clips.map((_, i) =>
      trainOracle(
        tracks.filter((_, j) => j !== i),
        o,
      ),
    );
    return (clip, i) => askOracle(oracles[i], trackOf(clip)).labels;
  };
  const start = startingOracle();
  const rows: [string, Labeller, boolean][] = [
    ["height", (c) => detectContacts(c, "height"), false],
    ["speed", (c) => detectContacts(c, "speed"), false],
    ["height and speed", (c) => detectContacts(c, "both"), false],
    ["plain kNN (paper's features, k 1)", leftOut({ ...PAPER_ORACLE, k: 1 }), false],
    ...[5, 10, 20].map((k): [string, Labeller, boolean] => [
      `paper's features, k ${k}`,
      leftOut({ ...PAPER_ORACLE, k }),
      false,
    ]),
    ...[5, 15].map((half): [string, Labeller, boolean] => [
      `paper's features, window ${2 * half + 1}`,
      leftOut({ ...PAPER_ORACLE, half }),
      false,
    ]),
    ["own features", leftOut(OWN_ORACLE), true],
    ["own features, starting oracle", (c) => askOracle(start, trackOf(c)).labels, false],
  ];
  for (const [name, label, judged] of rows) {
    progress(`contacts: ${name} ...`);
    for (const drift of [false, true]) {
      const score = emptyScore();
      clips.forEach((c, i) => {
        addScore(score, atSourceRate(label(drift ? drifting(c.clip, i + 1) : c.clip, i), c), c.truth);
      });
      const tag = `contacts, ${name}${drift ? ", drifting" : ""}`;
      const add = (what: string, unit: string, value: number, goal: string, least: number) =>
        figures.push(figure(`${tag}: ${what}`, unit, [value], judged ? goal : null, (v) => v >= least));
      add("labels", "%", (100 * score.right) / score.all, drift ? ">= 94 %" : ">= 95 %", drift ? 94 : 95);
      add(
        "away from boundaries",
        "%",
        (100 * score.rightAway) / score.allAway,
        drift ? ">= 98 %" : ">= 99 %",
        drift ? 98 : 99,
      );
      add("plant F1", "", (2 * score.matched) / (score.found + score.true), ">= 0.99", 0.99);
      figures.push(figure(`${tag}: flickers`, "", [score.flickers], judged ? "0" : null, (v) => v === 0));
    }
  }
}

/** 18,820 examples of 378 numbers, as in [Oracle §6], from the studio; queries from a capture that is not among them. */
function speed(figures: Figure[]): void {
  const { rendered } = studio();
  const size = featureSize(PAPER_ORACLE);
  const count = 18820;
  const data = new Float32Array(count * size);
  let filled = 0;
  for (const r of rendered.slice(1)) {
    const rows = featuresOf(trackOf(r.clip), PAPER_ORACLE);
    const take = Math.min(rows.length, data.length - filled);
    data.set(rows.subarray(0, take), filled);
    filled += take;
  }
  const queries = featuresOf(trackOf(rendered[0].clip), PAPER_ORACLE);
  const n = Math.min(600, queries.length / size);
  const index = createNearestIndex(data, count, size);
  const own: number[] = [];
  const cold: number[] = [];
  const plain: number[] = [];
  let same = 0;
  const search = createNearestSearch(index, 10);
  for (let round = 0; round < 2; round++) {
    for (let f = 0; f < n; f++) {
      let t = performance.now();
      findNearest(search, queries, f * size);
      if (round === 1) own.push(performance.now() - t);
      if (round === 0 || f % 20 !== 0) continue;
      const fresh = createNearestSearch(index, 10);
      t = performance.now();
      findNearest(fresh, queries, f * size);
      cold.push(performance.now() - t);
      t = performance.now();
      const found = bruteForce(data, count, size, queries, f * size);
      plain.push(performance.now() - t);
      if (found.every((e, i) => e === search.found[i] && e === fresh.found[i])) same++;
    }
  }
  const brute = median(plain);
  const add = (name: string, values: number[], goal: string, most: number) => {
    const f = figure(name, "ms", values, goal, (v) => v <= most);
    f.peer = "plain brute force";
    f.peerMedian = brute;
    f.ratio = f.median / brute;
    figures.push(f);
  };
  add("nearest neighbours, running", own, "<= 0.25 ms", 0.25);
  add("nearest neighbours, cold", cold, "<= 1.5 ms", 1.5);
  figures.push(
    figure(
      "nearest neighbours, same as brute force",
      "%",
      [(100 * same) / cold.length],
      "100 %",
      (v) => v === 100,
    ),
  );
}

function bruteForce(
  data: Float32Array,
  count: number,
  size: number,
  rows: Float32Array,
  at: number,
): number[] {
  const best: [number, number][] = [];
  for (let e = 0; e < count; e++) {
    let sum = 0;
    for (let k = 0; k < size; k++) {
      const d = data[e * size + k] - rows[at + k];
      sum += d * d;
    }
    if (best.length === 10 && sum >= best[9][0]) continue;
    if (best.length === 10) best.pop();
    best.push([sum, e]);
    best.sort((a, b) => a[0] - b[0] || a[1] - b[1]);
  }
  return best.map((x) => x[1]);
}

export default bench;
