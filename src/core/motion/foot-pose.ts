/** A foot in the world: ankle place, rotation, toe bend; from a footstep and a pitch, or from a capture's swing. */
import { wrapAngle } from "../math/angle.ts";
import type { GroundPose } from "../math/frame2.ts";
import { quatFromYawPitchRoll } from "../math/quaternion.ts";
import type { FootShape } from "../skeleton/skeleton.ts";
import { plantedAnkle } from "./sole.ts";

/** x, y, z, then rotation xyzw, then toe bend (toes up positive), in one row. */
export const FOOT_STRIDE = 8;

const place = new Float64Array(3);

/** A planted foot at `pitch` (toe up positive) on a footstep of ground height `height`. */
export function plantedFoot(
  out: Float64Array,
  o: number,
  shape: FootShape,
  step: GroundPose,
  height: number,
  pitch: number,
): void {
  plantedAnkle(place, shape, pitch);
  out[o] = step.x + Math.sin(step.yaw) * place[0];
  out[o + 1] = height + place[1];
  out[o + 2] = step.z + Math.cos(step.yaw) * place[0];
  // Rotation about +X by a positive angle lowers +Z.
  quatFromYawPitchRoll(out, o + 3, step.yaw, -pitch, 0);
  out[o + 7] = place[2];
}

/** Pitch of a world rotation's +Z axis over the ground, toe up positive. */
export function pitchOf(q: Float64Array, qi: number): number {
  const fy = 2 * (q[qi + 1] * q[qi + 2] - q[qi + 3] * q[qi]);
  return Math.asin(Math.max(-1, Math.min(1, fy)));
}

/** Bend of a local toes rotation, toes up positive. */
export function toeBendOf(q: Float64Array, qi: number): number {
  return -wrapAngle(2 * Math.atan2(q[qi], q[qi + 3]));
}
