/** Footsteps to a minimum of the objective [TaskLoco §5]: BFGS started from the banded Gauss-Newton matrix. */
import { factorBand, solveBand } from "./banded-cholesky.ts";
import { type BfgsResult, type BfgsWorkspace, createBfgsWorkspace, minimiseBfgs } from "./bfgs.ts";
import { BAND, evaluateFootsteps, type FootstepProblem } from "./footstep-objective.ts";

export interface FootstepWorkspace {
  capacity: number;
  bfgs: BfgsWorkspace;
  band: Float64Array;
  grad: Float64Array;
  terms: Float64Array;
}

/** Room for up to `steps` footsteps. */
export function createFootstepWorkspace(steps: number): FootstepWorkspace {
  return {
    capacity: steps,
    bfgs: createBfgsWorkspace(3 * steps),
    band: new Float64Array(3 * steps * BAND),
    grad: new Float64Array(3 * steps),
    terms: new Float64Array(5),
  };
}

export interface OptimizeOptions {
  gradientTolerance?: number;
  maxIterations?: number;
  /** Receives a row an iteration: total and the five weighted terms. */
  trace?: number[][];
}

/**
 * Minimises the objective from `x` (3 n, written).
 *
 * @throws RangeError when the problem has more footsteps than the workspace has room for.
 */
export function optimizeFootsteps(
  problem: FootstepProblem,
  x: Float64Array,
  w: FootstepWorkspace,
  options: OptimizeOptions = {},
): BfgsResult {
  const n = 3 * problem.n;
  if (problem.n > w.capacity)
    throw new RangeError(`footsteps: at most ${w.capacity} fit the workspace, found ${problem.n}.`);
  const pinned = problem.pinned;
  const note = options.trace
    ? (at: Float64Array) => {
        const f = evaluateFootsteps(problem, at, null, w.terms, null);
        options.trace?.push([f, ...w.terms]);
      }
    : null;
  note?.(x);
  evaluateFootsteps(problem, x, w.grad, null, w.band);
  if (pinned) decouple(w.band, pinned, problem.n);
  factorBand(w.band, n, BAND, 1e-6);
  const objective = pinned
    ? (at: Float64Array, grad: Float64Array) => {
        const f = evaluateFootsteps(problem, at, grad, null, null);
        for (let i = 0; i < problem.n; i++) if (pinned[i]) grad.fill(0, 3 * i, 3 * i + 3);
        return f;
      }
    : (at: Float64Array, grad: Float64Array) => evaluateFootsteps(problem, at, grad, null, null);
  return minimiseBfgs(objective, x, n, w.bfgs, {
    gradientTolerance: options.gradientTolerance ?? 1e-5,
    maxIterations: options.maxIterations ?? 120,
    precondition: (v) => solveBand(w.band, n, BAND, v),
    ...(note ? { onIteration: note } : {}),
  });
}

/** A pinned footstep's rows and columns become the identity. */
function decouple(band: Float64Array, pinned: Uint8Array, steps: number): void {
  for (let i = 0; i < steps; i++) {
    if (!pinned[i]) continue;
    for (let r = 3 * i; r < 3 * i + 3; r++) {
      band.fill(0, r * BAND, (r + 1) * BAND);
      band[r * BAND] = 1;
      for (let q = r + 1; q < Math.min(3 * steps, r + BAND); q++) band[q * BAND + (q - r)] = 0;
    }
  }
}
