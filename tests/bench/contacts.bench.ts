/** Contact labels on hand-checked captures, each left out in turn: the oracle beside thresholds, plain and drifting; and its speed. */
import { detectContacts } from "../../src/core/contacts/baselines.ts";
import { HABIT, type Habit, learnHabit } from "../../src/core/contacts/convention.ts";
import { featureSize, featuresOf } from "../../src/core/contacts/features.ts";
import { trackOf } from "../../src/core/contacts/motion-track.ts";
import { createNearestIndex, createNearestSearch, findNearest } from "../../src/core/contacts/nearest.ts";
import {
  askOracle,
  type Oracle,
  type OracleOptions,
  OWN_ORACLE,
  PAPER_ORACLE,
  trainOracle,
} from "../../src/core/contacts/oracle.ts";
import { startingLessons, startingOracle } from "../../src/studio/starting-oracle.ts";
import { addScore, emptyScore } from "../support/contact-score.ts";
import { atSourceRate, drifting, type LabelledClip, labelledClips } from "../support/labelled.ts";
import { studio } from "../support/library.ts";
import { hasShared } from "../support/shared.ts";
import { countStrikes, strikeClips } from "../support/strikes.ts";
import { clean } from "./contacts-clean.ts";
import { learning } from "./contacts-learning.ts";
import { figure, median } from "./measure.ts";
import type { BenchModule, Figure } from "./types.ts";

const bench: BenchModule = {
  name: "contacts",
  async run(options) {
    const figures: Figure[] = [];
    if (hasShared) {
      const starting = startingOracles();
      accuracy(figures, starting, options.progress);
      clean(figures, starting.each, options.progress);
      learning(figures, options.progress);
    } else options.progress("contacts: no hand-checked captures beside the repository.");
    speed(figures);
    return figures;
  },
};

/** Labels of a clip: which of the hand-checked ones it is, or null for a clip of others. */
type Labeller = (clip: LabelledClip["clip"], i: number | null) => Uint8Array;

interface Row {
  name: string;
  label: Labeller;
  /** Held to the goals. */
  judged?: boolean;
  /** A row of [Oracle Table 1]: only labels are counted. */
  table?: boolean;
}

/** Starting oracles that answer as those label whom the other clips show: one for each clip, and one of all for clips of others. */
function startingOracles(): { each: Oracle[]; all: Oracle } {
  const lessons = startingLessons();
  const exact = startingOracle(null, lessons);
  const pairs = labelledClips().map((c) => ({
    exact: askOracle(exact, trackOf(c.clip)).labels,
    labels: c.labels,
  }));
  const made = new Map<string, Oracle>();
  const ofHabit = (habit: Habit): Oracle => {
    const key = JSON.stringify(habit);
    const oracle = made.get(key) ?? startingOracle(habit, lessons);
    made.set(key, oracle);
    return oracle;
  };
  const all = learnHabit(pairs);
  if (JSON.stringify(all) !== JSON.stringify(HABIT))
    throw new Error(`The habit that ships is not what the captures show: ${JSON.stringify(all)}.`);
  return {
    each: pairs.map((_, i) => ofHabit(learnHabit(pairs.filter((__, j) => j !== i)))),
    all: ofHabit(all),
  };
}

function accuracy(
  figures: Figure[],
  starting: { each: Oracle[]; all: Oracle },
  progress: (text: string) => void,
): void {
  const clips = labelledClips();
  const tracks = clips.map((c) => ({ track: trackOf(c.clip), labels: c.labels }));
  const leftOut = (o: OracleOptions): Labeller => {
    const oracles = clips.map((_, i) =>
      trainOracle(
        tracks.filter((_, j) => j !== i),
        o,
      ),
    );
    let all: Oracle | null = null;
    return (clip, i) => {
      if (i !== null) return askOracle(oracles[i], trackOf(clip)).labels;
      all ??= trainOracle(tracks, o);
      return askOracle(all, trackOf(clip)).labels;
    };
  };
  const paper = (change: Partial<OracleOptions>): Labeller => leftOut({ ...PAPER_ORACLE, ...change });
  const rows: Row[] = [
    { name: "height", label: (c) => detectContacts(c, "height") },
    { name: "speed", label: (c) => detectContacts(c, "speed") },
    { name: "height and speed", label: (c) => detectContacts(c, "both") },
    // [Oracle Table 1]: k, window, joints, one at a time.
    ...[1, 5, 10, 15, 20, 30, 40].map((k) => ({
      name: `paper's features, k ${k}`,
      label: paper({ k }),
      table: k !== 10,
    })),
    ...[1, 5, 15, 20, 30, 60].map((half) => ({
      name: `paper's features, window ${2 * half + 1}`,
      label: paper({ half }),
      table: true,
    })),
    { name: "paper's features and the root's place", label: paper({ set: "paper-root" }), table: true },
    { name: "paper's features without knees", label: paper({ set: "paper-knees" }), table: true },
    { name: "own features", label: leftOut(OWN_ORACLE), judged: true },
    {
      name: "own features, starting oracle",
      label: (c, i) => askOracle(i === null ? starting.all : starting.each[i], trackOf(c)).labels,
      judged: true,
    },
  ];
  const others = strikeClips();
  for (const { name, label, judged = false, table = false } of rows) {
    progress(`contacts: ${name} ...`);
    let plain = 0;
    for (const drift of table ? [false] : [false, true]) {
      const score = emptyScore();
      clips.forEach((c, i) => {
        addScore(score, atSourceRate(label(drift ? drifting(c.clip, i + 1) : c.clip, i), c), c.truth);
      });
      const tag = `contacts, ${name}${drift ? ", drifting" : ""}`;
      const add = (what: string, unit: string, value: number, goal: string, ok: boolean) =>
        figures.push(figure(`${tag}: ${what}`, unit, [value], judged ? goal : null, () => ok));
      const right = (100 * score.right) / score.all;
      if (!drift) plain = right;
      if (drift) add("labels", "%", right, "within 1 % of plain", right >= plain - 1);
      else add("labels", "%", right, ">= 95 %", right >= 95);
      if (table) continue;
      const away = (100 * score.rightAway) / score.allAway;
      add("away from boundaries", "%", away, ">= 99 %", away >= 99);
      const f1 = (2 * score.matched) / (score.found + score.true);
      add("plant F1", "", f1, drift ? ">= 0.98" : ">= 0.99", f1 >= (drift ? 0.98 : 0.99));
      add("flickers", "", score.flickers, "0", score.flickers === 0);
    }
    if (table) continue;
    const count = { matched: 0, plants: 0, strikes: 0 };
    for (const other of others) {
      const c = countStrikes(label(other.clip, null), other);
      count.matched += c.matched;
      count.plants += c.plants;
      count.strikes += c.strikes;
    }
    figures.push(
      figure(
        `contacts, ${name}, another skeleton: strike F1`,
        "",
        [(2 * count.matched) / (count.plants + count.strikes)],
        judged ? ">= 0.95" : null,
        (v) => v >= 0.95,
      ),
    );
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
