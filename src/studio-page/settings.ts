/** The sliders of the studio page: what each changes, in which range, and how its value is said. */
import { BOUNCING } from "../studio/gait-shapes.ts";
import { type Mood, NEUTRAL } from "../studio/score.ts";
import { type Style, styleManner } from "../studio/styles.ts";
import type { WalkSettings } from "../studio/walk-score.ts";

export interface Slider {
  id: string;
  label: string;
  /** Shown unit; values are in it. */
  unit: string;
  min: number;
  max: number;
  step: number;
  read(s: WalkSettings): number;
  write(s: WalkSettings, value: number): WalkSettings;
  /** Said instead of the number where it fits. */
  says?(s: WalkSettings): string | null;
}

export const START: WalkSettings = {
  height: 1.75,
  speed: 1.15,
  run: false,
  stepLength: null,
  width: 0.14,
  toeOut: 6,
  mood: {},
  noise: 1,
  seed: 1,
  bouncing: false,
  phrase: null,
  without: [],
};

/** Over this speed people run, unless they are asked to walk. */
export const FASTEST_WALK = 2;
const SLOWEST_RUN = 1.7;

const mood = (
  id: keyof Mood,
  label: string,
  unit: string,
  min: number,
  max: number,
  step: number,
  scale = 1,
): Slider => ({
  id,
  label,
  unit,
  min,
  max,
  step,
  read: (s) => (s.mood[id] ?? NEUTRAL[id]) * scale,
  write: (s, value) => ({ ...s, mood: { ...s.mood, [id]: value / scale } }),
});

export const PERSON: Slider[] = [
  {
    id: "height",
    label: "Height",
    unit: "m",
    min: 1.4,
    max: 2.05,
    step: 0.01,
    read: (s) => s.height,
    write: (s, height) => ({ ...s, height }),
  },
  {
    id: "speed",
    label: "Speed",
    unit: "m/s",
    min: 0.4,
    max: 4,
    step: 0.05,
    read: (s) => s.speed,
    write: (s, speed) => ({
      ...s,
      speed,
      run: s.run ? speed >= SLOWEST_RUN : speed > FASTEST_WALK,
      bouncing: s.bouncing && speed <= FASTEST_WALK,
    }),
  },
  {
    id: "stepLength",
    label: "Step",
    unit: "m",
    min: 0.2,
    max: 1.6,
    step: 0.01,
    read: (s) => s.stepLength ?? 0.635 * (s.speed / 1.15) ** 0.42,
    write: (s, stepLength) => ({ ...s, stepLength }),
    says: (s) => (s.stepLength === null ? "auto" : null),
  },
  {
    id: "width",
    label: "Width",
    unit: "cm",
    min: 3,
    max: 30,
    step: 0.5,
    read: (s) => 100 * s.width,
    write: (s, value) => ({ ...s, width: value / 100 }),
  },
  {
    id: "toeOut",
    label: "Toe-out",
    unit: "°",
    min: -5,
    max: 25,
    step: 1,
    read: (s) => s.toeOut,
    write: (s, toeOut) => ({ ...s, toeOut }),
  },
];

export const MOOD: Slider[] = [
  mood("lean", "Lean", "°", -10, 25, 1),
  mood("head", "Head down", "°", -15, 30, 1),
  mood("swing", "Arm swing", "×", 0, 2.2, 0.05),
  mood("elbow", "Elbows", "°", -10, 90, 1),
  mood("armsOut", "Arms out", "°", 0, 70, 1),
  mood("twist", "Twist", "×", 0, 2, 0.05),
  mood("sway", "Sway", "×", 0, 2.2, 0.05),
  mood("bounce", "Bounce", "cm", 0, 5, 0.1, 100),
  mood("crouch", "Crouch", "cm", 0, 8, 0.1, 100),
  mood("lift", "Foot lift", "cm", 0, 8, 0.1, 100),
  mood("push", "Push-off", "×", 0.3, 1.3, 0.05),
  mood("wobble", "Wobble", "°", 0, 5, 0.1),
];

export const VARIATION: Slider[] = [
  {
    id: "noise",
    label: "Noise",
    unit: "×",
    min: 0,
    max: 4,
    step: 0.1,
    read: (s) => s.noise,
    write: (s, noise) => ({ ...s, noise }),
  },
  {
    id: "seed",
    label: "Seed",
    unit: "",
    min: 1,
    max: 40,
    step: 1,
    read: (s) => s.seed,
    write: (s, seed) => ({ ...s, seed: Math.round(seed) }),
  },
];

/** Settings that walk in one of the styles, at the person's own height. */
export function inStyle(s: WalkSettings, style: Style): WalkSettings {
  const { pace, mood: manner, phrase, shape } = styleManner(style);
  const length = pace.length ?? 0.635;
  const time = pace.time ?? 0.55;
  return {
    ...START,
    height: s.height,
    seed: s.seed,
    without: s.without,
    speed: Math.round((100 * length) / time) / 100,
    run: (pace.stance ?? 0.65) < 0.5,
    stepLength: style === "walking" ? null : length,
    width: pace.width ?? 0.14,
    toeOut: ((pace.toeOut ?? 0.1) * 180) / Math.PI,
    mood: { ...manner },
    bouncing: shape === BOUNCING,
    phrase: phrase ?? null,
  };
}
