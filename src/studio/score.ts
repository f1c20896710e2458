/**
 * The score language: what a performance is, before it is rendered into a capture.
 *
 * A score says which foot lifts and lands when and where, what the hands and the seat do, and where the eyes go.
 * Times in seconds, places in metres, yaws in radians; footsteps as in docs/glossary.md. The renderer
 * (`src/studio/render.ts`) turns it into a clip with exact contacts; the choreographies
 * (`src/studio/choreography/`) write scores.
 */
import type { SidecarTask } from "../core/capture/sidecar.ts";
import type { Proportions } from "../core/skeleton/skeleton.ts";
import type { Foot, StepCategory } from "../core/steps/types.ts";
import type { GaitShape } from "./gait-shape.ts";
import type { Phrase } from "./layers/phrase.ts";

export interface ScoreStance {
  x: number;
  z: number;
  yaw: number;
}

/**
 * How a foot goes:
 * - `walk`: heel strike, roll, push-off;
 * - `run`: lands under a bent knee while the other foot is still in the air, flies off the toes;
 * - `turnStep`: a walking step whose foot turns by 0.3 radians or more;
 * - `side`, `close`: toe-first low step to the side / to stand beside the other foot;
 * - `forward`, `backward`: a small step during a task;
 * - `heelPivot`, `toePivot`: the foot turns about its heel / ball without leaving the ground (yaw alone is read
 *   from the step; x and z follow from the pivot and must agree to 1 mm, see `pivotPlace`);
 * - `slide`: the flat foot slides along the ground.
 */
export const STEP_KINDS = [
  "walk",
  "run",
  "turnStep",
  "side",
  "close",
  "forward",
  "backward",
  "heelPivot",
  "toePivot",
  "slide",
] as const;
export type StepKind = (typeof STEP_KINDS)[number];

/** What segmentation should call each kind of step; null where it depends on where the step goes. */
export const CATEGORY_OF: Record<StepKind, StepCategory | null> = {
  walk: "Walk",
  run: "Walk",
  turnStep: "TurnAndStep",
  side: "SideStep",
  close: null,
  forward: "ForwardStepDuringTask",
  backward: "BackwardStepDuringTask",
  heelPivot: "HeelPivot",
  toePivot: "ToePivot",
  slide: null,
};

export interface ScoreStep {
  foot: Foot;
  kind: StepKind;
  /** When the foot loses firm contact (toe-off, start of a pivot) and when it makes it again (first touch, end of a pivot). */
  lift: number;
  land: number;
  x: number;
  z: number;
  yaw: number;
}

/** Circles or lines drawn on a board, or a single tap. */
export interface WriteEvent {
  type: "write";
  task: SidecarTask;
  /** Pen path on the board: points [right of the task point, above it] in metres as the writer sees it, with times; pen up between strokes. */
  strokes: { times: number[]; points: [number, number][] }[];
}
/** Both hands take the box whose centre is at the task's position. `grasp` = task.contact; the box is held until a `place` event. */
export interface LiftEvent {
  type: "lift";
  task: SidecarTask;
  /** Kilograms. */
  mass: number;
  size: [number, number, number];
}
export interface PlaceEvent {
  type: "place";
  task: SidecarTask;
}
/** Sits at task.contact on the seat at task.position, leaves it at `rise` (off the seat at task.end). */
export interface SitEvent {
  type: "sit";
  task: SidecarTask;
  /** Seconds at which the trunk begins to lean for rising; the body is off the seat at task.end. Null: stays seated. */
  rise: number | null;
}
/** Turning on a spot or standing: steps say it all; only the task is noted. */
export interface NoteEvent {
  type: "note";
  task: SidecarTask;
}
export type ScoreEvent = WriteEvent | LiftEvent | PlaceEvent | SitEvent | NoteEvent;

/** How an actor goes straight ahead; lengths at the reference leg of 0.93 m. */
export interface Pace {
  /** Metres from one footstep to the other foot's next. */
  length: number;
  /** Seconds from landing to landing. */
  time: number;
  /** Share of a foot's cycle that it is down: over one half walks, under one half runs. */
  stance: number;
  /** Metres across, ankle to ankle. */
  width: number;
  /** Toe-out, radians. */
  toeOut: number;
  /** Times the small variation that people have from step to step; 0 none. */
  noise: number;
}

