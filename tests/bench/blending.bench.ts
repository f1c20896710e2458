/**
 * Cost of footstep-parameterised blending a character and frame, beside three's AnimationMixer on the same skeleton and
 * clips in the same run; of choosing a step; and how flat it stays as the crowd grows.
 */
import {
  AnimationClip,
  AnimationMixer,
  Bone,
  Object3D,
  QuaternionKeyframeTrack,
  Skeleton,
  VectorKeyframeTrack,
} from "three";
import { type BlendCrowd, createBlendCrowd } from "../../src/core/blending/crowd.ts";
import { createLocated, locate } from "../../src/core/blending/foot-space.ts";
import type { BlendLibrary } from "../../src/core/blending/library.ts";
import { bakeLibrary } from "../../src/core/blending/library.ts";
import { createChoice, createMix } from "../../src/core/blending/mix.ts";
import { rootWeights } from "../../src/core/blending/polar-bands.ts";
import { createStepQuery, queryStep } from "../../src/core/blending/step-query.ts";
import type { CyclicSource } from "../../src/core/blending/types.ts";
import { createRandom } from "../../src/core/math/random.ts";
import { JOINT_COUNT, JOINT_NAMES, PARENTS } from "../../src/core/skeleton/joints.ts";
import { createSkeleton } from "../../src/core/skeleton/skeleton.ts";
import { figureLines } from "../../src/plots/figure-lines.ts";
import { cyclicSources } from "../../src/studio/blend-library.ts";
import { figure, median } from "./measure.ts";
import type { BenchModule, Figure } from "./types.ts";

/** Characters; 60 and 100 as the paper tells them. */
const SIZES = [10, 60, 100, 1000, 2000];
/** What the paper states, drawing included, by number of characters [Barycentric §7]: frames a second. */
const PAPER_RATES: [number, number][] = [
  [60, 25],
  [100, 13],
];
const PEER = "three AnimationMixer, two clips, no inverse kinematics";
const FRAME = 1 / 60;

/** Characters walking each at its own pace, its footsteps always two ahead. */
function walkers(library: BlendLibrary, n: number): { crowd: BlendCrowd; feed(): void } {
  const crowd = createBlendCrowd(library, n);
  const next = new Float64Array(n);
  const way = new Float64Array(n);
  const side = new Uint8Array(n);
  for (let i = 0; i < n; i++) {
    crowd.add({ x: 2 * (i % 50), z: 0, yaw: 0 });
    next[i] = 0.3 + 0.5 * ((i * 0.618) % 1);
  }
  return {
    crowd,
    feed() {
      for (let i = 0; i < n; i++) {
        const quick = (i * 0.377) % 1;
        while (crowd.queueCount[i] < 3) {
          const time = 0.62 - 0.1 * quick;
          way[i] += 0.45 + 0.4 * quick;
          crowd.push(i, {
            foot: side[i] === 0 ? "left" : "right",
            x: 2 * (i % 50) + (side[i] === 0 ? 0.08 : -0.08),
            y: 0,
            z: way[i],
            yaw: 0,
            lift: next[i],
            land: next[i] + 0.7 * time,
          });
          next[i] += time;
          side[i] = 1 - side[i];
        }
      }
    },
  };
}

/** Microseconds a character and frame, a number a round. */
function blendCost(library: BlendLibrary, n: number, rounds: number): number[] {
  const { crowd, feed } = walkers(library, n);
  const frames = Math.max(20, Math.ceil(20_000 / n));
  const out: number[] = [];
  for (let round = -2; round < rounds; round++) {
    let ms = 0;
    for (let f = 0; f < frames; f++) {
      feed();
      const t = performance.now();
      crowd.update(FRAME);
      ms += performance.now() - t;
    }
    if (round >= 0) out.push((1000 * ms) / frames / n);
  }
  return out;
}

/** Two of the clips as three's, on the same bones. */
function mixerClips(sources: readonly CyclicSource[]): AnimationClip[] {
  return sources.slice(1, 3).map((s) => {
    const { frames, rate, rotations, root } = s.clip;
    const times = Float32Array.from({ length: frames }, (_, f) => f / rate);
    const tracks = JOINT_NAMES.map(
      (name, j) =>
        new QuaternionKeyframeTrack(
          `${name}.quaternion`,
          times,
          Float32Array.from(
            { length: 4 * frames },
            (_, k) => rotations[4 * (JOINT_COUNT * (k >> 2) + j) + (k & 3)],
          ),
        ),
    );
    return new AnimationClip(s.name, frames / rate, [
      new VectorKeyframeTrack("hips.position", times, Float32Array.from(root)),
      ...tracks,
    ]);
  });
}

function mixerCost(clips: readonly AnimationClip[], n: number, rounds: number): number[] {
  const { offsets } = createSkeleton(1.75);
  const all = Array.from({ length: n }, (_, i) => {
    const holder = new Object3D();
    const bones = JOINT_NAMES.map((name, j) => {
      const bone = new Bone();
      bone.name = name;
      bone.position.set(offsets[3 * j], offsets[3 * j + 1], offsets[3 * j + 2]);
      return bone;
    });
    bones.forEach((b, j) => {
      if (j === 0) holder.add(b);
      else bones[PARENTS[j]].add(b);
    });
    const mixer = new AnimationMixer(holder);
    clips.forEach((c, k) => {
      const action = mixer.clipAction(c);
      action.weight = k === 0 ? 0.4 : 0.6;
      action.time = ((i * 0.618) % 1) * c.duration;
      action.play();
    });
    return { holder, mixer, skeleton: new Skeleton(bones) };
  });
  const frames = Math.max(4, Math.ceil(4000 / n));
  const out: number[] = [];
  for (let round = -1; round < rounds; round++) {
    const t = performance.now();
    for (let f = 0; f < frames; f++)
      for (const c of all) {
        c.mixer.update(FRAME);
        c.holder.updateMatrixWorld(true);
        c.skeleton.update();
      }
    if (round >= 0) out.push((1000 * (performance.now() - t)) / frames / n);
  }
  return out;
}

