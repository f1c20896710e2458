/**
 * Straight samples of seven styles, after [Express Table 1]: each a pace and a mood of the same person, walking or
 * running straight ahead from standing to standing.
 */
import { DEFAULT_PROPORTIONS, REFERENCE_HEIGHT } from "../core/skeleton/skeleton.ts";
import { straightScore } from "./choreography/straight.ts";
import { BOUNCING } from "./gait-shapes.ts";
import type { Mood, Pace, Score } from "./score.ts";

export const STYLES = [
  "walking",
  "jogging",
  "excited",
  "balancing",
  "distressed",
  "energetic",
  "tired",
] as const;
export type Style = (typeof STYLES)[number];

interface StyleSpec {
  pace: Partial<Pace>;
  mood: Partial<Mood>;
  steps: number;
  /** The bouncing walk's shape in place of the speed's. */
  bouncing?: boolean;
}

const SPECS: Record<Style, StyleSpec> = {
  walking: { pace: {}, mood: {}, steps: 8 },
  jogging: { pace: { length: 0.92, time: 0.385, stance: 0.42, width: 0.09 }, mood: { lean: 5 }, steps: 14 },
  // Up on the toes, arms high and loose, chest out.
  excited: {
    pace: { length: 0.62, time: 0.45, stance: 0.6 },
    mood: {
      bounce: 0.03,
      swing: 1.5,
      elbow: 45,
      armsOut: 14,
      armsForward: 6,
      head: -9,
      lean: -4,
      lift: 0.03,
      twist: 1.5,
      sway: 1.5,
    },
    steps: 10,
  },
  // Heel to toe along a line, arms out, eyes on the way, unsteady.
  balancing: {
    pace: { length: 0.31, time: 0.95, stance: 0.7, width: 0.03, toeOut: 0.03 },
    mood: {
      armsOut: 62,
      swing: 0.15,
      elbow: 6,
      head: 16,
      lean: 2,
      wobble: 3,
      sway: 0.7,
      push: 0.55,
      strike: 0.5,
    },
    steps: 9,
  },
  // Bent over the hands that are held before the chest, quick short steps.
  distressed: {
    pace: { length: 0.47, time: 0.5, stance: 0.67, width: 0.12 },
    mood: {
      lean: 15,
      head: 20,
      swing: 0.25,
      elbow: 88,
      armsForward: 24,
      armsOut: 2,
      wobble: 1.2,
      twist: 0.6,
      sway: 1.3,
      crouch: 0.015,
      push: 0.85,
      strike: 0.75,
    },
    steps: 10,
  },
  energetic: {
    pace: { length: 0.73, time: 0.475, stance: 0.615 },
    mood: { swing: 1.75, elbow: 26, twist: 1.35, lean: 3, head: -4, lift: 0.008, armsOut: 3 },
    steps: 8,
  },
  tired: {
    pace: { length: 0.45, time: 0.7, stance: 0.7, width: 0.17 },
    mood: {
      lean: 13,
      head: 20,
      swing: 0.45,
      elbow: -8,
      armsForward: 7,
      crouch: 0.025,
      push: 0.65,
      strike: 0.55,
      sway: 1.8,
      twist: 0.7,
    },
    steps: 8,
  },
};

/** How a style's actor goes. */
export const styleManner = (style: Style): Omit<StyleSpec, "steps"> => SPECS[style];

/** The straight sample of a style. */
export function styleScore(style: Style): Score {
  const spec = SPECS[style];
  return straightScore({
    name: `style-${style}`,
    seed: 100 + STYLES.indexOf(style),
    actor: {
      height: REFERENCE_HEIGHT,
      proportions: DEFAULT_PROPORTIONS,
      pace: spec.pace,
      mood: spec.mood,
      ...(spec.bouncing ? { shape: BOUNCING } : {}),
    },
    steps: spec.steps,
  });
}
