/** What each gait shape is fitted to: a group of real walkers, their pace, and the numbers to begin with. */

import type { GaitShape } from "../../src/studio/gait-shape.ts";
import { BOUNCING, FITTED } from "../../src/studio/gait-shapes.ts";
import type { Pace } from "../../src/studio/score.ts";
import { type RealGait, realGait } from "../support/gait-real.ts";

export interface Recipe {
  group: string;
  pace: Partial<Pace>;
  start: GaitShape;
  run?: boolean;
  /** Share of frames in balance that is enough. */
  balance?: number;
  /** Least standard deviation that a curve is judged by, degrees. */
  softness?: number;
  /** Jerk of the group's own captures over the median at their speed, where it is another. */
  jerk?: number;
  /**
   * Turning of the group's pelvis to a side, degrees, and how much later than the feet are farthest apart, radians of the
   * stride: the first harmonic over its captures, by `pelvisTurn`.
   */
  pelvis: readonly [number, number];
  /** Changes a group's averages to another speed. */
  change?: (real: RealGait) => RealGait;
}

const { walks, runs } = FITTED;

export const RECIPES: Record<string, Recipe> = {
  slow: {
    group: "bandai-2/walk/elderly",
    pelvis: [2.9, 0.89],
    pace: { length: 0.3818, time: 0.5335, stance: 0.69, width: 0.1147, toeOut: 0.1358 },
    start: walks[0],
  },
  comfortable: {
    group: "bandai-2/walk/normal",
    pelvis: [7.5, 0],
    pace: { length: 0.6387, time: 0.5555, stance: 0.6426, width: 0.0903, toeOut: 0.2085 },
    start: walks[1],
  },
  brisk: {
    group: "bandai-1/walk/normal",
    pelvis: [6.3, -0.14],
    pace: {
      length: 0.6867,
      time: 0.5435,
      stance: 0.648,
      width: 0.06,
      toeOut: 0.0764,
    },
    start: walks[2],
  },
  fast: {
    group: "bandai-1/walk/normal",
    pelvis: [8, 0],
    pace: { length: 0.74, time: 0.475, stance: 0.63, width: 0.09, toeOut: 0.1 },
    start: walks[3],
    softness: 4,
    change: faster,
  },
  bouncing: {
    group: "bandai-2/walk/active",
    pelvis: [8.1, -0.2],
    pace: {
      length: 0.73,
      time: 0.4935,
      stance: 0.6067,
      width: 0.0938,
      toeOut: 0.2061,
    },
    start: BOUNCING,
    balance: 0.75,
    jerk: 1.36,
  },
  jog: {
    group: "bandai-1/run/happy",
    pelvis: [3.9, -0.68],
    pace: { length: 0.75, time: 0.3835, stance: 0.4772, width: 0.06, toeOut: 0.0838 },
    start: runs[0],
    run: true,
  },
  easyRun: {
    group: "bandai-1/run/normal-loop",
    pelvis: [2.5, 2.64],
    pace: { length: 1.04, time: 0.3835, stance: 0.37, width: 0.06, toeOut: 0.1 },
    start: runs[1],
    softness: 3,
    run: true,
  },
  run: {
    group: "bandai-2/run/normal",
    pelvis: [9.7, -0.44],
    pace: { length: 1.416, time: 0.373, stance: 0.337, width: 0.06, toeOut: 0.1 },
    start: runs[2],
    run: true,
  },
};

/**
 * A brisk walker's averages at 1.56 m/s: the hip swings wider in proportion to the step, the knee yields more as it is loaded,
 * the hips rise and fall more [Winter, Biomechanics and Motor Control of Human Gait, fast cadence]. (The one capture at that
 * speed is a loop whose feet slide by 0.2 to 0.3 m/s: feet that stay put cannot follow its curves.)
 */
function faster(real: RealGait): RealGait {
  const hip = real.curves_deg.hip.mean;
  const middle = hip.reduce((a, b) => a + b, 0) / hip.length;
  const knee = real.curves_deg.knee.mean.map((v, k) => v + 5 * Math.exp(-(((k - 13) / 8) ** 2)));
  return {
    ...real,
    curves_deg: {
      ...real.curves_deg,
      hip: { ...real.curves_deg.hip, mean: hip.map((v) => middle + 1.13 * (v - middle) + 1.5) },
      knee: { ...real.curves_deg.knee, mean: knee },
    },
    pelvis_vertical_excursion_cm: { ...real.pelvis_vertical_excursion_cm, mean: 4.6 },
  };
}

export const targetOf = (recipe: Recipe): RealGait => {
  const real = realGait(recipe.group);
  return recipe.change ? recipe.change(real) : real;
};
