/**
 * What real captures have and rendered ones have not: marker noise, a slow drift of the whole figure, a floor that is
 * not at 0. For testing detection and clean-up honestly; the contacts stay those of the performance.
 */
import type { Clip } from "../core/capture/clip.ts";
import { gaussian } from "../core/math/interpolate.ts";
import { quatFromRotationVector, quatMultiply, quatNormalize } from "../core/math/quaternion.ts";
import { createRandom } from "../core/math/random.ts";
import { JOINT_COUNT } from "../core/skeleton/joints.ts";

export interface Realism {
  /** Standard deviation of the joints' noise, radians, and of the hips' place, metres. */
  jointNoise: number;
  rootNoise: number;
  /** Largest slow drift across the ground and up and down, metres. */
  drift: number;
  rise: number;
  /** Height of the floor, metres. */
  floor: number;
}

/** As measured on optical captures after clean-up: noise of a fifth of a degree and a millimetre, centimetres of drift. */
export const REALISM: Realism = {
  jointNoise: 0.2 * (Math.PI / 180),
  rootNoise: 0.001,
  drift: 0.03,
  rise: 0.008,
  floor: 0.02,
};

/** Seconds over which the drift changes its mind, and frames of smoothing of the noise. */
const DRIFT_TIME = 2.5;
const NOISE_SMOOTH = 1.2;

/**
 * A worn copy of a clip; the same seed wears it the same.
 *
 * @param clip untouched. @param seed any integer.
 */
export function wearClip(clip: Clip, seed: number, options: Realism = REALISM): Clip {
  const random = createRandom(seed);
  const { frames } = clip;
  const track = (sigma: number, size: number, byPeak: boolean): Float64Array => {
    const x = Float64Array.from({ length: frames }, () => random.normal());
    gaussian(x, 1, sigma);
    let scale = 0;
    if (byPeak) for (const v of x) scale = Math.max(scale, Math.abs(v));
    else scale = Math.sqrt(x.reduce((a, v) => a + v * v, 0) / frames);
    for (let f = 0; f < frames; f++) x[f] *= size / (scale || 1);
    return x;
  };
  const root = Float64Array.from(clip.root);
  const slow = DRIFT_TIME * clip.rate * 0.5;
  [options.drift, options.rise, options.drift].forEach((size, k) => {
    const drift = track(slow, size, true);
    const noise = track(NOISE_SMOOTH, options.rootNoise, false);
    for (let f = 0; f < frames; f++) root[3 * f + k] += drift[f] + noise[f] + (k === 1 ? options.floor : 0);
  });
  const rotations = Float64Array.from(clip.rotations);
  const q = new Float64Array(4);
  for (let j = 0; j < JOINT_COUNT; j++) {
    const noise = [0, 1, 2].map(() => track(NOISE_SMOOTH, options.jointNoise / Math.sqrt(3), false));
    for (let f = 0; f < frames; f++) {
      const o = 4 * (JOINT_COUNT * f + j);
      quatFromRotationVector(q, 0, noise[0][f], noise[1][f], noise[2][f]);
      quatMultiply(rotations, o, rotations, o, q, 0);
      quatNormalize(rotations, o);
    }
  }
  return { ...clip, root, rotations };
}
