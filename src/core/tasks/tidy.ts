/**
 * What the paper's objectives do not know: feet keep apart, steps keep within reach, and no foot stands in furniture.
 * A few small moves after the optimisation; a plan that needs none is left as it is.
 */
import { wrapAngle } from "../math/angle.ts";
import { toLocal, toWorld } from "../math/frame2.ts";
import { pivotPlace } from "../motion/sole.ts";
import type { Skeleton } from "../skeleton/skeleton.ts";
import { type DraftStep, type Feet, footPose, otherFoot } from "./draft.ts";
import { pivotEnd } from "./pivots.ts";
import { type Obstacle, obstacleDistance, pushOut } from "./route.ts";

/** Shares of the leg length (0.93 m at 1.75 m). */
export const TIDY = {
  /** Least distance across the feet between the two ankles. */
  apart: 0.1 / 0.93,
  /** ... applied when the feet are this near along their direction. */
  beside: 0.24 / 0.93,
  /** Longest distance between consecutive footsteps of different feet. */
  reach: 0.92 / 0.93,
  /** Radius of the circle about the middle of a foot that may not enter an obstacle, metres. */
  footRadius: 0.1,
  /** From the ankle to the middle of the foot. */
  footMiddle: 0.06 / 0.93,
  /** How far a foot is turned in and out against the other, radians: captures of turns reach -73 and 81 degrees, hips little more. */
  turnIn: -1.35,
  turnOut: 1.65,
};

/** Moves footsteps that cross, overreach or stand in an obstacle, and turns those that no hip could. Mutates `steps`; pivots only follow their foot. */
export function tidyFootsteps(
  skeleton: Skeleton,
  feet: Feet,
  steps: DraftStep[],
  obstacles: readonly Obstacle[],
): void {
  const leg = skeleton.legLength;
  const now: Feet = { left: feet.left, right: feet.right };
  for (const s of steps) {
    const end = pivotEnd(s.category);
    const other = now[otherFoot(s.foot)];
    const out = s.foot === "left" ? 1 : -1;
    const turned = out * wrapAngle(s.yaw - other.yaw);
    const held = Math.max(TIDY.turnIn, Math.min(TIDY.turnOut, turned));
    if (held !== turned) s.yaw = wrapAngle(other.yaw + out * held);
    if (end) {
      // Its foot may have been moved before.
      const place = pivotPlace(skeleton.foot, now[s.foot], s.yaw, end);
      s.x = place.x;
      s.z = place.z;
    } else {
      const stance = footPose(other);
      const side = out;
      // Across the mean direction of both feet, so that a turned foot may stand with its heel to the other.
      const local = toLocal(stance, footPose(s));
      const half = local.yaw / 2;
      const c = Math.cos(half);
      const sn = Math.sin(half);
      const across = (c * local.x - sn * local.z) * side;
      const along = sn * local.x + c * local.z;
      const least = TIDY.apart * leg;
      if (
        Math.abs(local.yaw) < 1.9 &&
        across < least &&
        Math.abs(along) < TIDY.beside * leg + Math.max(0, least - across)
      ) {
        const push = (least - across) * side;
        local.x += c * push;
        local.z -= sn * push;
      } else if (Math.abs(local.yaw) < 1.9 && across < -0.02 * leg) {
        // A long crossing step: at most onto the line of the other foot.
        const push = -across * side;
        local.x += c * push;
        local.z -= sn * push;
      }
      const length = Math.hypot(local.x, local.z);
      const longest = TIDY.reach * leg;
      if (length > longest) {
        local.x *= longest / length;
        local.z *= longest / length;
      }
      const world = toWorld(stance, local);
      s.x = world.x;
      s.z = world.z;
      keepOut(skeleton, s, obstacles);
    }
    now[s.foot] = s;
  }
}

/** Pushes the middle of the foot out of every obstacle. */
function keepOut(skeleton: Skeleton, s: DraftStep, obstacles: readonly Obstacle[]): void {
  const m = TIDY.footMiddle * skeleton.legLength;
  const dx = m * Math.sin(s.yaw);
  const dz = m * Math.cos(s.yaw);
  const p = { x: s.x + dx, z: s.z + dz };
  if (pushOut(p, obstacles, TIDY.footRadius)) {
    s.x = p.x - dx;
    s.z = p.z - dz;
  }
}

/** How many of the footsteps stand in an obstacle, their hips' way included: for choosing among templates. */
export function collisions(
  steps: readonly { x: number; z: number; yaw: number }[],
  obstacles: readonly Obstacle[],
  hipRadius: number,
): number {
  let count = 0;
  for (let i = 0; i < steps.length; i++) {
    const s = steps[i];
    const p = steps[Math.max(0, i - 1)];
    const hx = (s.x + p.x) / 2;
    const hz = (s.z + p.z) / 2;
    for (const o of obstacles) {
      if (obstacleDistance(o, s.x, s.z) < TIDY.footRadius * 0.6 || obstacleDistance(o, hx, hz) < hipRadius) {
        count++;
        break;
      }
    }
  }
  return count;
}

/** Whether the middle of a foot at a pose is in an obstacle, as `tidyFootsteps` would not leave it. */
export function footInside(
  obstacles: readonly Obstacle[],
  foot: { x: number; z: number; yaw: number },
  skeleton: Skeleton,
): boolean {
  const m = TIDY.footMiddle * skeleton.legLength;
  const x = foot.x + m * Math.sin(foot.yaw);
  const z = foot.z + m * Math.cos(foot.yaw);
  return obstacles.some((o) => obstacleDistance(o, x, z) < TIDY.footRadius);
}

/** Farthest that a stance is moved from where its task wants it, metres. */
const MOST_ASIDE = 0.5;

/**
 * How far a stance has to be moved for both feet to stand free of furniture: one way for both, so that they stay beside each
 * other. [0, 0] where nothing is in the way, or no way out is near.
 */
export function wayOut(
  skeleton: Skeleton,
  feet: readonly { x: number; z: number; yaw: number }[],
  obstacles: readonly Obstacle[],
): [number, number] {
  const m = TIDY.footMiddle * skeleton.legLength;
  let x = 0;
  let z = 0;
  for (let round = 0; round < 8; round++) {
    let moved = false;
    for (const f of feet) {
      const p = { x: f.x + x + m * Math.sin(f.yaw), z: f.z + z + m * Math.cos(f.yaw) };
      const from = { ...p };
      if (!pushOut(p, obstacles, TIDY.footRadius)) continue;
      x += p.x - from.x;
      z += p.z - from.z;
      moved = true;
    }
    if (!moved) break;
  }
  return Math.hypot(x, z) <= MOST_ASIDE ? [x, z] : [0, 0];
}
