/** Where feet stand beside each other. */
import { wrapAngle } from "../math/angle.ts";
import type { GroundPose } from "../math/frame2.ts";
import type { Skeleton } from "../skeleton/skeleton.ts";
import type { Feet } from "./draft.ts";

/** The stance that a plan begins with: feet beside each other, toes a little out. */
export function standingFeet(at: GroundPose, skeleton: Skeleton): Feet {
  const half = 0.095 * (skeleton.legLength / 0.93);
  const out = 0.12;
  const c = Math.cos(at.yaw);
  const s = Math.sin(at.yaw);
  return {
    left: { foot: "left", x: at.x + c * half, y: 0, z: at.z - s * half, yaw: wrapAngle(at.yaw + out) },
    right: { foot: "right", x: at.x - c * half, y: 0, z: at.z + s * half, yaw: wrapAngle(at.yaw - out) },
  };
}
