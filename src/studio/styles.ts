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

/** Rhythms and lengths near those of the published samples [Express Table 1]. */
const SPECS: Record<Style, StyleSpec> = {
  walking: { pace: { length: 0.61, time: 0.52, stance: 0.65 }, mood: {}, steps: 5 },
  jogging: { pace: { length: 0.86, time: 0.36, stance: 0.42, width: 0.09 }, mood: { lean: 5 }, steps: 6 },
  // Up on the toes, arms high and loose, chest out.
  excited: {
    pace: { length: 0.66, time: 0.5, stance: 0.605, width: 0.11 },
    mood: {
      swing: 1.5,
      elbow: 45,
      armsOut: 14,
      armsForward: 6,
      head: -9,
      lean: -3,
      bounce: 0.03,
      lift: 0.03,
      twist: 1.5,
      sway: 1.5,
    },
    steps: 8,
  },
  // Heel to toe along a line, arms stretched to the sides and paddling, eyes on the line, unsteady.
  balancing: {
    pace: { length: 0.27, time: 1.25, stance: 0.72, width: 0.02, toeOut: 0.03 },
    mood: {
      armsOut: 80,
      swing: 0.1,
      elbow: -9,
      head: 18,
      lean: 2,
      wobble: 3.6,
      sway: 0.7,
      twist: 0.5,
      push: 0.5,
      strike: 0.45,
      lift: 0.02,
    },
    steps: 7,
  },
  // Bent over the hands that are held before the chest, short steps, head down, crouched.
  distressed: {
    pace: { length: 0.45, time: 0.62, stance: 0.68, width: 0.12 },
    mood: {
      lean: 16,
      head: 22,
      swing: 0.25,
      elbow: 88,
      armsForward: 24,
      armsOut: 2,
      wobble: 1.6,
      twist: 0.6,
      sway: 1.4,
      crouch: 0.02,
      push: 0.85,
      strike: 0.7,
    },
    steps: 7,
  },
  energetic: {
    pace: { length: 0.72, time: 0.45, stance: 0.62 },
    mood: { swing: 1.75, elbow: 26, twist: 1.35, lean: 3, head: -4, lift: 0.008, armsOut: 3 },
    steps: 7,
  },
  // Trunk and head sunk, arms hanging, feet hardly lifted and far apart.
  tired: {
    pace: { length: 0.47, time: 0.74, stance: 0.7, width: 0.17 },
    mood: {
      lean: 14,
      head: 22,
      swing: 0.55,
      elbow: -9,
      armsForward: 8,
      crouch: 0.03,
      push: 0.8,
      strike: 0.6,
      sway: 2,
      twist: 0.7,
    },
    steps: 9,
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
