/**
 * A step begins: its clips are chosen, the root's way and the times follow from them [Barycentric §§4.2-5].
 */
import { wrapAngle } from "../math/angle.ts";
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
import type { BlendLibrary } from "./library.ts";
import { MIX, type Mix } from "./mix.ts";
import { rootFrom } from "./root-track.ts";
import { DURATION, ENDED, mixMoves, queryStep, STANCE, SWING } from "./step-query.ts";

/** A next lift this much later than the clips' own is a stop in between, seconds. */
const PAUSE = 0.4;
/** Seconds from a last landing until the root rests. */
const SETTLE = 0.4;
/** Shortest swing that is made, seconds. */
const SHORTEST = 0.15;

/**
 * Starts the step to the queue row at `row` (already taken off), at its lift.
 *
 * @param next the lift of the step after it; Infinity when none is known.
 */
export function startStep(b: Batch, i: number, row: number, next: number): void {
  const s = b.state;
  const { queue, library } = b;
  const { query, mix, choice, rootWeights } = b.scratch;
  const o = STATE * i;
  const side = queue[row];
  const f = o + FOOT + FOOT_STATE * side;
  const g = o + FOOT + FOOT_STATE * (1 - side);
  const lift = queue[row + 7];
  const land = Math.max(lift + SHORTEST, queue[row + 8]);
  if (s[f + AIR] === 1) landFoot(b, i, side);
  const support = g + (s[g + AIR] === 1 ? TARGET : PLACE);
  rootFrom(s, o, lift);
  query.side = side;
  readPlace(query.from, s, f + PLACE);
  readPlace(query.support, s, support);
  readPlace(query.target, queue, row + 1);
  // A runner's other foot is still on its way.
  query.since = land - Math.max(s[f + F_LAND], s[g + F_LAND]);
  query.air = land - lift;
  query.lambda4 = s[o + LAMBDA4];
  query.want.x = s[o + WANT];
  query.want.z = s[o + WANT + 1];
  query.want.yaw = s[o + WANT + 2];
  query.epsilon = b.options.epsilon;
  query.correction = b.options.correction;
  choice.located.triangle = b.triangle[2 * i + side];
  queryStep(query, mix, choice, library, rootWeights);
  b.triangle[2 * i + side] = choice.located.triangle;
  storeMix(b, 3 * i);
  storeMix(b, 3 * i + 1 + side);
  s[f + TARGET] = query.landing.x;
  s[f + TARGET + 1] = queue[row + 2];
  s[f + TARGET + 2] = query.landing.z;
  s[f + TARGET + 3] = query.landing.yaw;
  s[f + TARGET + 4] = queue[row + 5];
  s[f + TARGET + 5] = queue[row + 6];
  leaveGround(b, i, side);
  s[f + AIR] = 1;
  s[f + F_LIFT] = lift;
  s[f + F_LAND] = land;
  s[f + STAY] = mixMoves(library, mix, side, STANCE);
  s[f + F_NEXT] = Number.POSITIVE_INFINITY;
  // Times: the clips' own, warped to the footstep's.
  const swing = mixMoves(library, mix, side, SWING);
  const duration = mixMoves(library, mix, side, DURATION);
  const goesOn = next <= Math.max(land, lift + duration) + PAUSE;
  s[o + STEPPING] = 1;
  s[o + LAST_SIDE] = side;
  s[o + LIFT] = lift;
  s[o + LAND] = land;
  s[o + PHI] = Math.max(0.3, Math.min(0.97, swing / duration));
  s[o + NEXT_LIFT] = goesOn ? next : Number.POSITIVE_INFINITY;
  if (goesOn) walkOn(b, i, side, Math.max(next, lift + SHORTEST));
  else comeToRest(s, o, f, support, query.yawAfter, land);
}

/** x, y, z, yaw of a block as a place on the ground. */
function readPlace(out: { x: number; z: number; yaw: number }, from: Float64Array, at: number): void {
  out.x = from[at];
  out.z = from[at + 2];
  out.yaw = from[at + 3];
}

/**
 * The root's end when another step follows: where the clips have it beside the foot that has landed, which is eq. 2's
 * displacement from where the track had it.
 */
function walkOn(b: Batch, i: number, side: number, next: number): void {
  const s = b.state;
  const { library } = b;
  const { mix, query } = b.scratch;
  const o = STATE * i;
  const yawAfter = query.yawAfter;
  const f = o + FOOT + FOOT_STATE * side;
  const g = o + FOOT + FOOT_STATE * (1 - side);
  const support = g + (s[g + AIR] === 1 ? TARGET : PLACE);
  const length = next - s[o + LIFT];
  const duration = mixMoves(library, mix, side, DURATION);
  const warp = duration / length;
  const turnRate = mixVelocity(library, mix, 2) * warp;
  const yaw1 = s[o + NOW + 2] + wrapAngle(yawAfter + turnRate * (next - s[o + LAND]) - s[o + NOW + 2]);
  // The landed foot seen from the root's frame at the next lift.
  const lx = mixMoves(library, mix, side, ENDED);
  const lz = mixMoves(library, mix, side, ENDED + 1);
  const c = Math.cos(yaw1);
  const n = Math.sin(yaw1);
  s[o + T1] = next;
  s[o + TO] = s[f + TARGET] - (c * lx + n * lz);
  s[o + TO + 1] = s[f + TARGET + 2] - (c * lz - n * lx);
  s[o + TO + 2] = yaw1;
  const vx = mixVelocity(library, mix, 0) * warp;
  const vz = mixVelocity(library, mix, 1) * warp;
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

function mixVelocity(library: BlendLibrary, mix: Mix, column: number): number {
  let v = 0;
  for (let k = 0; k < mix.count; k++) v += mix.weights[k] * library.velocities[3 * mix.clips[k] + column];
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
