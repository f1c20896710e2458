/**
 * The body over its feet: the centre of mass goes the way of a pendulum whose zero-moment point stays in the footsteps that are
 * known [Kajita et al. 2003; Englsberger et al. 2015 for the capture point in closed form].
 *
 * With w^2 = g / h and xi = x + x' / w (the capture point), x'' = w^2 (x - p) falls apart: xi' = w (xi - p) is solved backward from where
 * the last known footstep leaves it, piece by piece where p is a line; x' = w (xi - x) forward, from where the body is. Footsteps
 * at least one ahead make the end's influence small (exp(-w T)); what a changed plan changes fades over a fifth of a second.
 * In a run's flight nothing bears: there the hips follow the clips.
 *
 * Tried before: the hips' place from the blend alone, with its own blend between steps. Sideways it is jerked by up to 5 m/s^2
 * where clips change, which put the zero-moment point outside the soles in half of the frames.
 */

import { lerpAngle } from "../math/angle.ts";
import { GRAVITY } from "../math/gravity.ts";
import { J, JOINT_COUNT } from "../skeleton/joints.ts";
import { MASSES } from "../skeleton/masses.ts";
import {
  AIR,
  ANKLE,
  BALANCE,
  type Batch,
  F_LAND,
  F_LIFT,
  FOOT,
  FOOT_STATE,
  NOW,
  PLACE,
  QUEUE,
  QUEUE_ROW,
  STATE,
  TARGET,
} from "./batch.ts";
import { HIPS_AT } from "./library.ts";

/**
 * Offsets in a character's block of `balance`, x, z and height each: where the pendulum has the centre of mass (of the height: the
 * ground under the body); the capture point shown less the plan's; the plan's.
 */
const CENTRE = 0;
const OFF = 3;
const PLAN = 6;
/** The piece of the plan under way: pressure, its speed and the capture point at its end, and when that is. */
const PRESSURE = 9;
const DRIFT = 12;
const POINT = 15;
const UNTIL = 18;
/** When a flight begins as far as is known; Infinity. */
const FLIES = 19;
/** How far the pendulum leads, 0..1 before easing; 1 once the block holds; 1 when footsteps have changed. */
const LEAD = 20;
const KNOWN = 21;
const CHANGED = 22;
const AXES = 3;

/** Height of the centre of mass of a standing adult over that of its hips [Winter, table 4.1]. */
const CENTRE_OVER_HIPS = 1.05;
/** The ground under the body is smoothed by the same equation with this in the place of w, 1/s. */
const RISE = 10;
/**
 * Share of the difference of two feet's heights that the body is over the lower one: while it climbs, so that the leg that pushes comes
 * nearly straight, and at all other times, when the foot ahead is the lower one and has to be reached.
 */
const CLIMBS = 0.12;
const OVER_LOWER = -0.1;
/** Seconds ahead that are looked at. */
const HORIZON = 2;
/** Seconds in which the pressure goes over to the middle of the feet or back; a longer gap between steps is a stop. */
const SETTLE = 0.4;
const STOP = 0.9;
/** Pressure under a foot: ahead of the ankle, at ease; how far it is behind and ahead of that as the other foot leaves and lands, shares of the distance from ankle to ball. */
const EASE = 0.3;
const BEHIND = 0.3;
const AHEAD = 0.75;
/** Half a stride at which the pressure runs so far, shares of the leg. */
const FULL = 0.5;
/** Seconds in which a changed plan's change fades, and in which the pendulum takes over or gives way. */
const FADE = 0.2;
const TAKE_OVER = 0.45;
/** A flight this soon makes it give way, seconds. */
const FLIGHT_SOON = 0.45;
/** The last footstep known is taken for the last one when it lands sooner than this; for one of more when later, seconds. */
const LAST_SOON = 0.25;
const LAST_LATE = 0.75;
/** Farthest that the hips go from the blend, metres, reached softly. */
const FARTHEST = 0.2;

/** Knots of the pressure point: times; x, z, height. */
const MOST = 40;
const times = new Float64Array(MOST);
const points = new Float64Array(AXES * MOST);
let knots = 0;
/** Places of both feet as steps are gone through: x, z, height, yaw. */
const feet = new Float64Array(8);
const spot = new Float64Array(AXES);
const end = new Float64Array(AXES);
/** w of each axis. */
const rates = new Float64Array(AXES);

/** Adds a knot at `spot`. */
function knot(t: number): void {
  if (knots >= MOST) return;
  // Never back in time: a step that comes too soon takes over at once.
  times[knots] = knots > 0 ? Math.max(t, times[knots - 1] + 1e-4) : t;
  for (let k = 0; k < AXES; k++) points[AXES * knots + k] = spot[k];
  knots++;
}

