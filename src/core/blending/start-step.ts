/**
 * A step begins: the clips that land on its footstep, the root's way, the times [Barycentric §§4.3-5].
 *
 * The foot's space is laid on the root's track at the lift; the turn that the track asks for beyond what the clips turn by
 * themselves is made about the ball of the supporting foot, so the query is turned back by it first. The track's root, not
 * the one shown, because that lags where speed changes: a query from it would answer one odd step with more of them.
 */
import { lerpAngle, wrapAngle } from "../math/angle.ts";
import {
  AIR,
  type Batch,
  F_LAND,
  F_LIFT,
  F_NEXT,
  FOOT,
  FOOT_STATE,
  LAMBDA4,
  LAND,
  LAST_LAND,
  LAST_SIDE,
  LIFT,
  NEXT_LIFT,
  NOW,
  PHI,
  PLACE,
  PLACE_SIZE,
  QUEUE,
  QUEUE_ROW,
  STATE,
  STAY,
  STEPPING,
  T1,
  TARGET,
  TO,
  TO_V,
  WANT,
} from "./batch.ts";
import { leaveGround } from "./foot-track.ts";
import { MOVE_ROW } from "./library.ts";
import { chooseMix, MIX } from "./mix.ts";
import { rootWeights } from "./polar-bands.ts";
import { rootFrom } from "./root-track.ts";
import { blendMoves } from "./sample.ts";

/** Columns of `moves`. */
const WHOLE = 6;
const SWING = 9;
const DURATION = 10;
const STANCE = 11;
const ENDED = 12;

/** A next lift this much later than the clips' own is a stop in between, seconds. */
const PAUSE = 0.4;
/** A landing longer ago was of another walk; a step from rest counts this much before its lift, seconds. */
const LONG_AGO = 1.3;
const REST_LEAD = 0.15;
/** Seconds from a last landing until the root rests. */
const SETTLE = 0.4;
/** Most that a step turns beyond its clips, radians. */
const MOST_TURN = 1.4;
/** Shortest swing that is made, seconds. */
const SHORTEST = 0.15;

/** Turns (x, z) about (cx, cz) by `angle` into `at`. */
const at = new Float64Array(2);
function turned(x: number, z: number, cx: number, cz: number, angle: number): void {
  const c = Math.cos(angle);
  const n = Math.sin(angle);
  const dx = x - cx;
  const dz = z - cz;
  at[0] = cx + c * dx + n * dz;
  at[1] = cz - n * dx + c * dz;
}

/**
 * Starts the step to the queue row at `row` (already taken off), at its lift.
 *
 * @param next the lift of the step after it; Infinity when none is known.
 */
