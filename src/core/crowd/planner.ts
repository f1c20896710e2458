/**
 * Short-horizon best-first search over footsteps [Footsteps §4, Algorithm 1].
 *
 * One thing is added to the paper's search so that nobody ever walks into another: a step is only taken when, at its end, its
 * walker could still come to rest without touching any other's step and rest. All keep to that, one after the other,
 * so resting is always possible. Beyond that first step others are where they have said that they will be, which may
 * change, and so costs instead of forbidding.
 */
import { cosine, sine } from "./elementary.ts";
import { farFromWalls, type Ground, nearestGap } from "./ground.ts";
import {
  createFootstep,
  createStep,
  createStop,
  evaluateStep,
  S,
  STATE,
  STOP_TIME,
  type Step,
} from "./locomotion.ts";
import { ahead, type LongWay } from "./long-way.ts";
import { BODY_RADIUS, type Gait, SHOULDER } from "./types.ts";

/** Seconds looked ahead and their samples. */
export const HORIZON = 3;
const SAMPLE = 0.1;
const SAMPLES = 46;
/** Others that are looked at: the nearest within the visual field. */
const MOST_OTHERS = 18;
/** Gap kept between bodies, and to walls, metres. */
const MARGIN = 0.03;
const WALL_MARGIN = 0.015;
/** Gap within which another's nearness costs, and what a predicted touch costs, J/kg a sample. */
const SPACE = 0.3;
const SPACE_COST = 0.12;
const TOUCH_COST = 2.5;
const MOST_NODES = 2400;

const TURNS = [3, 10, 22, 40, 62].map((d) => (d * Math.PI) / 180);
const TURN_COS = TURNS.map(cosine);
const TURN_SIN = TURNS.map(sine);
/** From rest: ways off the way to the goal. */
const STARTS = [0, 25, -25, 55, -55, 95, -95, 150].map((d) => (d * Math.PI) / 180);
const START_COS = STARTS.map(cosine);
const START_SIN = STARTS.map(sine);
const PACES = [1, 0.72, 0.4];
const SQUEEZE_COST = 0.25;

/** Others' bodies over the samples: what they are bound to do, and what they say they will. */
export interface Others {
  count: number;
  /** MOST_OTHERS x SAMPLES x 4: x, z, facing. */
  bound: Float64Array;
  told: Float64Array;
  /** Nearest gap now, to tell who overlaps from the start. */
  now: Float64Array;
}

export interface Planner {
  gait: Gait;
  states: Float64Array;
  steps: Step[];
  parent: Int32Array;
  depth: Int32Array;
  g: Float64Array;
  h: Float64Array;
  heap: Int32Array;
  f: Float64Array;
  others: Others;
  /** The answer: node indices of the path, first step first. */
  path: Int32Array;
  pathLength: number;
  expanded: number;
  generated: number;
}

export function createPlanner(gait: Gait): Planner {
  return {
    gait,
    states: new Float64Array(MOST_NODES * STATE),
    steps: Array.from({ length: MOST_NODES }, createStep),
    parent: new Int32Array(MOST_NODES),
    depth: new Int32Array(MOST_NODES),
    g: new Float64Array(MOST_NODES),
    h: new Float64Array(MOST_NODES),
    heap: new Int32Array(MOST_NODES),
    f: new Float64Array(MOST_NODES),
    others: {
      count: 0,
      bound: new Float64Array(MOST_OTHERS * SAMPLES * 4),
      told: new Float64Array(MOST_OTHERS * SAMPLES * 4),
      now: new Float64Array(MOST_OTHERS),
    },
    path: new Int32Array(64),
    pathLength: 0,
    expanded: 0,
    generated: 0,
  };
}

/** Somebody to be seen: the step under way and those to come. */
export interface Walker {
  step: Step;
  plan: Step[];
  planned: number;
}

const mine = new Float64Array(4);

/** Takes down where others will be from `time` on. */
export function seeOthers(
  p: Planner,
  walkers: readonly Walker[],
  seen: ArrayLike<number>,
  count: number,
  time: number,
): void {
  const { others } = p;
  others.count = Math.min(MOST_OTHERS, count);
  for (let i = 0; i < others.count; i++) {
    const w = walkers[seen[i]];
    let next = 0;
    for (let k = 0; k < SAMPLES; k++) {
      const t = time + k * SAMPLE;
      const o = (i * SAMPLES + k) * 4;
      evaluateStep(others.bound, o, w.step, t);
      let step = w.step;
      while (next < w.planned && t >= w.plan[next].start - 1e-9) next++;
      if (next > 0) step = w.plan[next - 1];
      evaluateStep(others.told, o, step, t);
    }
  }
}

