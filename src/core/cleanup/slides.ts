/** How far planted feet slide: for every plant of a pad, the way of the point of it that moves least. */
import type { BvhFile } from "../capture/bvh-parse.ts";
import type { Clip } from "../capture/clip.ts";
import { jointsOf } from "../capture/import.ts";
import type { JointName } from "../skeleton/joints.ts";
import type { ContactTrack } from "../steps/types.ts";
import { feetOf } from "./feet.ts";
import { stillest } from "./roll.ts";

/** Directions in which the excursion of a way is measured. */
const DIRECTIONS = 18;

/** The 95th percentile of slides; 0 of none. */
export function slideP95(slides: readonly number[]): number {
  const sorted = [...slides].sort((a, b) => a - b);
  return sorted.length === 0 ? 0 : sorted[Math.min(sorted.length - 1, Math.floor(0.95 * sorted.length))];
}

/** Slides of all plants of a file that last two frames or more, millimetres. */
export function plantSlides(
  file: BvhFile,
  clip: Clip,
  contacts: ContactTrack,
  joints: Map<JointName, number> = jointsOf(file),
): number[] {
  const { pads, bits } = feetOf(file, clip, contacts, joints);
  const out: number[] = [];
  const step = new Float64Array(2);
  pads.forEach((pad, side) => {
    for (const bit of [1, 2]) {
      for (let f = 0; f < pad.frames; f++) {
        if (!(bits[side][f] & bit)) continue;
        const low = new Float64Array(DIRECTIONS);
        const high = new Float64Array(DIRECTIONS);
        let x = 0;
        let z = 0;
        let steps = 0;
        for (; f + 1 < pad.frames && bits[side][f + 1] & bit; f++) {
          stillest(step, pad.points, f, bit);
          x += step[0];
          z += step[1];
          steps++;
          for (let k = 0; k < DIRECTIONS; k++) {
            const a = (Math.PI * k) / DIRECTIONS;
            const along = x * Math.cos(a) + z * Math.sin(a);
            low[k] = Math.min(low[k], along);
            high[k] = Math.max(high[k], along);
          }
        }
        if (steps > 0) out.push(1000 * Math.max(...high.map((h, k) => h - low[k])));
      }
    }
  });
  return out;
}
