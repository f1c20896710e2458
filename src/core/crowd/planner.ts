/**
 * Short-horizon best-first search over footsteps [Footsteps §4, Algorithm 1].
 *
 * One thing is added to the paper's search so that nobody ever walks into another: a step is only taken when, at its end, its
 * walker could still come to rest without touching any other's step and rest. All keep to that, one after the other,
 * so resting is always possible. Beyond that first step others are where they have said that they will be, which may
 * change, and so costs instead of forbidding (`judge.ts`).
 */
import { expand, expandSlower } from "./actions.ts";
import type { Ground } from "./ground.ts";
import { ALL, createOthers, isFree, nearness, type Others, startJudging } from "./judge.ts";
import {
  ACTIONS,
  action,
  keepFacing,
  makeFootstep,
  twistTorso,
  WEIGHED as W,
  weighed,
  weighFootstep,
} from "./locomotion.ts";
import { ahead, type LongWay } from "./long-way.ts";
import { KIND, P, S, STATE, STEP } from "./state.ts";
import { type Gait, stepTime } from "./types.ts";

/** Seconds looked ahead. */
export const HORIZON = 3;
/** Most nodes that a search holds. */
const MOST_NODES = 2400;
/** Most children of one node. */
const MOST_CHILDREN = 60;
/** How much what was spent counts beside what is left, where a search ends early. */
const SPENT = 0.35;
/** Nearness is added up until a node is this much worse than the next one open, J/kg: at once it would soon be asked again. */
const SLACK = 0.3;
/**
 * Where a step was near others, the next one will be too: this share of its nearness is expected of a node until it is judged. In dense
 * crowds a third fewer are judged for it; with 0, 0.5 and 0.7 rooms empty as fast.
 */
const LIKE_BEFORE = 0.5;
/**
 * How far a node has come: its step is weighed only, made, judged in part: nearness is being added up (and all else is known to be free),
 * walls are left; judged.
 */
const WEIGHED = 0;
const UNJUDGED = 1;
const NEARNESS = 2;
const NEARNESS_FREE = 3;
const WALLS = 4;
const JUDGED = 5;

export interface Planner {
  /** STATE numbers a node; a node's step is what led to it. Both are written down when it is judged: most never are. */
  states: Float64Array;
  steps: Float64Array;
  /** Until then its action, ACTIONS numbers, and where it leads: x, z. */
  actions: Float64Array;
  places: Float64Array;
  /** Its pace, by its place in the list of paces: slower ones have not been thought of yet. */
  pace: Uint8Array;
  parent: Int32Array;
  depth: Int32Array;
  g: Float64Array;
  h: Float64Array;
  f: Float64Array;
  /** How far a node's step has been judged, and the first other not looked at yet. */
  judged: Uint8Array;
  looked: Uint8Array;
  /** Energy that a twisted torso would add where a node's step is not free, 0 for never; and energy of the step. */
  twist: Float64Array;
  cost: Float64Array;
  nodes: number;
  /** Open nodes and their f, the least first. */
  heap: Int32Array;
  keys: Float64Array;
  open: number;
  others: Others;
  /** The answer: node indices of the path, first step first. */
  path: Int32Array;
  pathLength: number;
  expanded: number;
  /** Nodes made, and steps judged. */
  generated: number;
  judgements: number;
}

export const createPlanner = (): Planner => ({
  states: new Float64Array(MOST_NODES * STATE),
  steps: new Float64Array(MOST_NODES * STEP),
  actions: new Float64Array(MOST_NODES * ACTIONS),
  places: new Float64Array(MOST_NODES * 2),
  pace: new Uint8Array(MOST_NODES),
  parent: new Int32Array(MOST_NODES),
  depth: new Int32Array(MOST_NODES),
  g: new Float64Array(MOST_NODES),
  h: new Float64Array(MOST_NODES),
  f: new Float64Array(MOST_NODES),
  judged: new Uint8Array(MOST_NODES),
  looked: new Uint8Array(MOST_NODES),
  twist: new Float64Array(MOST_NODES),
  cost: new Float64Array(MOST_NODES),
  nodes: 0,
  heap: new Int32Array(MOST_NODES),
  keys: new Float64Array(MOST_NODES),
  open: 0,
  others: createOthers(),
  path: new Int32Array(64),
  pathLength: 0,
  expanded: 0,
  generated: 0,
  judgements: 0,
});

export interface Search {
  ground: Ground;
  way: LongWay;
  gait: Gait;
  /** Speed wanted, metres a second. */
  speed: number;
  /** Distance to the goal at which it is reached. */
  tolerance: number;
  /** Most nodes expanded: N_max of Algorithm 1. */
  most: number;
  /** Body overlaps a wall already: walls are not looked at until it is out. */
  inWall: boolean;
  /** Energy of a metre of normal steps, and of getting under way from rest, J/kg. */
  perMetre: number;
  underWay: number;
  /** What standing costs over the energy it takes: more for one who has waited long. */
  impatience: number;
  /** Seconds at the start. */
  time: number;
}

