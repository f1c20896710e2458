/**
 * Key-times and the gait phase that all loops share [Express §6.1, Figure 4].
 *
 * Key-times are the boundaries of foot-plants. Sorted, they bound the spans in which one foot bears and those in which both
 * do or neither does (Figure 4's L, B, R, B): a walk's double support corresponds to a run's flight. The generic time
 * counts strides: phase i is the middle of the i-th left plant, and each key has a fixed place between. Two loops with
 * different numbers of strides correspond stride by stride, which is the paper's alignment through the shorter clip: the
 * shorter one is passed through again for each further stride of the longer one. Where the paper maps linearly between
 * keys, the map here is a monotone cubic through the same keys, so that time never changes its pace at once.
 */

/** Phases of the four keys in a stride: begin and end of the first span of both or neither, and of the second. */
export const KEY_PHASES = [0.19, 0.31, 0.69, 0.81] as const;
const KNOTS = 5;
const KNOT_PHASES = [0, ...KEY_PHASES, 1];

/** Shortest span of both feet or neither, frames: where a walk hardly has one, time must not race through it. */
const LEAST_SPAN = 2.5;

/** The four plant boundaries of a stride as phases in [0, 1). A walk lands before it lifts, a run lifts before. */
export interface ContactPhases {
  leftLift: number;
  rightLand: number;
  rightLift: number;
  leftLand: number;
}

/** Phase to frame of one loop and back. Frames are fractional; a pass is `frames` long and `strides` in phase. */
export interface PhaseMap {
  strides: number;
  frames: number;
  /** Frame of each knot, 5 a stride and one at the end; frames a phase at each. */
  at: Float64Array;
  slope: Float64Array;
}

/**
 * The map of a loop from its strides' first frames and plant boundaries.
 *
 * @param starts first frame of each stride, and `frames` after the last one: strides + 1 numbers.
 * @param boundaries per stride the frames of left lift, right landing, right lift, left landing.
 */
export function createPhaseMap(
  starts: readonly number[],
  boundaries: readonly (readonly [number, number, number, number])[],
): PhaseMap {
  const strides = boundaries.length;
  const n = KNOTS * strides;
  const at = new Float64Array(n + 1);
  boundaries.forEach((b, i) => {
    const keys = [Math.min(b[0], b[1]), Math.max(b[0], b[1]), Math.min(b[2], b[3]), Math.max(b[2], b[3])];
    spread(keys, 0);
    spread(keys, 2);
    let before = starts[i];
    at[KNOTS * i] = before;
    for (let k = 0; k < 4; k++) {
      // Keys at one instant are set half a frame apart: a pace is never infinite.
      const room = starts[i + 1] - 0.5 * (4 - k);
      before = Math.min(room, Math.max(before + 0.5, keys[k]));
      at[KNOTS * i + 1 + k] = before;
    }
  });
  at[n] = starts[strides];
  const secant = (i: number): number => {
    const k = ((i % n) + n) % n;
    const u = k % KNOTS;
    return (at[k + 1] - at[k]) / (KNOT_PHASES[u + 1] - KNOT_PHASES[u]);
  };
  const width = (i: number): number => {
    const u = (((i % n) + n) % n) % KNOTS;
    return KNOT_PHASES[u + 1] - KNOT_PHASES[u];
  };
  const slope = new Float64Array(n + 1);
  for (let i = 0; i <= n; i++) {
    // Fritsch and Butland's weighted harmonic mean: monotone.
    const h0 = width(i - 1);
    const h1 = width(i);
    slope[i] = (3 * (h0 + h1)) / ((2 * h1 + h0) / secant(i - 1) + (h1 + 2 * h0) / secant(i));
  }
  return { strides, frames: starts[strides], at, slope };
}

/** Two keys that fall together are set apart about their middle. */
function spread(keys: number[], k: number): void {
  const lack = LEAST_SPAN - (keys[k + 1] - keys[k]);
  if (lack <= 0) return;
  keys[k] -= lack / 2;
  keys[k + 1] += lack / 2;
}

function knotOf(phase: number): number {
  const u = phase - Math.floor(phase);
  let k = 0;
  while (k < 4 && u >= KEY_PHASES[k]) k++;
  return k;
}

/** Frame of a phase: any phase, frames counted on over passes. */
export function frameOfPhase(map: PhaseMap, phase: number): number {
  const pass = Math.floor(phase / map.strides);
  const p = phase - pass * map.strides;
  const stride = Math.min(map.strides - 1, Math.floor(p));
  const k = Math.min(4, knotOf(Math.min(p - stride, 0.9999999)));
  const i = KNOTS * stride + k;
  const h = KNOT_PHASES[k + 1] - KNOT_PHASES[k];
  const u = (p - stride - KNOT_PHASES[k]) / h;
  const u2 = u * u;
  const u3 = u2 * u;
  return (
    pass * map.frames +
    (2 * u3 - 3 * u2 + 1) * map.at[i] +
    (u3 - 2 * u2 + u) * h * map.slope[i] +
    (3 * u2 - 2 * u3) * map.at[i + 1] +
    (u3 - u2) * h * map.slope[i + 1]
  );
}

/** Frames a phase at a phase. */
export function paceOfPhase(map: PhaseMap, phase: number): number {
  const p = phase - Math.floor(phase / map.strides) * map.strides;
  const stride = Math.min(map.strides - 1, Math.floor(p));
  const k = knotOf(Math.min(p - stride, 0.9999999));
  const i = KNOTS * stride + k;
  const h = KNOT_PHASES[k + 1] - KNOT_PHASES[k];
  const u = (p - stride - KNOT_PHASES[k]) / h;
  const u2 = u * u;
  return (
    ((6 * u2 - 6 * u) * (map.at[i] - map.at[i + 1])) / h +
    (3 * u2 - 4 * u + 1) * map.slope[i] +
    (3 * u2 - 2 * u) * map.slope[i + 1]
  );
}

/** Phase of a frame, the inverse of `frameOfPhase`. */
export function phaseOfFrame(map: PhaseMap, frame: number): number {
  const pass = Math.floor(frame / map.frames);
  const f = frame - pass * map.frames;
  let i = 0;
  while (i + 1 < map.at.length - 1 && map.at[i + 1] <= f) i++;
  const stride = Math.floor(i / KNOTS);
  const k = i % KNOTS;
  let low = stride + KNOT_PHASES[k];
  let high = stride + KNOT_PHASES[k + 1];
  let p = low + ((f - map.at[i]) / (map.at[i + 1] - map.at[i])) * (high - low);
  for (let step = 0; step < 30; step++) {
    const miss = frameOfPhase(map, p) - f;
    if (Math.abs(miss) < 1e-9) break;
    if (miss > 0) high = p;
    else low = p;
    const next = p - miss / paceOfPhase(map, p);
    p = next > low && next < high ? next : (low + high) / 2;
  }
  return pass * map.strides + p;
}