/** Gap between two bodies of three circles, metres; anything over `enough` may come back as that. */
export function bodyGap(a: Float64Array, i: number, b: Float64Array, k: number, enough: number): number {
  const dx = b[k] - a[i];
  const dz = b[k + 1] - a[i + 1];
  const d2 = dx * dx + dz * dz;
  const sure = enough + 2 * BODY_RADIUS + 2 * SHOULDER;
  if (d2 > sure * sure) return enough;
  const ax = SHOULDER * a[i + 3];
  const az = -SHOULDER * a[i + 2];
  const bx = SHOULDER * b[k + 3];
  const bz = -SHOULDER * b[k + 2];
  let least = Number.POSITIVE_INFINITY;
  for (let s = -1; s <= 1; s++)
    for (let t = -1; t <= 1; t++) {
      const x = dx + t * bx - s * ax;
      const z = dz + t * bz - s * az;
      const q = x * x + z * z;
      if (q < least) least = q;
    }
  return Math.min(enough, Math.sqrt(least) - 2 * BODY_RADIUS);
}

/** Whether a body stands clear of walls. */
export function clearOfWalls(ground: Ground, a: Float64Array, i: number): boolean {
  if (farFromWalls(ground, a[i], a[i + 1])) return true;
  const need = BODY_RADIUS + WALL_MARGIN;
  if (nearestGap(ground, a[i], a[i + 1]) < need) return false;
  const sx = SHOULDER * a[i + 3];
  const sz = -SHOULDER * a[i + 2];
  return (
    nearestGap(ground, a[i] + sx, a[i + 1] + sz) >= need &&
    nearestGap(ground, a[i] - sx, a[i + 1] - sz) >= need
  );
}

export interface Search {
  ground: Ground;
  way: LongWay;
  /** Speed wanted, metres a second. */
  speed: number;
  /** Distance to the goal at which it is reached. */
  tolerance: number;
  /** Most nodes expanded. */
  most: number;
  /** Body overlaps a wall already: walls are not looked at until it is out. */
  inWall: boolean;
}

/** Energy a metre of normal steps at the speed wanted [Footsteps eq. 17]. */
function energyPerMetre(gait: Gait, speed: number): number {
  const length = speed * gait.quick;
  const apart2 = length * length + 4 * gait.footAside * gait.footAside;
  const kept = speed * (1 - (2 * apart2) / (4 * gait.leg * gait.leg));
  return (gait.power * gait.quick + 0.5 * (speed * speed - kept * kept)) / length;
}

