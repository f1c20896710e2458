/**
 * Footsteps of the steps that walkers take: which foot comes to rest where, which way, lifted and landed when. A pendulum's foot
 * lands as its step begins; it has swung while the step before was walked, after a short time on both feet.
 */
import { arcTangent } from "./elementary.ts";
import { KIND, P } from "./state.ts";

export interface CrowdFootstep {
  agent: number;
  /** 1 left, -1 right. */
  side: number;
  x: number;
  z: number;
  /** Heel to toe, radians. */
  yaw: number;
  /** Seconds; null for feet that stood there from the start. */
  lift: number | null;
  land: number;
}

/** Share of a step during which the foot behind still stands. */
const BOTH = 0.2;
/** The same for feet that shift one after the other, seconds. */
const BETWEEN = 0.05;
/** Both feet rest for so long before a shift's first foot lifts: it may have landed just before. */
const BEFORE = 0.1;

/** What is remembered of each walker between its steps: when the one before began and lasted. */
export interface FootfallMemory {
  start: Float64Array;
  duration: Float64Array;
}

export const createFootfallMemory = (walkers: number): FootfallMemory => ({
  start: new Float64Array(walkers),
  duration: new Float64Array(walkers),
});

/** World yaw of a step's planted foot: its parabola's, and outwards of it. */
export function footYaw(steps: Float64Array, p: number): number {
  if (steps[p + P.kind] !== KIND.walk) return arcTangent(steps[p + P.headX], steps[p + P.headZ]);
  return arcTangent(steps[p + P.px], steps[p + P.pz]) + steps[p + P.side] * steps[p + P.yaw];
}

/**
 * The footsteps that a step taken brings, in order of landing.
 *
 * @param steps, p the step. @param first the walker has just been set down: both feet stand.
 */
export function footfallsOf(
  memory: FootfallMemory,
  agent: number,
  steps: Float64Array,
  p: number,
  footAside: number,
  first = false,
): CrowdFootstep[] {
  const kind = steps[p + P.kind];
  const start = steps[p + P.start];
  const duration = steps[p + P.duration];
  const side = steps[p + P.side];
  const yaw = footYaw(steps, p);
  const lifted = memory.start[agent] + BOTH * memory.duration[agent];
  memory.start[agent] = start;
  memory.duration[agent] = duration;
  const at = (s: number, x: number, z: number, lift: number | null, land: number): CrowdFootstep => ({
    agent,
    side: s,
    x,
    z,
    yaw,
    lift,
    land,
  });
  const x = steps[p + P.footX];
  const z = steps[p + P.footZ];
  // Across the body from a foot at rest.
  const acrossX = x - 2 * side * steps[p + P.headZ] * footAside;
  const acrossZ = z + 2 * side * steps[p + P.headX] * footAside;
  if (first) return [at(side, x, z, null, start), at(-side, acrossX, acrossZ, null, start)];
  if (kind === KIND.walk) return [at(side, x, z, lifted, start)];
  if (kind === KIND.stop)
    return [at(side, x, z, lifted, start), at(-side, acrossX, acrossZ, start + BETWEEN, start + duration)];
  if (kind === KIND.shift)
    return [
      at(side, x, z, start + BEFORE, start + duration / 2),
      at(-side, acrossX, acrossZ, start + duration / 2 + BETWEEN, start + duration),
    ];
  return [];
}

/** Planted feet at a time within a step, x and z each, into `out`: how many. */
export function plantedFeet(
  out: Float64Array,
  steps: Float64Array,
  p: number,
  time: number,
  footAside: number,
): number {
  const kind = steps[p + P.kind];
  const side = steps[p + P.side];
  const t = time - steps[p + P.start];
  const x = steps[p + P.footX];
  const z = steps[p + P.footZ];
  if (kind === KIND.shift && 2 * t < steps[p + P.duration]) {
    out[0] = steps[p + P.x] - side * steps[p + P.fromHeadZ] * footAside;
    out[1] = steps[p + P.z] + side * steps[p + P.fromHeadX] * footAside;
    return 1;
  }
  out[0] = x;
  out[1] = z;
  if (kind !== KIND.stand && !(kind === KIND.stop && t >= steps[p + P.duration] - 1e-9)) return 1;
  out[2] = x - 2 * side * steps[p + P.headZ] * footAside;
  out[3] = z + 2 * side * steps[p + P.headX] * footAside;
  return 2;
}
