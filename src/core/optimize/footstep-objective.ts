/**
 * The footstep objective with its analytic gradient [TaskLoco §5, eqs. 11-16].
 *
 * Variables are x, z, yaw of footsteps 1..n (index 3 (i - 1)); footsteps -1 and 0 are given. Every term is a weighted
 * sum of squares, so the same pass also yields the Gauss-Newton matrix that the optimiser starts from: footstep i is
 * coupled with i - 1 and i - 2 alone, a band of 9.
 *
 * | here | paper |
 * | --- | --- |
 * | lateral, forward | x_i, y_i of eq. 12: the step seen from the footstep before it |
 * | W_A, W_THETA | w_a, w_theta |
 * | ALPHA | alpha_o of eq. 14, alpha_dg of eq. 15 |
 */
import { wrapAngle } from "../math/angle.ts";
import type { ObjectiveWeights } from "./phase-weights.ts";

const W_A = 2;
const W_THETA = 0.4;
const ALPHA = 0.9;
/** Keeps the step length smooth where two footsteps meet, m^2. */
const LENGTH_SOFT = 1e-12;

export interface FootstepProblem {
  /** Number of free footsteps, at least 1. */
  n: number;
  /** Footsteps -1 and 0: x, z, yaw. */
  previous: Float64Array;
  current: Float64Array;
  /** n x (lateral, forward, yaw) of the template. */
  desired: Float64Array;
  /** The line of eq. 16: a point and another; equal points give no direction and no term. */
  start: Float64Array;
  goal: Float64Array;
  /** theta_g of eq. 14, a world yaw. */
  goalYaw: number;
  /** Goals of the last min(3, n) footsteps, x and z each, in their order (eq. 15). */
  goals: Float64Array;
  weights: ObjectiveWeights;
  /** 1 where a footstep may not move; may be left out. */
  pinned?: Uint8Array;
}

/** Half bandwidth of the Gauss-Newton matrix: entries (r, c) with r - c <= 8. */
export const BAND = 9;

/**
 * Value of the objective, its gradient and, when asked for, its terms and Gauss-Newton band.
 *
 * @param x 3 n variables.
 * @param grad 3 n, written; null for the value alone.
 * @param terms five weighted terms, written; or null.
 * @param band 3 n x BAND, row r holds entries (r, r - k) at [r BAND + k]; written; or null.
 */
