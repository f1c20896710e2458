/**
 * Walking to a stance that is given foot by foot: where a path or stones begin, or tasks leave off for them.
 */
import { bearing, groundDistance, midPose, toWorld } from "../math/frame2.ts";
import type { Foot, Footstep } from "../steps/types.ts";
import { type DraftStep, type Feet, footPose, otherFoot } from "./draft.ts";

/** Feet this near to where they are wanted stand there, metres and radians. */
const THERE = 0.001;
/** How far behind its place the second foot is when the first has landed, metres at a leg of 0.93 m. */
const BEHIND = 0.32;

/** Whether a foot already stands at a footstep. */
export function standsAt(foot: Footstep, at: Footstep): boolean {
  return groundDistance(foot, at) < THERE && Math.abs(Math.sin(foot.yaw - at.yaw)) < THERE && foot.y === at.y;
}

/** What walking to a stance aims at: which foot lands first, where, and where the other then is. */
export interface GoTo {
  stanceFoot: Foot;
  aim: Footstep;
  stance: Feet;
}

/** The foot nearer to where one comes from lands last, closing up to the other. */
export function goToOf(feet: readonly [Footstep, Footstep], from: Feet, legLength: number): GoTo {
  const here = midPose(from.left, from.right);
  const to = midPose(feet[0], feet[1]);
  const course = bearing(here, to);
  // The foot on the inner side of the turn into the stance stands; the other walks round it.
  const stanceFoot: Foot = Math.sin(to.yaw - course) > 0 ? "left" : "right";
  const aim = feet[stanceFoot === "left" ? 0 : 1];
  const other = feet[stanceFoot === "left" ? 1 : 0];
  const behind = toWorld(footPose(other), { x: 0, z: (-BEHIND * legLength) / 0.93, yaw: 0 });
  const waiting: Footstep = { ...other, ...behind };
  return {
    stanceFoot,
    aim,
    stance: stanceFoot === "left" ? { left: aim, right: waiting } : { left: waiting, right: aim },
  };
}

/** The order in which feet that do not stand there yet close up. */
export const closingOrder = (goal: GoTo): Foot[] => [goal.stanceFoot, otherFoot(goal.stanceFoot)];

/** A step laid exactly on a footstep. */
export function laidOn(step: DraftStep, at: Footstep): DraftStep {
  return { ...step, x: at.x, y: at.y, z: at.z, yaw: at.yaw };
}
