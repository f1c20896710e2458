/** Averages over real walkers' cycles and how ours stand beside them, for the tests that compare. */
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { CLIP_RATE } from "../../src/core/capture/clip.ts";
import { GAIT_PHASES, type GaitAnalysis } from "../../src/core/quality/gait.ts";
import { J, JOINT_COUNT } from "../../src/core/skeleton/joints.ts";
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

/**
 * How the pelvis turns about up as someone goes straight ahead: its first harmonic over the frames, with the feet's own as the
 * clock. @returns degrees in step with the feet and a quarter of a stride later; left hip ahead as the left foot is: positive.
 */
export function pelvisTurn(
  joints: ArrayLike<number>,
  frames: number,
  counts: (frame: number) => boolean,
): [number, number] {
  const at = (f: number, joint: number, axis: number) => joints[3 * (JOINT_COUNT * f + joint) + axis];
  const used = Array.from({ length: frames }, (_, f) => f).filter(counts);
  const [first, last] = [used[0], used[used.length - 1]];
  const way = [0, 2].map((k) => at(last, J.hips, k) - at(first, J.hips, k));
  const far = Math.hypot(way[0], way[1]);
  const ahead = (f: number, a: number, b: number) =>
    ((at(f, a, 0) - at(f, b, 0)) * way[0] + (at(f, a, 2) - at(f, b, 2)) * way[1]) / far;
  const width = (f: number) =>
    Math.hypot(...[0, 1, 2].map((k) => at(f, J.leftUpperLeg, k) - at(f, J.rightUpperLeg, k)));
  const feet = used.map((f) => ahead(f, J.leftFoot, J.rightFoot));
  const yaw = used.map(
    (f) => (Math.asin(ahead(f, J.leftUpperLeg, J.rightUpperLeg) / width(f)) * 180) / Math.PI,
  );
  const harmonic = (values: readonly number[], hertz: number): [number, number] => {
    const mean = values.reduce((a, b) => a + b, 0) / values.length;
    let [c, s] = [0, 0];
    used.forEach((f, i) => {
      c += (values[i] - mean) * Math.cos((2 * Math.PI * hertz * f) / CLIP_RATE);
      s += (values[i] - mean) * Math.sin((2 * Math.PI * hertz * f) / CLIP_RATE);
    });
    return [(2 * Math.hypot(c, s)) / values.length, Math.atan2(s, c)];
  };
  let stride = 0.5;
  for (let hertz = 0.5; hertz < 2; hertz += 0.005)
    if (harmonic(feet, hertz)[0] > harmonic(feet, stride)[0]) stride = hertz;
  const [turn, phase] = harmonic(yaw, stride);
  const lag = phase - harmonic(feet, stride)[1];
  return [turn * Math.cos(lag), turn * Math.sin(lag)];
}