/** Searches from the state at `from` in `start`; the path is left in the planner. False when not even resting is free. */
export function planSteps(p: Planner, start: Float64Array, from: number, search: Search): boolean {
  const { gait } = p;
  const time = start[from + S.time];
  const perMetre = energyPerMetre(gait, search.speed);
  for (let k = 0; k < STATE; k++) p.states[k] = start[from + k];
  let nodes = 1;
  let open = 0;
  p.parent[0] = -1;
  p.depth[0] = 0;
  p.g[0] = 0;
  p.h[0] = perMetre * ahead(search.ground, search.way, start[from], start[from + 1]).distance;
  p.f[0] = p.h[0];
  p.heap[open++] = 0;
  p.expanded = 0;
  p.generated = 0;
  let best = -1;
  let bestWorth = Number.POSITIVE_INFINITY;
  let goal = -1;
  for (let i = 0; i < p.others.count; i++) p.others.now[i] = bodyGapAt(p, p.states, 0, i);

  const add = (node: number, cost: number): void => {
    p.parent[nodes] = node;
    p.depth[nodes] = p.depth[node] + 1;
    p.g[nodes] = p.g[node] + cost;
    const o = nodes * STATE;
    p.h[nodes] = perMetre * ahead(search.ground, search.way, p.states[o], p.states[o + 1]).distance;
    p.f[nodes] = p.g[nodes] + p.h[nodes];
    let i = open++;
    while (i > 0) {
      const q = (i - 1) >> 1;
      if (p.f[p.heap[q]] <= p.f[nodes]) break;
      p.heap[i] = p.heap[q];
      i = q;
    }
    p.heap[i] = nodes;
    nodes++;
    p.generated++;
  };
  /** Looks at the step made in the next node; its extra cost, or -1 when it is not free. */
  const judge = (node: number): number => costOfStep(p, p.steps[nodes], p.depth[node] === 0, time, search);

  while (open > 0 && p.expanded < search.most && nodes < MOST_NODES - 40) {
    const node = p.heap[0];
    open--;
    if (open > 0) {
      const moved = p.heap[open];
      let i = 0;
      for (;;) {
        let c = 2 * i + 1;
        if (c >= open) break;
        if (c + 1 < open && p.f[p.heap[c + 1]] < p.f[p.heap[c]]) c++;
        if (p.f[p.heap[c]] >= p.f[moved]) break;
        p.heap[i] = p.heap[c];
        i = c;
      }
      p.heap[i] = moved;
    }
    const o = node * STATE;
    const elapsed = p.states[o + S.time] - time;
    if (node > 0) {
      const worth = p.h[node] + 0.35 * p.g[node];
      if (worth < bestWorth) {
        bestWorth = worth;
        best = node;
      }
      if (elapsed >= HORIZON - 1e-6 || p.h[node] < perMetre * search.tolerance) {
        goal = node;
        break;
      }
    }
    p.expanded++;
    const target = ahead(search.ground, search.way, p.states[o], p.states[o + 1]);
    let gx = target.x - p.states[o];
    let gz = target.z - p.states[o + 1];
    const gl = Math.sqrt(gx * gx + gz * gz);
    gx = gl > 1e-6 ? gx / gl : p.states[o + S.faceX];
    gz = gl > 1e-6 ? gz / gl : p.states[o + S.faceZ];
    const speed = p.states[o + S.speed];
    if (speed < 0.05) expandRest(node, o, gx, gz);
    else expandWalk(node, o, gx, gz, speed);
    const cost = createStop(p.states, nodes * STATE, p.steps[nodes], p.states, o, 0.4, gait);
    const extra = judge(node);
    if (extra >= 0) add(node, cost + extra);
  }
  if (goal < 0) goal = best;
  if (goal < 0) {
    p.pathLength = 0;
    return false;
  }
  p.pathLength = p.depth[goal];
  for (let n = goal, k = p.pathLength - 1; k >= 0; k--, n = p.parent[n]) p.path[k] = n;
  return true;

  function expandWalk(node: number, o: number, gx: number, gz: number, speed: number): void {
    const ux = p.states[o + S.ux];
    const uz = p.states[o + S.uz];
    const side = p.states[o + S.side];
    // The turn that leads straight to the goal, if it is to the free side [Footsteps §4, goal-directed action].
    const cos = ux * gx + uz * gz;
    const sin = side * (uz * -gx + ux * gz);
    for (let t = -1; t < TURNS.length; t++) {
      if (t < 0 && (sin < TURN_SIN[0] || cos < 0.35)) continue;
      const c = t < 0 ? cos : TURN_COS[t];
      const s = t < 0 ? sin : TURN_SIN[t];
      for (let v = 0; v < PACES.length; v++) {
        const wanted = search.speed * PACES[v];
        if (wanted > speed + 0.75 || wanted < speed - 0.95) continue;
        // Sharp turns are taken slowly.
        if (c < 0.8 && v === 0) continue;
        const pace = Math.min(wanted, search.speed);
        walk(node, o, c, s, pace, v === 0 ? gait.quick : gait.slow, v === PACES.length - 1);
      }
    }
  }

  function expandRest(node: number, o: number, gx: number, gz: number): void {
    for (let t = 0; t < STARTS.length; t++) {
      const dx = START_COS[t] * gx + START_SIN[t] * gz;
      const dz = START_COS[t] * gz - START_SIN[t] * gx;
      const facing = dx * p.states[o + S.faceX] + dz * p.states[o + S.faceZ];
      for (let v = 1; v < PACES.length; v++) {
        // The way at the start leans to the foot by the least turn.
        const side = p.states[o + S.side];
        const keepX = p.states[o + S.ux];
        const keepZ = p.states[o + S.uz];
        p.states[o + S.ux] = TURN_COS[0] * dx + side * TURN_SIN[0] * dz;
        p.states[o + S.uz] = TURN_COS[0] * dz - side * TURN_SIN[0] * dx;
        const pace = search.speed * PACES[v];
        if (facing < 0.2) {
          // Beside or behind: a slow step that keeps the facing.
          if (v === PACES.length - 1) walk(node, o, TURN_COS[0], TURN_SIN[0], pace, gait.slow, false, true);
        }
        if (facing > -0.4) walk(node, o, TURN_COS[0], TURN_SIN[0], pace, gait.slow, v === PACES.length - 1);
        p.states[o + S.ux] = keepX;
        p.states[o + S.uz] = keepZ;
      }
    }
  }

  function walk(
    node: number,
    o: number,
    c: number,
    s: number,
    pace: number,
    duration: number,
    squeeze: boolean,
    keepFacing = false,
  ): void {
    const to = nodes * STATE;
    const step = p.steps[nodes];
    const cost = createFootstep(p.states, to, step, p.states, o, c, s, pace, duration, gait);
    if (keepFacing) face(step, to, step.fromX, step.fromZ);
    let extra = judge(node);
    if (extra >= 0) {
      add(node, cost + extra + (keepFacing ? SQUEEZE_COST : 0));
      return;
    }
    if (!squeeze || keepFacing) return;
    // Through a gap sideways: the shoulder first that is nearer to where it faces.
    const left = step.fromX * step.pz - step.fromZ * step.px >= 0 ? 1 : -1;
    face(step, to, left * step.pz, -left * step.px);
    extra = judge(node);
    if (extra >= 0) add(node, cost + extra + SQUEEZE_COST);
  }

  function face(step: Step, to: number, x: number, z: number): void {
    step.toX = x;
    step.toZ = z;
    p.states[to + S.faceX] = x;
    p.states[to + S.faceZ] = z;
  }
}