export function startStep(b: Batch, i: number, row: number, next: number): void {
  const s = b.state;
  const q = b.queue;
  const o = STATE * i;
  const side = q[row];
  const f = o + FOOT + FOOT_STATE * side;
  const g = o + FOOT + FOOT_STATE * (1 - side);
  const lift = q[row + 7];
  const land = Math.max(lift + SHORTEST, q[row + 8]);
  if (s[f + AIR] === 1) landFoot(b, i, side);
  const support = g + (s[g + AIR] === 1 ? TARGET : PLACE);
  rootFrom(s, o, lift);
  const ball = b.library.skeleton.foot.ballForward;
  const bx = s[support] + Math.sin(s[support + 3]) * ball;
  const bz = s[support + 2] + Math.cos(s[support + 3]) * ball;
  // The root's track at the two landings: midpoints and mean yaws of consecutive footsteps [§4.2].
  const mx = (s[f + PLACE] + s[support]) / 2;
  const mz = (s[f + PLACE + 2] + s[support + 2]) / 2;
  const yawBefore = lerpAngle(s[f + PLACE + 3], s[support + 3], 0.5);
  const yawAfter = lerpAngle(s[support + 3], q[row + 4], 0.5);
  const since = land - s[o + LAST_LAND];
  const time = since > SHORTEST && since < LONG_AGO ? since : land - lift + REST_LEAD;
  // Share of the time between the landings that is past at the lift; below 0 in a run, which lifts first.
  const past = Math.max(-1, (time - (land - lift)) / time);
  const turn = wrapAngle(yawAfter - yawBefore);
  const scratch = b.scratch;
  const lambda4 = s[o + LAMBDA4];
  if (lambda4 > 0)
    rootWeights(scratch.rootWeights, b.library.root, s[o + WANT], s[o + WANT + 1], s[o + WANT + 2]);
  else {
    const vx = (q[row + 1] - s[f + PLACE]) / (2 * time);
    const vz = (q[row + 3] - s[f + PLACE + 2]) / (2 * time);
    const c = Math.cos(yawBefore);
    const n = Math.sin(yawBefore);
    rootWeights(scratch.rootWeights, b.library.root, c * vx - n * vz, n * vx + c * vz, turn / time);
  }
  const mix = 3 * i;
  const space = b.library.feet[side];
  const choice = scratch.choice;
  choice.located.triangle = b.triangle[2 * i + side];
  let over = 0;
  let natural = turn;
  let x0 = 0;
  let z0 = 0;
  let yaw0 = 0;
  let px = 0;
  let pz = 0;
  for (let round = 0; round < 3; round++) {
    over = Math.max(-MOST_TURN, Math.min(MOST_TURN, wrapAngle(turn - natural)));
    turned(q[row + 1], q[row + 3], bx, bz, -over);
    // The track's root at the lift, as if there were no turn but the clips'.
    x0 = mx + past * ((at[0] + s[support]) / 2 - mx);
    z0 = mz + past * ((at[1] + s[support + 2]) / 2 - mz);
    yaw0 = yawBefore + past * natural;
    const c = Math.cos(yaw0);
    const n = Math.sin(yaw0);
    px = c * (at[0] - x0) - n * (at[1] - z0);
    pz = n * (at[0] - x0) + c * (at[1] - z0);
    chooseMix(scratch.mix, choice, space, px, pz, scratch.rootWeights, b.options.epsilon, lambda4);
    storeMix(b, mix);
    // Turn between the landings: the clips' even rate over their time.
    const wanted =
      (blendMoves(b, mix, side, MOVE_ROW, WHOLE + 2) * time) /
      Math.max(0.1, blendMoves(b, mix, side, MOVE_ROW, DURATION));
    if (Math.abs(wanted - natural) < 0.01) break;
    natural = wanted;
  }
  b.triangle[2 * i + side] = choice.located.triangle;
  copyMix(b, mix, 3 * i + 1 + side);
  // Where it lands: on the footstep, or as near as the correction allows [§5, outside the convex hull].
  let rx = choice.x;
  let rz = choice.z;
  const limit = b.options.correction * (1 - choice.lambda4);
  const out = choice.located.outside;
  const f1 = out > 1e-9 ? Math.min(1, limit / out) : 0;
  rx += f1 * (px - choice.located.x);
  rz += f1 * (pz - choice.located.z);
  const exact = choice.lambda4 === 0 && (out <= limit || out === 0);
  const c = Math.cos(yaw0);
  const n = Math.sin(yaw0);
  turned(x0 + c * rx + n * rz, z0 - n * rx + c * rz, bx, bz, over);
  s[f + TARGET] = exact ? q[row + 1] : at[0];
  s[f + TARGET + 1] = q[row + 2];
  s[f + TARGET + 2] = exact ? q[row + 3] : at[1];
  s[f + TARGET + 3] = q[row + 4];
  s[f + TARGET + 4] = q[row + 5];
  s[f + TARGET + 5] = q[row + 6];
  leaveGround(b, i, side);
  s[f + AIR] = 1;
  s[f + F_LIFT] = lift;
  s[f + F_LAND] = land;
  s[f + STAY] = blendMoves(b, mix, side, MOVE_ROW, STANCE);
  s[f + F_NEXT] = Number.POSITIVE_INFINITY;
  // Times: the clips' own, warped to the footstep's.
  const swing = blendMoves(b, mix, side, MOVE_ROW, SWING);
  const duration = blendMoves(b, mix, side, MOVE_ROW, DURATION);
  const goesOn = next <= Math.max(land, lift + duration) + PAUSE;
  s[o + STEPPING] = 1;
  s[o + LAST_SIDE] = side;
  s[o + LIFT] = lift;
  s[o + LAND] = land;
  s[o + PHI] = Math.max(0.3, Math.min(0.97, swing / duration));
  s[o + NEXT_LIFT] = goesOn ? next : Number.POSITIVE_INFINITY;
  if (goesOn) walkOn(b, i, side, yawAfter, Math.max(next, lift + SHORTEST));
  else comeToRest(s, o, f, support, yawAfter, land);
}

/**
 * The root's end when another step follows: where the clips have it beside the foot that has landed, which is eq. 2's
 * displacement from where the track had it.
 */
