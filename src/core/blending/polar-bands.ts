/**
 * The root's parametric space Omega_r: polar gradient band interpolation of velocities [Barycentric §§4.1, 5, after
 * Johansen, Automated Semi-Procedural Animation, chapter 6].
 *
 * For example i and every other j, in the plane of (speed difference over their mean speed, signed angle x 2) and with the
 * turn rate as a third coordinate: h_i(p) = min over j of 1 - <p - p_i, p_j - p_i> / |p_j - p_i|^2, clipped to [0, 1]; the
 * weights are the h_i over their sum. An example at rest has no direction: its angle differences are 0.
 */
import type { GroundMove } from "./types.ts";

/** Weight of directions against speeds [Johansen: 2]. */
const ANGLE_SCALE = 2;
/** Metres a second that one radian a second of turning counts as. */
const TURN_SCALE = 0.5;
/** Speeds under this have no direction, m/s. */
const STILL = 0.05;

export interface RootSpace {
  count: number;
  /** x, z, scaled turn rate, speed, direction of each example. */
  examples: Float64Array;
  /** Direction of p_j - p_i over its squared length, and 1 over the pair's mean speed: count x count x 4. */
  pairs: Float64Array;
}

const EXAMPLE = 5;
const PAIR = 4;

/** Examples are velocities in the root's frame. */
export function createRootSpace(velocities: readonly GroundMove[]): RootSpace {
  const count = velocities.length;
  const examples = new Float64Array(EXAMPLE * count);
  velocities.forEach((v, i) => {
    examples.set([v.x, v.z, v.yaw * TURN_SCALE, Math.hypot(v.x, v.z), Math.atan2(v.x, v.z)], EXAMPLE * i);
  });
  const pairs = new Float64Array(PAIR * count * count);
  for (let i = 0; i < count; i++) {
    for (let j = 0; j < count; j++) {
      if (i === j) continue;
      const a = EXAMPLE * i;
      const b = EXAMPLE * j;
      const mean = Math.max(STILL, (examples[a + 3] + examples[b + 3]) / 2);
      const dr = (examples[b + 3] - examples[a + 3]) / mean;
      const da = ANGLE_SCALE * angleOf(examples[a + 3], examples[a + 4], examples[b + 3], examples[b + 4]);
      const dw = (examples[b + 2] - examples[a + 2]) / Math.max(TURN_SCALE, mean);
      const n = dr * dr + da * da + dw * dw;
      const o = PAIR * (count * i + j);
      const f = n > 1e-12 ? 1 / n : 0;
      pairs[o] = dr * f;
      pairs[o + 1] = da * f;
      pairs[o + 2] = dw * f;
      pairs[o + 3] = 1 / mean;
    }
  }
  return { count, examples, pairs };
}

/** Signed angle from direction a to direction b; 0 when either is at rest. */
function angleOf(speedA: number, a: number, speedB: number, b: number): number {
  if (speedA < STILL || speedB < STILL) return 0;
  const d = b - a;
  return d > Math.PI ? d - 2 * Math.PI : d < -Math.PI ? d + 2 * Math.PI : d;
}

/**
 * Weights of all examples for a velocity. No allocation.
 *
 * @param out `count` weights, none negative, sum 1. Where no band reaches (the bands of three coordinates leave gaps) the
 *   example least far out has it all.
 */
export function rootWeights(out: Float64Array, space: RootSpace, vx: number, vz: number, turn: number): void {
  const { count, examples, pairs } = space;
  const speed = Math.sqrt(vx * vx + vz * vz);
  const angle = speed < STILL ? 0 : Math.atan2(vx, vz);
  const w = turn * TURN_SCALE;
  let sum = 0;
  let nearest = 0;
  let most = Number.NEGATIVE_INFINITY;
  for (let i = 0; i < count; i++) {
    const a = EXAMPLE * i;
    const dr = speed - examples[a + 3];
    const da = ANGLE_SCALE * angleOf(examples[a + 3], examples[a + 4], speed, angle);
    const dw = w - examples[a + 2];
    let h = 1;
    for (let j = 0; j < count && h > most; j++) {
      if (j === i) continue;
      const o = PAIR * (count * i + j);
      const inverse = pairs[o + 3];
      const turnInverse = Math.min(inverse, 1 / TURN_SCALE);
      const g = 1 - (dr * inverse * pairs[o] + da * pairs[o + 1] + dw * turnInverse * pairs[o + 2]);
      if (g < h) h = g;
    }
    if (h > most) {
      // Until one is in a band, the least far out is kept for where the bands leave a gap.
      if (h <= 0) most = h;
      else most = 0;
      nearest = i;
    }
    out[i] = Math.max(0, h);
    sum += out[i];
  }
  if (sum === 0) {
    out[nearest] = 1;
    return;
  }
  const f = 1 / sum;
  for (let i = 0; i < count; i++) out[i] *= f;
}
