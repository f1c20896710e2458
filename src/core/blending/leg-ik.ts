/**
 * Analytic two-bone legs for a batch [Barycentric §4.5]: how far the hips must sink so that both feet reach, and the legs closed on
 * their ankles with the knees where the blended pose has them. The bend itself is core/ik's.
 */

import { bendLeg } from "../ik/leg.ts";
import { quatInverseMultiply, quatMultiply } from "../math/quaternion.ts";
import { J } from "../skeleton/joints.ts";
import type { Skeleton } from "../skeleton/skeleton.ts";
import { ANKLE } from "./batch.ts";

/** Bones' lengths of one leg: both legs are alike. */
export interface Leg {
  thigh: number;
  shank: number;
}

export function legOf(skeleton: Skeleton): Leg {
  const length = (j: number) =>
    Math.hypot(skeleton.offsets[3 * j], skeleton.offsets[3 * j + 1], skeleton.offsets[3 * j + 2]);
  return { thigh: length(J.leftLowerLeg), shank: length(J.leftFoot) };
}

/** A leg never gets straighter than this under its full length, metres; and how softly it gets there. */
const SPARE = 0.003;
const SOFT = 0.015;

/** How far the hips must sink for an ankle (dx, dy, dz from the hip joint) to be in reach, softly, metres. */
export function sinkFor(leg: Leg, dx: number, dy: number, dz: number): number {
  const d = Math.sqrt(dx * dx + dy * dy + dz * dz);
  const over = d - (leg.thigh + leg.shank - SPARE);
  if (over < -12 * SOFT) return 0;
  const soft = SOFT * Math.log1p(Math.exp(Math.min(50, over / SOFT)));
  // Down by as much as makes the hip's distance shorter by `soft`.
  const aim = d - Math.max(soft, over + 1e-6);
  const flat = dx * dx + dz * dz;
  if (aim * aim <= flat) return Math.min(0.4, -dy);
  return Math.max(0, -dy - Math.sqrt(aim * aim - flat));
}

const toes = new Float64Array(4);

/**
 * Closes the leg whose thigh is joint `upper` on the ankle wanted in the state block at `foot`.
 *
 * @param rotations local rotations, thigh to toes written; @param positions, @param world likewise; the hips' are read.
 */
export function closeLeg(
  leg: Leg,
  offsets: Float64Array,
  rotations: Float64Array,
  positions: Float64Array,
  world: Float64Array,
  upper: number,
  state: Float64Array,
  foot: number,
): void {
  const lower = upper + 1;
  const ankle = upper + 2;
  const w = foot + ANKLE;
  // The way the knee points: as blended, and half of what the foot is turned beyond the blend.
  const tu = 4 * upper;
  const tf = 4 * ankle;
  const blendX = 2 * (world[tf] * world[tf + 2] + world[tf + 3] * world[tf + 1]);
  const blendZ = 1 - 2 * (world[tf] * world[tf] + world[tf + 1] * world[tf + 1]);
  const wantX = 2 * (state[w + 3] * state[w + 5] + state[w + 6] * state[w + 4]);
  const wantZ = 1 - 2 * (state[w + 3] * state[w + 3] + state[w + 4] * state[w + 4]);
  // Their lengths shrink as the foot points down, where it says nothing of where the knee goes.
  const kx = 2 * (world[tu] * world[tu + 2] + world[tu + 3] * world[tu + 1]) + 0.5 * (wantX - blendX);
  const ky = 2 * (world[tu + 1] * world[tu + 2] - world[tu + 3] * world[tu]);
  const kz = 1 - 2 * (world[tu] * world[tu] + world[tu + 1] * world[tu + 1]) + 0.5 * (wantZ - blendZ);
  bendLeg(positions, world, upper, leg.thigh, leg.shank, state[w], state[w + 1], state[w + 2], kx, ky, kz);
  for (let k = 0; k < 4; k++) world[tf + k] = state[w + 3 + k];
  quatInverseMultiply(rotations, tu, world, 4 * J.hips, world, tu);
  quatInverseMultiply(rotations, 4 * lower, world, tu, world, 4 * lower);
  quatInverseMultiply(rotations, tf, world, 4 * lower, world, tf);
  // Toes: their joint from the foot, bent about the foot's -X.
  const t = upper + 3;
  const half = -state[w + 7] / 2;
  toes[0] = Math.sin(half);
  toes[3] = Math.cos(half);
  for (let k = 0; k < 4; k++) rotations[4 * t + k] = toes[k];
  quatMultiply(world, 4 * t, world, tf, rotations, 4 * t);
  const ox = offsets[3 * t];
  const oy = offsets[3 * t + 1];
  const oz = offsets[3 * t + 2];
  const qx = world[tf];
  const qy = world[tf + 1];
  const qz = world[tf + 2];
  const qw = world[tf + 3];
  const vx = 2 * (qy * oz - qz * oy);
  const vy = 2 * (qz * ox - qx * oz);
  const vz = 2 * (qx * oy - qy * ox);
  positions[3 * t] = positions[3 * ankle] + ox + qw * vx + (qy * vz - qz * vy);
  positions[3 * t + 1] = positions[3 * ankle + 1] + oy + qw * vy + (qz * vx - qx * vz);
  positions[3 * t + 2] = positions[3 * ankle + 2] + oz + qw * vz + (qx * vy - qy * vx);
}
