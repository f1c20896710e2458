/** What each gait shape is fitted to: a group of real walkers, their pace, and the numbers to begin with. */

import type { GaitShape } from "../../src/studio/gait-shape.ts";
import { BOUNCING, FITTED } from "../../src/studio/gait-shapes.ts";
import type { Pace } from "../../src/studio/score.ts";
import { type RealGait, realGait, type StrideSwings } from "../support/gait-real.ts";

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
  /** How the group's pelvis, chest and arms go with the stride: the mean over its captures, by `strideSwings`. */
  swings: StrideSwings;
  /** Lean of the group's line from the hips to the neck, forwards, degrees: over its captures, by `measureGait`. */
  trunk: number;
  /**
   * Lengths of the steps, of the pace's, in which ours gains speed as the group's runners do while they are measured. Who speeds up
   * leans ahead of the feet, by 8 cm at 0.9 m/s2: a steady run does not look like that.
   */
  gains?: readonly number[];
  /** Changes a group's averages to another speed. */
  change?: (real: RealGait) => RealGait;
}

const { walks, runs } = FITTED;

export const RECIPES: Record<string, Recipe> = {
  slow: {
    group: "bandai-2/walk/elderly",
    // An old person's arms hardly swing; whoever strolls swings them as others do, less.
    swings: {
      pelvis: [0, 2.9, 0.88],
      chest: [0, 2.4, 2.38],
      arm: [0, 17, 2.75],
      out: [12, 3, 2.8],
      elbow: [20, 12, 2.75],
      twice: [20, 2, -0.9],
    },
    trunk: 1,
    pace: { length: 0.3818, time: 0.5335, stance: 0.69, width: 0.1147, toeOut: 0.1358 },
    start: walks[0],
  },
  comfortable: {
    group: "bandai-2/walk/normal",
    swings: {
      pelvis: [0, 7.5, 0],
      chest: [0, 3.3, 2.35],
      arm: [3.4, 20.9, 2.6],
      out: [14.9, 5.2, 2.75],
      elbow: [20.7, 15.2, 2.68],
      twice: [20.7, 3.6, -0.96],
    },
    trunk: 1,
    pace: { length: 0.6387, time: 0.5555, stance: 0.6426, width: 0.0903, toeOut: 0.2085 },
    start: walks[1],
  },
  brisk: {
    group: "bandai-1/walk/normal",
    swings: {
      pelvis: [0, 6.5, -0.12],
      chest: [0, 3.3, 2.72],
      arm: [-3.6, 24.1, 3.06],
      out: [13.5, 4.5, 2.7],
      elbow: [14.6, 14.6, 3.11],
      twice: [14.6, 2.3, -0.27],
    },
    trunk: -1,
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
    // The brisk walkers', wider.
    swings: {
      pelvis: [0, 8, 0],
      chest: [0, 4.5, 2.72],
      arm: [-4, 28, 3.0],
      out: [13.5, 5, 2.7],
      elbow: [24, 17, 3.0],
      twice: [24, 3.5, -0.5],
    },
    trunk: 1,
    pace: { length: 0.74, time: 0.475, stance: 0.63, width: 0.09, toeOut: 0.1 },
    start: walks[3],
    softness: 4,
    change: faster,
  },
  bouncing: {
    group: "bandai-2/walk/active",
    swings: {
      pelvis: [0, 8.2, -0.18],
      chest: [0, 14.6, 2.54],
      arm: [-12.5, 54.5, 2.35],
      out: [24.9, 11.3, -1.27],
      elbow: [92.4, 22.1, 1.96],
      twice: [92.4, 11.5, -1.49],
    },
    trunk: 6,
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
    // The runner's own arms fling: two thirds of them.
    swings: {
      pelvis: [0, 3.9, -0.62],
      chest: [0, 10, 2.6],
      arm: [-19, 34, 2.72],
      out: [15.5, 6, -0.26],
      elbow: [100, 9.1, 3.05],
      twice: [100, 5.5, -0.55],
    },
    trunk: 3.6,
    pace: { length: 0.75, time: 0.3835, stance: 0.4772, width: 0.06, toeOut: 0.0838 },
    start: runs[0],
    run: true,
  },
  easyRun: {
    group: "bandai-1/run/normal-loop",
    // Between this runner, who carries the hands low and still, and the quick ones.
    swings: {
      pelvis: [0, 2.4, 2.76],
      chest: [0, 14, 3.03],
      arm: [-25, 32, 2.82],
      out: [18, 6, -0.7],
      elbow: [80, 19, 2.6],
      twice: [80, 7, -0.8],
    },
    trunk: 10,
    pace: { length: 1.04, time: 0.3835, stance: 0.37, width: 0.06, toeOut: 0.1 },
    start: runs[1],
    softness: 3,
    run: true,
  },
  run: {
    group: "bandai-2/run/normal",
    swings: {
      pelvis: [0, 10, -0.42],
      chest: [0, 12.9, 3.11],
      arm: [-27, 39.6, 2.67],
      out: [23.6, 8.8, -1.05],
      elbow: [91.9, 20.5, 2.2],
      twice: [91.9, 9.7, -0.55],
    },
    // Once they no longer gain speed.
    trunk: 11,
    pace: { length: 1.416, time: 0.373, stance: 0.337, width: 0.06, toeOut: 0.1 },
    start: runs[2],
    run: true,
    // From 3.1 to 3.9 m/s within a second, then on at that: the three captures, stride by stride.
    gains: [0.65, 0.78, 0.86, 0.94, 1, 1.04, 1.06, 1.06, 1.05, 1.04],
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

const targets = new Map<Recipe, RealGait>();

/** What a recipe's shape is judged by. */
export function targetOf(recipe: Recipe): RealGait {
  const known = targets.get(recipe);
  if (known) return known;
  const real = realGait(recipe.group);
  const target = recipe.change ? recipe.change(real) : real;
  targets.set(recipe, target);
  return target;
}
