/** The discretised actions of a state [Footsteps §4, generating discretised footstep actions], each made into a step. */
import { arcTangent, cosine, sine } from "./elementary.ts";
import { surfaceCost } from "./ground.ts";
import {
  ACTION,
  ACTIONS,
  action,
  createShift,
  createStart,
  createStop,
  footCouldPoint,
  WEIGHED,
  weighed,
  weighFootstep,
} from "./locomotion.ts";
import { keepMade, keepWeighed, type Planner, type Search } from "./planner.ts";
import { P, S, STATE, STEP } from "./state.ts";
import { stepTime } from "./types.ts";

const degrees = (values: number[]): number[] => values.map((d) => (d * Math.PI) / 180);
/** Turns of the parabola from the motion: from almost straight to almost a U-turn. */
const TURNS = degrees([3, 10, 22, 40, 62]);
const TURN_COS = TURNS.map(cosine);
const TURN_SIN = TURNS.map(sine);
/** Speeds over the speed wanted. */
const PACES = [1, 0.72, 0.4];
/** How much faster and slower a step may be than the one before, metres a second. */
const FASTER = 0.75;
const SLOWER = 0.95;
/** From rest: ways off the way to the goal. */
const STARTS = degrees([0, 25, -25, 55, -55, 95, -95, 150]);
const START_COS = STARTS.map(cosine);
const START_SIN = STARTS.map(sine);
/** Widest start over the feet's heading, radians: beyond it feet are shifted or turned first. */
const WIDEST_START = 1.6;
/** Cosine between torso and feet under which one stands twisted. */
const TWISTED = 0.9;
/** Shifts: ways off the way to the goal, how far, how long, and how far the feet turn to the goal at once. */
const SHIFTS = degrees([0, 90, -90, 180, 140, -140]);
const SHIFT_COS = SHIFTS.map(cosine);
const SHIFT_SIN = SHIFTS.map(sine);
const SHIFT = 0.3;
const SHIFT_TIME = 0.8;
/** The same where the feet turn farther than this, radians: each step takes 0.6 s with the shift of weight before it, as people's do. */
const TURNS_FAR = 0.5;
const TURN_TIME = 1.2;
const SHIFT_TURN = 1.05;
/** Effort of going sideways or with the torso twisted, J/kg a step. */
const SQUEEZE_COST = 0.25;
/** The same for shifting without turning, where turning is not free. */
const KEEP_COST = 0.05;
const STAND_TIME = 0.4;

/** Adds the children of a node; (gx, gz) is the way to its local goal, unit. */
export function expand(p: Planner, search: Search, node: number, gx: number, gz: number): void {
  const o = node * STATE;
  const speed = p.states[o + S.speed];
  if (speed < 0.05) expandRest(p, search, node, o, gx, gz);
  else expandWalk(p, search, node, o, gx, gz);
  const to = p.nodes;
  const stop = createStop(p.states, to * STATE, p.steps, to * STEP, p.states, o, STAND_TIME, search.gait);
  keep(p, search, node, speed < 0.05 ? stop * search.impatience : stop, 0);
}

/** Keeps the step just made unless it is impossible. */
function keep(
  p: Planner,
  search: Search,
  node: number,
  energy: number,
  twist: number,
  pace: number = PACES.length,
): void {
  if (energy < 0) return;
  p.pace[p.nodes] = pace;
  const o = p.nodes * STATE;
  p.cost[p.nodes] = energy * floorCost(search, p.states[o + S.x], p.states[o + S.z]);
  p.twist[p.nodes] = twist;
  keepMade(p, search, node);
}

/** Energy of a step over that on plain floor, by where it leads. */
const floorCost = (search: Search, x: number, z: number): number =>
  search.ground.surface === null ? 1 : surfaceCost(search.ground, x, z);

function expandWalk(p: Planner, search: Search, node: number, o: number, gx: number, gz: number): void {
  const { gait } = search;
  const ux = p.states[o + S.ux];
  const uz = p.states[o + S.uz];
  const side = p.states[o + S.side];
  // The turn that leads straight to the goal, if it is to the free side [Footsteps §4, goal-directed action].
  const cos = ux * gx + uz * gz;
  const sin = side * (uz * -gx + ux * gz);
  for (let t = -1; t < TURNS.length; t++) {
    if (t < 0 && (sin < TURN_SIN[0] || cos < 0.35)) continue;
    const theta = t < 0 ? arcTangent(sin, cos) : TURNS[t];
    if (theta > gait.mostTurn) continue;
    if (!footCouldPoint(p.states, o, theta, gait)) continue;
    action[ACTION.theta] = theta;
    action[ACTION.cos] = t < 0 ? cos : TURN_COS[t];
    action[ACTION.sin] = t < 0 ? sin : TURN_SIN[t];
    keepPace(p, search, node, 0);
  }
}

