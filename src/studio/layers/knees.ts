/**
 * Knees that neither snap straight nor jerk: the hips' height and the airborne ankles give way where a knee would turn
 * faster than people's do.
 *
 * Near full extension half a centimetre is a dozen degrees of knee, so a hip path and a foot path that are each smooth
 * still make the knee jump at heel strike and toe-off. Both are freed a little: in the air the ankle moves along the leg,
 * on the ground the hips move up and down, each by a banded least-squares problem whose rows are the knee's second
 * differences at 30 Hz, held under what walkers show. By turns, since each fixes the other's ends.
 *
 * CONTRIBUTOR NOTES. Tried before: lowering the hips until no leg, airborne or not, is too straight (drops the body
 * 2 cm at every strike); smoothing the ankle's path (drags the landing). Feet on the ground are never moved.
 */
import { CLIP_RATE } from "../../core/capture/clip.ts";
import { factorBand, solveBand } from "../../core/optimize/banded-cholesky.ts";
import type { FootShape } from "../../core/skeleton/skeleton.ts";
import { boundToes, clearanceAt, type FootTrack, lowestOfFoot } from "./feet.ts";

/** Frames between the samples of a second difference: 60 and 30 a second. */
const SPANS = [1, 2];
const SPAN = 2;
const WIDTH = 2 * SPAN + 1;
/** Knee's angular acceleration that is left alone, radians per second squared (walkers: 240, runners: 400 at the 99.9th percentile). */
const CALM = 170;
const LEAST = (3 * Math.PI) / 180;
/** Weights, one over a tolerance: an airborne knee's change, a knee's acceleration (radians per second squared), the hips' change and its second difference. */
const SWING = 1 / 0.05;
const BEND = 22;
const HIPS = 1 / 0.008;
const HIPS_BEND = 1 / 0.0004;
const bendWeight = (span: number): number => (BEND * (span / CLIP_RATE) ** 2) ** -2;
const FIXED = 1e5;
const TURNS = 3;

/** Hip joints, frames x 3, of one side; changed in height only. */
export interface Legs {
  hips: [Float64Array, Float64Array];
  thigh: number;
  shank: number;
  shape: FootShape;
  /** Frames in which the hips fall freely and must not be moved. */
  flight: Uint8Array | null;
}

/**
 * Calms both knees. Mutates the airborne ankles and toe bends of `feet`.
 *
 * @returns metres by which the hips are to be raised, a frame.
 */
export function calmKnees(feet: readonly [FootTrack, FootTrack], legs: Legs): Float64Array {
  const n = feet[0].yaw.length;
  const raise = new Float64Array(n);
  const knees = [new Float64Array(n), new Float64Array(n)];
  const slopes = [new Float64Array(n), new Float64Array(n)];
  const read = (side: 0 | 1) => {
    for (let f = 0; f < n; f++) {
      const hip = legs.hips[side];
      const { ankle } = feet[side];
      const dx = hip[3 * f] - ankle[3 * f];
      const dy = hip[3 * f + 1] + raise[f] - ankle[3 * f + 1];
      const dz = hip[3 * f + 2] - ankle[3 * f + 2];
      const d = Math.sqrt(dx * dx + dy * dy + dz * dz);
      const k = kneeOf(legs, d);
      knees[side][f] = k;
      // Radians of knee per metre that the hips rise.
      slopes[side][f] = -dy / (legs.thigh * legs.shank * Math.max(0.08, Math.sin(k)));
    }
  };
  for (let turn = 0; turn < TURNS; turn++) {
    for (const side of [0, 1] as const) {
      read(side);
      calmSwing(feet[side], legs, side, knees[side], raise);
    }
    read(0);
    read(1);
    calmHips(feet, legs, knees, slopes, raise);
  }
  for (const side of [0, 1] as const) {
    read(side);
    calmSwing(feet[side], legs, side, knees[side], raise);
  }
  return raise;
}

/** Knee flexion of a leg whose hip and ankle are `d` apart; never under `LEAST`. */
function kneeOf(legs: Legs, d: number): number {
  const cos = (d * d - legs.thigh ** 2 - legs.shank ** 2) / (2 * legs.thigh * legs.shank);
  return Math.max(LEAST, Math.acos(Math.max(-1, Math.min(1, cos))));
}

function lengthOf(legs: Legs, knee: number): number {
  return Math.sqrt(legs.thigh ** 2 + legs.shank ** 2 + 2 * legs.thigh * legs.shank * Math.cos(knee));
}

const airborne = (t: FootTrack, f: number): boolean => t.swing[f] > 0 && !t.turning[f];

