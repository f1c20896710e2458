/** A file's motion on our skeleton, frame by frame at our rate. */
import { JOINT_COUNT } from "../skeleton/joints.ts";
import type { Skeleton } from "../skeleton/skeleton.ts";
import type { BvhFile } from "./bvh-parse.ts";
import type { WorldMotion } from "./bvh-world.ts";
import { CLIP_RATE, type Clip } from "./clip.ts";
import type { FeetCalibration } from "./import-measure.ts";
import { createPoser } from "./import-pose.ts";
import type { Joints } from "./names.ts";

/** Our clip, frame by frame. */
export function rebuild(
  file: BvhFile,
  world: WorldMotion,
  joints: Joints,
  skeleton: Skeleton,
  feet: FeetCalibration,
): Clip {
  const seconds = (file.frames - 1) * file.frameTime;
  const frames = Math.max(1, Math.round(seconds * CLIP_RATE) + 1);
  const clip: Clip = {
    name: file.name,
    skeleton,
    rate: CLIP_RATE,
    frames,
    root: new Float64Array(3 * frames),
    rotations: new Float64Array(4 * JOINT_COUNT * frames),
  };
  const at = new Float64Array(3 * world.joints);
  const pose = new Float64Array(4 * JOINT_COUNT);
  const ours = createPoser(joints, skeleton, feet);
  for (let f = 0; f < frames; f++) {
    const x = Math.min(world.frames - 1, (f / CLIP_RATE) * world.rate);
    interpolate(at, world, x);
    ours(at, pose, clip.root, 3 * f);
    clip.rotations.set(pose, 4 * JOINT_COUNT * f);
  }
  for (let i = 4 * JOINT_COUNT; i < clip.rotations.length; i += 4) {
    const b = i - 4 * JOINT_COUNT;
    const r = clip.rotations;
    if (r[i] * r[b] + r[i + 1] * r[b + 1] + r[i + 2] * r[b + 2] + r[i + 3] * r[b + 3] < 0)
      for (let k = 0; k < 4; k++) r[i + k] = -r[i + k];
  }
  return clip;
}

/** Joint places at a fractional frame: Catmull-Rom between the file's frames. */
function interpolate(out: Float64Array, world: WorldMotion, x: number): void {
  const n = world.frames;
  const i = Math.min(n - 1, Math.floor(x));
  const t = x - i;
  const row = 3 * world.joints;
  const a = Math.max(0, i - 1) * row;
  const b = i * row;
  const c = Math.min(n - 1, i + 1) * row;
  const d = Math.min(n - 1, i + 2) * row;
  const p = world.positions;
  for (let k = 0; k < row; k++) {
    out[k] =
      t < 1e-9
        ? p[b + k]
        : p[b + k] +
          0.5 *
            t *
            (p[c + k] -
              p[a + k] +
              t *
                (2 * p[a + k] -
                  5 * p[b + k] +
                  4 * p[c + k] -
                  p[d + k] +
                  t * (3 * (p[b + k] - p[c + k]) + p[d + k] - p[a + k])));
  }
}
