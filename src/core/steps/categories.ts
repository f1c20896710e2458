/** The seven step categories, told apart by geometry [TaskLoco §4.1, Figure 5]. */

import type { SidecarTask } from "../capture/sidecar.ts";
import { wrapAngle } from "../math/angle.ts";
import { midPose, toLocal } from "../math/frame2.ts";
import type { Foot, Footstep, Step } from "./types.ts";

/** Limits at a leg of 0.93 m: metres, radians, seconds. */
export const CATEGORY_DEFAULTS = {
  /** A foot that turns this much while it steps turns and steps. */
  turn: 0.3,
  /** Sideways steps lead by this much over forward. */
  side: 1.15,
  /** A small step is at most this long, near enough to a task. */
  small: 0.36,
  near: 0.95,
  /** ... and within this time before its contact. */
  before: 2.2,
};

/**
 * Fills in each step's category. Pivots have theirs from the segmentation.
 *
 * @param rate frames a second of the steps' frames; @param legLength metres.
 */
export function categorise(
  steps: Step[],
  initialStance: readonly [Footstep, Footstep],
  tasks: readonly SidecarTask[],
  rate: number,
  legLength: number,
): void {
  const d = CATEGORY_DEFAULTS;
  const scale = legLength / 0.93;
  const feet: Record<Foot, Footstep> = { left: initialStance[0], right: initialStance[1] };
  for (const s of steps) {
    const before = midPose(feet.left, feet.right);
    feet[s.foot] = s.to;
    if (s.category === "HeelPivot" || s.category === "ToePivot") continue;
    const after = midPose(feet.left, feet.right);
    const own = toLocal(
      { x: s.from.x, z: s.from.z, yaw: before.yaw + wrapAngle(after.yaw - before.yaw) / 2 },
      s.to,
    );
    const turn = Math.abs(wrapAngle(s.to.yaw - s.from.yaw));
    const forward = own.z;
    const across = Math.abs(own.x);
    const length = Math.hypot(own.x, own.z);
    if (turn >= d.turn) {
      s.category = "TurnAndStep";
      continue;
    }
    if (across > d.side * Math.abs(forward) && across > 0.05 * scale) {
      s.category = "SideStep";
      continue;
    }
    const atTask = tasks.some((t) => {
      const time = s.start / rate;
      const reach = Math.hypot(after.x - t.position[0], after.z - t.position[2]);
      return t.category !== "turn" && time > t.contact - d.before && time < t.end && reach < d.near * scale;
    });
    if (forward < 0) s.category = "BackwardStepDuringTask";
    else if (atTask && length < d.small * scale) s.category = "ForwardStepDuringTask";
    else s.category = "Walk";
  }
}