/** Height that the body goes by while both feet are down, at rest: nearer to the lower one's, so that both legs reach. */
const between = (a: number, c: number): number => Math.min(a, c) + OVER_LOWER * Math.abs(a - c);

/** The same as it goes from the foot behind to the one ahead. */
const onTheWay = (behind: number, ahead: number): number =>
  behind < ahead ? behind + CLIMBS * (ahead - behind) : between(behind, ahead);

/** Where foot `side` is pressed when the other one is `along` (0..1) from leaving to landing at (x, z), into spot. */
function pressed(b: Batch, side: number, x: number, z: number, along: number): void {
  const { skeleton } = b.library;
  const ball = skeleton.foot.ballForward;
  const o = 4 * side;
  const fx = Math.sin(feet[o + 3]);
  const fz = Math.cos(feet[o + 3]);
  const way = ((x - feet[o]) * fx + (z - feet[o + 1]) * fz) / (FULL * skeleton.legLength);
  const share = Math.max(-0.6, Math.min(1, way));
  const ahead = ball * (EASE + share * (along * (BEHIND + AHEAD) - BEHIND));
  spot[0] = feet[o] + fx * ahead;
  spot[1] = feet[o + 1] + fz * ahead;
}

/** The middle of both feet, where a standing body presses, into spot. */
function middle(b: Batch): void {
  const ahead = EASE * b.library.skeleton.foot.ballForward;
  const yaw = lerpAngle(feet[3], feet[7], 0.5);
  spot[0] = (feet[0] + feet[4]) / 2 + ahead * Math.sin(yaw);
  spot[1] = (feet[1] + feet[5]) / 2 + ahead * Math.cos(yaw);
  spot[2] = between(feet[2], feet[6]);
}

/** One step of foot `side` to the place at `at` (x, y, z, yaw) of `from`, from `lift` to `land`: the other foot bears. */
function stepKnots(b: Batch, side: number, from: Float64Array, at: number, lift: number, land: number): void {
  const bears = feet[4 * (1 - side) + 2];
  pressed(b, 1 - side, from[at], from[at + 2], 0);
  spot[2] = onTheWay(feet[4 * side + 2], bears);
  knot(lift);
  pressed(b, 1 - side, from[at], from[at + 2], 1);
  spot[2] = onTheWay(bears, from[at + 1]);
  knot(land);
  takeFoot(side, from, at);
}

function takeFoot(side: number, from: Float64Array, at: number): void {
  feet[4 * side] = from[at];
  feet[4 * side + 1] = from[at + 2];
  feet[4 * side + 2] = from[at + 1];
  feet[4 * side + 3] = from[at + 3];
}

/**
 * Lays the pressure's knots from before t on over all footsteps that are known, and the capture point at the last one into
 * `end`; notes when a flight begins. No knots in flight.
 */
function layKnots(b: Batch, i: number, t: number): void {
  const s = b.state;
  const q = b.queue;
  const o = STATE * i;
  knots = 0;
  for (let side = 0; side < 2; side++) {
    takeFoot(side, s, o + FOOT + FOOT_STATE * side + PLACE);
  }
  const left = o + FOOT;
  const right = left + FOOT_STATE;
  b.balance[BALANCE * i + FLIES] = t;
  if (s[left + AIR] === 1 && s[right + AIR] === 1) return;
  let landed: number;
  // The step under way or, with both feet down, the one that landed last: where its foot was before it, and how long ago the other's landing.
  let last = s[left + F_LAND] >= s[right + F_LAND] ? 0 : 1;
  let fromX = feet[4 * last];
  let fromZ = feet[4 * last + 1];
  let rhythm = 0.55;
  const flying = s[left + AIR] === 1 ? 0 : s[right + AIR] === 1 ? 1 : -1;
  let flight = Number.POSITIVE_INFINITY;
  if (flying >= 0) {
    const f = o + FOOT + FOOT_STATE * flying;
    last = flying;
    fromX = s[f + PLACE];
    fromZ = s[f + PLACE + 2];
    landed = s[f + F_LAND];
    rhythm = landed - s[o + FOOT + FOOT_STATE * (1 - flying) + F_LAND];
    stepKnots(b, flying, s, f + TARGET, s[f + F_LIFT], landed);
  } else {
    landed = s[o + FOOT + FOOT_STATE * last + F_LAND];
    if (landed > t - 2) {
      pressed(b, 1 - last, feet[4 * last], feet[4 * last + 1], 1);
      spot[2] = onTheWay(feet[4 * (1 - last) + 2], feet[4 * last + 2]);
      knot(landed);
      fromX = 2 * feet[4 * (1 - last)] - feet[4 * last];
      fromZ = 2 * feet[4 * (1 - last) + 1] - feet[4 * last + 1];
    } else {
      landed = t - 2;
      middle(b);
      knot(landed);
    }
  }
  let more = true;
  for (let k = 0; k < b.queueCount[i]; k++) {
    const row = QUEUE_ROW * (QUEUE * i + ((b.queueHead[i] + k) % QUEUE));
    const side = q[row];
    const lift = q[row + 7];
    const land = Math.max(lift + 0.1, q[row + 8]);
    if (lift > t + HORIZON) break;
    if (lift < landed - 1e-6) {
      flight = lift;
      break;
    }
    if (lift - landed > STOP) {
      middle(b);
      knot(landed + SETTLE);
      knot(lift - SETTLE);
    }
    last = side;
    fromX = feet[4 * side];
    fromZ = feet[4 * side + 1];
    stepKnots(b, side, q, row + 1, lift, land);
    rhythm = land - landed;
    landed = land;
    more = k + 1 === b.queueCount[i];
  }
  if (flying < 0 && b.queueCount[i] === 0) more = true;
  b.balance[BALANCE * i + FLIES] = flight;
  lastPoint(b, t, last, fromX, fromZ, rhythm, landed, more && flight === Number.POSITIVE_INFINITY);
}

