/**
 * Motion quality over a fixed set of scenes of all the systems: every figure of docs/quality.md for the example scenes (tasks,
 * paths, stones, crowds), an obstacle course, stairs, and paths in all styles, beside what real captures of walking score (their 95th percentile) and
 * the goal.
 */

import { bakeLibrary } from "../../src/core/blending/library.ts";
import { crowdOfScene } from "../../src/core/crowd/from-scene.ts";
import { type CrowdMotion, createCrowdMotion, moveCrowd } from "../../src/core/crowd/motion.ts";
import { wholeChunk } from "../../src/core/motion/chunk.ts";
import type { MotionChunk, QualityFigures } from "../../src/core/motion/types.ts";
import { planWhole } from "../../src/core/motion/whole-scene.ts";
import { measureMotion } from "../../src/core/quality/measure.ts";
import { parseScene } from "../../src/core/scene/schema.ts";
import type { Scene } from "../../src/core/scene/types.ts";
import { JOINT_COUNT } from "../../src/core/skeleton/joints.ts";
import { createSkeleton } from "../../src/core/skeleton/skeleton.ts";
import type { Foot, Footstep } from "../../src/core/steps/types.ts";
import { goalsOf } from "../../src/core/tasks/plan-scene.ts";
import type { Plan, PlannedStep } from "../../src/core/tasks/plan-types.ts";
import { retargetLibrary } from "../../src/core/templates/retarget-library.ts";
import { EXAMPLES } from "../../src/editor/examples.ts";
import { cyclicSources } from "../../src/studio/blend-library.ts";
import { styleFamilies } from "../../src/studio/style-families.ts";
import { STYLES } from "../../src/studio/styles.ts";
import { studio } from "../support/library.ts";
import { courseScene, stairsScene } from "../support/stone-scenes.ts";
import type { BenchModule, Figure } from "./types.ts";

const Q = 4 * JOINT_COUNT;

type Row = { name: string; quality: QualityFigures };

interface Judged {
  name: string;
  unit: string;
  of: (q: QualityFigures) => number | null;
  /** What real walks score: their 95th percentile, or the 5th where more is better. */
  real: number | null;
  goal: string | null;
  ok: (v: number) => boolean;
}

const JUDGED: readonly Judged[] = [
  { name: "skate", unit: "mm", of: (q) => q.skate, real: 14.9, goal: "<= 4 mm", ok: (v) => v <= 4 },
  { name: "skate flat", unit: "mm", of: (q) => q.skateFlat, real: 6.8, goal: "<= 2 mm", ok: (v) => v <= 2 },
  {
    name: "penetration",
    unit: "mm",
    of: (q) => q.penetration,
    real: 1.3,
    goal: "<= 3 mm",
    ok: (v) => v <= 3,
  },
  { name: "float", unit: "mm", of: (q) => q.float, real: 7.5, goal: "<= 5 mm", ok: (v) => v <= 5 },
  { name: "reach", unit: "mm", of: (q) => q.reach, real: null, goal: "<= 5 mm", ok: (v) => v <= 5 },
  {
    name: "footsteps",
    unit: "mm",
    of: (q) => q.footstepError?.position ?? null,
    real: null,
    goal: "<= 1 mm",
    ok: (v) => v <= 1,
  },
  {
    name: "out of range",
    unit: "frames",
    of: (q) => q.limitViolations,
    real: 0,
    goal: "<= 0 frames",
    ok: (v) => v <= 0,
  },
  { name: "popping", unit: "", of: (q) => q.popping, real: 1.8, goal: "<= 1.5", ok: (v) => v <= 1.5 },
  {
    name: "popping per joint",
    unit: "",
    of: (q) => q.poppingOwn,
    real: 1.75,
    goal: "<= 1.75",
    ok: (v) => v <= 1.75,
  },
  {
    name: "jerk",
    unit: "",
    of: (q) => q.jerk,
    real: 2.3,
    goal: "0.7 to 1.4",
    ok: (v) => v >= 0.7 && v <= 1.4,
  },
  {
    name: "balance within 5 cm",
    unit: "",
    of: (q) => q.balanceWithin50mm,
    real: 0.69,
    goal: ">= 0.69",
    ok: (v) => v >= 0.69,
  },
  { name: "missed plants", unit: "", of: (q) => q.missedPlants, real: 0, goal: "<= 0", ok: (v) => v <= 0 },
];

const cycles = cyclicSources();

/** A scene's tasks, paths and stones in their order, as the page plans them. @throws Error when nobody takes a step in it. */
function ofScene(name: string, scene: Scene): QualityFigures {
  const { height, proportions } = scene.character;
  const skeleton = createSkeleton(height, proportions);
  const library = retargetLibrary(studio().library, skeleton);
  const { plan, clip, contacts } = planWhole(scene, skeleton, {
    library: () => library,
    families: (styles) => styleFamilies(styles, skeleton),
    blends: () => bakeLibrary(cycles, skeleton),
    cache: new Map(),
  });
  if (plan.steps.length === 0) throw new Error(`${name}: there is no motion to judge.`);
  return measureMotion(skeleton, [wholeChunk(clip, contacts)], clip.frames, plan, goalsOf(scene));
}

/** Seconds of a crowd that are judged, and how many of its walkers. */
const CROWD_SECONDS = 12;
const CROWD_WALKERS = 4;

