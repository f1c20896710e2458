/** Reads footstep optimisation instances into problems. */
import { readFileSync } from "node:fs";
import type { FootstepProblem } from "../../src/core/optimize/footstep-objective.ts";
import type { PhaseName } from "../../src/core/optimize/phase-weights.ts";

interface Row {
  id: string;
  phase: PhaseName;
  n: number;
  previous: number[];
  current: number[];
  desired: number[][];
  start: number[];
  goal: number[];
  goalYaw: number;
  goals: number[][];
  x0: number[];
}

export interface Instance {
  id: string;
  problem: FootstepProblem;
  x0: number[];
}

export function readInstances(path: string): Instance[] {
  const file = JSON.parse(readFileSync(path, "utf8")) as {
    weights: Record<PhaseName, { d: number; s: number; o: number; dg: number; l: number }>;
    instances: Row[];
  };
  return file.instances.map((r) => {
    const w = file.weights[r.phase];
    return {
      id: r.id,
      x0: r.x0.flat(),
      problem: {
        n: r.n,
        previous: Float64Array.from(r.previous),
        current: Float64Array.from(r.current),
        desired: Float64Array.from(r.desired.flat()),
        start: Float64Array.from(r.start),
        goal: Float64Array.from(r.goal),
        goalYaw: r.goalYaw,
        goals: Float64Array.from(r.goals.flat()),
        weights: [w.d, w.s, w.o, w.dg, w.l],
      },
    };
  });
}
