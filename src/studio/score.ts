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
import type { Foot } from "../core/steps/types.ts";

export interface ScoreStance {
  x: number;
  z: number;
  yaw: number;
}

/**
 * How a foot goes:
 * - `walk`: heel strike, roll, push-off;
 * - `turnStep`: a walking step that turns;
 * - `side`, `close`: toe-first low step to the side / to stand beside the other foot;
 * - `forward`, `backward`: a small step during a task;
 * - `heelPivot`, `toePivot`: the foot turns about its heel / ball without leaving the ground (yaw alone is read
 *   from the step; x and z follow from the pivot and must agree to 1 mm, see `pivotPlace`);
 * - `slide`: the flat foot slides along the ground.
 */
export const STEP_KINDS = [
  "walk",
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

export interface Actor {
  height: number;
  proportions: Proportions;
}

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
}
