/** Whether measured figures hold their goals, allowing for noise. */
import type { Figure } from "./types.ts";

/** Share of a goal within which a measurement on a busy machine may miss it. */
export const NOISE = 0.1;

/** One sentence for each figure that misses its goal by more than noise; figures without a goal are passed over. */
export function misses(figures: readonly Figure[]): string[] {
  return figures.flatMap((f) => {
    if (f.goal === null || f.ok !== false) return [];
    const bound = /(<=|>=|<|>)\s*(\d+(?:\.\d+)?)/.exec(f.goal);
    const value = f.goal.includes("ratio") ? f.ratio : f.median;
    if (bound && value !== null && Number.isFinite(value)) {
      const limit = Number(bound[2]);
      const near = bound[1].startsWith("<") ? value <= limit * (1 + NOISE) : value >= limit * (1 - NOISE);
      if (near) return [];
    }
    return [`${f.name}: ${value === null ? "not measured" : value.toPrecision(3)}, goal ${f.goal}.`];
  });
}
