/** Whether measured figures hold their goals, allowing for noise. */
import type { Figure } from "./types.ts";

/** Share of a goal within which a measurement on a busy machine may miss it. */
export const NOISE = 0.1;

/** Units that tell more of the machine than of the code. */
const ABSOLUTE = /^(s|ms|us|frames\/s)$/;

const number = (text: string): number => Number(text.replaceAll(",", ""));

/** Whether a value misses a goal, "<= 4 mm", ">= 30,000" or "0.7 to 1.4", by no more than noise. */
function near(value: number, goal: string): boolean {
  if (!Number.isFinite(value)) return false;
  const range = /(\d[\d,.]*) to (\d[\d,.]*)/.exec(goal);
  if (range) return value >= number(range[1]) * (1 - NOISE) && value <= number(range[2]) * (1 + NOISE);
  const bound = /(<=|>=|<|>)\s*(\d[\d,]*(?:\.\d+)?)/.exec(goal);
  if (!bound) return false;
  const limit = number(bound[2]);
  return bound[1].startsWith("<") ? value <= limit * (1 + NOISE) : value >= limit * (1 - NOISE);
}

/**
 * One sentence for each figure that misses its goal by more than noise, or was not measured. Ratios within one run are judged, and
 * figures of no machine (shares, lengths, counts); absolute times and rates are printed beside their goals and judged by
 * nobody.
 */
export function misses(figures: readonly Figure[]): string[] {
  return figures.flatMap((f) => {
    if (f.goal === null || f.ok !== false) return [];
    if (!f.goal.includes("ratio") && ABSOLUTE.test(f.unit) && Number.isFinite(f.median)) return [];
    const value = f.goal.includes("ratio") ? f.ratio : f.median;
    if (value !== null && near(value, f.goal)) return [];
    return [`${f.name}: ${value === null ? "not measured" : value.toPrecision(3)}, goal ${f.goal}.`];
  });
}