function walkOn(b: Batch, i: number, side: number, yawAfter: number, next: number): void {
  const s = b.state;
  const o = STATE * i;
  const mix = 3 * i;
  const f = o + FOOT + FOOT_STATE * side;
  const g = o + FOOT + FOOT_STATE * (1 - side);
  const support = g + (s[g + AIR] === 1 ? TARGET : PLACE);
  const length = next - s[o + LIFT];
  const duration = blendMoves(b, mix, side, MOVE_ROW, DURATION);
  const warp = duration / length;
  const turnRate = mixVelocity(b, mix, 2) * warp;
  const yaw1 = s[o + NOW + 2] + wrapAngle(yawAfter + turnRate * (next - s[o + LAND]) - s[o + NOW + 2]);
  // The landed foot seen from the root's frame at the next lift.
  const lx = blendMoves(b, mix, side, MOVE_ROW, ENDED);
  const lz = blendMoves(b, mix, side, MOVE_ROW, ENDED + 1);
  const c = Math.cos(yaw1);
  const n = Math.sin(yaw1);
  s[o + T1] = next;
  s[o + TO] = s[f + TARGET] - (c * lx + n * lz);
  s[o + TO + 1] = s[f + TARGET + 2] - (c * lz - n * lx);
  s[o + TO + 2] = yaw1;
  const vx = mixVelocity(b, mix, 0) * warp;
  const vz = mixVelocity(b, mix, 1) * warp;
  s[o + TO_V] = c * vx + n * vz;
  s[o + TO_V + 1] = c * vz - n * vx;
  s[o + TO_V + 2] = turnRate;
  // Height: along the line from the supporting footstep to the new one.
  const wx = s[f + TARGET] - s[support];
  const wz = s[f + TARGET + 2] - s[support + 2];
  const w = Math.max(0.04, wx * wx + wz * wz);
  const u = ((s[o + TO] - s[support]) * wx + (s[o + TO + 1] - s[support + 2]) * wz) / w;
  const rise = s[f + TARGET + 1] - s[support + 1];
  s[o + TO + 3] = s[support + 1] + Math.max(0, Math.min(1, u)) * rise;
  s[o + TO_V + 3] = (rise * (s[o + TO_V] * wx + s[o + TO_V + 1] * wz)) / w;
}

function mixVelocity(b: Batch, mix: number, column: number): number {
  let v = 0;
  for (let k = 0; k < b.mixCount[mix]; k++)
    v += b.mixWeights[MIX * mix + k] * b.library.velocities[3 * b.mixClips[MIX * mix + k] + column];
  return v;
}

/** The root's end when nothing follows: over the middle of the feet, at rest. */
function comeToRest(
  s: Float64Array,
  o: number,
  f: number,
  support: number,
  yawAfter: number,
  land: number,
): void {
  s[o + T1] = land + SETTLE;
  s[o + TO] = (s[f + TARGET] + s[support]) / 2;
  s[o + TO + 1] = (s[f + TARGET + 2] + s[support + 2]) / 2;
  s[o + TO + 2] = s[o + NOW + 2] + wrapAngle(yawAfter - s[o + NOW + 2]);
  s[o + TO + 3] = (s[f + TARGET + 1] + s[support + 1]) / 2;
  for (let k = 0; k < 4; k++) s[o + TO_V + k] = 0;
}

/** A foot comes down: its target is its place. */
export function landFoot(b: Batch, i: number, side: number): void {
  const s = b.state;
  const f = STATE * i + FOOT + FOOT_STATE * side;
  for (let k = 0; k < PLACE_SIZE; k++) s[f + PLACE + k] = s[f + TARGET + k];
  s[f + AIR] = 0;
  s[STATE * i + LAST_LAND] = s[f + F_LAND];
  findNext(b, i, side);
}

/** The next lift of a foot that the queue knows. */
export function findNext(b: Batch, i: number, side: number): void {
  let next = Number.POSITIVE_INFINITY;
  for (let k = 0; k < b.queueCount[i]; k++) {
    const row = QUEUE_ROW * (QUEUE * i + ((b.queueHead[i] + k) % QUEUE));
    if (b.queue[row] !== side) continue;
    next = b.queue[row + 7];
    break;
  }
  b.state[STATE * i + FOOT + FOOT_STATE * side + F_NEXT] = next;
}

function storeMix(b: Batch, mix: number): void {
  const m = b.scratch.mix;
  b.mixCount[mix] = m.count;
  for (let k = 0; k < m.count; k++) {
    b.mixClips[MIX * mix + k] = m.clips[k];
    b.mixWeights[MIX * mix + k] = m.weights[k];
  }
}

export function copyMix(b: Batch, from: number, to: number): void {
  b.mixCount[to] = b.mixCount[from];
  for (let k = 0; k < MIX; k++) {
    b.mixClips[MIX * to + k] = b.mixClips[MIX * from + k];
    b.mixWeights[MIX * to + k] = b.mixWeights[MIX * from + k];
  }
}
