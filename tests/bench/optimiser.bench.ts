/**
 * The footstep optimiser beside fmin's conjugate gradients: same objective and gradient, same start, in one run.
 *
 * fmin gets the objective in its own form (plain arrays, gradient written in place) and stops by its own rule, with 200
 * iterations a dimension at most as it sets itself.
 */
import { existsSync, readFileSync, writeFileSync } from "node:fs";
// Its main file is no module that Node reads: the sources are bundled with the benchmark.
import { conjugateGradient } from "fmin/index.js";
import { evaluateFootsteps } from "../../src/core/optimize/footstep-objective.ts";
import { createFootstepWorkspace, optimizeFootsteps } from "../../src/core/optimize/optimize-footsteps.ts";
import { searchOtherBasins } from "../../src/core/optimize/other-basins.ts";
import { readInstances } from "../support/instances.ts";
import { figure, median } from "./measure.ts";
import type { BenchModule, Figure } from "./types.ts";

const bench: BenchModule = {
  name: "optimiser",
  async run(options) {
    const instancesPath = options.instances ?? "../shared/bench/footstep-instances.json";
    const referencePath = options.reference ?? "../shared/bench/footstep-reference.json";
    if (!existsSync(instancesPath) || !existsSync(referencePath)) {
      options.progress("optimiser: no instances; name them with --instances and --reference.");
      return [];
    }
    const instances = readInstances(instancesPath);
    const reference = new Map(
      (
        JSON.parse(readFileSync(referencePath, "utf8")).reference as { id: string; f: number; best: number }[]
      ).map((r) => [r.id, r]),
    );
    const workspace = createFootstepWorkspace(64);
    const rows: {
      id: string;
      n: number;
      f0: number;
      f: number;
      x: number[];
      ms: number;
      peerMs: number;
      reached: boolean;
      best: boolean;
    }[] = [];
    for (let round = 0; round < 4; round++) {
      for (const { id, problem, x0 } of instances) {
        const ref = reference.get(id);
        const f0 = evaluateFootsteps(problem, Float64Array.from(x0), null, null, null);
        const x = Float64Array.from(x0);
        let t = performance.now();
        const { f } = optimizeFootsteps(problem, x, workspace);
        const ms = performance.now() - t;
        const xs = new Float64Array(x0.length);
        const gs = new Float64Array(x0.length);
        const objective = (at: number[], gradient?: number[]) => {
          xs.set(at);
          const value = evaluateFootsteps(problem, xs, gs, null, null);
          if (gradient) for (let i = 0; i < gs.length; i++) gradient[i] = gs[i];
          return value;
        };
        t = performance.now();
        conjugateGradient(objective, [...x0]);
        const peerMs = performance.now() - t;
        if (round < 3) continue;
        // What is left of the peer's time goes into other basins. A start takes about as long as the first one at most.
        const lowest = Float64Array.from(x);
        const from = performance.now();
        const best = searchOtherBasins(
          problem,
          lowest,
          f,
          workspace,
          () => performance.now() - from + ms < 0.9 * peerMs - ms / 2,
        ).f;
        rows.push({
          id,
          n: problem.n,
          f0,
          f,
          x: [...x],
          ms,
          peerMs,
          reached: ref !== undefined && (f <= ref.f + 1e-6 || f <= ref.best + 1e-6),
          best: ref !== undefined && best <= ref.best + 1e-6,
        });
      }
    }
    if (options.out)
      writeFileSync(options.out, JSON.stringify(rows.map(({ id, f0, f, x, ms }) => ({ id, f0, f, x, ms }))));
    const figures: Figure[] = [];
    for (const n of [...new Set(rows.map((r) => r.n))].sort((a, b) => a - b)) {
      const own = rows.filter((r) => r.n === n);
      const peer = median(own.map((r) => r.peerMs));
      const f = figure(
        `optimiser, ${n} steps, one start`,
        "ms",
        own.map((r) => r.ms),
        "ratio <= 0.7",
        () => true,
      );
      f.peer = "fmin conjugateGradient";
      f.peerMedian = peer;
      f.ratio = f.median / peer;
      f.ok = f.ratio <= 0.7;
      figures.push(f);
      const share = (k: "reached" | "best") => (100 * own.filter((r) => r[k]).length) / own.length;
      figures.push(
        figure(
          `optimiser, ${n} steps, reference reached`,
          "%",
          [share("reached")],
          ">= 98.5 %",
          (v) => v >= 98.5,
        ),
      );
      const goal = n <= 4 ? 99 : n <= 8 ? 98 : 97;
      figures.push(
        figure(
          `optimiser, ${n} steps, best in the peer's time`,
          "%",
          [share("best")],
          `>= ${goal} %`,
          (v) => v >= goal,
        ),
      );
    }
    return figures;
  },
};

export default bench;
