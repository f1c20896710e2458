/**
 * Characters that follow footsteps: the batch that one character and a thousand share [Barycentric §§4, 5].
 *
 * Feed each its footsteps with `push` (or a velocity with `steer`), call `update(dt)` once a frame, read `root`, `rotations`,
 * `matrices` and `contacts`. Nothing is allocated after `createBlendCrowd`.
 *
 * ```ts
 * const crowd = createBlendCrowd(library, 1000);
 * const i = crowd.add({ x: 0, z: 0, yaw: 0 });
 * crowd.push(i, { foot: "left", x: 0.1, y: 0, z: 0.4, yaw: 0, lift: 0.5, land: 0.95 });
 * crowd.update(1 / 60);
 * crowd.rotations.subarray(88 * i, 88 * i + 88);
 * ```
 */
import { type GroundPose, midPose, toLocal } from "../math/frame2.ts";
import { type Numbers, quatFromAxisAngle, quatMultiply } from "../math/quaternion.ts";
import type { Footstep } from "../steps/types.ts";
import { changeBalance, restBalance } from "./balance.ts";
import {
  AIR,
  type Batch,
  type BatchOptions,
  BLEND_FROM,
  BLEND_TIME,
  createBatch,
  F_LAND,
  F_NEXT,
  FOOT,
  FOOT_STATE,
  HIPS_TIME,
  LAMBDA4,
  LAND,
  LAST_SIDE,
  NEXT_LIFT,
  NOW,
  PITCH,
  PLACE,
  QUEUE,
  QUEUE_ROW,
  STATE,
  STAY,
  STEPPING,
  T1,
  TARGET,
  TO,
  WANT,
  WANTED,
} from "./batch.ts";
import { type BlendLibrary, HIPS_AT } from "./library.ts";
import { MIX } from "./mix.ts";
import { shownBody, writePose } from "./pose.ts";
import { beginOffset, sampleBody } from "./sample.ts";
import { findNext, landFoot, startStep } from "./start-step.ts";

/** A footstep with its times, seconds on the crowd's clock. */
export interface TimedFootstep extends Footstep {
  lift: number;
  land: number;
}

/** Blends into and out of standing take longer, seconds. */
const STAND_BLEND = 0.45;
/** Longer blends for poses that are far apart: seconds per tangent of half the largest angle; at most. */
const FAR_BLEND = 0.3;
const LONGEST_BLEND = 0.45;
/** Longest blend of the hips' place. */
const HIPS_BLEND = 0.5;
const FRAME = 1 / 60;

export interface BlendCrowd extends Batch {
  /** Adds a character standing at ease. @returns its index. @throws RangeError when the crowd is full. */
  add(at: GroundPose & { y?: number }): number;
  /** Puts a character somewhere, standing, and forgets its footsteps. */
  place(i: number, at: GroundPose & { y?: number }): void;
  /**
   * Puts a character where another motion left it: its feet as they stand, its pose as it is, which then goes over into
   * standing at ease.
   *
   * @param feet left and right; @param root the hips' place; @param rotations JOINT_COUNT x 4 local rotations.
   */
  adopt(i: number, feet: readonly [Footstep, Footstep], root: Numbers, rotations: Numbers): void;
  /**
   * Queues a footstep after those already queued. @returns false when the queue (8) is full: try again later.
   */
  push(i: number, step: TimedFootstep): boolean;
  /** Forgets the footsteps that have not begun. */
  clear(i: number): void;
  /** Root control: lambda_4 and the wanted velocity in the root's frame, m/s and rad/s; NaN for the footsteps' own. */
  steer(i: number, lambda4: number, lateral: number, forward: number, turn: number): void;
  /** Whether a foot is on its way, and the place where it is or goes. */
  footstep(i: number, side: 0 | 1, out: { x: number; y: number; z: number; yaw: number }): boolean;
  /** Advances all characters by dt seconds. */
  update(dt: number): void;
}

/**
 * A crowd of at most `capacity` characters on one library.
 */