/** The capture point at the last knot: of a walk that goes on evenly, or of one that stops there. */
function lastPoint(
  b: Batch,
  t: number,
  last: number,
  fromX: number,
  fromZ: number,
  rhythm: number,
  landed: number,
  ends: boolean,
): void {
  middle(b);
  const u = (landed - t - LAST_SOON) / (LAST_LATE - LAST_SOON);
  const on = ends ? (u <= 0 ? 0 : u >= 1 ? 1 : u * u * (3 - 2 * u)) : 1;
  const time = Math.max(0.3, Math.min(1, rhythm));
  const half = Math.tanh((rates[0] * time) / 2) / 2;
  for (let k = 0; k < AXES; k++) {
    const w = rates[k];
    // The pressure's way to the middle after the last landing, solved backward from rest there.
    const settle = (1 - Math.exp(-w * SETTLE)) / (w * SETTLE);
    const at = points[AXES * (knots - 1) + k];
    const rests = at + settle * (spot[k] - at);
    end[k] = rests;
    if (k === 2) continue;
    const own = feet[4 * last + k];
    const other = feet[4 * (1 - last) + k];
    // A step's way and, left over, what swings from side to side.
    const way = (own - (k === 0 ? fromX : fromZ)) / 2;
    const walks = spot[k] + way / (w * time) + half * (own - other - way);
    end[k] += on * (walks - rests);
  }
  if (landed < t) {
    // Stopped, or about to: to the middle, and there it stays.
    knot(landed + SETTLE);
    end.set(spot);
  }
}

/** Share of the body's mass that follows an ankle when its hip stays: half of the thigh's and shank's ways, and the foot. */
const WITH_ANKLE = 0.1 * 0.433 * 0.5 + 0.0465 * (0.5 + 0.433 * 0.5) + 0.0145;

/** Share of the body's mass that goes with each joint. */
const SHARES = new Float64Array(JOINT_COUNT);
for (const [share, from, to, u] of MASSES) {
  const whole = MASSES.reduce((sum, [more]) => sum + more, 0);
  SHARES[from] += ((1 - u) * share) / whole;
  SHARES[to] += (u * share) / whole;
}

/** Where the whole body's mass is, x and z, with the ankles where they are wanted. */
const centre = new Float64Array(AXES);
function massCentre(b: Batch, i: number): void {
  const { positions } = b.scratch;
  const s = b.state;
  let x = 0;
  let z = 0;
  for (let j = 0; j < JOINT_COUNT; j++) {
    x += SHARES[j] * positions[3 * j];
    z += SHARES[j] * positions[3 * j + 2];
  }
  // Legs are closed on the ankles afterwards: what of their mass goes with the ankle.
  const l = STATE * i + FOOT + ANKLE;
  const r = l + FOOT_STATE;
  const a = 3 * J.leftFoot;
  const c = 3 * J.rightFoot;
  centre[0] = x + WITH_ANKLE * (s[l] - positions[a] + s[r] - positions[c]);
  centre[1] = z + WITH_ANKLE * (s[l + 2] - positions[a + 2] + s[r + 2] - positions[c + 2]);
}

const told = new Float64Array(AXES);

/** Forgets what was: the pendulum starts anew from where the body is. */
export function restBalance(b: Batch, i: number): void {
  b.balance[BALANCE * i + KNOWN] = 0;
}

/** Footsteps that are to come have changed. */
export function changeBalance(b: Batch, i: number): void {
  b.balance[BALANCE * i + CHANGED] = 1;
}

/** What of the way to the capture point is gone in a frame, each axis. */
const follows = new Float64Array(AXES);
/** What a frame's length and the pendulum's make of each other, kept while they stay. */
const pace = { dt: -1, w: -1, fades: 0 };