export function evaluateFootsteps(
  p: FootstepProblem,
  x: Float64Array,
  grad: Float64Array | null,
  terms: Float64Array | null,
  band: Float64Array | null,
): number {
  const n = p.n;
  const [wd, ws, wo, wg, wl] = p.weights;
  if (grad) grad.fill(0, 0, 3 * n);
  if (band) band.fill(0, 0, 3 * n * BAND);
  let fd = 0;
  let fs = 0;
  let fo = 0;
  let fg = 0;
  let fl = 0;
  // Line of eq. 16: unit normal.
  let nx = p.goal[1] - p.start[1];
  let nz = -(p.goal[0] - p.start[0]);
  const ln = Math.sqrt(nx * nx + nz * nz);
  const line = ln > 1e-12 && wl > 0;
  if (line) {
    nx /= ln;
    nz /= ln;
  }
  const m = Math.min(3, n);
  let ax = p.current[0];
  let az = p.current[1];
  let ayaw = p.current[2];
  let ux = ax - p.previous[0];
  let uz = az - p.previous[1];
  let lBefore = Math.sqrt(ux * ux + uz * uz + LENGTH_SOFT);
  let vx = ux / lBefore;
  let vz = uz / lBefore;
  let decay = ALPHA ** (n - 1);
  for (let i = 1; i <= n; i++) {
    const o = 3 * (i - 1);
    const b = o - 3;
    const px = x[o];
    const pz = x[o + 1];
    const yaw = x[o + 2];
    const s = Math.sin(ayaw);
    const c = Math.cos(ayaw);
    const dx = px - ax;
    const dz = pz - az;
    const lateral = c * dx - s * dz;
    const forward = s * dx + c * dz;
    // Eq. 12
    const r1 = lateral - p.desired[o];
    const r2 = forward - p.desired[o + 1];
    const r3 = wrapAngle(yaw - ayaw - p.desired[o + 2]);
    fd += r1 * r1 + W_A * r2 * r2 + W_THETA * r3 * r3;
    // Eq. 13
    const l = Math.sqrt(dx * dx + dz * dz + LENGTH_SOFT);
    const ex = dx / l;
    const ez = dz / l;
    const r4 = l - lBefore;
    fs += r4 * r4;
    // Eq. 14
    const r5 = wrapAngle(yaw - p.goalYaw);
    fo += decay * r5 * r5;
    // Eq. 15
    let gx = 0;
    let gz = 0;
    const k = i - (n - m) - 1;
    if (k >= 0) {
      gx = px - p.goals[2 * k];
      gz = pz - p.goals[2 * k + 1];
      fg += decay * (gx * gx + gz * gz);
    }
    // Eq. 16
    let d = 0;
    if (line) {
      d = nx * ((ax + px) / 2 - p.start[0]) + nz * ((az + pz) / 2 - p.start[1]);
      fl += d * d;
    }
    if (grad) {
      const g1 = 2 * wd * r1;
      const g2 = 2 * wd * W_A * r2;
      const g3 = 2 * wd * W_THETA * r3;
      const g4 = 2 * ws * r4;
      const gl = line ? wl * d : 0;
      const sx = c * g1 + s * g2;
      const sz = -s * g1 + c * g2;
      grad[o] += sx + g4 * ex + gl * nx;
      grad[o + 1] += sz + g4 * ez + gl * nz;
      grad[o + 2] += g3 + 2 * wo * decay * r5;
      if (k >= 0) {
        grad[o] += 2 * wg * decay * gx;
        grad[o + 1] += 2 * wg * decay * gz;
      }
      if (i > 1) {
        grad[b] += -sx - g4 * (ex + vx) + gl * nx;
        grad[b + 1] += -sz - g4 * (ez + vz) + gl * nz;
        grad[b + 2] += g1 * -forward + g2 * lateral - g3;
        if (i > 2) {
          grad[b - 3] += g4 * vx;
          grad[b - 2] += g4 * vz;
        }
      }
      if (band)
        addBand(
          band,
          o,
          i,
          n,
          wd,
          ws,
          wo * decay,
          k >= 0 ? wg * decay : 0,
          line ? wl : 0,
          c,
          s,
          lateral,
          forward,
          ex,
          ez,
          vx,
          vz,
          nx,
          nz,
        );
    }
    ax = px;
    az = pz;
    ayaw = yaw;
    lBefore = l;
    ux = dx;
    uz = dz;
    vx = ex;
    vz = ez;
    decay /= ALPHA;
  }
  if (terms) {
    terms[0] = wd * fd;
    terms[1] = ws * fs;
    terms[2] = wo * fo;
    terms[3] = wg * fg;
    terms[4] = wl * fl;
  }
  return wd * fd + ws * fs + wo * fo + wg * fg + wl * fl;
}

/** Scratch of one residual's derivatives, variables o - 6 .. o + 2. */
const row = new Float64Array(9);

/** Adds footstep i's residuals to the Gauss-Newton band: 2 w J^T J. */
function addBand(
  band: Float64Array,
  o: number,
  i: number,
  _n: number,
  wd: number,
  ws: number,
  wo: number,
  wg: number,
  wl: number,
  c: number,
  s: number,
  lateral: number,
  forward: number,
  ex: number,
  ez: number,
  vx: number,
  vz: number,
  nx: number,
  nz: number,
): void {
  const first = i > 2 ? 0 : i > 1 ? 3 : 6;
  // lateral
  row.fill(0);
  row[6] = c;
  row[7] = -s;
  row[3] = -c;
  row[4] = s;
  row[5] = -forward;
  accumulate(band, o, first, 2 * wd);
  // forward
  row[6] = s;
  row[7] = c;
  row[3] = -s;
  row[4] = -c;
  row[5] = lateral;
  accumulate(band, o, first, 2 * wd * W_A);
  // step length
  row[6] = ex;
  row[7] = ez;
  row[3] = -ex - vx;
  row[4] = -ez - vz;
  row[5] = 0;
  row[0] = vx;
  row[1] = vz;
  accumulate(band, o, first, 2 * ws);
  row[0] = 0;
  row[1] = 0;
  if (wl > 0) {
    row[6] = nx / 2;
    row[7] = nz / 2;
    row[3] = nx / 2;
    row[4] = nz / 2;
    accumulate(band, o, first, 2 * wl);
  }
  // yaw difference, orientation, goal
  const yy = 2 * wd * W_THETA;
  band[(o + 2) * BAND] += yy + 2 * wo;
  if (i > 1) {
    band[(o + 2) * BAND + 3] -= yy;
    band[(o - 1) * BAND] += yy;
  }
  band[o * BAND] += 2 * wg;
  band[(o + 1) * BAND] += 2 * wg;
}

function accumulate(band: Float64Array, o: number, first: number, w: number): void {
  for (let r = first; r < 8; r++) {
    const a = row[r];
    if (a === 0) continue;
    const wa = w * a;
    const base = (o - 6 + r) * BAND + r;
    for (let q = first; q <= r; q++) band[base - q] += wa * row[q];
  }
}
