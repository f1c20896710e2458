/**
 * Short-horizon best-first search over footsteps [Footsteps §4, Algorithm 1].
 *
 * One thing is added to the paper's search so that nobody ever walks into another: a step is only taken when, at its end, its
 * walker could still come to rest without touching any other's step and rest. All keep to that, one after the other,
 * so resting is always possible. Beyond that first step others are where they have said that they will be, which may
 * change, and so costs instead of forbidding (`judge.ts`).
 */
import { expand } from "./actions.ts";
import type { Ground } from "./ground.ts";
import { costOfStep, createOthers, type Others, startJudging } from "./judge.ts";
import { keepFacing, twistTorso } from "./locomotion.ts";
import { ahead, type LongWay } from "./long-way.ts";
import { KIND, P, S, STATE, STEP } from "./state.ts";
import type { Gait } from "./types.ts";

/** Seconds looked ahead. */
export const HORIZON = 3;
/** Most nodes that a search holds. */
const MOST_NODES = 2400;
/** Most children of one node. */
const MOST_CHILDREN = 60;
/** How much what was spent counts beside what is left, where a search ends early. */
const SPENT = 0.35;

export interface Planner {
  /** STATE numbers a node; a node's step is what led to it. */
  states: Float64Array;
  steps: Float64Array;
  parent: Int32Array;
  depth: Int32Array;
  g: Float64Array;
  h: Float64Array;
  f: Float64Array;
  /** Whether a node's step has been judged; energy that a twisted torso would add where it is not free, 0 for never. */
  judged: Uint8Array;
  twist: Float64Array;
  nodes: number;
  heap: Int32Array;
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
  parent: new Int32Array(MOST_NODES),
  depth: new Int32Array(MOST_NODES),
  g: new Float64Array(MOST_NODES),
  h: new Float64Array(MOST_NODES),
  f: new Float64Array(MOST_NODES),
  judged: new Uint8Array(MOST_NODES),
  twist: new Float64Array(MOST_NODES),
  nodes: 0,
  heap: new Int32Array(MOST_NODES),
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
  const time = (gait.quick[0] + gait.quick[1]) / 2;
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
  startJudging(p.others, start, from);
  ahead(place, search.ground, search.way, start[from], start[from + 1]);
  p.parent[0] = -1;
  p.depth[0] = 0;
  p.g[0] = 0;
  p.h[0] = perMetre * place[2];
  p.f[0] = p.h[0];
  p.heap[0] = 0;
  p.nodes = 1;
  p.open = 1;
  p.expanded = 0;
  p.generated = 0;
  p.judgements = 0;
  p.judged[0] = 1;
  let goal = -1;
  let bestWorth = Number.POSITIVE_INFINITY;
  while (p.open > 0) {
    const node = takeBest(p);
    const o = node * STATE;
    if (p.judged[node] === 0 && !judge(p, search, node)) continue;
    if (node > 0) {
      const worth = p.h[node] + SPENT * p.g[node];
      if (worth < bestWorth) {
        bestWorth = worth;
        goal = node;
      }
      if (p.states[o + S.time] - search.time >= HORIZON - 1e-6 || p.h[node] < perMetre * search.tolerance) {
        goal = node;
        break;
      }
    }
    if (p.expanded >= search.most || p.nodes > MOST_NODES - MOST_CHILDREN) break;
    p.expanded++;
    ahead(place, search.ground, search.way, p.states[o], p.states[o + 1]);
    const gx = place[0] - p.states[o];
    const gz = place[1] - p.states[o + 1];
    const gl = Math.sqrt(gx * gx + gz * gz);
    if (gl > 1e-6) expand(p, search, node, gx / gl, gz / gl);
    else expand(p, search, node, p.states[o + S.faceX], p.states[o + S.faceZ]);
  }
  if (goal < 0) {
    p.pathLength = 0;
    return false;
  }
  p.pathLength = p.depth[goal];
  for (let n = goal, k = p.pathLength - 1; k >= 0; k--, n = p.parent[n]) p.path[k] = n;
  return true;
}

/**
 * Judges a node's step, which is put off until the node is the best one open: nearness only adds to a cost, so the order is the
 * same as if all had been judged at once, and most never are.
 *
 * @returns whether the node may be looked at now; else it was dropped, or put back at what it costs.
 */
function judge(p: Planner, search: Search, node: number): boolean {
  const q = node * STEP;
  const first = p.parent[node] === 0;
  p.judged[node] = 1;
  p.judgements++;
  let extra = costOfStep(p.others, p.steps, q, first, search);
  if (extra < 0 && p.twist[node] > 0) {
    if (p.steps[q + P.kind] === KIND.shift)
      keepFacing(p.states, node * STATE, p.steps, q, search.gait.footAside);
    else {
      // Once more sideways: the shoulder first that is nearer to where it faces.
      const left =
        p.steps[q + P.fromX] * p.steps[q + P.headZ] - p.steps[q + P.fromZ] * p.steps[q + P.headX] >= 0
          ? 1
          : -1;
      twistTorso(p.states, node * STATE, p.steps, q, left);
    }
    p.judgements++;
    extra = costOfStep(p.others, p.steps, q, first, search);
    if (extra >= 0) p.g[node] += p.twist[node];
    else p.f[node] = Number.POSITIVE_INFINITY;
  }
  if (extra < 0) return false;
  p.steps[q + P.nearness] = extra;
  p.g[node] += extra;
  const f = p.g[node] + p.h[node];
  if (f <= p.f[node]) return true;
  p.f[node] = f;
  putOpen(p, node);
  return false;
}

/**
 * Keeps the step made in the next free node as a child, not judged yet.
 *
 * @param cost its energy. @param twist what going sideways would add where the plain step is not free; 0 for never.
 */
export function keepNext(p: Planner, search: Search, node: number, cost: number, twist: number): void {
  const next = p.nodes++;
  p.generated++;
  p.judged[next] = 0;
  p.twist[next] = twist;
  p.parent[next] = node;
  p.depth[next] = p.depth[node] + 1;
  p.g[next] = p.g[node] + cost;
  const o = next * STATE;
  ahead(place, search.ground, search.way, p.states[o], p.states[o + 1]);
  // Who rests has still to get under way: else standing would look best whenever little is gained within the horizon.
  p.h[next] = search.perMetre * place[2] + (p.states[o + S.speed] === 0 ? search.underWay : 0);
  p.f[next] = p.g[next] + p.h[next];
  putOpen(p, next);
}

function putOpen(p: Planner, node: number): void {
  const { heap, f } = p;
  let i = p.open++;
  while (i > 0) {
    const q = (i - 1) >> 1;
    if (f[heap[q]] <= f[node]) break;
    heap[i] = heap[q];
    i = q;
  }
  heap[i] = node;
}

/** Takes the open node of least f out of the heap. */
function takeBest(p: Planner): number {
  const { heap, f } = p;
  const node = heap[0];
  const open = --p.open;
  if (open === 0) return node;
  const moved = heap[open];
  const worth = f[moved];
  let i = 0;
  for (;;) {
    let c = 2 * i + 1;
    if (c >= open) break;
    if (c + 1 < open && f[heap[c + 1]] < f[heap[c]]) c++;
    if (f[heap[c]] >= worth) break;
    heap[i] = heap[c];
    i = c;
  }
  heap[i] = moved;
  return node;
}
