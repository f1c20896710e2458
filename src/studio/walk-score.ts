/** One person's walk or run across the room from a few settings: what the studio page asks for. */
import { createSkeleton, DEFAULT_PROPORTIONS } from "../core/skeleton/skeleton.ts";
import { straightScore } from "./choreography/straight.ts";
import { BOUNCING } from "./gait-shapes.ts";
import type { Phrase } from "./layers/phrase.ts";
import { paceAt, runAt } from "./pace.ts";
import type { Layer, Mood, Score } from "./score.ts";

export interface WalkSettings {
  /** Metres. */
  height: number;
  /** Metres a second. */
  speed: number;
  run: boolean;
  /** Metres; null: as people at this speed. */
  stepLength: number | null;
  /** Metres across, ankle to ankle. */
  width: number;
  /** Degrees, of each foot. */
  toeOut: number;
  mood: Partial<Mood>;
  /** Times the variation that people have from step to step. */
  noise: number;
  seed: number;
  bouncing: boolean;
  /** What goes on over several strides; null for nothing. */
  phrase: Phrase | null;
  without: readonly Layer[];
}

/** Metres that the walk goes. */
const WAY = 6.2;

/** The score of a walk along +X through the middle of the room. */
export function walkScore(s: WalkSettings): Score {
  const scale = createSkeleton(s.height, DEFAULT_PROPORTIONS).legLength / 0.93;
  // A longer leg swings slower: speeds go with its root.
  const speed = s.speed / Math.sqrt(scale);
  const usual = s.run ? runAt(speed) : paceAt(speed);
  const length = s.stepLength === null ? usual.length : s.stepLength / scale;
  const time = length / speed;
  const steps = Math.max(4, Math.min(24, Math.round(WAY / (length * scale)) - 1));
  return straightScore({
    name: s.run ? "run" : "walk",
    seed: s.seed,
    actor: {
      height: s.height,
      proportions: DEFAULT_PROPORTIONS,
      pace: {
        length,
        time,
        stance: usual.stance,
        width: s.width / scale,
        toeOut: (s.toeOut * Math.PI) / 180,
        noise: s.noise,
      },
      mood: s.mood,
      ...(s.bouncing && !s.run ? { shape: BOUNCING } : {}),
      ...(s.phrase ? { phrase: s.phrase } : {}),
    },
    steps,
    start: { x: -((steps + 1.4) * length * scale) / 2, z: 0, yaw: Math.PI / 2 },
  });
}
