/** The studio's gaits beside averages of real walkers: curves, rhythm, excursions; the seven styles tell apart. */

import { describe, expect, it } from "vitest";
import { wholeChunk } from "../../src/core/motion/chunk.ts";
import { type GaitAnalysis, measureGait } from "../../src/core/quality/gait.ts";
import { motionPoints } from "../../src/core/quality/measure.ts";
import { DEFAULT_PROPORTIONS, REFERENCE_HEIGHT } from "../../src/core/skeleton/skeleton.ts";
import { straightScore } from "../../src/studio/choreography/straight.ts";
import { paceAt } from "../../src/studio/pace.ts";
import { type Rendered, renderScore } from "../../src/studio/render.ts";
import type { Pace } from "../../src/studio/score.ts";
import { STYLES, styleScore } from "../../src/studio/styles.ts";
import { middleOf, perform } from "../fit/perform.ts";
import { RECIPES } from "../fit/recipes.ts";
import {
  curveShares,
  type RealGait,
  realGait,
  type StrideSwings,
  sharesOf,
  strideSwings,
} from "../support/gait-real.ts";
import { hasShared } from "../support/shared.ts";

const JOINTS = ["hip", "knee", "ankle"] as const;

function walked(pace: Partial<Pace>, height = REFERENCE_HEIGHT) {
  return renderScore(
    straightScore({
      name: "gait",
      seed: 1,
      actor: { height, proportions: DEFAULT_PROPORTIONS, pace },
      steps: 10,
    }),
  );
}

function gaitOf({ clip, contacts }: Rendered): GaitAnalysis {
  const gait = measureGait(clip, contacts);
  if (!gait) throw new Error("no steady cycle");
  return gait;
}

/** How pelvis, chest and arms go with the stride in the middle of a performance. */
function swingsOf({ clip, contacts }: Rendered): StrideSwings {
  const chunk = wholeChunk(clip, contacts);
  const { joints } = motionPoints(clip.skeleton, [chunk], clip.frames);
  return strideSwings(joints, clip.frames, middleOf(clip.frames));
}

/** The shapes that were fitted, and the least share of the cycle inside each band that holds for hip, knee and ankle. */
const FITTED: [keyof typeof RECIPES, [number, number][]][] = [
  [
    "slow",
    [
      [0.9, 0.99],
      [0.9, 0.99],
      [0.95, 0.99],
    ],
  ],
  [
    "comfortable",
    [
      [0.9, 0.99],
      [0.95, 0.99],
      [0.95, 0.99],
    ],
  ],
  [
    "brisk",
    [
      [0.84, 0.99],
      [0.78, 0.95],
      [0.65, 0.97],
    ],
  ],
  [
    "bouncing",
    [
      [0.85, 0.98],
      [0.8, 0.99],
      [0.88, 0.99],
    ],
  ],
  [
    "jog",
    [
      [0.9, 0.99],
      [0.95, 0.99],
      [0.95, 0.99],
    ],
  ],
  [
    "easyRun",
    [
      [0.9, 0.99],
      [0.95, 0.99],
      [0.92, 0.99],
    ],
  ],
  [
    "run",
    [
      [0.42, 0.86],
      [0.6, 0.95],
      [0.7, 0.86],
    ],
  ],
];

/** Walkers that no shape was fitted to, each walked at its own pace. */
const OTHERS = ["bandai-1/walk/happy", "bandai-1/walk/tired", "bandai-1/walk/old", "bandai-2/walk/exhausted"];

/** Groups that walk as adults walk at their speed; who plays an old person shuffles, with short quick steps. */
const WALKERS = [
  "bandai-1/walk/normal",
  "bandai-1/walk/tired",
  "bandai-1/walk/happy",
  "bandai-2/walk/exhausted",
  "bandai-2/walk/normal",
  "bandai-2/walk/active",
];

function paceOfReal(real: RealGait): Partial<Pace> {
  return {
    length: real.step_length_cm.mean / 100,
    time: real.cycle_s.mean / 2,
    // The measured stance ends late by some 0.03 of the cycle.
    stance: real.stance_fraction.mean - 0.03,
    width: Math.max(0.05, real.step_width_cm.mean / 100),
    toeOut: (real.toe_out_deg.mean * Math.PI) / 180,
  };
}

