/** Active learning against random choice: how much of a pool must be labelled to do as well as with all of it [Oracle §5]. */
import { mkdirSync, writeFileSync } from "node:fs";
import { rankSegments, type Segment } from "../../src/core/contacts/active-learning.ts";
import { trackOf } from "../../src/core/contacts/motion-track.ts";
import { askOracle, type LabelledTrack, OWN_ORACLE, trainOracle } from "../../src/core/contacts/oracle.ts";
import { createRandom } from "../../src/core/math/random.ts";
import { learningCurve } from "../../src/plots/learning-curve.ts";
import { addScore, emptyScore } from "../support/contact-score.ts";
import { atSourceRate, labelledClips } from "../support/labelled.ts";
import { figure } from "./measure.ts";
import type { Figure } from "./types.ts";

/** Frames a segment here: the pool is short, 200 would be ten segments. */
const SEGMENT = 40;
/** Shares of the pool at which both are compared. */
const SHARES = [0.05, 0.1, 0.17, 0.25, 0.333, 0.5, 0.75, 1];
const SEEDS = [1, 2, 3];

export function learning(figures: Figure[], progress: (text: string) => void): void {
  const clips = labelledClips();
  const all = clips.map((c) => ({ track: trackOf(c.clip), labels: c.labels }));
  const accuracyAt = (choose: (pool: readonly LabelledTrack[], i: number) => Iterable<Segment>): number[] => {
    const right = SHARES.map(() => 0);
    let labels = 0;
    clips.forEach((c, i) => {
      const pool = all.filter((_, j) => j !== i);
      const masks = pool.map((p) => new Uint8Array(p.track.frames));
      const frames = pool.reduce((n, p) => n + p.track.frames, 0);
      let known = 0;
      let next = 0;
      for (const s of choose(pool, i)) {
        masks[s.motion].fill(1, s.first, s.last);
        known += s.last - s.first;
        while (next < SHARES.length && known >= SHARES[next] * frames - 1) {
          const oracle = trainOracle(labelledOf(pool, masks));
          const score = emptyScore();
          addScore(score, atSourceRate(askOracle(oracle, all[i].track).labels, c), c.truth);
          right[next++] += score.right;
          if (next === 1) labels += score.all;
        }
        if (next === SHARES.length) break;
      }
    });
    return right.map((r) => (100 * r) / labels);
  };
  const byDistance = SEEDS.map((seed) => {
    progress(`contacts: most foreign first, seed ${seed} ...`);
    return accuracyAt((pool, i) => mostForeign(pool, shuffled(segmentsOf(pool), 10 * seed + i)[0]));
  });
  const random = SEEDS.map((seed) => {
    progress(`contacts: random choice, seed ${seed} ...`);
    return accuracyAt((pool, i) => shuffled(segmentsOf(pool), 10 * seed + i));
  });
  const meanOf = (runs: readonly number[][]): number[] =>
    SHARES.map((_, k) => runs.reduce((a, r) => a + r[k], 0) / runs.length);
  const active = meanOf(byDistance);
  const mean = meanOf(random);
  SHARES.forEach((share, k) => {
    const f = figure(
      `contacts, active learning, ${Math.round(100 * share)} % of the labels: right`,
      "%",
      [active[k]],
      share === 0.333 ? "within 1 % of all labels" : null,
      (v) => v >= active[SHARES.length - 1] - 1,
    );
    f.peer = "segments chosen at random";
    f.peerMedian = mean[k];
    f.ratio = f.median / mean[k];
    figures.push(f);
  });
  const points = (values: readonly number[]): [number, number][] =>
    SHARES.map((s, k) => [100 * s, values[k]]);
  mkdirSync("artefacts", { recursive: true });
  const svg = learningCurve({
    width: 640,
    height: 280,
    range: [Math.floor(Math.min(...active, ...mean) / 5) * 5, 100],
    xName: "labelled, %",
    last: "",
    finding: `With a third of the labels the active choice is right in ${active[4].toFixed(1)} % of labels, a random choice in ${mean[4].toFixed(1)} %, all labels in ${active[7].toFixed(1)} %.`,
    series: [
      { name: "most foreign", dashed: false, points: points(active) },
      { name: "at random", dashed: true, points: points(mean) },
    ],
  });
  writeFileSync("artefacts/oracle-learning.svg", `${svg}\n`);
}

function labelledOf(pool: readonly LabelledTrack[], masks: readonly Uint8Array[]): LabelledTrack[] {
  return pool.flatMap((p, k) => (masks[k].includes(1) ? [{ ...p, mask: masks[k] }] : []));
}

function segmentsOf(pool: readonly LabelledTrack[]): Segment[] {
  return pool.flatMap((p, motion) =>
    Array.from({ length: Math.ceil(p.track.frames / SEGMENT) }, (_, k) => ({
      motion,
      first: k * SEGMENT,
      last: Math.min(p.track.frames, (k + 1) * SEGMENT),
      foreign: 0,
    })),
  );
}

/** A segment chosen at random, then always the one that holds what is known least [Oracle §5]. */
function* mostForeign(pool: readonly LabelledTrack[], first: Segment): Iterable<Segment> {
  const masks = pool.map((p) => new Uint8Array(p.track.frames));
  let segment: Segment | undefined = first;
  while (segment) {
    masks[segment.motion].fill(1, segment.first, segment.last);
    yield segment;
    const oracle = trainOracle(labelledOf(pool, masks), OWN_ORACLE);
    segment = rankSegments(
      oracle,
      pool.map((p) => p.track),
      SEGMENT,
    ).find((s) => masks[s.motion][s.first] === 0);
  }
}

function shuffled(segments: Segment[], seed: number): Segment[] {
  const r = createRandom(seed);
  for (let i = segments.length - 1; i > 0; i--) {
    const j = r.below(i + 1);
    [segments[i], segments[j]] = [segments[j], segments[i]];
  }
  return segments;
}