/** Energy a metre of normal steps at the speed wanted [Footsteps eq. 17]. */
export function energyPerMetre(gait: Gait, speed: number): number {
  const time = (stepTime(gait, 0, speed) + stepTime(gait, 1, speed)) / 2;
  const length = speed * time;
  const apart2 = length * length + 4 * gait.footAside * gait.footAside;
  const kept = speed * (1 - 2 * Math.min(0.5, apart2 / (4 * gait.leg * gait.leg)));
  return (gait.power * time + 0.5 * (speed * speed - kept * kept)) / length;
}

const place = new Float64Array(3);

/**
 * Searches from the state at `from` in `start`, among the others that were noted before; the path is left in the planner.
 *
 * @returns false when not even resting is free.
 */
export function planSteps(p: Planner, start: Float64Array, from: number, search: Search): boolean {
  const { perMetre } = search;
  search.time = start[from + S.time];
  for (let k = 0; k < STATE; k++) p.states[k] = start[from + k];
  p.places[0] = start[from + S.x];
  p.places[1] = start[from + S.z];
  startJudging(p.others, start, from);
  ahead(place, search.ground, search.way, start, from);
  p.steps[P.nearness] = 0;
  p.parent[0] = -1;
  p.depth[0] = 0;
  p.g[0] = 0;
  p.h[0] = perMetre * place[2];
  p.f[0] = p.h[0];
  p.heap[0] = 0;
  p.keys[0] = p.f[0];
  p.nodes = 1;
  p.open = 1;
  p.expanded = 0;
  p.generated = 0;
  p.judgements = 0;
  p.judged[0] = JUDGED;
  let goal = -1;
  let stop = -1;
  let whole = false;
  let bestWorth = Number.POSITIVE_INFINITY;
  while (p.open > 0) {
    const node = takeBest(p);
    const o = node * STATE;
    if (p.judged[node] !== JUDGED && !judge(p, search, node)) continue;
    if (node > 0) {
      const worth = p.h[node] + SPENT * p.g[node];
      if (worth < bestWorth) {
        bestWorth = worth;
        goal = node;
      }
      if (p.states[o + S.time] - search.time >= HORIZON - 1e-6 || p.h[node] < perMetre * search.tolerance) {
        goal = node;
        whole = true;
        break;
      }
    }
    if (p.expanded >= search.most || p.nodes > MOST_NODES - MOST_CHILDREN) break;
    p.expanded++;
    ahead(place, search.ground, search.way, p.states, o);
    const gx = place[0] - p.states[o];
    const gz = place[1] - p.states[o + 1];
    const gl = Math.sqrt(gx * gx + gz * gz);
    if (gl > 1e-6) expand(p, search, node, gx / gl, gz / gl);
    else expand(p, search, node, p.states[o + S.faceX], p.states[o + S.faceZ]);
    if (node === 0) stop = p.nodes - 1;
  }
  // Parabolas turn to either side in turn: who walks away from the goal and finds no way round in time would go on so. At rest it can turn.
  if (goal >= 0 && !whole && p.states[S.speed] > 0 && p.h[goal] > p.h[0] && restsFree(p, search, stop))
    goal = stop;
  if (goal < 0) {
    p.pathLength = 0;
    return false;
  }
  p.pathLength = p.depth[goal];
  for (let n = goal, k = p.pathLength - 1; k >= 0; k--, n = p.parent[n]) p.path[k] = n;
  return true;
}

/** Whether the stop that a search began with, judged or not, is free. */
function restsFree(p: Planner, search: Search, stop: number): boolean {
  if (p.judged[stop] === JUDGED) return p.f[stop] < Number.POSITIVE_INFINITY;
  return isFree(p.others, p.steps, stop * STEP, true, search);
}

/** Whether a node's step was looked at among the others, be it in part. */
export const wasJudged = (p: Planner, node: number): boolean => p.judged[node] > UNJUDGED;

/**
 * Judges a node's step, which is put off until the node is the best one open: most never are. Nearness only adds to a cost, so nobody is
 * looked at any more once others open are better, and walls last, where no twist of the torso depends on them: what is left follows
 * when the node is the best one again.
 *
 * @returns whether the node may be looked at now; else it was dropped, or put back at what it costs as far as is known.
 */
