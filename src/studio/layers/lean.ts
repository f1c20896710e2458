/**
 * Who gains speed leans ahead, who slows down leans back: the ground's push must pass through the body's mass, so a body that is
 * pushed along by `a` stands at atan(a / g) [Winter, Biomechanics and Motor Control]. Runners' trunks do more than that: three
 * who went from 2.9 to 3.9 m/s within a second leaned 23 degrees, and 11 at the speed then reached.
 */

import { CLIP_RATE } from "../../core/capture/clip.ts";
import { GRAVITY } from "../../core/math/gravity.ts";
import { gaussian } from "../../core/math/interpolate.ts";
import type { BodyAngles } from "./body.ts";
import type { FootTrack } from "./feet.ts";

/** Share of atan(a / g) that the trunk takes, walking and running. */
const WALKING = 1;
const RUNNING = 2.3;
/** Of that, the pelvis. */
const PELVIS = 0.5;
/** Seconds: the mean of the feet moves in jerks, the body over them does not. */
const SMOOTH = 0.33;

/**
 * Adds the lean to pelvis and chest, and notes it in `b.lean`. Mutates the angles.
 *
 * @param facing the body's yaw, radians, a frame each. @param runs whether the actor runs.
 */
export function addLean(
  b: BodyAngles,
  feet: readonly [FootTrack, FootTrack],
  facing: Float64Array,
  runs: boolean,
): void {
  const place = [0, 2].map((k) => {
    const track = facing.map((_, f) => (feet[0].ankle[3 * f + k] + feet[1].ankle[3 * f + k]) / 2);
    gaussian(track, 1, SMOOTH * CLIP_RATE);
    return track;
  });
  for (let f = 1; f < facing.length - 1; f++) {
    const [x, z] = place.map((p) => (p[f + 1] - 2 * p[f] + p[f - 1]) * CLIP_RATE ** 2);
    const ahead = x * Math.sin(facing[f]) + z * Math.cos(facing[f]);
    b.lean[f] = (runs ? RUNNING : WALKING) * Math.atan(ahead / GRAVITY);
    b.pelvisPitch[f] += PELVIS * b.lean[f];
    b.chestPitch[f] += b.lean[f];
  }
}