/** Adds weight * (sum of c x - target)^2 over the frames f - span, f, f + span to a banded system. */
function addRow(
  band: Float64Array,
  right: Float64Array,
  f: number,
  c: readonly number[],
  target: number,
  weight: number,
  span: number,
): void {
  for (let a = 0; a < 3; a++) {
    if (c[a] === 0) continue;
    const i = f + span * (a - 1);
    right[i] += weight * c[a] * target;
    for (let b = 0; b <= a; b++) band[WIDTH * i + span * (a - b)] += weight * c[a] * c[b];
  }
}

/** What a second difference of the knee should be: its own, within what is calm. */
function calmed(knee: Float64Array, f: number, span: number): number {
  const most = CALM * (span / CLIP_RATE) ** 2;
  return Math.max(-most, Math.min(most, second(knee, f, span)));
}

const second = (x: Float64Array, f: number, span: number): number => x[f - span] - 2 * x[f] + x[f + span];

function calmSwing(foot: FootTrack, legs: Legs, side: 0 | 1, knee: Float64Array, raise: Float64Array): void {
  const n = knee.length;
  const band = new Float64Array(WIDTH * n);
  const right = new Float64Array(n);
  let any = false;
  for (let f = 0; f < n; f++) {
    const free = airborne(foot, f);
    any ||= free;
    const w = (free ? SWING : FIXED) ** 2;
    band[WIDTH * f] += w;
    right[f] += w * knee[f];
    if (f < SPAN || f >= n - SPAN) continue;
    for (const span of SPANS) {
      if (!free && !airborne(foot, f - span) && !airborne(foot, f + span)) continue;
      addRow(band, right, f, [1, -2, 1], calmed(knee, f, span), bendWeight(span), span);
    }
  }
  if (!any) return;
  factorBand(band, n, WIDTH, 1e-9);
  solveBand(band, n, WIDTH, right);
  const hip = legs.hips[side];
  const { ankle, pitch } = foot;
  for (let f = 0; f < n; f++) {
    if (!airborne(foot, f)) continue;
    const wanted = lengthOf(legs, Math.max(LEAST, right[f]));
    const dx = ankle[3 * f] - hip[3 * f];
    const dy = ankle[3 * f + 1] - hip[3 * f + 1] - raise[f];
    const dz = ankle[3 * f + 2] - hip[3 * f + 2];
    const share = wanted / Math.max(1e-6, Math.sqrt(dx * dx + dy * dy + dz * dz));
    const y = hip[3 * f + 1] + raise[f] + share * dy;
    ankle[3 * f] = hip[3 * f] + share * dx;
    // Lower than it was only as far as the foot stays clear of the ground.
    const floor = clearanceAt(foot.swing[f]) + 0.0005 - lowestOfFoot(legs.shape, pitch[f]);
    ankle[3 * f + 1] = Math.max(y, Math.min(ankle[3 * f + 1], floor));
    ankle[3 * f + 2] = hip[3 * f + 2] + share * dz;
  }
  boundToes(foot, legs.shape);
}

function calmHips(
  feet: readonly [FootTrack, FootTrack],
  legs: Legs,
  knees: readonly Float64Array[],
  slopes: readonly Float64Array[],
  raise: Float64Array,
): void {
  const n = raise.length;
  const band = new Float64Array(WIDTH * n);
  const right = new Float64Array(n);
  // The unknown is the further raise; the whole raise is what is kept small.
  for (let f = 0; f < n; f++) {
    const w = (legs.flight?.[f] ? FIXED : HIPS) ** 2;
    band[WIDTH * f] += w;
    right[f] -= w * raise[f];
    if (f < SPAN || f >= n - SPAN) continue;
    addRow(band, right, f, [1, -2, 1], -second(raise, f, 1), HIPS_BEND ** 2, 1);
    for (let side = 0; side < 2; side++) {
      const at = (k: number) => (airborne(feet[side], k) ? 0 : slopes[side][k]);
      const knee = knees[side];
      for (const span of SPANS) {
        const c = [at(f - span), -2 * at(f), at(f + span)];
        if (c[0] === 0 && c[1] === 0 && c[2] === 0) continue;
        addRow(band, right, f, c, calmed(knee, f, span) - second(knee, f, span), bendWeight(span), span);
      }
    }
  }
  factorBand(band, n, WIDTH, 1e-9);
  solveBand(band, n, WIDTH, right);
  for (let f = 0; f < n; f++) raise[f] += Math.max(-0.02, Math.min(0.02, right[f]));
}
