/**
 * Which clips make a step, and where it lands [Barycentric §§4.3-5].
 *
 * The foot's space is laid on the root's track at the lift; the turn that the track asks for beyond what the clips turn by
 * themselves is made about the ball of the supporting foot, so the query is turned back by it first. The track's root, not
 * the one shown, because that lags where speed changes: a query from it would answer one odd step with more of them.
 */
import { lerpAngle, wrapAngle } from "../math/angle.ts";
import { type BlendLibrary, MOVE_ROW } from "./library.ts";
import { type Choice, chooseMix, type Mix } from "./mix.ts";
import { rootWeights } from "./polar-bands.ts";

/** Columns of `moves`. */
export const WHOLE = 6;
export const SWING = 9;
export const DURATION = 10;
export const STANCE = 11;
export const ENDED = 12;

/** Most that a step turns beyond its clips, radians. */
const MOST_TURN = 1.4;
/** A landing longer ago was of another walk; a step from rest counts this much before its lift, seconds. */
const LONG_AGO = 1.3;
const REST_LEAD = 0.15;
const SHORTEST = 0.15;

/** A place on the ground as numbers that are set again and again. */
export interface Place {
  x: number;
  z: number;
  yaw: number;
}

/** What is asked of a step, and what comes of it. Made once, filled in for every step. */
export interface StepQuery {
  side: number;
  /** The foot's place before, the supporting foot's, the footstep wanted. */
  from: Place;
  support: Place;
  target: Place;
  /** Seconds from the landing before to the landing; from the lift to it. */
  since: number;
  air: number;
  /** lambda_4 and the root's wanted velocity in its own frame; with lambda_4 = 0 the track's own velocity counts. */
  lambda4: number;
  want: Place;
  /** Options of the batch. */
  epsilon: number;
  correction: number;
  /** Written: where the foot lands, the root's yaw there by the track, the root's velocity (lateral, forward, turn). */
  landing: Place;
  yawAfter: number;
  velocity: Place;
  /** Whether the footstep itself is reached. */
  exact: boolean;
  /** The query in the root's frame. */
  x: number;
  z: number;
}

const place = (): Place => ({ x: 0, z: 0, yaw: 0 });

export const createStepQuery = (): StepQuery => ({
  side: 0,
  from: place(),
  support: place(),
  target: place(),
  since: Number.POSITIVE_INFINITY,
  air: 0.4,
  lambda4: 0,
  want: place(),
  epsilon: 0.12,
  correction: 0.25,
  landing: place(),
  yawAfter: 0,
  velocity: place(),
  exact: true,
  x: 0,
  z: 0,
});

/** A number of each clip's step (a column of `moves`), blended by a mix: eq. 2 and its like. */
export function mixMoves(library: BlendLibrary, mix: Mix, side: number, column: number): number {
  let out = 0;
  for (let k = 0; k < mix.count; k++)
    out += mix.weights[k] * library.moves[MOVE_ROW * (2 * mix.clips[k] + side) + column];
  return out;
}

/** (x, z) turned about (cx, cz) by `angle`, into `at`. */
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
 * Answers a query. No allocation.
 *
 * @param mix, @param choice written; choice.located.triangle is where the search starts.
 * @param weights work array, one number a clip.
 */
export function queryStep(
  q: StepQuery,
  mix: Mix,
  choice: Choice,
  library: BlendLibrary,
  weights: Float64Array,
): void {
  const { from, support, target, side } = q;
  const ball = library.skeleton.foot.ballForward;
  const bx = support.x + Math.sin(support.yaw) * ball;
  const bz = support.z + Math.cos(support.yaw) * ball;
  // The root's track at the two landings: midpoints and mean yaws of consecutive footsteps [§4.2].
  const mx = (from.x + support.x) / 2;
  const mz = (from.z + support.z) / 2;
  const yawBefore = lerpAngle(from.yaw, support.yaw, 0.5);
  q.yawAfter = lerpAngle(support.yaw, target.yaw, 0.5);
  const time = q.since > SHORTEST && q.since < LONG_AGO ? q.since : q.air + REST_LEAD;
  // Share of the time between the landings that is past at the lift; below 0 in a run, which lifts first.
  const past = Math.max(-1, (time - q.air) / time);
  const turn = wrapAngle(q.yawAfter - yawBefore);
  if (q.lambda4 > 0) {
    q.velocity.x = q.want.x;
    q.velocity.z = q.want.z;
    q.velocity.yaw = q.want.yaw;
  } else {
    const vx = (target.x - from.x) / (2 * time);
    const vz = (target.z - from.z) / (2 * time);
    const c = Math.cos(yawBefore);
    const n = Math.sin(yawBefore);
    q.velocity.x = c * vx - n * vz;
    q.velocity.z = n * vx + c * vz;
    q.velocity.yaw = turn / time;
  }
  rootWeights(weights, library.root, q.velocity.x, q.velocity.z, q.velocity.yaw);
  const space = library.feet[side];
  let over = 0;
  let natural = turn;
  let x0 = 0;
  let z0 = 0;
  let yaw0 = 0;
  for (let round = 0; round < 3; round++) {
    over = Math.max(-MOST_TURN, Math.min(MOST_TURN, wrapAngle(turn - natural)));
    turned(target.x, target.z, bx, bz, -over);
    // The track's root at the lift, as if there were no turn but the clips'.
    x0 = mx + past * ((at[0] + support.x) / 2 - mx);
    z0 = mz + past * ((at[1] + support.z) / 2 - mz);
    yaw0 = yawBefore + past * natural;
    const c = Math.cos(yaw0);
    const n = Math.sin(yaw0);
    q.x = c * (at[0] - x0) - n * (at[1] - z0);
    q.z = n * (at[0] - x0) + c * (at[1] - z0);
    chooseMix(mix, choice, space, q.x, q.z, weights, q.epsilon, q.lambda4);
    // Turn between the landings: the clips' even rate over their time.
    const wanted =
      (mixMoves(library, mix, side, WHOLE + 2) * time) /
      Math.max(0.1, mixMoves(library, mix, side, DURATION));
    if (Math.abs(wanted - natural) < 0.01) break;
    natural = wanted;
  }
  // On the footstep, or as near as the correction allows [§5, outside the convex hull].
  const limit = q.correction * (1 - choice.lambda4);
  const out = choice.located.outside;
  q.exact = choice.lambda4 === 0 && out <= limit;
  q.landing.yaw = target.yaw;
  if (q.exact) {
    q.landing.x = target.x;
    q.landing.z = target.z;
    return;
  }
  const share = out > 1e-9 ? Math.min(1, limit / out) : 0;
  const rx = choice.x + share * (q.x - choice.located.x);
  const rz = choice.z + share * (q.z - choice.located.z);
  const c = Math.cos(yaw0);
  const n = Math.sin(yaw0);
  turned(x0 + c * rx + n * rz, z0 - n * rx + c * rz, bx, bz, over);
  q.landing.x = at[0];
  q.landing.z = at[1];
}
