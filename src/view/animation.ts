/** A clip as three.js animation tracks on bones named as our joints. */
import { AnimationClip, QuaternionKeyframeTrack, VectorKeyframeTrack } from "three";
import type { Clip } from "../core/capture/clip.ts";
import { JOINT_COUNT, JOINT_NAMES } from "../core/skeleton/joints.ts";

/** Rotations of every bone and the hips' place, at the clip's rate; tracks are named "hips.position", "head.quaternion". */
export function animationOf(clip: Clip): AnimationClip {
  const times = Float32Array.from({ length: clip.frames }, (_, f) => f / clip.rate);
  const tracks = JOINT_NAMES.map((name, j) => {
    const values = new Float32Array(4 * clip.frames);
    for (let f = 0; f < clip.frames; f++) {
      const o = (f * JOINT_COUNT + j) * 4;
      for (let k = 0; k < 4; k++) values[4 * f + k] = clip.rotations[o + k];
      // Neighbouring keys on the same half of the sphere: viewers interpolate them as they are.
      if (f > 0) {
        let dot = 0;
        for (let k = 0; k < 4; k++) dot += values[4 * f + k] * values[4 * f - 4 + k];
        if (dot < 0) for (let k = 0; k < 4; k++) values[4 * f + k] *= -1;
      }
    }
    return new QuaternionKeyframeTrack(`${name}.quaternion`, times, values);
  });
  const place = new VectorKeyframeTrack(`${JOINT_NAMES[0]}.position`, times, Float32Array.from(clip.root));
  return new AnimationClip(clip.name, (clip.frames - 1) / clip.rate, [place, ...tracks]);
}
