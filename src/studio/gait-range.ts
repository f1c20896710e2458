/** How real walkers and runners move: averages and spreads a band of speed, to draw ours against. */
import data from "./gait-range.json" with { type: "json" };

export interface RangeCurve {
  /** Degrees at 0, 4, ... 100 % of the cycle. */
  mean: number[];
  sd: number[];
}
export interface GaitRange {
  name: string;
  kind: "walk" | "run";
  /** Speeds that it is for, metres a second. */
  from: number;
  to: number;
  /** How many walkers it is of. */
  walkers: number;
  curves: { hip: RangeCurve; knee: RangeCurve; ankle: RangeCurve };
  /** Mean and spread; lengths in metres, shares of the cycle, steps a minute. */
  facts: Record<
    | "cadence"
    | "stepLength"
    | "stance"
    | "doubleSupport"
    | "pelvisVertical"
    | "pelvisLateral"
    | "tipClearance",
    [number, number]
  >;
}

/** The band of a speed, metres a second. */
export function rangeAt(speed: number, runs: boolean): GaitRange {
  const bands = data.bands as unknown as GaitRange[];
  const own = bands.filter((b) => b.kind === (runs ? "run" : "walk"));
  return own.find((b) => speed < b.to) ?? own[own.length - 1];
}
