import { readFileSync } from "node:fs";
import { join } from "node:path";
import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { createRandom } from "../../src/core/math/random.ts";
import { createBfgsWorkspace, minimiseBfgs } from "../../src/core/optimize/bfgs.ts";
import { evaluateFootsteps, type FootstepProblem } from "../../src/core/optimize/footstep-objective.ts";
import { createFootstepWorkspace, optimizeFootsteps } from "../../src/core/optimize/optimize-footsteps.ts";
import { PHASE_NAMES, PHASE_WEIGHTS } from "../../src/core/optimize/phase-weights.ts";
import { readInstances } from "../support/instances.ts";
import { hasShared, SHARED } from "../support/shared.ts";

function randomProblem(seed: number): { problem: FootstepProblem; x: Float64Array } {
  const r = createRandom(seed);
  const n = 1 + r.below(16);
  const array = (k: number, low: number, high: number) =>
    Float64Array.from({ length: k }, () => r.between(low, high));
  const problem: FootstepProblem = {
    n,
    previous: array(3, -0.3, 0.3),
    current: array(3, -0.3, 0.3),
    desired: array(3 * n, -0.6, 0.6),
    start: array(2, -1, 1),
    goal: array(2, 2, 4),
    goalYaw: r.between(-1, 1),
    goals: array(2 * Math.min(3, n), -2, 2),
    weights: PHASE_WEIGHTS[PHASE_NAMES[r.below(4)]],
  };
  return { problem, x: array(3 * n, -1, 1) };
}

describe("footstep objective", () => {
  it("gradient agrees with central differences to 1e-6 (seed 4711)", () => {
    fc.assert(
      fc.property(fc.integer({ min: 0, max: 1e6 }), (seed) => {
        const { problem, x } = randomProblem(seed);
        const g = new Float64Array(x.length);
        evaluateFootsteps(problem, x, g, null, null);
        for (let i = 0; i < x.length; i++) {
          const h = 1e-5;
          const keep = x[i];
          x[i] = keep + h;
          const up = evaluateFootsteps(problem, x, null, null, null);
          x[i] = keep - h;
          const down = evaluateFootsteps(problem, x, null, null, null);
          x[i] = keep;
          expect(Math.abs(g[i] - (up - down) / (2 * h))).toBeLessThan(1e-6 * Math.max(1, Math.abs(g[i])));
        }
      }),
      { seed: 4711, numRuns: 150 },
    );
  });

  it("terms add up to the value", () => {
    const { problem, x } = randomProblem(3);
    const terms = new Float64Array(5);
    const f = evaluateFootsteps(problem, x, null, terms, null);
    expect(terms.reduce((a, b) => a + b, 0)).toBeCloseTo(f, 12);
  });

  it("pinned footsteps stay", () => {
    const { problem, x } = randomProblem(12);
    problem.pinned = new Uint8Array(problem.n);
    problem.pinned[0] = 1;
    const before = x.slice(0, 3);
    optimizeFootsteps(problem, x, createFootstepWorkspace(16));
    expect([...x.slice(0, 3)]).toEqual([...before]);
  });
});

describe("BFGS", () => {
  it("solves Rosenbrock's valley from (-1.2, 1)", () => {
    const x = Float64Array.of(-1.2, 1);
    const result = minimiseBfgs(
      (at, g) => {
        const [a, b] = at;
        g[0] = -2 * (1 - a) - 400 * a * (b - a * a);
        g[1] = 200 * (b - a * a);
        return (1 - a) ** 2 + 100 * (b - a * a) ** 2;
      },
      x,
      2,
      createBfgsWorkspace(2),
      { gradientTolerance: 1e-8 },
    );
    expect(result.status).toBe("converged");
    expect(x[0]).toBeCloseTo(1, 6);
    expect(x[1]).toBeCloseTo(1, 6);
  });

  it("not converging is a status", () => {
    const x = Float64Array.of(5);
    expect(
      minimiseBfgs(
        (at, g) => {
          g[0] = 1;
          return at[0];
        },
        x,
        1,
        createBfgsWorkspace(1),
        { maxIterations: 3 },
      ).status,
    ).not.toBe("converged");
  });
});

describe.skipIf(!hasShared)("reference instances", () => {
  it("starts at f0 to 1e-9 and ends at or below the reference on 98.5 % of each size", () => {
    const instances = readInstances(join(SHARED, "bench/footstep-instances.json"));
    const reference = new Map(
      (
        JSON.parse(readFileSync(join(SHARED, "bench/footstep-reference.json"), "utf8")).reference as {
          id: string;
          f0: number;
          f: number;
          best: number;
        }[]
      ).map((r) => [r.id, r]),
    );
    const workspace = createFootstepWorkspace(16);
    const hits: Record<number, [number, number]> = {};
    for (const { id, problem, x0 } of instances) {
      const ref = reference.get(id)!;
      const x = Float64Array.from(x0);
      expect(Math.abs(evaluateFootsteps(problem, x, null, null, null) - ref.f0)).toBeLessThan(1e-9);
      const { f } = optimizeFootsteps(problem, x, workspace);
      hits[problem.n] ??= [0, 0];
      const h = hits[problem.n];
      h[1]++;
      if (f <= ref.f + 1e-6 || f <= ref.best + 1e-6) h[0]++;
    }
    for (const [n, [hit, all]] of Object.entries(hits))
      expect(hit / all, `n = ${n}`).toBeGreaterThanOrEqual(0.985);
  });
});
