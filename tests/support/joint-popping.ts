/** Whether the joint between two passes of a loop pops more than the sample that it was cut from. */
import type { Clip } from "../../src/core/capture/clip.ts";
import { quatMultiply, quatToRotationVector } from "../../src/core/math/quaternion.ts";
import { JOINT_COUNT } from "../../src/core/skeleton/joints.ts";
import { buildFamily } from "../../src/core/styles/family.ts";
import type { LoopSequence } from "../../src/core/styles/loop.ts";
import { createPath } from "../../src/core/styles/path.ts";
import { synthesisePath } from "../../src/core/styles/synthesise-path.ts";

const Q = 4 * JOINT_COUNT;
/** Frames at 60 Hz between three poses: 30 Hz, as accelerations of captures are told. */
const STEP = 2;
const inverse = new Float64Array(4);
const turn = new Float64Array(4);
const vector = new Float64Array(6);

function acceleration(clip: Clip, joint: number, frame: number): number {
  for (const [o, at] of [
    [0, frame - STEP],
    [3, frame],
  ]) {
    const a = Q * at + 4 * joint;
    const b = a + Q * STEP;
    const r = clip.rotations;
    inverse.set([-r[a], -r[a + 1], -r[a + 2], r[a + 3]]);
    quatMultiply(turn, 0, r, b, inverse, 0);
    quatToRotationVector(vector, o, turn, 0);
  }
  const d = Math.hypot(vector[3] - vector[0], vector[4] - vector[1], vector[5] - vector[2]);
  return d * (clip.rate / STEP) ** 2;
}

/**
 * Largest angular acceleration of any joint about the places where a loop begins anew, played straight ahead with its feet
 * planted, over the largest of the sample.
 */
export function jointPopping(sample: Clip, loop: LoopSequence): number {
  const family = buildFamily(loop, sample.skeleton, 0);
  const path = createPath(
    [
      [0, 0],
      [0, 3.2 * loop.speed * loop.frames],
    ],
    true,
  );
  const { clip, timeline } = synthesisePath(path, [family], [{ at: 0, style: 0 }], sample.skeleton, {
    stand: false,
    stride: false,
    lean: false,
    balance: false,
  });
  let own = 0;
  let seam = 0;
  for (let j = 0; j < JOINT_COUNT; j++) {
    for (let f = STEP; f < sample.frames - STEP; f++) own = Math.max(own, acceleration(sample, j, f));
    for (const { frame } of timeline.loopStarts.slice(1))
      for (let f = Math.max(STEP, frame - 8); f <= frame + Math.max(8, loop.blended); f++)
        if (f < clip.frames - STEP) seam = Math.max(seam, acceleration(clip, j, f));
  }
  return seam / own;
}
