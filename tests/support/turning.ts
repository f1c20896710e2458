/** Captures of people who turn, as turn tasks. */
import type { Clip } from "../../src/core/capture/clip.ts";
import type { SidecarTask } from "../../src/core/capture/sidecar.ts";
import { wrapAngle } from "../../src/core/math/angle.ts";
import { quatYaw } from "../../src/core/math/quaternion.ts";
import { JOINT_COUNT } from "../../src/core/skeleton/joints.ts";

/** A capture's turn: it ends where nine tenths of the turning are done. */
export function turnTask(clip: Clip): SidecarTask {
  const yaw = new Float64Array(clip.frames);
  for (let f = 0; f < clip.frames; f++) {
    const y = quatYaw(clip.rotations, 4 * JOINT_COUNT * f);
    yaw[f] = f === 0 ? y : yaw[f - 1] + wrapAngle(y - yaw[f - 1]);
  }
  const end = clip.frames - 1;
  const total = yaw[end] - yaw[0];
  let contact = end;
  while (contact > 0 && Math.abs(yaw[contact] - yaw[0]) > 0.9 * Math.abs(total)) contact--;
  const at = Math.min(end, contact + 1);
  return {
    category: "turn",
    effort: 1,
    position: [clip.root[3 * at], 0, clip.root[3 * at + 2]],
    yaw: wrapAngle(yaw[end]),
    start: at / 60,
    contact: at / 60,
    end: Math.min(end, at + 2) / 60,
    hand: "both",
  };
}