export function createBlendCrowd(
  library: BlendLibrary,
  capacity: number,
  options: Partial<BatchOptions> = {},
): BlendCrowd {
  const b = createBatch(library, capacity, options);
  const crowd = b as BlendCrowd;
  crowd.add = (at) => {
    if (b.count >= capacity) throw new RangeError(`crowd: it holds ${capacity} characters.`);
    const i = b.count++;
    crowd.place(i, at);
    return i;
  };
  crowd.place = (i, at) => stand(b, i, at);
  crowd.adopt = (i, feet, root, rotations) => adopt(b, i, feet, root, rotations);
  crowd.push = (i, step) => push(b, i, step);
  crowd.clear = (i) => {
    b.queueCount[i] = 0;
    changeBalance(b, i);
    findNext(b, i, 0);
    findNext(b, i, 1);
  };
  crowd.steer = (i, lambda4, lateral, forward, turn) => {
    const o = STATE * i;
    b.state[o + LAMBDA4] = lambda4;
    b.state[o + WANT] = lateral;
    b.state[o + WANT + 1] = forward;
    b.state[o + WANT + 2] = turn;
  };
  crowd.footstep = (i, side, out) => {
    const f = STATE * i + FOOT + FOOT_STATE * side;
    const air = b.state[f + AIR] === 1;
    const p = f + (air ? TARGET : PLACE);
    out.x = b.state[p];
    out.y = b.state[p + 1];
    out.z = b.state[p + 2];
    out.yaw = b.state[p + 3];
    return air;
  };
  crowd.update = (dt) => {
    b.time += dt;
    for (let i = 0; i < b.count; i++) advance(b, i, b.time, dt);
  };
  return crowd;
}

/** Stands a character at ease. */
function stand(b: Batch, i: number, at: GroundPose & { y?: number }): void {
  const s = b.state;
  const o = STATE * i;
  s.fill(0, o, o + STATE);
  b.queueCount[i] = 0;
  b.upperYaw[i] = 0;
  s.set([at.x, at.z, at.yaw, at.y ?? 0], o + TO);
  s.set([at.x, at.z, at.yaw, at.y ?? 0], o + NOW);
  s[o + T1] = b.time;
  s[o + LAST_SIDE] = 1;
  s[o + NEXT_LIFT] = Number.POSITIVE_INFINITY;
  const { standFoot } = b.library;
  const c = Math.cos(at.yaw);
  const n = Math.sin(at.yaw);
  for (let side = 0; side < 2; side++) {
    const f = o + FOOT + FOOT_STATE * side;
    const sign = side === 0 ? 1 : -1;
    s[f + PLACE] = at.x + sign * (c * standFoot.x + n * standFoot.z);
    s[f + PLACE + 1] = at.y ?? 0;
    s[f + PLACE + 2] = at.z + sign * (c * standFoot.z - n * standFoot.x);
    s[f + PLACE + 3] = at.yaw + sign * standFoot.yaw;
    s[f + WANTED] = s[f + PLACE];
    s[f + WANTED + 1] = s[f + PLACE + 2];
    s[f + WANTED + 2] = s[f + PLACE + 3];
    s[f + F_LAND] = Number.NEGATIVE_INFINITY;
    s[f + F_NEXT] = Number.POSITIVE_INFINITY;
    s[f + STAY] = 0.7;
    s[f + PITCH] = 0;
  }
  for (let m = 0; m < 3; m++) {
    b.mixCount[3 * i + m] = 1;
    b.mixClips[MIX * (3 * i + m)] = 0;
    b.mixWeights[MIX * (3 * i + m)] = 1;
  }
  b.triangle[2 * i] = 0;
  b.triangle[2 * i + 1] = 0;
  b.landingError[i] = Number.NaN;
  restBalance(b, i);
  writePose(b, i, b.time, 0, -1);
}

function adopt(
  b: Batch,
  i: number,
  feet: readonly [Footstep, Footstep],
  root: Numbers,
  rotations: Numbers,
): void {
  const s = b.state;
  const o = STATE * i;
  const middle = midPose(feet[0], feet[1]);
  stand(b, i, { ...middle, y: (feet[0].y + feet[1].y) / 2 });
  feet.forEach((p, side) => {
    s.set([p.x, p.y, p.z, p.yaw], o + FOOT + FOOT_STATE * side + PLACE);
    s.set([p.x, p.z, p.yaw], o + FOOT + FOOT_STATE * side + WANTED);
  });
  const { old, pose } = b.scratch;
  for (let k = 0; k < HIPS_AT; k++) old[k] = rotations[k];
  // As the rows have it: seen from the root's frame.
  const turn = new Float64Array(4);
  quatFromAxisAngle(turn, 0, 0, 1, 0, -middle.yaw);
  quatMultiply(old, 0, turn, 0, old, 0);
  const hips = toLocal(middle, { x: root[0], z: root[2], yaw: 0 });
  old.set([hips.x, root[1] - s[o + NOW + 3], hips.z], HIPS_AT);
  pose.set(b.library.stand);
  blend(b, i, b.time, old, old, pose, pose, STAND_BLEND);
  restBalance(b, i);
  writePose(b, i, b.time, 0, -1);
}