/**
 * How far the hips are to go from where the blend has them, x, z and up in the world, into out. No allocation.
 *
 * Call once a frame when joints (`scratch.positions`) and ankles wanted are those of time t.
 */
export function balanceHips(out: Float64Array, b: Batch, i: number, t: number, dt: number): void {
  const g = b.balance;
  const o = BALANCE * i;
  const w = Math.sqrt(GRAVITY / (CENTRE_OVER_HIPS * b.library.stand[HIPS_AT + 1]));
  if (pace.dt !== dt || pace.w !== w) {
    pace.dt = dt;
    pace.w = w;
    rates.fill(w, 0, 2);
    rates[2] = RISE;
    for (let a = 0; a < AXES; a++) follows[a] = 1 - Math.exp(-rates[a] * dt);
    pace.fades = Math.exp(-dt / FADE);
  }
  massCentre(b, i);
  centre[2] = b.state[STATE * i + NOW + 3];
  out.fill(0, 0, AXES);
  const known = g[o + KNOWN] === 1;
  const led = known && g[o + LEAD] > 0;
  const again = !led || g[o + CHANGED] === 1 || t > g[o + UNTIL];
  if (again) {
    // Where the plan so far has it now.
    if (led) for (let a = 0; a < AXES; a++) told[a] = planned(g, o, a, t);
    layKnots(b, i, t);
    piece(g, o, t);
    g[o + CHANGED] = 0;
  }
  const soon = g[o + FLIES] - t;
  const wanted = soon > FLIGHT_SOON ? 1 : 0;
  const step = dt / TAKE_OVER;
  const lead = known ? g[o + LEAD] + Math.max(-step, Math.min(step, wanted - g[o + LEAD])) : wanted;
  g[o + KNOWN] = 1;
  g[o + LEAD] = lead;
  if (lead <= 0 || (!led && knots === 0)) {
    // Nothing to hold: from here on it starts with the body as it is.
    g[o + LEAD] = 0;
    for (let a = 0; a < AXES; a++) g[o + CENTRE + a] = centre[a];
    return;
  }
  const u = lead * lead * lead * (10 - lead * (15 - 6 * lead));
  for (let a = 0; a < AXES; a++) {
    const plan = planned(g, o, a, t);
    const before = g[o + PLAN + a] + g[o + OFF + a];
    let off = led ? g[o + OFF + a] : 0;
    if (led && again) off += told[a] - plan;
    off *= pace.fades;
    let x = led ? g[o + CENTRE + a] : centre[a];
    if (led) x += follows[a] * ((before + plan + off) / 2 - x);
    g[o + CENTRE + a] = x;
    g[o + OFF + a] = off;
    g[o + PLAN + a] = plan;
    out[a] = (u * (x - centre[a])) / (a < 2 ? 1 - 2 * WITH_ANKLE : 1);
  }
  const far = (out[0] * out[0] + out[1] * out[1]) / (FARTHEST * FARTHEST);
  const soft = 1 / Math.sqrt(Math.sqrt(1 + far * far));
  out[0] *= soft;
  out[1] *= soft;
}

/** The plan's capture point at time t of the piece under way. */
function planned(g: Float64Array, o: number, axis: number, t: number): number {
  const w = rates[axis];
  const v = g[o + DRIFT + axis];
  const p1 = g[o + PRESSURE + axis];
  if (g[o + UNTIL] === Number.POSITIVE_INFINITY) return p1;
  const since = g[o + UNTIL] - t;
  return p1 - v * since + v / w + (g[o + POINT + axis] - p1 - v / w) * Math.exp(-w * since);
}

/** Backward over the knots to the piece with t, which the block then holds. */
function piece(g: Float64Array, o: number, t: number): void {
  // A flight that was not foreseen: the piece before goes on while the pendulum gives way.
  if (knots === 0) return;
  let k = knots - 1;
  while (k > 0 && times[k - 1] > t) {
    const time = times[k] - times[k - 1];
    for (let a = 0; a < AXES; a++) {
      const p1 = points[AXES * k + a];
      const p = points[AXES * (k - 1) + a];
      const drift = (p1 - p) / time / rates[a];
      end[a] = p + drift + (end[a] - p1 - drift) * Math.exp(-rates[a] * time);
    }
    k--;
  }
  const last = k === 0 || times[k] <= t;
  g[o + UNTIL] = last ? Number.POSITIVE_INFINITY : times[k];
  for (let a = 0; a < AXES; a++) {
    const p = points[AXES * k + a];
    g[o + PRESSURE + a] = p;
    g[o + DRIFT + a] = last ? 0 : (p - points[AXES * (k - 1) + a]) / (times[k] - times[k - 1]);
    g[o + POINT + a] = end[a];
  }
}