describe("gaits of the studio", () => {
  it.skipIf(!hasShared)("curves of hip, knee and ankle against the averages that were fitted", () => {
    const rows: string[] = [];
    for (const [name, least] of FITTED) {
      const recipe = RECIPES[name];
      const real = realGait(recipe.group);
      const ours = perform(recipe, recipe.start, 12);
      const gait = gaitOf(ours);
      JOINTS.forEach((joint, k) => {
        const s = curveShares(gait, real, joint);
        rows.push(
          `${name} ${joint}: ${s.once.toFixed(2)} inside max(SD, 3 deg), ${s.twice.toFixed(2)} twice, rms ${s.rms.toFixed(1)}`,
        );
        expect(s.once, rows.at(-1)).toBeGreaterThanOrEqual(least[k][0]);
        expect(s.twice, rows.at(-1)).toBeGreaterThanOrEqual(least[k][1]);
      });
      const f = gait.facts;
      rows.push(
        `  stance ${f.stance.toFixed(3)} (${real.stance_fraction.mean}), double support ${f.doubleSupport.toFixed(3)} (${real.double_support_fraction.mean}), ` +
          `vertical ${(100 * f.pelvisVertical).toFixed(1)} cm (${real.pelvis_vertical_excursion_cm.mean}), lateral ${(100 * f.pelvisLateral).toFixed(1)} (${real.pelvis_lateral_excursion_cm.mean}), ` +
          `clearance ${(100 * f.tipClearance).toFixed(1)} (${real.swing_min_tip_clearance_cm.mean}), toe lift ${(100 * f.toeLift).toFixed(1)} (${real.swing_max_toe_joint_lift_cm.mean})`,
      );
      rows.push(`  trunk leans ${f.trunkLean.toFixed(1)} degrees (${recipe.trunk})`);
      expect(Math.abs(f.trunkLean - recipe.trunk), rows.at(-1)).toBeLessThan(2);
      const seen = swingsOf(ours);
      for (const part of Object.keys(seen) as (keyof StrideSwings)[]) {
        const [mean, amount, lag] = seen[part];
        const [m, a, l] = recipe.swings[part];
        const apart = Math.hypot(
          amount * Math.cos(lag) - a * Math.cos(l),
          amount * Math.sin(lag) - a * Math.sin(l),
        );
        rows.push(
          `  ${part} ${mean.toFixed(0)} + ${amount.toFixed(1)} degrees (${m.toFixed(0)} + ${a}), ${apart.toFixed(1)} degrees apart`,
        );
        expect(apart, rows.at(-1)).toBeLessThan(2 + 0.15 * a);
        expect(Math.abs(mean - m), rows.at(-1)).toBeLessThan(4);
      }
      expect(Math.abs(f.stance - real.stance_fraction.mean)).toBeLessThan(0.04);
      expect(Math.abs(f.doubleSupport - real.double_support_fraction.mean)).toBeLessThan(0.08);
      const rise = real.pelvis_vertical_excursion_cm;
      expect(Math.abs(100 * f.pelvisVertical - rise.mean)).toBeLessThan(Math.max(1.5, 2 * rise.sd));
    }
    console.log(rows.join("\n"));
  });

  it.skipIf(!hasShared)("walkers that were not fitted judge ours no worse than they judge each other", () => {
    const rows: string[] = [];
    const ours = [0, 0, 0];
    const theirs = [0, 0, 0];
    for (const group of OTHERS) {
      const real = realGait(group);
      const gait = gaitOf(walked({ ...paceOfReal(real), noise: 0.3 }));
      JOINTS.forEach((joint, k) => {
        const s = curveShares(gait, real, joint).once;
        const peers = OTHERS.filter((g) => g !== group).map(
          (g) => sharesOf(realGait(g).curves_deg[joint].mean, real, joint).once,
        );
        const peer = peers.reduce((a, b) => a + b, 0) / peers.length;
        ours[k] += s / OTHERS.length;
        theirs[k] += peer / OTHERS.length;
        rows.push(`${group} ${joint}: ours ${s.toFixed(2)}, other walkers ${peer.toFixed(2)}`);
      });
    }
    rows.push(`mean: ours ${ours.map((v) => v.toFixed(2))}, each other ${theirs.map((v) => v.toFixed(2))}`);
    console.log(rows.join("\n"));
    JOINTS.forEach((joint, k) => {
      expect(ours[k], joint).toBeGreaterThanOrEqual(theirs[k]);
    });
  });

  it.skipIf(!hasShared)(
    "speed, step length, cadence, stance, excursions and clearance lie in the range of real walkers",
    () => {
      const walkers = WALKERS.map(realGait);
      /** A line through the walkers, over the logarithm of speed, and twice the deviation of single cycles from it. */
      const line = (read: (g: RealGait) => number, within: (g: RealGait) => number) => {
        const points = walkers.map((g) => [Math.log(g.speed_cm_s.mean / 100), read(g)]);
        const n = points.length;
        const mx = points.reduce((a, p) => a + p[0], 0) / n;
        const my = points.reduce((a, p) => a + p[1], 0) / n;
        const slope =
          points.reduce((a, p) => a + (p[0] - mx) * (p[1] - my), 0) /
          points.reduce((a, p) => a + (p[0] - mx) ** 2, 0);
        const at = (speed: number) => my + slope * (Math.log(speed) - mx);
        const square = walkers.map((g) => (read(g) - at(g.speed_cm_s.mean / 100)) ** 2 + within(g) ** 2);
        const spread = 2 * Math.sqrt(square.reduce((a, b) => a + b, 0) / n);
        return { at, spread };
      };
      const share = (read: (g: RealGait) => { mean: number; sd: number }) => (g: RealGait) =>
        read(g).sd / read(g).mean;
      const length = line(
        (g) => Math.log(g.step_length_cm.mean / 100),
        share((g) => g.step_length_cm),
      );
      const cadence = line(
        (g) => Math.log(g.cadence_steps_min.mean),
        share((g) => g.cadence_steps_min),
      );
      const stance = line(
        (g) => g.stance_fraction.mean,
        (g) => g.stance_fraction.sd,
      );
      const double = line(
        (g) => g.double_support_fraction.mean,
        (g) => g.double_support_fraction.sd,
      );
      const rows = [
        "speed: step length (real, spread), cadence, stance, double support, rise, sway, clearance, arm",
      ];
      for (const speed of [1, 1.15, 1.3, 1.45]) {
        const f = gaitOf(walked({ ...paceAt(speed), noise: 0.3 })).facts;
        const near = walkers.filter((g) => Math.abs(g.speed_cm_s.mean / 100 - f.speed) < 0.3);
        const range = (
          key: "pelvis_vertical_excursion_cm" | "pelvis_lateral_excursion_cm" | "swing_min_tip_clearance_cm",
        ) =>
          [
            Math.min(...near.map((g) => g[key].mean - 2 * g[key].sd)),
            Math.max(...near.map((g) => g[key].mean + 2 * g[key].sd)),
          ] as const;
        const within = (value: number, [low, high]: readonly [number, number], what: string) => {
          expect(value, `${what} at ${speed} m/s`).toBeGreaterThanOrEqual(low);
          expect(value, `${what} at ${speed} m/s`).toBeLessThanOrEqual(high);
          return `${value.toFixed(1)} (${low.toFixed(1)} to ${high.toFixed(1)})`;
        };
        const ratio = (value: number, real: { at(speed: number): number; spread: number }, what: string) => {
          const off = Math.log(value) - real.at(f.speed);
          expect(Math.abs(off), `${what} at ${speed} m/s`).toBeLessThanOrEqual(real.spread);
          return `${value.toFixed(2)} (${Math.exp(real.at(f.speed)).toFixed(2)}, ${(100 * real.spread).toFixed(0)} %)`;
        };
        rows.push(
          [
            `${f.speed.toFixed(2)} m/s: ${ratio(f.stepLength, length, "step length")}`,
            ratio(f.cadence, cadence, "cadence"),
            `${f.stance.toFixed(3)} (${stance.at(f.speed).toFixed(3)})`,
            `${f.doubleSupport.toFixed(3)} (${double.at(f.speed).toFixed(3)})`,
            within(100 * f.pelvisVertical, range("pelvis_vertical_excursion_cm"), "rise"),
            within(100 * f.pelvisLateral, range("pelvis_lateral_excursion_cm"), "sway"),
            within(100 * f.tipClearance, range("swing_min_tip_clearance_cm"), "clearance"),
            f.armRange.toFixed(0),
          ].join(", "),
        );
        expect(Math.abs(f.stance - stance.at(f.speed)), rows.at(-1)).toBeLessThanOrEqual(0.04);
        expect(Math.abs(f.doubleSupport - double.at(f.speed)), rows.at(-1)).toBeLessThanOrEqual(0.08);
      }
      console.log(rows.join("\n"));
    },
  );

  it("walks at every height with the same rhythm for its leg, and steps where it is told", () => {
    for (const height of [1.55, 1.75, 1.92]) {
      const f = gaitOf(walked({}, height)).facts;
      const scale = height / REFERENCE_HEIGHT;
      expect(f.stepLength / scale).toBeCloseTo(0.635, 1);
      expect(f.stance).toBeGreaterThan(0.6);
      expect(f.flight).toBe(0);
    }
  });

  it("runs fly and walks do not", () => {
    const run = gaitOf(walked({ length: 1.3, time: 0.375, stance: 0.34 })).facts;
    expect(run.flight).toBeGreaterThan(0.2);
    expect(run.doubleSupport).toBe(0);
    expect(gaitOf(walked({})).facts.flight).toBe(0);
  });

  it("seven styles differ in speed, rhythm or arms, each from every other", () => {
    const facts = STYLES.map((style) => {
      const { clip, contacts } = renderScore(styleScore(style));
      return measureGait(clip, contacts)?.facts;
    });
    for (let i = 0; i < STYLES.length; i++)
      for (let j = 0; j < i; j++) {
        const a = facts[i];
        const b = facts[j];
        if (!a || !b) throw new Error(`no steady cycle in ${STYLES[i]} or ${STYLES[j]}`);
        const apart =
          Math.abs(a.speed - b.speed) / 0.15 +
          Math.abs(a.armRange - b.armRange) / 15 +
          Math.abs(a.stance - b.stance) / 0.05;
        expect(apart, `${STYLES[i]} and ${STYLES[j]}`).toBeGreaterThan(1.5);
      }
  });
});
