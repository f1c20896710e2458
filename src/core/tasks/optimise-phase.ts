/**
 * One phase's footsteps through the optimiser [TaskLoco §5, Algorithm 1 "Optimize"]: builds the problem from the
 * drafts, runs it, puts pivots back on the end they turn about, and runs the rest again.
 */
import { wrapAngle } from "../math/angle.ts";
import {
  createFootstepWorkspace,
  type FootstepWorkspace,
  optimizeFootsteps,
} from "../optimize/optimize-footsteps.ts";
import { PHASE_WEIGHTS, type PhaseName } from "../optimize/phase-weights.ts";
import type { Skeleton } from "../skeleton/skeleton.ts";
import { type DraftStep, type Feet, otherFoot } from "./draft.ts";
import { placePivots } from "./pivots.ts";
import type { OptimisationTrace } from "./plan-types.ts";

export interface PhaseGoal {
  phase: PhaseName;
  /** The line of eq. 16: from here ... */
  start: { x: number; z: number };
  /** ... to here; also theta_g's bearing where `goalYaw` is null. */
  goal: { x: number; z: number };
  goalYaw: number;
  /** Goals of the last footsteps, in their order; fewer than three where there are fewer (eq. 15). */
  goals: { x: number; z: number }[];
}

export function createPhaseWorkspace(): FootstepWorkspace {
  return createFootstepWorkspace(24);
}

/**
 * Optimises `steps` (their x, z, yaw are the initial guess and are written) from the feet they start at.
 *
 * @returns what the plots show; null for no steps.
 */
export function optimisePhase(
  workspace: FootstepWorkspace,
  skeleton: Skeleton,
  feet: Feet,
  steps: DraftStep[],
  goal: PhaseGoal,
  trace: boolean,
): { before: OptimisationTrace["before"]; terms: number[][]; f: number } | null {
  const n = steps.length;
  if (n === 0) return null;
  const stance = feet[otherFoot(steps[0].foot)];
  const own = feet[steps[0].foot];
  const x = new Float64Array(3 * n);
  const desired = new Float64Array(3 * n);
  steps.forEach((s, i) => {
    x[3 * i] = s.x;
    x[3 * i + 1] = s.z;
    x[3 * i + 2] = s.yaw;
    desired.set(s.desired, 3 * i);
  });
  const m = Math.min(3, n);
  const goals = new Float64Array(2 * m);
  for (let k = 0; k < m; k++) {
    const g = goal.goals[Math.max(0, goal.goals.length - m + k)] ?? goal.goal;
    goals[2 * k] = g.x;
    goals[2 * k + 1] = g.z;
  }
  const pinned = new Uint8Array(n);
  const problem = {
    n,
    previous: Float64Array.of(own.x, own.z, own.yaw),
    current: Float64Array.of(stance.x, stance.z, stance.yaw),
    desired,
    start: Float64Array.of(goal.start.x, goal.start.z),
    goal: Float64Array.of(goal.goal.x, goal.goal.z),
    goalYaw: goal.goalYaw,
    goals,
    weights: PHASE_WEIGHTS[goal.phase],
    pinned,
  };
  const before = steps.map((s) => ({ x: s.x, z: s.z, yaw: s.yaw }));
  const terms: number[][] = [];
  let f = optimizeFootsteps(problem, x, workspace, trace ? { trace: terms } : {}).f;
  read(steps, x);
  if (placePivots(skeleton.foot, feet, steps, pinned)) {
    steps.forEach((s, i) => {
      x[3 * i] = s.x;
      x[3 * i + 1] = s.z;
      x[3 * i + 2] = s.yaw;
    });
    f = optimizeFootsteps(problem, x, workspace, trace ? { trace: terms } : {}).f;
    read(steps, x);
    placePivots(skeleton.foot, feet, steps, pinned);
  }
  return { before, terms, f };
}

function read(steps: DraftStep[], x: Float64Array): void {
  steps.forEach((s, i) => {
    s.x = x[3 * i];
    s.z = x[3 * i + 1];
    s.yaw = wrapAngle(x[3 * i + 2]);
  });
}
