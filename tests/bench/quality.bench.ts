/**
 * Motion quality over a fixed set of scenes: every figure of docs/quality.md for tasks and for paths in all styles, beside
 * what real captures of walking score (their 95th percentile) and the goal.
 */
import { beginSynthesis, synthesiseClip } from "../../src/core/motion/synthesise.ts";
import type { QualityFigures } from "../../src/core/motion/types.ts";
import { measureMotion } from "../../src/core/quality/measure.ts";
import { parseScene } from "../../src/core/scene/schema.ts";
import type { Scene } from "../../src/core/scene/types.ts";
import { createSkeleton } from "../../src/core/skeleton/skeleton.ts";
import { planPaths, stylesOf } from "../../src/core/styles/plan-paths.ts";
import { goalsOf, planScene } from "../../src/core/tasks/plan-scene.ts";
import { retargetLibrary } from "../../src/core/templates/retarget-library.ts";
import { EXAMPLES } from "../../src/editor/examples.ts";
import { styleFamilies } from "../../src/studio/style-families.ts";
import { STYLES } from "../../src/studio/styles.ts";
import { studio } from "../support/library.ts";
import type { BenchModule, Figure } from "./types.ts";

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
  { name: "jerk", unit: "", of: (q) => q.jerk, real: 2.3, goal: null, ok: () => true },
  { name: "missed plants", unit: "", of: (q) => q.missedPlants, real: 0, goal: "<= 0", ok: (v) => v <= 0 },
];

/** A scene of tasks: library, plan, motion, figures. */
function ofTasks(scene: Scene): QualityFigures {
  const { height, proportions } = scene.character;
  const skeleton = createSkeleton(height, proportions);
  const library = retargetLibrary(studio().library, skeleton);
  const goals = goalsOf(scene);
  const plan = planScene(scene, library, skeleton);
  const synthesis = beginSynthesis(library, skeleton, plan, goals, new Map());
  const clip = synthesiseClip(synthesis, "quality");
  return measureMotion(skeleton, [chunkOf(clip, synthesis.track.contacts)], clip.frames, plan, goals);
}

function ofPaths(scene: Scene): QualityFigures {
  const skeleton = createSkeleton(scene.character.height, scene.character.proportions);
  const { plan, motion } = planPaths(scene, skeleton, styleFamilies(stylesOf(scene), skeleton));
  return measureMotion(skeleton, [chunkOf(motion.clip, motion.contacts)], motion.clip.frames, plan, []);
}

const chunkOf = (
  clip: { frames: number; root: Float64Array; rotations: Float64Array },
  contacts: Uint8Array,
) => ({
  first: 0,
  frames: clip.frames,
  root: Float32Array.from(clip.root),
  rotations: Float32Array.from(clip.rotations),
  contacts,
});

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
      rows.push({ name: e.name, quality: scene.paths.length > 0 ? ofPaths(scene) : ofTasks(scene) });
    }
    for (const p of pathScenes()) {
      options.progress(`quality: ${p.name}`);
      rows.push({ name: p.name, quality: ofPaths(p.scene) });
    }
    return rows.flatMap((r) =>
      JUDGED.flatMap((j): Figure[] => {
        const v = j.of(r.quality);
        if (v === null) return [];
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
