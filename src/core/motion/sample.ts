/** Reading a clip at a frame and a fraction, without allocation. */
import type { Clip } from "../capture/clip.ts";
import { quatSlerp } from "../math/quaternion.ts";
import { JOINT_COUNT } from "../skeleton/joints.ts";

const STRIDE = JOINT_COUNT * 4;

/**
 * The pose at `frame` (fractions interpolate; clamped to the clip).
 *
 * @param root 3 numbers, written; @param rotations JOINT_COUNT x 4, written.
 */
export function sampleClip(root: Float64Array, rotations: Float64Array, clip: Clip, frame: number): void {
  const f = Math.max(0, Math.min(clip.frames - 1, frame));
  const i = Math.min(clip.frames - 1, Math.floor(f));
  const u = f - i;
  const a = i * STRIDE;
  if (u < 1e-6 || i + 1 >= clip.frames) {
    for (let k = 0; k < 3; k++) root[k] = clip.root[3 * i + k];
    for (let k = 0; k < STRIDE; k++) rotations[k] = clip.rotations[a + k];
    return;
  }
  for (let k = 0; k < 3; k++) root[k] = clip.root[3 * i + k] * (1 - u) + clip.root[3 * i + 3 + k] * u;
  for (let j = 0; j < JOINT_COUNT; j++)
    quatSlerp(rotations, 4 * j, clip.rotations, a + 4 * j, clip.rotations, a + STRIDE + 4 * j, u);
}
