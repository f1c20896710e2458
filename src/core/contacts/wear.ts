/** A clean motion made like a captured one, for training: markers tremble, resting feet creep. */
import { gaussian } from "../math/interpolate.ts";
import { createRandom } from "../math/random.ts";
import { LEG_ROW, type MotionTrack } from "./motion-track.ts";

export interface Wear {
  /** Spread of a point's slow and quick tremble, metres. */
  slow: number;
  quick: number;
  seed: number;
}

/** A copy with seeded noise on every point of both legs: smooth over a third of a second, and over three frames. */
export function wearTrack(track: MotionTrack, wear: Wear): MotionTrack {
  const r = createRandom(wear.seed);
  const points = track.points.slice();
  const stride = 2 * LEG_ROW;
  for (const [spread, softness] of [
    [wear.slow, 9],
    [wear.quick, 1.5],
  ]) {
    const noise = new Float64Array(points.length);
    for (let i = 0; i < noise.length; i++) noise[i] = r.normal();
    gaussian(noise, stride, softness);
    // Smoothing divides the spread by the root of the window's width.
    const scale = spread * Math.sqrt(2 * softness * Math.sqrt(Math.PI));
    for (let i = 0; i < noise.length; i++) points[i] += scale * noise[i];
  }
  return { ...track, points };
}
