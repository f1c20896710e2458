/** Averages over real walkers' cycles and how ours stand beside them, for the tests that compare. */
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { GAIT_PHASES, type GaitAnalysis } from "../../src/core/quality/gait.ts";
import { SHARED } from "./shared.ts";

interface Average {
  mean: number;
  sd: number;
}
interface Curve {
  mean: number[];
  sd: number[];
}
export interface RealGait {
  curves_deg: { hip: Curve; knee: Curve; ankle: Curve };
  stance_fraction: Average;
  double_support_fraction: Average;
  flight_fraction: Average;
  speed_cm_s: Average;
  cadence_steps_min: Average;
  cycle_s: Average;
  step_length_cm: Average;
  step_width_cm: Average;
  toe_out_deg: Average;
  pelvis_vertical_excursion_cm: Average;
  pelvis_lateral_excursion_cm: Average;
  swing_min_tip_clearance_cm: Average;
  swing_max_toe_joint_lift_cm: Average;
}

/** One group of the measured gaits, as "bandai-2/walk/normal". */
export function realGait(group: string): RealGait {
  const all = JSON.parse(readFileSync(join(SHARED, "mocap/gait-facts.json"), "utf8")) as {
    groups: Record<string, RealGait>;
  };
  return all.groups[group];
}

/** Shares of the cycle inside max(SD, 3 degrees) of the real mean and inside twice that, and the rms, degrees. */
export function curveShares(ours: GaitAnalysis, real: RealGait, joint: "hip" | "knee" | "ankle"): Shares {
  return sharesOf(ours[joint].mean, real, joint);
}

interface Shares {
  once: number;
  twice: number;
  rms: number;
}

/** Likewise of any curve over the cycle, degrees. */
export function sharesOf(curve: ArrayLike<number>, real: RealGait, joint: "hip" | "knee" | "ankle"): Shares {
  const { mean, sd } = real.curves_deg[joint];
  let once = 0;
  let twice = 0;
  let square = 0;
  for (let i = 0; i < GAIT_PHASES; i++) {
    const d = Math.abs(curve[i] - mean[i]);
    const band = Math.max(3, sd[i]);
    if (d <= band) once++;
    if (d <= 2 * band) twice++;
    square += d * d;
  }
  return { once: once / GAIT_PHASES, twice: twice / GAIT_PHASES, rms: Math.sqrt(square / GAIT_PHASES) };
}
