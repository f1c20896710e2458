/** A few steps of the pendulum in a row, all with the same action, and one search: what the figures of its lesson draw. */

import { createGround } from "../../core/crowd/ground.ts";
import { createFootstep } from "../../core/crowd/locomotion.ts";
import { createLongWay, extendLongWay } from "../../core/crowd/long-way.ts";
import {
  createPlanner,
  energyPerMetre,
  type Planner,
  planSteps,
  type Search,
} from "../../core/crowd/planner.ts";
import { P, S, STATE, STEP } from "../../core/crowd/state.ts";
import { type CrowdWorld, DEFAULT_GAIT, type Gait, type Obstacle } from "../../core/crowd/types.ts";
import type { FloorPrint } from "../kit/floor.ts";

export interface WalkAction {
  /** Turn of each step away from the planted foot, radians. */
  turn: number;
  /** Metres a second. */
  speed: number;
  /** Seconds a step. */
  duration: number;
  count: number;
}

export interface PendulumStep {
  print: FloorPrint;
  /** Middle of mass along the parabola, from its start to its end. */
  way: [number, number][];
  /** Energies of eqs. 14, 15 and 16, J/kg. */
  energy: [fixed: number, speed: number, bend: number];
}

const WAY = 16;

/** Points of the parabola of the step at `p`. */
function wayOf(steps: Float64Array, p: number): [number, number][] {
  const duration = steps[p + P.duration];
  return Array.from({ length: WAY + 1 }, (_, k): [number, number] => {
    const t = (duration * k) / WAY;
    const u = t - duration / 2;
    const along = steps[p + P.along] * t;
    const aside = (steps[p + P.toFoot] / duration) * (duration * duration * 0.25 - u * u) * steps[p + P.side];
    return [
      steps[p + P.x] + steps[p + P.px] * along + steps[p + P.pz] * aside,
      steps[p + P.z] + steps[p + P.pz] * along - steps[p + P.px] * aside,
    ];
  });
}

function stepAt(steps: Float64Array, p: number): PendulumStep {
  return {
    print: {
      foot: steps[p + P.side] > 0 ? "left" : "right",
      x: steps[p + P.footX],
      z: steps[p + P.footZ],
      yaw: Math.atan2(steps[p + P.px], steps[p + P.pz]),
    },
    way: wayOf(steps, p),
    energy: [steps[p + P.fixedEnergy], steps[p + P.speedEnergy], steps[p + P.bendEnergy]],
  };
}

/** A state at a place, moving along the unit vector, with the side of the foot that comes next: 1 left, -1 right. */
function stateAt(
  x: number,
  z: number,
  ux: number,
  uz: number,
  speed: number,
  side: number,
  gait: Gait,
): Float64Array {
  const s = new Float64Array(STATE);
  s[S.x] = x;
  s[S.z] = z;
  s[S.ux] = ux;
  s[S.uz] = uz;
  s[S.speed] = speed;
  s[S.side] = side;
  s[S.footX] = x - side * uz * gait.footAside;
  s[S.footZ] = z + side * ux * gait.footAside;
  s[S.faceX] = s[S.headX] = ux;
  s[S.faceZ] = s[S.headZ] = uz;
  s[S.outer] = gait.yawRange;
  return s;
}

/**
 * Steps in a row from the origin along +Z, the right foot first.
 *
 * @returns fewer than `count` when a foot could not reach as far.
 */
export function walkOf(a: WalkAction, gait: Gait = DEFAULT_GAIT): PendulumStep[] {
  // Where a step ends, the motion leans to the foot that comes next: so does the first one here.
  let state = stateAt(0, 0, Math.sin(a.turn), Math.cos(a.turn), a.speed, -1, gait);
  const steps = new Float64Array(STEP);
  const out: PendulumStep[] = [];
  for (let k = 0; k < a.count; k++) {
    const next = new Float64Array(STATE);
    const cost = createFootstep(
      next,
      0,
      steps,
      0,
      state,
      0,
      a.turn,
      Math.cos(a.turn),
      Math.sin(a.turn),
      a.speed,
      a.duration,
      gait,
    );
    if (cost < 0) break;
    out.push(stepAt(steps, 0));
    state = next;
  }
  return out;
}

export interface SearchRun {
  found: boolean;
  path: PendulumStep[];
  /** From a node's parent to it, for all nodes. */
  tree: [number, number, number, number][];
  expanded: number;
  generated: number;
}

export interface SearchQuestion {
  goal: readonly [number, number];
  pillar: readonly [number, number];
  speed: number;
  /** Most nodes expanded. */
  most: number;
}

let planner: Planner | null = null;

/** One search from the origin to a goal round a pillar, as a walker makes it at every step. */
export function searchSteps(q: SearchQuestion): SearchRun {
  const gait = DEFAULT_GAIT;
  planner ??= createPlanner();
  const pillar: Obstacle = {
    x: q.pillar[0],
    z: q.pillar[1],
    halfX: 0.3,
    halfZ: 0.3,
    cos: 1,
    sin: 0,
    round: true,
  };
  const goal = { x: q.goal[0], z: q.goal[1], box: null, speed: q.speed, patience: Number.POSITIVE_INFINITY };
  const world: CrowdWorld = {
    name: "figure",
    obstacles: [pillar],
    agents: [{ x: 0, z: 0, dirX: 0, dirZ: 1, goals: [goal] }],
    repairs: [],
  };
  const ground = createGround(world);
  const way = createLongWay(ground, goal.x, goal.z);
  extendLongWay(ground, way, 0, 0);
  const search: Search = {
    ground,
    way,
    gait,
    speed: q.speed,
    tolerance: 0.3,
    most: q.most,
    inWall: false,
    perMetre: energyPerMetre(gait, q.speed),
    // It walks already, and has not waited.
    underWay: 0,
    impatience: 1,
    time: 0,
  };
  const start = stateAt(0, 0, 0, 1, q.speed, -1, gait);
  const found = planSteps(planner, start, 0, search);
  const p = planner;
  const tree: SearchRun["tree"] = [];
  for (let n = 1; n < p.nodes; n++) {
    const a = p.parent[n] * STATE;
    const b = n * STATE;
    tree.push([p.states[a + S.x], p.states[a + S.z], p.states[b + S.x], p.states[b + S.z]]);
  }
  const path = found ? [...p.path.subarray(0, p.pathLength)].map((n) => stepAt(p.steps, n * STEP)) : [];
  return { found, path, tree, expanded: p.expanded, generated: p.generated };
}