/** Keeps the step of the action's turn at the first pace from `from` on that is possible. */
function keepPace(p: Planner, search: Search, node: number, from: number): void {
  const { gait } = search;
  const o = node * STATE;
  const speed = p.states[o + S.speed];
  const foot = p.states[o + S.side] > 0 ? 0 : 1;
  // Sharp turns are taken slowly.
  for (let v = from === 0 && action[ACTION.cos] < 0.8 ? 1 : from; v < PACES.length; v++) {
    const pace = search.speed * PACES[v] * gait.pace[foot];
    if (pace > speed + FASTER || pace < speed - SLOWER) continue;
    action[ACTION.speed] = pace;
    action[ACTION.duration] = v === 0 ? stepTime(gait, foot, search.speed) : gait.slow[foot];
    if (!weighFootstep(p.states, o, gait)) continue;
    const { nodes } = p;
    p.cost[nodes] =
      (weighed[WEIGHED.fixedEnergy] + weighed[WEIGHED.speedEnergy] + weighed[WEIGHED.bendEnergy]) *
      floorCost(search, weighed[WEIGHED.x], weighed[WEIGHED.z]);
    p.twist[nodes] = v === PACES.length - 1 ? SQUEEZE_COST : 0;
    p.pace[nodes] = v;
    keepWeighed(p, search, node);
    return;
  }
}

/**
 * Adds the same step as a node's at the next slower pace that is possible, once the node is the best one open: slower hardly ever
 * looks better before, and most are never asked for.
 */
export function expandSlower(p: Planner, search: Search, node: number): void {
  const pace = p.pace[node] + 1;
  if (pace >= PACES.length) return;
  const from = p.parent[node];
  const q = node * STEP;
  if (p.states[from * STATE + S.speed] >= 0.05) {
    for (let k = 0; k < ACTIONS; k++) action[k] = p.actions[node * ACTIONS + k];
    keepPace(p, search, from, pace);
  } else
    keepStart(
      p,
      search,
      from,
      p.steps[q + P.px],
      p.steps[q + P.pz],
      -p.steps[q + P.side] * p.steps[q + P.yaw],
      pace,
    );
}

/** Keeps a start from rest towards (dx, dz), `angle` off the feet's heading. */
function keepStart(
  p: Planner,
  search: Search,
  node: number,
  dx: number,
  dz: number,
  angle: number,
  v: number,
): void {
  const { gait } = search;
  const to = p.nodes;
  const energy = createStart(
    p.states,
    to * STATE,
    p.steps,
    to * STEP,
    p.states,
    node * STATE,
    dx,
    dz,
    angle,
    search.speed * PACES[v] * gait.pace[0],
    gait.slow[0],
    gait,
  );
  keep(p, search, node, energy, v === PACES.length - 1 ? SQUEEZE_COST : 0, v);
}

function expandRest(p: Planner, search: Search, node: number, o: number, gx: number, gz: number): void {
  const { gait } = search;
  const headX = p.states[o + S.headX];
  const headZ = p.states[o + S.headZ];
  // Yaw grows to the left, (z, -x) of the heading.
  const goalYaw = arcTangent(gx * headZ - gz * headX, gx * headX + gz * headZ);
  for (let t = 0; t < STARTS.length; t++) {
    const dx = START_COS[t] * gx + START_SIN[t] * gz;
    const dz = START_COS[t] * gz - START_SIN[t] * gx;
    let angle = goalYaw + STARTS[t];
    if (angle > Math.PI) angle -= 2 * Math.PI;
    else if (angle < -Math.PI) angle += 2 * Math.PI;
    if (Math.abs(angle) > WIDEST_START) continue;
    keepStart(p, search, node, dx, dz, angle, 1);
  }
  // What the feet may turn towards the goal while they shift.
  const most = Math.min(gait.yawRange, SHIFT_TURN);
  const turn = goalYaw > most ? most : goalYaw < -most ? -most : goalYaw;
  const c = cosine(turn);
  const s = sine(turn);
  const toX = c * headX + s * headZ;
  const toZ = c * headZ - s * headX;
  const shift = (dx: number, dz: number, far: number, hx: number, hz: number, by: number): void => {
    const to = p.nodes;
    const energy = createShift(
      p.states,
      to * STATE,
      p.steps,
      to * STEP,
      p.states,
      o,
      dx,
      dz,
      far,
      hx,
      hz,
      by,
      Math.abs(by) > TURNS_FAR ? TURN_TIME : SHIFT_TIME,
      gait,
    );
    if (energy < 0) return;
    keep(p, search, node, far === 0 ? energy : energy + SQUEEZE_COST, far === 0 ? 0 : KEEP_COST);
  };
  // Who stands wedged, torso twisted over the feet, may only come on as it is: a start would turn a shoulder into what it is twisted for.
  const twisted = p.states[o + S.faceX] * headX + p.states[o + S.faceZ] * headZ < TWISTED;
  for (let t = twisted || Math.abs(goalYaw) > WIDEST_START ? 0 : 1; t < SHIFTS.length; t++) {
    const dx = SHIFT_COS[t] * gx + SHIFT_SIN[t] * gz;
    const dz = SHIFT_COS[t] * gz - SHIFT_SIN[t] * gx;
    shift(dx, dz, SHIFT, toX, toZ, turn);
  }
  if (Math.abs(turn) > 0.2) shift(gx, gz, 0, toX, toZ, turn);
}
