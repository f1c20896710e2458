/**
 * Straight samples of seven styles, after [Express Table 1]: each a pace and a mood of the same person, walking or
 * running straight ahead from standing to standing.
 */
import { DEFAULT_PROPORTIONS, REFERENCE_HEIGHT } from "../core/skeleton/skeleton.ts";
import { straightScore } from "./choreography/straight.ts";
import type { GaitShape } from "./gait-shape.ts";
import { FITTED } from "./gait-shapes.ts";
import type { Phrase, PhraseLine } from "./layers/phrase.ts";
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
  phrase?: Phrase;
  /** Of the gait's shape, where the pace's own is not wanted. */
  shape?: GaitShape;
  steps: number;
}

/** Both arms alike, or one against the other. */
const bothArms = (
  name: "Out" | "Swing" | "Elbow",
  times: number,
  amount: number,
  at: number,
): PhraseLine[] => [
  { part: `left${name}`, times, amount, at },
  { part: `right${name}`, times, amount, at },
];
const seesaw = (times: number, amount: number, at: number): PhraseLine[] => [
  { part: "leftOut", times, amount, at },
  { part: "rightOut", times, amount: -amount, at },
];

/** Numbers of steps, durations and what repeats after how many steps as in [Express Table 1]. */
const SPECS: Record<Style, StyleSpec> = {
  walking: { pace: { length: 0.655, time: 0.57 }, mood: { swing: 0.715 }, steps: 8 },
  jogging: {
    pace: { length: 0.84, time: 0.39, stance: 0.43, width: 0.09 },
    mood: { lean: 5, swing: 0.8 },
    steps: 14,
  },
  // Up on the toes, chest out; every second stride the arms fly up.
  excited: {
    pace: { length: 0.62, time: 0.5, stance: 0.61 },
    mood: {
      bounce: 0.024,
      swing: 1.08,
      elbow: 40,
      armsOut: 24,
      armsForward: 14,
      head: -9,
      lean: -4,
      lift: 0.03,
      twist: 1.4,
      sway: 1.5,
    },
    phrase: {
      strides: 2,
      lines: [
        ...bothArms("Out", 1, 26, 0.3),
        ...bothArms("Swing", 1, 20, 0.3),
        ...bothArms("Elbow", 1, -16, 0.3),
        { part: "lean", times: 1, amount: -3, at: 0.3 },
        { part: "nod", times: 1, amount: -6, at: 0.3 },
      ],
    },
    steps: 14,
  },
  // Heel to toe along a line, arms out; it goes well for a step, then the arms beat for balance.
  balancing: {
    pace: { length: 0.31, time: 1.28, stance: 0.72, width: 0.03, toeOut: 0.03 },
    mood: {
      armsOut: 52,
      swing: 0.15,
      elbow: 6,
      head: 16,
      lean: 2,
      wobble: 0.5,
      sway: 0.7,
      push: 0.55,
      strike: 0.5,
    },
    phrase: {
      strides: 3,
      lines: [
        ...seesaw(4, 16.5, 0.2),
        ...seesaw(5, 14.5, 0.2),
        ...seesaw(7, 7.5, 0.2),
        ...seesaw(12, 2, 0.2),
        ...seesaw(17, 1, 0.2),
        { part: "tip", times: 4, amount: -2.4, at: 0.18 },
        { part: "tip", times: 5, amount: -2.2, at: 0.18 },
        { part: "leftSwing", times: 4, amount: 11, at: 0.1 },
        { part: "rightSwing", times: 5, amount: 4.5, at: 0.3 },
        { part: "lean", times: 2, amount: 1.6, at: 0.3 },
      ],
    },
    steps: 14,
  },
  // Bent over the hands that are held before the chest, short steps, looking one way and then the other.
  distressed: {
    pace: { length: 0.44, time: 0.62, stance: 0.68, width: 0.12 },
    mood: {
      lean: 15,
      head: 20,
      swing: 0.32,
      elbow: 88,
      armsForward: 24,
      armsOut: 2,
      wobble: 0.6,
      twist: 0.6,
      sway: 1.3,
      crouch: 0.015,
      push: 0.85,
      strike: 0.75,
    },
    phrase: {
      strides: 2,
      lines: [
        { part: "twist", times: 1, amount: 8, at: 0.15 },
        { part: "shake", times: 1, amount: 16, at: 0.2 },
        { part: "lean", times: 1, amount: 4, at: 0.6 },
        { part: "nod", times: 1, amount: 6, at: 0.6 },
        ...bothArms("Elbow", 1, 12, 0.6),
        ...bothArms("Swing", 1, 8, 0.6),
      ],
    },
    steps: 14,
  },
  // Long quick steps, elbows bent, fists pumping.
  energetic: {
    pace: { length: 0.72, time: 0.475, stance: 0.62 },
    mood: {
      swing: 1.5,
      elbow: 91,
      armsForward: 13,
      twist: 1.25,
      lean: 3,
      head: -4,
      lift: 0.008,
      armsOut: 3,
    },
    shape: FITTED.walks[1],
    steps: 10,
  },
  // Bent, arms dangling; every second stride sags and is dragged along.
  tired: {
    pace: { length: 0.45, time: 0.78, stance: 0.7, width: 0.17 },
    mood: {
      lean: 13,
      head: 20,
      swing: 0.875,
      elbow: -8,
      armsForward: 0,
      crouch: 0.025,
      push: 0.65,
      strike: 0.55,
      sway: 1.8,
      twist: 0.7,
    },
    phrase: {
      strides: 2,
      lines: [
        { part: "lean", times: 1, amount: 7, at: 0.4 },
        { part: "nod", times: 1, amount: 9, at: 0.45 },
        { part: "tip", times: 1, amount: 6, at: 0.15 },
        { part: "sink", times: 1, amount: 0.008, at: 0.4 },
        ...bothArms("Swing", 1, 3, 0.5),
      ],
    },
    steps: 14,
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
      ...(spec.phrase ? { phrase: spec.phrase } : {}),
      ...(spec.shape ? { shape: spec.shape } : {}),
    },
    steps: spec.steps,
  });
}
