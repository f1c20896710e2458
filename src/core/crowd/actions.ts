/** The discretised actions of a state [Footsteps §4, generating discretised footstep actions], each made into a step. */
import { arcTangent, cosine, sine } from "./elementary.ts";
import { surfaceCost } from "./ground.ts";
import {
  ACTION,
  action,
  createShift,
  createStart,
  createStop,
  footCouldPoint,
  weighFootstep,
} from "./locomotion.ts";
import { keepNext, type Planner, type Search } from "./planner.ts";
import { P, S, STATE, STEP } from "./state.ts";

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
/** Shifts: ways off the way to the goal, how far, how long, and how far the feet turn to the goal at once. */
const SHIFTS = degrees([0, 90, -90, 180, 140, -140]);
const SHIFT_COS = SHIFTS.map(cosine);
const SHIFT_SIN = SHIFTS.map(sine);
const SHIFT = 0.3;
const SHIFT_TIME = 0.8;
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
  else expandWalk(p, search, node, o, gx, gz, speed);
  const to = p.nodes;
  const stop = createStop(p.states, to * STATE, p.steps, to * STEP, p.states, o, STAND_TIME, search.gait);
  keep(p, search, node, speed < 0.05 ? stop * search.impatience : stop, 0);
}

/** Keeps the step just made unless it is impossible. */
function keep(p: Planner, search: Search, node: number, energy: number, twist: number): void {
  if (energy < 0) return;
  p.cost[p.nodes] = energy * floorCost(p, search);
  p.twist[p.nodes] = twist;
  keepNext(p, search, node, true);
}

/** What the floor adds where the step just made leads to. */
const floorCost = (p: Planner, search: Search): number => {
  const o = p.nodes * STATE;
  return search.ground.surface === null ? 1 : surfaceCost(search.ground, p.states[o], p.states[o + 1]);
};

function expandWalk(
  p: Planner,
  search: Search,
  node: number,
  o: number,
  gx: number,
  gz: number,
  speed: number,
): void {
  const { gait } = search;
  const ux = p.states[o + S.ux];
  const uz = p.states[o + S.uz];
  const side = p.states[o + S.side];
  const foot = side > 0 ? 0 : 1;
  // The turn that leads straight to the goal, if it is to the free side [Footsteps §4, goal-directed action].
  const cos = ux * gx + uz * gz;
  const sin = side * (uz * -gx + ux * gz);
  for (let t = -1; t < TURNS.length; t++) {
    if (t < 0 && (sin < TURN_SIN[0] || cos < 0.35)) continue;
    const theta = t < 0 ? arcTangent(sin, cos) : TURNS[t];
    if (theta > gait.mostTurn) continue;
    if (!footCouldPoint(p.states, o, theta, gait)) continue;
    const c = t < 0 ? cos : TURN_COS[t];
    action[ACTION.theta] = theta;
    action[ACTION.cos] = c;
    action[ACTION.sin] = t < 0 ? sin : TURN_SIN[t];
    for (let v = 0; v < PACES.length; v++) {
      const pace = search.speed * PACES[v] * gait.pace[foot];
      if (pace > speed + FASTER || pace < speed - SLOWER) continue;
      // Sharp turns are taken slowly.
      if (c < 0.8 && v === 0) continue;
      action[ACTION.speed] = pace;
      action[ACTION.duration] = v === 0 ? gait.quick[foot] : gait.slow[foot];
      const { nodes } = p;
      const q = nodes * STEP;
      if (!weighFootstep(p.states, nodes * STATE, p.steps, q, p.states, o, gait)) continue;
      p.cost[nodes] =
        (p.steps[q + P.fixedEnergy] + p.steps[q + P.speedEnergy] + p.steps[q + P.bendEnergy]) *
        floorCost(p, search);
      p.twist[nodes] = v === PACES.length - 1 ? SQUEEZE_COST : 0;
      keepNext(p, search, node, false);
    }
  }
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
    for (let v = 1; v < PACES.length; v++) {
      const to = p.nodes;
      const energy = createStart(
        p.states,
        to * STATE,
        p.steps,
        to * STEP,
        p.states,
        o,
        dx,
        dz,
        angle,
        search.speed * PACES[v] * gait.pace[0],
        gait.slow[0],
        gait,
      );
      keep(p, search, node, energy, v === PACES.length - 1 ? SQUEEZE_COST : 0);
    }
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
      SHIFT_TIME,
      gait,
    );
    if (energy < 0) return;
    keep(p, search, node, far === 0 ? energy : energy + SQUEEZE_COST, far === 0 ? 0 : KEEP_COST);
  };
  for (let t = Math.abs(goalYaw) > WIDEST_START ? 0 : 1; t < SHIFTS.length; t++) {
    const dx = SHIFT_COS[t] * gx + SHIFT_SIN[t] * gz;
    const dz = SHIFT_COS[t] * gz - SHIFT_SIN[t] * gx;
    shift(dx, dz, SHIFT, toX, toZ, turn);
  }
  if (Math.abs(turn) > 0.2) shift(gx, gz, 0, toX, toZ, turn);
}
