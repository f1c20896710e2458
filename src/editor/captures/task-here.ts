/** A task marked on a capture: its place is the hand's, the hips' or the ground's at the cursor. */
import type { SidecarTask } from "../../core/capture/sidecar.ts";
import { quatRotate, quatYaw } from "../../core/math/quaternion.ts";
import type { TaskCategory } from "../../core/scene/task-types.ts";
import { forwardKinematics } from "../../core/skeleton/forward-kinematics.ts";
import { J, JOINT_COUNT } from "../../core/skeleton/joints.ts";
import { createSkeleton } from "../../core/skeleton/skeleton.ts";
import type { Capture } from "./capture.ts";

/** Middle of the seat under the hip joints, at 1.75 m. */
const SEAT_DROP = 0.09;
/** Seconds that a task takes before and after its contact until somebody says otherwise. */
const BEFORE = 0.3;
const AFTER: Record<TaskCategory, number> = {
  write: 1.2,
  lift: 0.4,
  place: 0.4,
  sit: 1.5,
  stand: 0.2,
  turn: 0.1,
};

/** A task of high effort at the frame of the cursor. */
export function taskHere(c: Pick<Capture, "clip" | "edits">, category: TaskCategory): SidecarTask {
  const { clip } = c;
  const f = c.edits.cursor;
  const skeleton = createSkeleton(clip.height);
  const p = new Float64Array(3 * JOINT_COUNT);
  const w = new Float64Array(4 * JOINT_COUNT);
  forwardKinematics(
    p,
    w,
    skeleton,
    Float64Array.from(clip.root.subarray(3 * f, 3 * f + 3)),
    0,
    Float64Array.from(clip.rotations.subarray(4 * JOINT_COUNT * f, 4 * JOINT_COUNT * (f + 1))),
    0,
  );
  const palm = (joint: number, sign: number): [number, number, number] => {
    const v = new Float64Array(3);
    quatRotate(v, 0, w, 4 * joint, sign * skeleton.palm, 0, 0);
    return [p[3 * joint] + v[0], p[3 * joint + 1] + v[1], p[3 * joint + 2] + v[2]];
  };
  const left = palm(J.leftHand, 1);
  const right = palm(J.rightHand, -1);
  const hips: [number, number, number] = [p[0], p[1], p[2]];
  const place: Record<TaskCategory, [number, number, number]> = {
    // The hand that reaches higher writes.
    write: left[1] > right[1] ? left : right,
    lift: [(left[0] + right[0]) / 2, (left[1] + right[1]) / 2, (left[2] + right[2]) / 2],
    place: [(left[0] + right[0]) / 2, (left[1] + right[1]) / 2, (left[2] + right[2]) / 2],
    sit: [hips[0], hips[1] - SEAT_DROP * (clip.height / 1.75), hips[2]],
    stand: [hips[0], 0, hips[2]],
    turn: [hips[0], 0, hips[2]],
  };
  const t = f / clip.rate;
  const end = (clip.frames - 1) / clip.rate;
  return {
    category,
    effort: 1,
    position: place[category],
    yaw: quatYaw(w, 0),
    start: Math.max(0, t - BEFORE),
    contact: t,
    end: Math.min(end, t + AFTER[category]),
    hand: category === "write" ? (left[1] > right[1] ? "left" : "right") : "both",
  };
}
