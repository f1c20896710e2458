/** The studio's gaits beside averages of real walkers: curves, rhythm, excursions; the seven styles tell apart. */
import { describe, expect, it } from "vitest";
import { type GaitAnalysis, measureGait } from "../../src/core/quality/gait.ts";
import { DEFAULT_PROPORTIONS, REFERENCE_HEIGHT } from "../../src/core/skeleton/skeleton.ts";
import { straightScore } from "../../src/studio/choreography/straight.ts";
import { renderScore } from "../../src/studio/render.ts";
import type { Pace } from "../../src/studio/score.ts";
import { STYLES, styleScore } from "../../src/studio/styles.ts";
import { curveShares, realGait } from "../support/gait-real.ts";
import { hasShared } from "../support/shared.ts";

function gaitOf(pace: Partial<Pace>, height = REFERENCE_HEIGHT): GaitAnalysis {
  const { clip, contacts } = renderScore(
    straightScore({
      name: "gait",
      seed: 1,
      actor: { height, proportions: DEFAULT_PROPORTIONS, pace },
      steps: 10,
    }),
  );
  const gait = measureGait(clip, contacts);
  if (!gait) throw new Error("no steady cycle");
  return gait;
}

/** Paces of the groups that the shapes were fitted to, and the least share of the cycle inside each band that holds. */
const FITTED: [string, Partial<Pace>, [number, number][]][] = [
  [
    "bandai-2/walk/normal",
    { length: 0.6387, time: 0.5555, stance: 0.6426, width: 0.0903, toeOut: 0.2085 },
    [
      [0.8, 0.99],
      [0.78, 0.96],
      [0.9, 0.99],
    ],
  ],
  [
    "bandai-2/walk/elderly",
    { length: 0.3818, time: 0.5335, stance: 0.69, width: 0.1147, toeOut: 0.1358 },
    [
      [0.8, 0.99],
      [0.65, 0.93],
      [0.9, 0.99],
    ],
  ],
  [
    "bandai-2/walk/active",
    { length: 0.7047, time: 0.4935, stance: 0.6067, width: 0.0938, toeOut: 0.2061 },
    [
      [0.7, 0.95],
      [0.5, 0.9],
      [0.5, 0.95],
    ],
  ],
  [
    "bandai-1/run/happy",
    { length: 0.7213, time: 0.3835, stance: 0.4772, width: 0.06, toeOut: 0.0838 },
    [
      [0.85, 0.99],
      [0.8, 0.97],
      [0.8, 0.97],
    ],
  ],
];

describe("gaits of the studio", () => {
  it.skipIf(!hasShared)("curves of hip, knee and ankle against the averages that were fitted", () => {
    const rows: string[] = [];
    for (const [group, pace, least] of FITTED) {
      const real = realGait(group);
      const gait = gaitOf({ ...pace, noise: 0.3 });
      (["hip", "knee", "ankle"] as const).forEach((joint, k) => {
        const s = curveShares(gait, real, joint);
        rows.push(
          `${group} ${joint}: ${s.once.toFixed(2)} inside max(SD, 3 deg), ${s.twice.toFixed(2)} twice, rms ${s.rms.toFixed(1)}`,
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
      expect(Math.abs(f.stance - real.stance_fraction.mean)).toBeLessThan(0.04);
      expect(Math.abs(f.doubleSupport - real.double_support_fraction.mean)).toBeLessThan(0.08);
      expect(Math.abs(100 * f.pelvisVertical - real.pelvis_vertical_excursion_cm.mean)).toBeLessThan(1.5);
    }
    console.log(rows.join("\n"));
  });

  it("walks at every height with the same rhythm for its leg, and steps where it is told", () => {
    for (const height of [1.55, 1.75, 1.92]) {
      const f = gaitOf({}, height).facts;
      const scale = height / REFERENCE_HEIGHT;
      expect(f.stepLength / scale).toBeCloseTo(0.635, 1);
      expect(f.stance).toBeGreaterThan(0.6);
      expect(f.flight).toBe(0);
    }
  });

  it("runs fly and walks do not", () => {
    const run = gaitOf({ length: 1.3, time: 0.375, stance: 0.34 }).facts;
    expect(run.flight).toBeGreaterThan(0.2);
    expect(run.doubleSupport).toBe(0);
    expect(gaitOf({}).facts.flight).toBe(0);
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
