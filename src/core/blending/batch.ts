/**
 * The state of a batch of characters in flat arrays: what one character and a thousand share.
 *
 * One block of numbers a character in `state`, at STATE x i; the names below are offsets in it. Three mixes a character:
 * the body's, and one for each foot (the step that it is in or last made).
 */
import { JOINT_COUNT } from "../skeleton/joints.ts";
import type { BlendLibrary } from "./library.ts";
import { HIPS_AT } from "./library.ts";
import { type Choice, createChoice, createMix, MIX, type Mix } from "./mix.ts";
import { createStepQuery, type StepQuery } from "./step-query.ts";

/** The root's way over the step under way: a cubic from (T0, pose, velocity) to (T1, pose, velocity). */
export const T0 = 0;
export const T1 = 1;
/** x, z, yaw, y at both ends, then their velocities. */
export const FROM = 2;
export const FROM_V = 6;
export const TO = 10;
export const TO_V = 14;
/** Where the root is now: x, z, yaw, y. */
export const NOW = 18;
/** The body's step: lift, landing, phase of its rows at the next lift; 1 while stepping. */
export const LIFT = 22;
export const LAND = 23;
export const PHI = 24;
export const STEPPING = 25;
/** The blend from what was shown before: begin and length, 0 for none. */
export const BLEND_FROM = 26;
export const BLEND_TIME = 27;
/** Root control: lambda_4, then the wanted velocity (lateral, forward, turn) in the root's frame. */
export const LAMBDA4 = 28;
export const WANT = 29;
/** Length of the blend of the hips' place, seconds. */
export const HIPS_TIME = 32;
/** Side of the body's step: 0 left, 1 right. */
export const LAST_SIDE = 33;
/** Lift of the step that comes next as far as is known; Infinity. */
export const NEXT_LIFT = 34;
/** Landing of the other foot during the step, in a run; 0 for none. */
export const OTHER_LAND = 35;
/** The foot blocks. */
export const FOOT = 36;
export const FOOT_STATE = 36;
export const STATE = FOOT + 2 * FOOT_STATE;

/** In a foot block. A place is x, y, z, yaw, and the ground's normal x, z. */
export const PLACE = 0;
export const TARGET = 6;
export const PLACE_SIZE = 6;
/** Ankle, pitch and toe bend at the lift. */
export const LEAVE = 12;
export const F_LIFT = 17;
export const F_LAND = 18;
/** 1 in the air. */
export const AIR = 19;
/** Seconds that the foot naturally stays down after its last step. */
export const STAY = 20;
/** Pitch shown. */
export const PITCH = 21;
export const F_NEXT = 22;
/** The ankle's place and rotation wanted this frame: x, y, z, then xyzw, toe bend. */
export const ANKLE = 23;
/** Where the foot was to go last: x, z, yaw; its place may be short of it. */
export const WANTED = 31;
/** Pitch with which the step under way lands. */
export const LAND_PITCH = 34;

/** Queued footsteps a character: side, x, y, z, yaw, normal x, normal z, lift, land. */
export const QUEUE = 8;
export const QUEUE_ROW = 9;

export const POSE = 4 * JOINT_COUNT;
/** The offset that a blend carries: Rodrigues vectors and their rates, then the hips' place and its rate. */
export const OFFSET = 6 * JOINT_COUNT + 6;
/** What keeps the body over its feet (balance.ts), numbers a character. */
export const BALANCE = 23;

export interface BatchOptions {
  /** Corners of the triangle may be replaced by clips that fit the root better and land this near, metres [Algorithm 1]. */
  epsilon: number;
  /** Farthest that a landing outside the hull is corrected by inverse kinematics, metres [§5]. */
  correction: number;
  /** Length of the blend between steps, seconds [§7]. */
  blend: number;
  /** Matrices for skinning are written too. */
  matrices: boolean;
}

export const BATCH_DEFAULTS: BatchOptions = { epsilon: 0.12, correction: 0.25, blend: 0.2, matrices: true };

export interface Batch {
  library: BlendLibrary;
  options: BatchOptions;
  capacity: number;
  count: number;
  /** Seconds. */
  time: number;
  state: Float64Array;
  queue: Float64Array;
  queueHead: Int32Array;
  queueCount: Int32Array;
  mixCount: Int32Array;
  mixClips: Int32Array;
  mixWeights: Float64Array;
  /** Triangle last hit, one a foot. */
  triangle: Int32Array;
  offset: Float64Array;
  /** How far each torso is turned over the feet, the shoulders' yaw less the root's, radians: set by who turns sideways in a gap. */
  upperYaw: Float64Array;
  balance: Float64Array;
  /** Hips' world places, count x 3. */
  root: Float32Array;
  /** Local rotations xyzw, count x JOINT_COUNT x 4. */
  rotations: Float32Array;
  /** Skinning matrices (world x inverse bind), count x JOINT_COUNT x 16, by columns. */
  matrices: Float32Array;
  /** Contact bits as in ContactTrack. */
  contacts: Uint8Array;
  /** Horizontal distance between where the blend alone would have put the foot that landed last and where it landed, metres; NaN before. */
  landingError: Float64Array;
  scratch: Scratch;
}

/** Work arrays, one set for all characters. */
export interface Scratch {
  query: StepQuery;
  mix: Mix;
  choice: Choice;
  rootWeights: Float64Array;
  rows: Float64Array;
  pose: Float64Array;
  before: Float64Array;
  after: Float64Array;
  old: Float64Array;
  positions: Float64Array;
  world: Float64Array;
  v: Float64Array;
  kept: Float64Array;
  swing: Float64Array;
}

export function createBatch(
  library: BlendLibrary,
  capacity: number,
  options: Partial<BatchOptions> = {},
): Batch {
  const o = { ...BATCH_DEFAULTS, ...options };
  return {
    library,
    options: o,
    capacity,
    count: 0,
    time: 0,
    state: new Float64Array(STATE * capacity),
    queue: new Float64Array(QUEUE_ROW * QUEUE * capacity),
    queueHead: new Int32Array(capacity),
    queueCount: new Int32Array(capacity),
    mixCount: new Int32Array(3 * capacity),
    mixClips: new Int32Array(3 * MIX * capacity),
    mixWeights: new Float64Array(3 * MIX * capacity),
    triangle: new Int32Array(2 * capacity),
    offset: new Float64Array(OFFSET * capacity),
    upperYaw: new Float64Array(capacity),
    balance: new Float64Array(BALANCE * capacity),
    root: new Float32Array(3 * capacity),
    rotations: new Float32Array(POSE * capacity),
    matrices: new Float32Array(o.matrices ? 16 * JOINT_COUNT * capacity : 0),
    contacts: new Uint8Array(capacity),
    landingError: new Float64Array(capacity).fill(Number.NaN),
    scratch: {
      query: createStepQuery(),
      mix: createMix(),
      choice: createChoice(),
      rootWeights: new Float64Array(library.names.length),
      rows: new Float64Array(MIX * (HIPS_AT + 4)),
      pose: new Float64Array(HIPS_AT + 4),
      before: new Float64Array(HIPS_AT + 4),
      after: new Float64Array(HIPS_AT + 4),
      old: new Float64Array(HIPS_AT + 4),
      positions: new Float64Array(3 * JOINT_COUNT),
      world: new Float64Array(4 * JOINT_COUNT),
      v: new Float64Array(8),
      kept: new Float64Array(6),
      swing: new Float64Array(5),
    },
  };
}
