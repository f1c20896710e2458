/**
 * Which animation steps are blended, and how much [Barycentric Algorithm 1, eqs. 3-5, Figure 6].
 *
 * The footstep's three and the root's k share the weight by lambda_4: 0 lands on the footstep q, 1 on the root's own
 * landing r. Up to beta the landing stays on q (the three corners make up for r's pull); beyond, the point that is reached
 * slides from q to r, so that no weight is ever negative.
 */
import { createLocated, type FootSpace, type Located, locate } from "./foot-space.ts";

/** Root clips that take part at most: those of the highest weights. */
export const ROOT_CLIPS = 3;
/** Clips in a mix at most. */
export const MIX = 3 + ROOT_CLIPS;

/** A mix of clips: `count` of them, heaviest anywhere; weights sum to 1. */
export interface Mix {
  count: number;
  clips: Int32Array;
  weights: Float64Array;
}

export const createMix = (): Mix => ({
  count: 0,
  clips: new Int32Array(MIX),
  weights: new Float64Array(MIX),
});

/** What a choice of weights rests on, for plots and tests. */
export interface Choice {
  located: Located;
  /** Clips at the corners after Algorithm 1's replacements. */
  corners: Int32Array;
  /** lambda_1..3 before the root's share is added clip by clip, and the lambda_4 used. */
  lambda: Float64Array;
  lambda4: number;
  /** Largest lambda_4 for which q itself is reached. */
  beta: number;
  /** r, the landing point of the root's clips; and where the mix lands. */
  rx: number;
  rz: number;
  x: number;
  z: number;
}

export const createChoice = (): Choice => ({
  located: createLocated(),
  corners: new Int32Array(3),
  lambda: new Float64Array(3),
  lambda4: 0,
  beta: 1,
  rx: 0,
  rz: 0,
  x: 0,
  z: 0,
});

const best = new Int32Array(ROOT_CLIPS);
const share = new Float64Array(ROOT_CLIPS);
const trial = new Float64Array(3);

/** Barycentric coordinates of (x, z) over the landing points of clips a, b, c, unclipped; false when they span nothing. */
function solve(
  out: Float64Array,
  p: Float64Array,
  a: number,
  b: number,
  c: number,
  x: number,
  z: number,
): boolean {
  const ax = p[2 * a];
  const az = p[2 * a + 1];
  const bx = p[2 * b] - ax;
  const bz = p[2 * b + 1] - az;
  const cx = p[2 * c] - ax;
  const cz = p[2 * c + 1] - az;
  const area = bx * cz - bz * cx;
  if (Math.abs(area) < 1e-9) return false;
  const dx = x - ax;
  const dz = z - az;
  out[1] = (dx * cz - dz * cx) / area;
  out[2] = (bx * dz - bz * dx) / area;
  out[0] = 1 - out[1] - out[2];
  return true;
}

/**
 * Algorithm 1. No allocation.
 *
 * @param mix written: clips and weights, merged where a clip comes in twice.
 * @param choice written; choice.located.triangle is where the search starts and ends.
 * @param rootW weights w_j of all clips for the root's velocity, as `rootWeights` gives them; null for none.
 * @param epsilon landing points this near may replace a corner, metres.
 * @param lambda4 0 (footsteps) to 1 (root).
 */