/** Microseconds a call. */
function callCost(rounds: number, calls: number, call: (k: number) => void): number[] {
  const out: number[] = [];
  for (let round = -2; round < rounds; round++) {
    const t = performance.now();
    for (let k = 0; k < calls; k++) call(k);
    if (round >= 0) out.push((1000 * (performance.now() - t)) / calls);
  }
  return out;
}

function selection(library: BlendLibrary): Figure[] {
  const r = createRandom(3);
  const queries = Float64Array.from({ length: 4096 }, (_, k) =>
    k % 2 === 0 ? r.between(-0.1, 0.3) : r.between(-0.3, 1.4),
  );
  const located = createLocated();
  const triangle = callCost(9, 40_000, (k) => {
    const q = 2 * (k & 2047);
    locate(located, library.feet[k & 1], queries[q], queries[q + 1], located.triangle);
  });
  const weights = new Float64Array(library.names.length);
  const bands = callCost(9, 20_000, (k) => {
    const q = 2 * (k & 2047);
    rootWeights(weights, library.root, queries[q], queries[q + 1], 0.2 * queries[q]);
  });
  const query = createStepQuery();
  const mix = createMix();
  const choice = createChoice();
  const whole = callCost(9, 10_000, (k) => {
    const side = k & 1;
    query.side = side;
    query.from.x = side === 0 ? 0.08 : -0.08;
    query.from.z = -0.5 - 0.1 * queries[2 * (k & 2047)];
    query.support.x = side === 0 ? -0.08 : 0.08;
    query.target.x = query.from.x + 0.2 * queries[2 * (k & 2047)];
    query.target.z = 0.5 + 0.1 * queries[2 * (k & 2047) + 1];
    query.since = 0.56;
    query.air = 0.4;
    queryStep(query, mix, choice, library, weights);
  });
  return [
    figure(
      "blending, triangle and weights of a step",
      "us",
      triangle,
      "<= 1 us (the paper: 45)",
      (v) => v <= 1,
    ),
    figure("blending, polar bands of a step", "us", bands, "<= 5 us (the paper: 155)", (v) => v <= 5),
    figure("blending, a whole step chosen, bands included", "us", whole, "<= 10 us", (v) => v <= 10),
  ];
}

const bench: BenchModule = {
  name: "blending",
  async run(options) {
    options.progress("blending: clips ...");
    const sources = cyclicSources();
    const library = bakeLibrary(sources, createSkeleton(1.75));
    const clips = mixerClips(sources);
    const out: Figure[] = [...selection(library)];
    const costs = new Map<number, number[]>();
    const peers = new Map<number, number>();
    for (const n of SIZES) {
      options.progress(`blending: ${n} characters ...`);
      costs.set(n, blendCost(library, n, 9));
      peers.set(n, median(mixerCost(clips, n, 5)));
    }
    for (const n of SIZES) {
      const own = costs.get(n) ?? [];
      const peer = peers.get(n) ?? Number.NaN;
      const f = figure(`blending, a frame of one of ${n} characters`, "us", own, null, () => true);
      f.peer = PEER;
      f.size = n;
      f.peerMedian = peer;
      f.ratio = f.median / peer;
      if (n === 1000) {
        f.goal = "ratio <= 0.167";
        f.ok = f.ratio <= 1 / 6;
      }
      out.push(f);
    }
    const medians = SIZES.map((n) => median(costs.get(n) ?? []));
    out.push(
      figure(
        "blending, a character and frame of 1,000",
        "us",
        costs.get(1000) ?? [],
        "<= 5 us",
        (v) => v <= 5,
      ),
      figure(
        "blending, dearest over cheapest of 10 to 2,000 characters",
        "",
        [Math.max(...medians) / Math.min(...medians)],
        "<= 1.2",
        (v) => v <= 1.2,
      ),
      figure(
        "blending, 1,000 characters at 60 updates a second",
        "ms a frame",
        (costs.get(1000) ?? []).map((v) => v),
        "<= 16.7 ms: one worker",
        (v) => v <= 16.7,
      ),
    );
    return out;
  },
  plots(figures) {
    const sized = figures.filter((f) => f.size !== undefined) as (Figure & { size: number })[];
    const own = sized.map((f): [number, number] => [f.size, f.median]);
    const peer = sized.map((f): [number, number] => [f.size, f.peerMedian ?? Number.NaN]);
    const rates = (costs: [number, number][]) =>
      costs.map(([n, us]): [number, number] => [n, 1e6 / (n * us)]);
    return {
      "cost-by-size": figureLines(
        [
          { name: "Stepwright", points: own },
          { name: "three AnimationMixer", points: peer },
        ],
        "A character's frame, by the size of the crowd",
        "characters",
        "microseconds a character and frame",
      ),
      "frame-rates": figureLines(
        [
          { name: "Stepwright, motion alone", points: rates(own) },
          { name: "AnimationMixer, motion alone", points: rates(peer) },
          { name: "the paper, drawn", points: PAPER_RATES, loose: true },
        ],
        "Frames a second, as in Barycentric, Figure 9",
        "characters",
        "frames a second",
      ),
    };
  },
};

export default bench;
