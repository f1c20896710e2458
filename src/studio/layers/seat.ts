/** Sitting: frames whose hips are held over the seat, and soft joins to the frames that are not. */
import { gaussian } from "../../core/math/interpolate.ts";
import { quatFromYawPitchRoll, quatRotate } from "../../core/math/quaternion.ts";
import { J } from "../../core/skeleton/joints.ts";
import type { Skeleton } from "../../core/skeleton/skeleton.ts";
import type { Score } from "../score.ts";
import type { BodyAngles } from "./body.ts";
import { SEAT_UNDER_HIPS, type TaskLayer } from "./tasks.ts";

/** Seated frames: the hips over the seat, tipping about the point that the seat carries. */
export function pinSeats(
  score: Score,
  body: BodyAngles,
  tasks: TaskLayer,
  skeleton: Skeleton,
  frames: number,
): void {
  const over = SEAT_UNDER_HIPS * (skeleton.height / 1.75);
  const drop = -skeleton.offsets[3 * J.leftUpperLeg + 1];
  const up = new Float64Array(4);
  const v = new Float64Array(3);
  for (const event of score.events) {
    if (event.type !== "sit") continue;
    const { task } = event;
    for (let f = 0; f < frames; f++) {
      if (
        !tasks.pins.pinned[f] ||
        Math.abs(tasks.pins.place[2 * f] - task.position[0]) +
          Math.abs(tasks.pins.place[2 * f + 1] - task.position[2]) >
          1e-9
      )
        continue;
      quatFromYawPitchRoll(up, 0, body.pelvisYaw[f], body.pelvisPitch[f], body.pelvisRoll[f]);
      quatRotate(v, 0, up, 0, 0, 1, 0);
      tasks.pins.place[2 * f] = task.position[0] + v[0] * (over + drop);
      tasks.pins.place[2 * f + 1] = task.position[2] + v[2] * (over + drop);
      body.hipHeight[f] = task.position[1] + v[1] * over;
    }
  }
  gaussianWhere(body.hipHeight, tasks.pins.pinned);
}

/** Softens a track for some frames around where pinning begins and ends. */
function gaussianWhere(track: Float64Array, pinned: Uint8Array): void {
  const n = pinned.length;
  const copy = Float64Array.from(track);
  gaussian(copy, track.length / n, 3);
  const stride = track.length / n;
  for (let f = 0; f < n; f++) {
    let near = 99;
    for (let k = -10; k <= 10; k++) {
      const a = f + k;
      if (a > 0 && a < n && pinned[a] !== pinned[a - 1]) near = Math.min(near, Math.abs(k));
    }
    if (near > 10) continue;
    const w = near <= 5 ? 1 : (10 - near) / 5;
    for (let c = 0; c < stride; c++)
      track[stride * f + c] += w * (copy[stride * f + c] - track[stride * f + c]);
  }
}

/** Softens a way of the body, x, z a frame, where pinning begins and ends. */
export function smoothJoins(way: Float64Array, pinned: Uint8Array): void {
  gaussianWhere(way, pinned);
}