/** The first walkers of a crowd, each judged as one character on level ground; of every figure the worst. */
function ofCrowd(name: string, scene: Scene): QualityFigures {
  const skeleton = createSkeleton(scene.character.height, scene.character.proportions);
  const m = createCrowdMotion(crowdOfScene(scene, name), bakeLibrary(cycles, skeleton));
  const frames = CROWD_SECONDS * 60;
  const walkers = Math.min(CROWD_WALKERS, m.body.count);
  const chunks: MotionChunk[] = Array.from({ length: walkers }, () => ({
    first: 0,
    frames: 0,
    root: new Float32Array(3 * frames),
    rotations: new Float32Array(Q * frames),
    contacts: new Uint8Array(frames),
  }));
  for (let f = 0; f < frames; f++) {
    while (!moveCrowd(m, f / 60, 400));
    chunks.forEach((c, i) => {
      // Who has arrived is taken away.
      if (m.session.gone[i] <= f / 60) return;
      c.frames = f + 1;
      c.root.set(m.body.root.subarray(3 * i, 3 * i + 3), 3 * f);
      c.rotations.set(m.body.rotations.subarray(Q * i, Q * i + Q), Q * f);
      c.contacts[f] = m.body.contacts[i];
    });
  }
  const all = chunks.map((c, i) =>
    measureMotion(skeleton, [c], c.frames, walkedPlan(m, i, c.frames / 60), []),
  );
  const worst = (of: (q: QualityFigures) => number | null): number | null =>
    all.reduce<number | null>((most, q) => {
      const v = of(q);
      return v === null ? most : Math.max(most ?? v, v);
    }, null);
  const position = worst((q) => q.footstepError?.position ?? null);
  return {
    ...all[0],
    skate: worst((q) => q.skate),
    skateFlat: worst((q) => q.skateFlat),
    penetration: worst((q) => q.penetration),
    float: worst((q) => q.float),
    footstepError:
      position === null ? null : { position, yaw: worst((q) => q.footstepError?.yaw ?? null) ?? 0 },
    limitViolations: worst((q) => q.limitViolations) ?? 0,
    popping: worst((q) => q.popping),
    poppingOwn: worst((q) => q.poppingOwn),
    jerk: worst((q) => q.jerk),
    balanceWithin50mm: Math.min(...all.map((q) => q.balanceWithin50mm ?? 1)),
    missedPlants: worst((q) => q.missedPlants),
  };
}

/** What one walker of a crowd has planned, as a character's plan. @throws Error when it takes no step. */
function walkedPlan(m: CrowdMotion, agent: number, seconds: number): Plan {
  const own = m.session.footsteps.map((f) => f.step).filter((s) => s.agent === agent && s.land < seconds);
  const steps = own.flatMap((s): PlannedStep[] =>
    s.lift === null
      ? []
      : [
          {
            foot: s.side > 0 ? "left" : "right",
            x: s.x,
            y: 0,
            z: s.z,
            yaw: s.yaw,
            category: "Walk",
            phase: "locomotion",
            task: -1,
            template: null,
            clip: -1,
            step: -1,
            lift: s.lift,
            land: s.land,
          },
        ],
  );
  if (steps.length === 0) throw new Error(`walker ${agent + 1} takes no step: there is nothing to judge.`);
  const stand = (foot: Foot): Footstep => ({ foot, x: 0, y: 0, z: 0, yaw: 0 });
  return {
    start: [stand("left"), stand("right")],
    steps,
    segments: [],
    tasks: [],
    duration: seconds,
    candidates: [],
    traces: [],
    warnings: [],
  };
}

const circle = Array.from({ length: 17 }, (_, i) => {
  const a = (2 * Math.PI * i) / 16;
  return [2.2 - 2.2 * Math.cos(a), 2.2 * Math.sin(a)];
});
const wave = Array.from({ length: 25 }, (_, i) => [0.7 * Math.sin(i / 2.2), 0.4 * i]);

/** One path a style on a wave, a circle, and three styles on one path. */
function pathScenes(): { name: string; scene: Scene }[] {
  const scene = (points: number[][], styles: { at: number; style: string }[]) =>
    parseScene({ version: 1, paths: [{ id: "p", points, styles }] });
  return [
    ...STYLES.map((s) => ({ name: `wave, ${s}`, scene: scene(wave, [{ at: 0, style: s }]) })),
    { name: "circle, walking", scene: scene(circle, [{ at: 0, style: "walking" }]) },
    {
      name: "wave, three styles",
      scene: scene(wave, [
        { at: 0, style: "walking" },
        { at: 0.35, style: "energetic" },
        { at: 0.7, style: "tired" },
      ]),
    },
  ];
}

const bench: BenchModule = {
  name: "quality",
  async run(options) {
    const rows: Row[] = [];
    for (const e of EXAMPLES) {
      options.progress(`quality: ${e.name}`);
      const scene = e.scene();
      rows.push({ name: e.name, quality: scene.crowd ? ofCrowd(e.name, scene) : ofScene(e.name, scene) });
    }
    for (const p of [
      { name: "Obstacle course", scene: courseScene() },
      { name: "Stairs", scene: stairsScene() },
      ...pathScenes(),
    ]) {
      options.progress(`quality: ${p.name}`);
      rows.push({ name: p.name, quality: ofScene(p.name, p.scene) });
    }
    return rows.flatMap((r) =>
      JUDGED.flatMap((j): Figure[] => {
        const v = j.of(r.quality);
        // Runs have no balance to keep [docs/quality.md].
        if (v === null || (j.name.startsWith("balance") && r.name.includes("jogging"))) return [];
        return [
          {
            name: `${r.name}: ${j.name}`,
            unit: j.unit,
            median: v,
            min: v,
            max: v,
            n: 1,
            peer: j.real === null ? null : "real walks",
            peerMedian: j.real,
            ratio: j.real ? v / j.real : null,
            goal: j.goal,
            ok: j.goal === null ? null : j.ok(v),
          },
        ];
      }),
    );
  },
};

export default bench;