export function chooseMix(
  mix: Mix,
  choice: Choice,
  space: FootSpace,
  x: number,
  z: number,
  rootW: Float64Array | null,
  epsilon: number,
  lambda4: number,
): void {
  const { located, corners, lambda } = choice;
  const p = space.points;
  locate(located, space, x, z, located.triangle);
  const qx = located.x;
  const qz = located.z;
  for (let k = 0; k < 3; k++) corners[k] = space.triangles[3 * located.triangle + k];
  lambda.set(located.weights);
  choice.lambda4 = 0;
  choice.beta = 1;
  choice.rx = qx;
  choice.rz = qz;
  let kept = 0;
  if (rootW) {
    kept = heaviest(rootW);
    // Lines 1-14: corners give way to clips that fit the root's velocity better.
    for (let i = 0; i < 3; i++) {
      const u = corners[(i + 1) % 3];
      const v = corners[(i + 2) % 3];
      for (let j = 0; j < kept; j++) {
        const c = best[j];
        if (c === corners[i]) break;
        if (c === u || c === v) continue;
        const dx = p[2 * c] - p[2 * corners[i]];
        const dz = p[2 * c + 1] - p[2 * corners[i] + 1];
        if (dx * dx + dz * dz > epsilon * epsilon) continue;
        if (!solve(trial, p, c, u, v, qx, qz)) continue;
        if (trial[0] < -1e-9 || trial[1] < -1e-9 || trial[2] < -1e-9) continue;
        corners[i] = c;
        for (let n = 0; n < 3; n++) lambda[(i + n) % 3] = Math.max(trial[n], 0);
        break;
      }
    }
    // Line 15, eq. 3.
    choice.rx = 0;
    choice.rz = 0;
    for (let j = 0; j < kept; j++) {
      choice.rx += share[j] * p[2 * best[j]];
      choice.rz += share[j] * p[2 * best[j] + 1];
    }
  }
  choice.x = qx;
  choice.z = qz;
  if (rootW && lambda4 > 0) withRoot(choice, p, lambda4);
  // One list, a clip once.
  mix.count = 0;
  for (let k = 0; k < 3; k++) add(mix, corners[k], lambda[k]);
  for (let j = 0; j < kept; j++) add(mix, best[j], choice.lambda4 * share[j]);
}

/**
 * Lines 16, eqs. 4-5: lambda_1..3 for a given lambda_4. In coordinates of the corners, q has weights l and r has weights m:
 * l - lambda_4 m must not be negative, hence beta = min l_i / m_i over m_i > 0. Beyond, q' on the line from q to r is the
 * nearest point for which that holds: with s its share of the way, l + s (m - l) >= lambda_4 m.
 */
function withRoot(choice: Choice, p: Float64Array, lambda4: number): void {
  const { lambda, corners, located } = choice;
  if (!solve(trial, p, corners[0], corners[1], corners[2], choice.rx, choice.rz)) return;
  const four = Math.min(lambda4, 1);
  let beta = 1;
  for (let k = 0; k < 3; k++) if (trial[k] > 0) beta = Math.min(beta, lambda[k] / trial[k]);
  choice.beta = beta;
  choice.lambda4 = four;
  let s = 0;
  for (let k = 0; k < 3; k++) {
    const need = four * trial[k] - lambda[k];
    if (need > 0) s = Math.max(s, need / (trial[k] - lambda[k]));
  }
  s = Math.min(s, 1);
  let sum = 0;
  for (let k = 0; k < 3; k++) {
    const v = lambda[k] + s * (trial[k] - lambda[k]) - four * trial[k];
    lambda[k] = Math.max(v, 0);
    sum += lambda[k];
  }
  // Rounding alone: eq. 5 holds exactly.
  const f = sum > 0 ? (1 - four) / sum : 0;
  for (let k = 0; k < 3; k++) lambda[k] *= f;
  choice.x = located.x + s * (choice.rx - located.x);
  choice.z = located.z + s * (choice.rz - located.z);
}

/** The heaviest clips into `best`, their weights scaled to 1 into `share`. */
function heaviest(w: Float64Array): number {
  let kept = 0;
  let sum = 0;
  for (let n = 0; n < ROOT_CLIPS; n++) {
    let at = -1;
    let most = 1e-6;
    for (let i = 0; i < w.length; i++) {
      if (w[i] <= most) continue;
      let taken = false;
      for (let k = 0; k < kept; k++) taken ||= best[k] === i;
      if (taken) continue;
      most = w[i];
      at = i;
    }
    if (at < 0) break;
    best[kept] = at;
    share[kept++] = most;
    sum += most;
  }
  for (let k = 0; k < kept; k++) share[k] /= sum;
  return kept;
}

function add(mix: Mix, clip: number, weight: number): void {
  if (weight < 1e-9) return;
  for (let k = 0; k < mix.count; k++) {
    if (mix.clips[k] !== clip) continue;
    mix.weights[k] += weight;
    return;
  }
  mix.clips[mix.count] = clip;
  mix.weights[mix.count++] = weight;
}