function bodyGapAt(p: Planner, states: Float64Array, o: number, other: number): number {
  mine[0] = states[o + S.x];
  mine[1] = states[o + S.z];
  mine[2] = states[o + S.faceX];
  mine[3] = states[o + S.faceZ];
  return bodyGap(mine, 0, p.others.bound, other * SAMPLES * 4, 0.5);
}

/** What nearness to others adds to a step's cost; -1 when it is not free. */
function costOfStep(p: Planner, step: Step, first: boolean, time: number, search: Search): number {
  const { others } = p;
  const begin = Math.round((step.start - time) / SAMPLE);
  const end = Math.round((step.start + step.duration - time) / SAMPLE);
  const rest = first ? Math.ceil(STOP_TIME / SAMPLE) : 0;
  let cost = 0;
  for (let k = begin + 1; k <= end + rest; k++) {
    const sample = Math.min(SAMPLES - 1, k);
    evaluateStep(mine, 0, step, time + k * SAMPLE);
    if (!search.inWall && !clearOfWalls(search.ground, mine, 0)) return -1;
    const sure = 1 - 0.2 * k * SAMPLE;
    for (let i = 0; i < others.count; i++) {
      const o = (i * SAMPLES + sample) * 4;
      if (first) {
        const gap = bodyGap(mine, 0, others.bound, o, SPACE);
        // Who overlaps from the start may part, not come nearer.
        if (gap < MARGIN && gap < others.now[i] + 0.002) return -1;
      }
      if (k > end) continue;
      const gap = bodyGap(mine, 0, others.told, o, SPACE);
      if (gap < MARGIN) cost += TOUCH_COST * Math.max(0.2, sure);
      else if (gap < SPACE) cost += SPACE_COST * (1 - gap / SPACE);
    }
  }
  if (first) {
    // At rest, until all others would be.
    for (let k = end + rest + 1; k <= end + 8; k++) {
      const sample = Math.min(SAMPLES - 1, k);
      for (let i = 0; i < others.count; i++) {
        const gap = bodyGap(mine, 0, others.bound, (i * SAMPLES + sample) * 4, SPACE);
        if (gap < MARGIN && gap < others.now[i] + 0.002) return -1;
      }
    }
  }
  return cost;
}
