/**
 * Exit, locomotion and enter [TaskLoco §4.1, motion templates].
 *
 * Locomotion is the run of walking steps whose foot points, within a threshold, the way the body does. An exit keeps its
 * first walking step and an entry its last ones, as in [TaskLoco Table 1]. Without locomotion, more than four steps
 * are split evenly, fewer all enter.
 */
import { wrapAngle } from "../math/angle.ts";
import { midPose } from "../math/frame2.ts";
import type { Foot, Footstep, Step } from "./types.ts";

export const PHASE_DEFAULTS = {
  /** Yaw of the swing foot against the body's forward axis, radians. */
  yaw: 0.3,
  /** Walking steps that stay with the exit and with the entry. */
  exitWalks: 1,
  enterWalks: 2,
  /** Longest transition without locomotion that all enters [TaskLoco §4.1]. */
  allEnter: 4,
};

/** Fills in the phase of steps[first..last), one transition. */
export function assignPhases(
  steps: Step[],
  first: number,
  last: number,
  initialStance: readonly [Footstep, Footstep],
): void {
  const d = PHASE_DEFAULTS;
  const feet: Record<Foot, Footstep> = { left: initialStance[0], right: initialStance[1] };
  for (let i = 0; i < first; i++) feet[steps[i].foot] = steps[i].to;
  const straight: boolean[] = [];
  for (let i = first; i < last; i++) {
    const s = steps[i];
    feet[s.foot] = s.to;
    straight.push(
      s.category === "Walk" && Math.abs(wrapAngle(s.to.yaw - midPose(feet.left, feet.right).yaw)) < d.yaw,
    );
  }
  // The longest run of straight walking.
  let from = 0;
  let to = 0;
  for (let i = 0; i < straight.length; i++) {
    if (!straight[i]) continue;
    let e = i;
    while (e < straight.length && straight[e]) e++;
    if (e - i > to - from) {
      from = i;
      to = e;
    }
    i = e;
  }
  // A walk that begins or ends the transition has nothing to leave to exit or entry on that side beyond its share.
  const begin = from + d.exitWalks;
  const end = to - d.enterWalks;
  const count = last - first;
  for (let i = 0; i < count; i++) {
    const s = steps[first + i];
    if (end > begin) s.phase = i < begin ? "exit" : i < end ? "locomotion" : "enter";
    else if (count > d.allEnter) s.phase = i < Math.floor(count / 2) ? "exit" : "enter";
    else s.phase = "enter";
  }
}
