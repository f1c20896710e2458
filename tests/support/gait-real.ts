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

/** What swings with the stride: its mean, and over one stride its amount and how much later than the feet it is ahead, radians. */
export type Swing = readonly [mean: number, amount: number, lag: number];

/** How pelvis, chest and arms go with the stride, degrees; the mean of both sides. */
export interface StrideSwings {
  /** Left hip and left shoulder ahead as the left foot is: positive. */
  pelvis: Swing;
  chest: Swing;
  /** Upper arm forwards against the vertical, and outwards. */
  arm: Swing;
  out: Swing;
  /** Elbow's flexion, and its second harmonic. */
  elbow: Swing;
  twice: Swing;
}

/**
 * First harmonics over the frames that count of someone who goes straight ahead; the clock is the feet's own first harmonic, zero
 * where the side's foot is farthest ahead of the other.
 */
export function strideSwings(
  joints: ArrayLike<number>,
  frames: number,
  counts: (frame: number) => boolean,
): StrideSwings {
  const at = (f: number, joint: number, axis: number) => joints[3 * (JOINT_COUNT * f + joint) + axis];
  const used = Array.from({ length: frames }, (_, f) => f).filter(counts);
  const [first, last] = [used[0], used[used.length - 1]];
  const way = [0, 2].map((k) => at(last, J.hips, k) - at(first, J.hips, k));
  const far = Math.hypot(way[0], way[1]);
  const part = (f: number, a: number, b: number) => [0, 1, 2].map((k) => at(f, b, k) - at(f, a, k));
  const ahead = ([x, , z]: readonly number[]) => (x * way[0] + z * way[1]) / far;
  const aside = ([x, , z]: readonly number[]) => (x * way[1] - z * way[0]) / far;
  const harmonic = (values: readonly number[], hertz: number): [number, number, number] => {
    const mean = values.reduce((a, b) => a + b, 0) / values.length;
    let [c, s] = [0, 0];
    used.forEach((f, i) => {
      c += (values[i] - mean) * Math.cos((2 * Math.PI * hertz * f) / CLIP_RATE);
      s += (values[i] - mean) * Math.sin((2 * Math.PI * hertz * f) / CLIP_RATE);
    });
    return [mean, (2 * Math.hypot(c, s)) / values.length, Math.atan2(s, c)];
  };
  const feet = used.map((f) => ahead(part(f, J.rightFoot, J.leftFoot)));
  let stride = 0.5;
  for (let hertz = 0.5; hertz < 2; hertz += 0.005)
    if (harmonic(feet, hertz)[1] > harmonic(feet, stride)[1]) stride = hertz;
  const start = harmonic(feet, stride)[2];
  /** The mean of both sides: amounts and lags as vectors, or one alone slips half a turn. */
  const both = (times: number, values: (f: number, side: 0 | 1) => number): Swing => {
    let [m, c, s] = [0, 0, 0];
    for (const side of [0, 1] as const) {
      const [mean, amount, phase] = harmonic(
        used.map((f) => values(f, side)),
        times * stride,
      );
      const lag = phase - times * (start + side * Math.PI);
      m += mean / 2;
      c += (amount * Math.cos(lag)) / 2;
      s += (amount * Math.sin(lag)) / 2;
    }
    return [m, Math.hypot(c, s), Math.atan2(s, c)];
  };
  const line = (f: number, a: number, b: number) => {
    const v = part(f, a, b);
    return Math.asin(ahead(v) / Math.hypot(...v)) * DEG;
  };
  const upper = (side: 0 | 1) => (side === 0 ? J.leftUpperArm : J.rightUpperArm);
  const hang = (f: number, side: 0 | 1) => part(f, upper(side), upper(side) + 1);
  const flexion = (f: number, side: 0 | 1) => {
    const [a, b] = [hang(f, side), part(f, upper(side) + 1, upper(side) + 2)];
    return Math.acos((a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) / (Math.hypot(...a) * Math.hypot(...b))) * DEG;
  };
  return {
    pelvis: both(1, (f, side) => (side === 0 ? 1 : -1) * line(f, J.rightUpperLeg, J.leftUpperLeg)),
    chest: both(1, (f, side) => (side === 0 ? 1 : -1) * line(f, J.rightUpperArm, J.leftUpperArm)),
    arm: both(1, (f, side) => Math.atan2(ahead(hang(f, side)), -hang(f, side)[1]) * DEG),
    out: both(1, (f, side) => {
      const v = hang(f, side);
      return Math.atan2((side === 0 ? 1 : -1) * aside(v), -v[1]) * DEG;
    }),
    elbow: both(1, flexion),
    twice: both(2, flexion),
  };
}

const DEG = 180 / Math.PI;