function push(b: Batch, i: number, step: TimedFootstep): boolean {
  if (b.queueCount[i] >= QUEUE) return false;
  const row = QUEUE_ROW * (QUEUE * i + ((b.queueHead[i] + b.queueCount[i]) % QUEUE));
  const side = step.foot === "left" ? 0 : 1;
  const q = b.queue;
  q[row] = side;
  q[row + 1] = step.x;
  q[row + 2] = step.y;
  q[row + 3] = step.z;
  q[row + 4] = step.yaw;
  q[row + 5] = step.normal ? step.normal[0] : 0;
  q[row + 6] = step.normal ? step.normal[1] : 0;
  q[row + 7] = step.lift;
  q[row + 8] = step.land;
  b.queueCount[i]++;
  changeBalance(b, i);
  const f = STATE * i + FOOT + FOOT_STATE * side;
  if (b.state[f + F_NEXT] === Number.POSITIVE_INFINITY) findNext(b, i, side);
  return true;
}

/** Events up to time t, then the frame. */
function advance(b: Batch, i: number, t: number, dt: number): void {
  const s = b.state;
  const o = STATE * i;
  let landed = -1;
  for (;;) {
    const row = QUEUE_ROW * (QUEUE * i + b.queueHead[i]);
    const lift = b.queueCount[i] > 0 ? b.queue[row + 7] : Number.POSITIVE_INFINITY;
    for (let side = 0; side < 2; side++) {
      const f = o + FOOT + FOOT_STATE * side;
      if (s[f + AIR] === 1 && s[f + F_LAND] <= t && s[f + F_LAND] <= lift) {
        landFoot(b, i, side);
        landed = side;
      }
    }
    if (lift > t) break;
    begin(b, i, row);
  }
  if (s[o + STEPPING] === 1 && s[o + NEXT_LIFT] === Number.POSITIVE_INFINITY && t >= s[o + LAND])
    rest(b, i, t);
  writePose(b, i, t, dt, landed);
}

/** Takes the queue's first footstep: new clips, new way, and a blend from what was shown. */
function begin(b: Batch, i: number, row: number): void {
  const s = b.state;
  const o = STATE * i;
  const { before, old, pose, after } = b.scratch;
  const lift = b.queue[row + 7];
  const wasStepping = s[o + STEPPING] === 1;
  shownBody(before, b, i, lift - FRAME);
  shownBody(old, b, i, lift);
  b.queueHead[i] = (b.queueHead[i] + 1) % QUEUE;
  b.queueCount[i]--;
  const next =
    b.queueCount[i] > 0 ? b.queue[QUEUE_ROW * (QUEUE * i + b.queueHead[i]) + 7] : Number.POSITIVE_INFINITY;
  startStep(b, i, row, next);
  changeBalance(b, i);
  const side = s[o + LAST_SIDE];
  const length = s[o + LAND] - lift;
  sampleBody(pose, b, 3 * i, side, 0);
  sampleBody(after, b, 3 * i, side, length > 0 ? FRAME / length : 0);
  blend(b, i, lift, old, before, pose, after, wasStepping ? b.options.blend : STAND_BLEND);
}

/** No step follows: the body comes to stand. */
function rest(b: Batch, i: number, t: number): void {
  const s = b.state;
  const { before, old, pose } = b.scratch;
  shownBody(before, b, i, t - FRAME);
  shownBody(old, b, i, t);
  s[STATE * i + STEPPING] = 0;
  pose.set(b.library.stand);
  blend(b, i, t, old, before, pose, pose, STAND_BLEND);
}

function blend(
  b: Batch,
  i: number,
  t: number,
  old: Float64Array,
  before: Float64Array,
  fresh: Float64Array,
  after: Float64Array,
  least: number,
): void {
  const most = beginOffset(b, i, old, before, fresh, after, FRAME);
  const o = STATE * i;
  b.state[o + BLEND_FROM] = t;
  // The hips are heavy: their place takes longer, but no longer than the step.
  const s = b.state;
  s[o + HIPS_TIME] = s[o + STEPPING] === 1 ? Math.min(HIPS_BLEND, 0.9 * (s[o + LAND] - t)) : HIPS_BLEND;
  b.state[o + BLEND_TIME] = Math.min(Math.max(LONGEST_BLEND, least), least + FAR_BLEND * most);
}
