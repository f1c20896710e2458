/** Whether measured figures hold their goals, allowing for noise. */
import type { Figure } from "./types.ts";

/** Share of a goal within which a measurement on a busy machine may miss it. */
export const NOISE = 0.1;

/** Units that tell more of the machine than of the code. */
const ABSOLUTE = /^(ms|us|frames\/s)/;

/**
 * One sentence for each figure that misses its goal by more than noise, or was not measured. Ratios within one run are judged, and
 * figures of no machine (shares, lengths, counts); absolute times and rates are printed beside their goals and judged by
 * nobody.
 */
export function misses(figures: readonly Figure[]): string[] {
  return figures.flatMap((f) => {
    if (f.goal === null || f.ok !== false) return [];
    const bound = /(<=|>=|<|>)\s*(\d+(?:\.\d+)?)/.exec(f.goal);
    if (!f.goal.includes("ratio") && ABSOLUTE.test(f.unit) && Number.isFinite(f.median)) return [];
    const value = f.goal.includes("ratio") ? f.ratio : f.median;
    if (bound && value !== null && Number.isFinite(value)) {
      const limit = Number(bound[2]);
      const near = bound[1].startsWith("<") ? value <= limit * (1 + NOISE) : value >= limit * (1 - NOISE);
      if (near) return [];
    }
    return [`${f.name}: ${value === null ? "not measured" : value.toPrecision(3)}, goal ${f.goal}.`];
  });
}
