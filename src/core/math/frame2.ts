/** Frames on the ground: an origin and a yaw. Lateral is +X of the frame, forward +Z (see docs/glossary.md). */
import { wrapAngle } from "./angle.ts";

export interface GroundPose {
  x: number;
  z: number;
  yaw: number;
}

/** `p` seen from `frame`: x is lateral, z forward, yaw relative (wrapped). */
export function toLocal(frame: GroundPose, p: GroundPose): GroundPose {
  const c = Math.cos(frame.yaw);
  const s = Math.sin(frame.yaw);
  const dx = p.x - frame.x;
  const dz = p.z - frame.z;
  return { x: c * dx - s * dz, z: s * dx + c * dz, yaw: wrapAngle(p.yaw - frame.yaw) };
}

/** A pose given in `frame`, in the world. */
export function toWorld(frame: GroundPose, p: GroundPose): GroundPose {
  const c = Math.cos(frame.yaw);
  const s = Math.sin(frame.yaw);
  return {
    x: frame.x + c * p.x + s * p.z,
    z: frame.z - s * p.x + c * p.z,
    yaw: wrapAngle(frame.yaw + p.yaw),
  };
}

/** Midpoint and mean yaw of two poses: the frame between the feet. */
export function midPose(a: GroundPose, b: GroundPose): GroundPose {
  return { x: (a.x + b.x) / 2, z: (a.z + b.z) / 2, yaw: wrapAngle(a.yaw + wrapAngle(b.yaw - a.yaw) / 2) };
}

/** Distance on the ground. */
export function groundDistance(a: { x: number; z: number }, b: { x: number; z: number }): number {
  return Math.hypot(b.x - a.x, b.z - a.z);
}

/** Yaw of the direction from a to b. */
export function bearing(a: { x: number; z: number }, b: { x: number; z: number }): number {
  return Math.atan2(b.x - a.x, b.z - a.z);
}
