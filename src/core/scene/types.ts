/**
 * The scene document, version 1: the whole state that a user edits, with every default filled in.
 * The schema that reads it (and says what is wrong with it, and where) is in `schema.ts`.
 *
 * Metres, radians, seconds; see docs/file-formats.md.
 */
import type { Proportions } from "../skeleton/skeleton.ts";
import type { Foot } from "../steps/types.ts";
import type { Effort, TaskCategory } from "./task-types.ts";

export interface SceneTask {
  id: string;
  category: TaskCategory;
  effort: Effort;
  /** `write`: the point written at; `lift`, `place`: the box's centre; `sit`: middle of the seat; `turn`: ground point. */
  position: [number, number, number];
  /** The way the character faces while doing it (`sit`: when seated; `turn`: afterwards). */
  yaw: number;
  /** Seconds that the task is held; null leaves it to the capture. */
  duration: number | null;
  hand: "left" | "right";
}

export interface ScenePath {
  id: string;
  points: [number, number][];
  styles: { at: number; style: string }[];
  smooth: boolean;
}

export interface SceneStone {
  id: string;
  position: [number, number, number];
  yaw: number;
  foot: Foot | null;
  time: number | null;
}

export const PROP_KINDS = ["board", "table", "stool", "box", "wall", "pillar"] as const;
export type PropKind = (typeof PROP_KINDS)[number];

export interface SceneProp {
  id: string;
  kind: PropKind;
  /** Middle of its base on the ground (board: middle of the board; box: its centre). */
  position: [number, number, number];
  yaw: number;
  /** Width (lateral), height, depth (forward), in its own frame. */
  size: [number, number, number];
}

export type Terrain =
  | { kind: "flat" }
  | { kind: "slope"; angle: number; yaw: number }
  | { kind: "heightfield"; size: [number, number]; cells: [number, number]; heights: number[] };

/** How a walker of the crowd steps: as usual, or with a leg that hurts. */
export const CROWD_GAITS = ["usual", "left leg hurts", "right leg hurts"] as const;
export type CrowdGait = (typeof CROWD_GAITS)[number];

export interface SceneWalker {
  position: [number, number];
  yaw: number;
  goals: [number, number][];
  /** Metres a second. */
  speed: number;
  gait: CrowdGait;
}

export interface SceneRegion {
  /** x0, x1, z0, z1. */
  bounds: [number, number, number, number];
  count: number;
  goals: [number, number][];
  speed: number;
  gait: CrowdGait;
}

export interface CrowdSpec {
  agents: SceneWalker[];
  regions: SceneRegion[];
  /** Ground that costs more energy to cross than plain floor, as a road beside a pavement. */
  surfaces: { bounds: [number, number, number, number]; cost: number }[];
}

/**
 * What is made of the plant that a footstep begins, from its landing to its foot's next lift: `auto` rolls heel and toe as the capture
 * does, `enforce` holds both down all the time, `never` leaves the foot to the capture, unheld, and claims no contact.
 */
export const PLANT_MODES = ["auto", "enforce", "never"] as const;
export type PlantMode = (typeof PLANT_MODES)[number];

/** A planned footstep that the user changed; null fields are the planner's. */
export interface FootstepEdit {
  /** Id of the task that the step leads to; null: `step` counts from the plan's first. */
  task: string | null;
  /** Its count, from 0, among the steps that lead to the task. */
  step: number;
  /** The other foot takes this step of a walk. */
  foot: Foot | null;
  position: [number, number, number] | null;
  yaw: number | null;
  /** Seconds; land less lift is how long the foot is in the air. */
  lift: number | null;
  land: number | null;
  /** Seconds that the foot rests, from its landing to its next lift. */
  rest: number | null;
  /** Kept in place even where the plan about it moves away, up to 1.6 m. */
  pinned: boolean;
  plant: PlantMode;
}

export interface Scene {
  version: 1;
  seed: number;
  character: { height: number; proportions: Proportions; model: string | null };
  start: { position: [number, number]; yaw: number };
  tasks: SceneTask[];
  paths: ScenePath[];
  stones: SceneStone[];
  order: string[];
  props: SceneProp[];
  terrain: Terrain;
  crowd: CrowdSpec | null;
  edits: FootstepEdit[];
}

/** Default sizes: width, height, depth in metres. */
export const PROP_SIZES: Record<PropKind, [number, number, number]> = {
  board: [1.9, 1.15, 0.04],
  table: [1.2, 0.75, 0.6],
  stool: [0.36, 0.46, 0.36],
  box: [0.36, 0.26, 0.28],
  wall: [2, 2.4, 0.12],
  pillar: [0.35, 2.4, 0.35],
};
