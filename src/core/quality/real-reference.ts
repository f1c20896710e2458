/**
 * What real captures score: facts to compare with, measured once over 215 clips (1,188 s) of two public archives, the
 * Bandai-Namco Research motion datasets 1 and 2 (30 frames a second) and flat passages of the phase-functioned neural network's
 * captures (120 frames a second). Averages and percentiles only.
 */

/** Kinds of motion that captures were sorted into, by the hips' way and facing. */
export type MotionKind = "walk" | "run" | "turn" | "sidestep" | "stand" | "all";

export interface RealAcceleration {
  /** 99.9th percentile of all joints' angular accelerations at 30 Hz, rad/s2. */
  pooled30: number;
  /** The same at 60 Hz, where clips were fast enough; null elsewhere. */
  pooled60: number | null;
  /** Per joint at 30 Hz, in pose order; 0 where no clip had the joint. */
  joints: readonly number[];
}

export const REAL_ACCELERATION: Readonly<Record<MotionKind, RealAcceleration>> = {
  walk: {
    pooled30: 344.99,
    pooled60: null,
    joints: [
      66.39, 48.04, 66.25, 70.13, 37.22, 52.73, 77.49, 180.72, 258.17, 199.98, 67.77, 140.59, 266.28, 133.95,
      126.03, 241.82, 310.75, 474.19, 161.51, 239.96, 544.07, 535.78,
    ],
  },
  run: {
    pooled30: 547.26,
    pooled60: null,
    joints: [
      115.36, 49.1, 97.92, 0, 74.67, 102.86, 143.79, 280.46, 619.76, 340.13, 157.68, 299.58, 608.9, 529.28,
      239.61, 397.23, 568.57, 772.36, 241.58, 420.88, 598.71, 766.85,
    ],
  },
  turn: {
    pooled30: 358.36,
    pooled60: 1226.58,
    joints: [
      59.62, 102.07, 205.26, 153.0, 48.23, 62.02, 74.72, 187.26, 311.27, 181.9, 90.38, 462.87, 462.92, 853.42,
      124.66, 272.37, 466.13, 526.53, 150.92, 208.65, 544.83, 483.43,
    ],
  },
  sidestep: {
    pooled30: 305.44,
    pooled60: null,
    joints: [
      74.69, 27.12, 54.17, 0, 40.38, 57.95, 47.17, 120.23, 166.53, 105.3, 47.68, 97.89, 165.71, 102.24,
      153.34, 249.84, 323.67, 425.1, 156.94, 261.33, 432.59, 422.14,
    ],
  },
  stand: {
    pooled30: 172.91,
    pooled60: null,
    joints: [
      23.67, 10.71, 21.31, 0, 31.37, 28.74, 45.45, 161.8, 268.64, 265.53, 45.61, 173.11, 236.39, 216.62,
      41.78, 68.53, 62.49, 9.32, 35.3, 40.17, 43.79, 13.63,
    ],
  },
  all: {
    pooled30: 403.75,
    pooled60: 1230.86,
    joints: [
      101.42, 66.35, 129.89, 138.57, 61.78, 77.89, 106.39, 221.18, 428.08, 237.59, 108.34, 256.07, 438.33,
      417.23, 200.82, 310.18, 463.32, 599.38, 209.67, 308.76, 556.51, 594.26,
    ],
  },
};

/** Effectors whose jerk is judged, in the order of `REAL_JERK`'s rows. */
export const JERK_EFFECTORS = ["leftHand", "rightHand", "leftFoot", "rightFoot", "head", "hips"] as const;

export interface RealJerk {
  /** Median over clips of the root-mean-square jerk over leg length, 1/s3, a row of JERK_EFFECTORS. */
  median: readonly number[];
  /** Straight line of log(ratio to the median) over log(speed in m/s): at, slope; null where speed explains nothing. */
  bySpeed: readonly [number, number] | null;
}

export const REAL_JERK: Readonly<Record<MotionKind, RealJerk>> = {
  walk: { median: [143.0299, 133.8725, 319.0941, 321.6335, 106.8053, 113.1271], bySpeed: [-0.0651, 1.3089] },
  run: { median: [743.2172, 693.7633, 709.5448, 713.2507, 327.8021, 342.4436], bySpeed: [-1.1081, 1.1325] },
  turn: { median: [132.4427, 131.7529, 318.9744, 304.0693, 99.3101, 103.2032], bySpeed: [0.0501, 1.3843] },
  sidestep: {
    median: [142.6653, 140.4847, 300.8871, 310.2155, 100.4328, 94.5843],
    bySpeed: [0.0962, 1.1371],
  },
  stand: { median: [57.7337, 55.2791, 5.3706, 7.3168, 9.87, 6.3489], bySpeed: null },
  all: { median: [209.4611, 192.8983, 350.8688, 359.7087, 115.1468, 117.7095], bySpeed: [-0.0757, 0.3754] },
};