function judge(p: Planner, search: Search, node: number): boolean {
  const q = node * STEP;
  if (p.judged[node] === WEIGHED) {
    const from = p.parent[node] * STATE;
    for (let k = 0; k < ACTIONS; k++) action[k] = p.actions[node * ACTIONS + k];
    weighFootstep(p.states, from, search.gait);
    makeFootstep(p.states, node * STATE, p.steps, q, p.states, from, search.gait);
    p.judged[node] = UNJUDGED;
  }
  if (p.judged[node] === UNJUDGED) {
    expandSlower(p, search, node);
    const first = p.parent[node] === 0;
    p.judgements++;
    p.looked[node] = 0;
    p.steps[q + P.nearness] = 0;
    p.judged[node] = NEARNESS;
    if (first || p.twist[node] > 0) {
      p.judged[node] = NEARNESS_FREE;
      if (
        !isFree(p.others, p.steps, q, first, search) &&
        !(p.twist[node] > 0 && squeeze(p, search, node, first))
      )
        return drop(p, node);
    }
  }
  if (p.judged[node] < WALLS) {
    const { steps, g, h } = p;
    const { sum } = p.others;
    sum[0] = steps[q + P.nearness];
    sum[1] = p.open > 0 ? p.keys[0] - g[node] - h[node] + SLACK : Number.POSITIVE_INFINITY;
    const next = nearness(p.others, steps, q, search.gait, p.looked[node]);
    steps[q + P.nearness] = sum[0];
    const f = g[node] + sum[0] + h[node];
    if (next === ALL) {
      p.judged[node] = p.judged[node] === NEARNESS ? WALLS : JUDGED;
      g[node] += sum[0];
    } else p.looked[node] = next;
    if (next !== ALL || f > p.f[node]) {
      p.f[node] = f;
      putOpen(p, node);
      return false;
    }
  }
  if (p.judged[node] === WALLS) {
    if (!isFree(p.others, p.steps, q, false, search)) return drop(p, node);
    p.judged[node] = JUDGED;
  }
  return true;
}

function drop(p: Planner, node: number): false {
  p.f[node] = Number.POSITIVE_INFINITY;
  p.judged[node] = JUDGED;
  return false;
}

/** Makes a step that is not free go sideways, or a shift keep its facing. Returns whether it is free then. */
function squeeze(p: Planner, search: Search, node: number, first: boolean): boolean {
  const q = node * STEP;
  if (p.steps[q + P.kind] === KIND.shift)
    keepFacing(p.states, node * STATE, p.steps, q, search.gait.footAside);
  else {
    // Once more sideways: the shoulder first that is nearer to where it faces.
    const left =
      p.steps[q + P.fromX] * p.steps[q + P.headZ] - p.steps[q + P.fromZ] * p.steps[q + P.headX] >= 0 ? 1 : -1;
    twistTorso(p.states, node * STATE, p.steps, q, left);
  }
  p.judgements++;
  if (!isFree(p.others, p.steps, q, first, search)) return false;
  p.g[node] += p.twist[node];
  return true;
}

/** Keeps the footstep just weighed in the next free node: its action and where it leads, for it may never be looked at. */
export function keepWeighed(p: Planner, search: Search, node: number): void {
  const next = p.nodes;
  const { actions, places } = p;
  for (let k = 0; k < ACTIONS; k++) actions[next * ACTIONS + k] = action[k];
  places[2 * next] = weighed[W.x];
  places[2 * next + 1] = weighed[W.z];
  p.judged[next] = WEIGHED;
  keepNext(p, search, node, 0);
}

/** Keeps the step made in the next free node. */
export function keepMade(p: Planner, search: Search, node: number): void {
  const next = p.nodes;
  const o = next * STATE;
  p.places[2 * next] = p.states[o + S.x];
  p.places[2 * next + 1] = p.states[o + S.z];
  p.judged[next] = UNJUDGED;
  // Who rests has still to get under way: else standing would look best whenever little is gained within the horizon.
  keepNext(p, search, node, p.states[o + S.speed] === 0 ? search.underWay : 0);
}

/**
 * Makes the next free node a child that is not judged yet; its energy is in `p.cost`, and in `p.twist` what going sideways would add
 * where the plain step is not free, 0 for never.
 *
 * @param more energy to come over that of the way left, J/kg.
 */
function keepNext(p: Planner, search: Search, node: number, more: number): void {
  const next = p.nodes++;
  p.generated++;
  p.parent[next] = node;
  p.depth[next] = p.depth[node] + 1;
  p.g[next] = p.g[node] + p.cost[next];
  ahead(place, search.ground, search.way, p.places, 2 * next);
  p.h[next] = search.perMetre * place[2] + more;
  p.f[next] = p.g[next] + p.h[next] + LIKE_BEFORE * p.steps[node * STEP + P.nearness];
  putOpen(p, next);
}

function putOpen(p: Planner, node: number): void {
  const { heap, keys } = p;
  const key = p.f[node];
  let i = p.open++;
  while (i > 0) {
    const q = (i - 1) >> 1;
    if (keys[q] <= key) break;
    heap[i] = heap[q];
    keys[i] = keys[q];
    i = q;
  }
  heap[i] = node;
  keys[i] = key;
}

/** Takes the open node of least f out of the heap. */
function takeBest(p: Planner): number {
  const { heap, keys } = p;
  const node = heap[0];
  const open = --p.open;
  if (open === 0) return node;
  const moved = heap[open];
  const key = keys[open];
  let i = 0;
  for (;;) {
    let c = 2 * i + 1;
    if (c >= open) break;
    if (c + 1 < open && keys[c + 1] < keys[c]) c++;
    if (keys[c] >= key) break;
    heap[i] = heap[c];
    keys[i] = keys[c];
    i = c;
  }
  heap[i] = moved;
  keys[i] = key;
  return node;
}
