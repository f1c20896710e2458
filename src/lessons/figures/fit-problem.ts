/** The small problem of the lesson on templates: a strategy laid from where the feet stand, a goal, weights; solved by the core. */

import type { FootstepProblem } from "../../core/optimize/footstep-objective.ts";
import { createFootstepWorkspace, optimizeFootsteps } from "../../core/optimize/optimize-footsteps.ts";
import type { ObjectiveWeights, PhaseName } from "../../core/optimize/phase-weights.ts";
import type { Foot, StepCategory } from "../../core/steps/types.ts";
import type { FloorPrint } from "../kit/floor.ts";
import { placeAt } from "./places.ts";

/** A step seen from the footstep before it: to the left, ahead (metres), turned (radians). */
interface StrategyStep {
  foot: Foot;
  category: StepCategory;
  lateral: number;
  forward: number;
  yaw: number;
}

export interface Strategy {
  name: string;
  steps: readonly StrategyStep[];
}

const step = (
  foot: Foot,
  category: StepCategory,
  lateral: number,
  forward: number,
  yaw = 0,
): StrategyStep => ({ foot, category, lateral: foot === "left" ? lateral : -lateral, forward, yaw });

/** Three ways to come to a task, as a person might: examples of this page, with round numbers. */
export const STRATEGIES: readonly Strategy[] = [
  {
    name: "Walk up",
    steps: [
      step("left", "Walk", 0.18, 0.55),
      step("right", "Walk", 0.18, 0.65),
      step("left", "Walk", 0.18, 0.65),
      step("right", "Walk", 0.18, 0.55),
      step("left", "ForwardStepDuringTask", 0.2, 0.02),
    ],
  },
  {
    name: "Turn, then walk",
    steps: [
      step("left", "TurnAndStep", 0.16, 0.35, 0.55),
      step("right", "TurnAndStep", 0.2, 0.5, 0.45),
      step("left", "Walk", 0.18, 0.6),
      step("right", "Walk", 0.18, 0.5, -0.35),
      step("left", "TurnAndStep", 0.2, 0.1, -0.4),
    ],
  },
  {
    name: "Side steps",
    steps: [
      step("left", "Walk", 0.18, 0.5),
      step("right", "Walk", 0.18, 0.5),
      step("left", "SideStep", 0.5, 0.05),
      step("right", "SideStep", -0.05 + 0.21, 0.02),
      step("left", "SideStep", 0.45, 0.02),
      step("right", "SideStep", 0.17, 0.02),
    ],
  },
];

/** Where the feet stand: left, right. The right one is the footstep that the first step is seen from. */
const START: [FloorPrint, FloorPrint] = [
  { foot: "left", x: 0.09, z: 0, yaw: 0 },
  { foot: "right", x: -0.09, z: 0, yaw: 0 },
];

export interface Fit {
  start: FloorPrint[];
  before: FloorPrint[];
  after: FloorPrint[];
  /** Rows of the objective and its weighted terms, one an iteration. */
  terms: number[][];
  /** Goal of the last footstep. */
  target: { x: number; z: number };
  /** The line of eq. 16: x, z of its ends. */
  line: [number, number, number, number];
}

export interface FitQuestion {
  strategy: Strategy;
  goal: { x: number; z: number; yaw: number };
  weights: ObjectiveWeights;
  phase: PhaseName;
}

export class StepFitter {
  private readonly workspace = createFootstepWorkspace(8);

  solve(q: FitQuestion): Fit {
    const { steps } = q.strategy;
    const n = steps.length;
    const before: FloorPrint[] = [];
    let at: FloorPrint = START[1];
    for (const s of steps) {
      at = { foot: s.foot, ...placeAt(at, s.lateral, s.forward, s.yaw) };
      before.push(at);
    }
    // The template laid so that its last two feet stand side by side at the goal: the goals of the last three.
    const last = steps[n - 1];
    const half = last.foot === "left" ? 0.09 : -0.09;
    const end = placeAt({ ...q.goal }, half, 0, 0);
    const goals = goalsBack(steps, end);
    const x = new Float64Array(3 * n);
    const desired = new Float64Array(3 * n);
    steps.forEach((s, i) => {
      x.set([before[i].x, before[i].z, before[i].yaw], 3 * i);
      desired.set([s.lateral, s.forward, s.yaw], 3 * i);
    });
    const bearing = Math.atan2(q.goal.x - START[1].x, q.goal.z - START[1].z);
    const problem: FootstepProblem = {
      n,
      previous: Float64Array.of(START[0].x, START[0].z, START[0].yaw),
      current: Float64Array.of(START[1].x, START[1].z, START[1].yaw),
      desired,
      start: Float64Array.of(0, 0),
      goal: Float64Array.of(q.goal.x, q.goal.z),
      goalYaw: q.phase === "enterPreparation" || q.phase === "enter" ? q.goal.yaw : bearing,
      goals,
      weights: q.weights,
    };
    const terms: number[][] = [];
    optimizeFootsteps(problem, x, this.workspace, { trace: terms });
    const after = steps.map(
      (s, i): FloorPrint => ({ foot: s.foot, x: x[3 * i], z: x[3 * i + 1], yaw: x[3 * i + 2] }),
    );
    return {
      start: [...START],
      before,
      after,
      terms,
      target: { x: end.x, z: end.z },
      line: [0, 0, q.goal.x, q.goal.z],
    };
  }
}

/** x and z of the last three footsteps when the last stands at `end`: the template walked backwards from there. */
function goalsBack(steps: readonly StrategyStep[], end: { x: number; z: number; yaw: number }): Float64Array {
  const m = Math.min(3, steps.length);
  const out = new Float64Array(2 * m);
  let at = end;
  for (let k = m - 1; k >= 0; k--) {
    out[2 * k] = at.x;
    out[2 * k + 1] = at.z;
    const s = steps[steps.length - m + k];
    // The footstep before: turned back first, then away.
    const yaw = at.yaw - s.yaw;
    const c = Math.cos(yaw);
    const sn = Math.sin(yaw);
    at = { x: at.x - (c * s.lateral + sn * s.forward), z: at.z - (-sn * s.lateral + c * s.forward), yaw };
  }
  return out;
}