/** Comfortable walking, 1.15 m/s [Perry, Gait Analysis; Winter, Biomechanics]. */
export const DEFAULT_PACE: Pace = {
  length: 0.635,
  time: 0.55,
  stance: 0.655,
  width: 0.14,
  toeOut: 0.1,
  noise: 1,
};

/**
 * How an actor carries the body: what is added to, or multiplies, the neutral walk. Angles in degrees, lengths in metres
 * at 1.75 m; all 0 (factors 1) is neutral.
 */
export interface Mood {
  /** Trunk forward, head down, shoulders' rounding. */
  lean: number;
  head: number;
  /** Factor on the arms' swing; elbow bend, arms to the side and forward beyond the neutral ones. */
  swing: number;
  elbow: number;
  armsOut: number;
  armsForward: number;
  /** Factor on the pelvis' and trunk's turning, on its list and sway. */
  twist: number;
  sway: number;
  /** Rise and fall of the hips beyond the walk's own, lowest as the weight is taken; how much they are lowered. */
  bounce: number;
  crouch: number;
  /** Feet lifted higher in the air, and factors on push-off and heel strike. */
  lift: number;
  push: number;
  strike: number;
  /** Slow unsteadiness of trunk and arms, degrees. */
  wobble: number;
}

export const NEUTRAL: Mood = {
  lean: 0,
  head: 0,
  swing: 1,
  elbow: 0,
  armsOut: 0,
  armsForward: 0,
  twist: 1,
  sway: 1,
  bounce: 0,
  crouch: 0,
  lift: 0,
  push: 1,
  strike: 1,
  wobble: 0,
};

export interface Actor {
  height: number;
  proportions: Proportions;
  /** Pace and mood where they are not the default. */
  pace?: Partial<Pace>;
  mood?: Partial<Mood>;
  /** What goes on over several strides. */
  phrase?: Phrase;
  /** The gait's shape, where it is not that of the pace's speed. */
  shape?: GaitShape;
}

/** An actor's whole pace and mood. */
export const paceOf = (actor: Actor): Pace => ({ ...DEFAULT_PACE, ...actor.pace });
export const moodOf = (actor: Actor): Mood => ({ ...NEUTRAL, ...actor.mood });

/**
 * Layers of the rendering that can be switched off, to see what each adds:
 * - `roll`: heel strike, heel-off and toe-off; without, feet stay flat;
 * - `balance`: the hips' way from the zero-moment point; without, they drift after the pressure;
 * - `rhythm`: pelvis, trunk and arms over the gait; without, the body is carried stiffly;
 * - `lean`: the trunk ahead while speed is gained, back while it is lost;
 * - `knees`: hips and airborne feet give way where a knee would jerk;
 * - `flight`: the whole body falls freely in a run's flight;
 * - `gaze`: the head leads turns and holds what it looks at;
 * - `tasks`: bending, reaching, carrying, sitting, writing;
 * - `alive`: breathing, sway, the ring after a strike, noise.
 */
export const LAYERS = [
  "roll",
  "balance",
  "rhythm",
  "lean",
  "knees",
  "flight",
  "gaze",
  "tasks",
  "alive",
] as const;
export type Layer = (typeof LAYERS)[number];
export type Layers = Record<Layer, boolean>;

export interface Score {
  name: string;
  actor: Actor;
  seed: number;
  /** Seconds. */
  duration: number;
  start: { left: ScoreStance; right: ScoreStance };
  /** In order of lift; feet need not alternate. */
  steps: ScoreStep[];
  events: ScoreEvent[];
  /** Where the eyes go, in order of time; between, the head follows the walk (and leads turns). */
  gaze: { time: number; target: [number, number, number] | null }[];
  /** Layers that are not to be rendered; all others are. */
  without?: readonly Layer[];
}

/** Which layers a score wants. */
export const layersOf = (score: Score): Layers =>
  Object.fromEntries(LAYERS.map((l) => [l, !score.without?.includes(l)])) as Layers;
