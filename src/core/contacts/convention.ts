/**
 * What a label of a capture means, and what a step needs.
 *
 * People, and rules that follow them, call a frame planted when the point rests before or after it: labels of 30 frames a
 * second begin a frame before the point has come to rest. Exact contacts, and steps that are made of them, begin when it has.
 * The differences below are what exact studio contacts and labels of real captures differ by in the middle, at 60 Hz.
 */
import type { ContactTrack } from "../steps/types.ts";

/** Frames at 60 Hz that a label begins before, and ends after, the rest itself; heels and toes alike. */
const LEAD = 2;
const LAG = 1;

/** Exact contacts as a person would label them. */
export const asLabelled = (exact: ContactTrack): ContactTrack => shifted(exact, LEAD, LAG);

/** Labels as when the points rest: plants of fewer than four frames stay as they are. */
export const asRested = (labels: ContactTrack): ContactTrack => shifted(labels, -LEAD, -LAG);

/** Every plant's ends moved outwards; a plant that the motion's ends cut is not moved there. */
function shifted(track: ContactTrack, lead: number, lag: number): ContactTrack {
  const n = track.length;
  const out = new Uint8Array(n);
  for (let b = 0; b < 4; b++) {
    const on = (f: number): boolean => ((track[f] >> b) & 1) === 1;
    for (let f = 0; f < n; ) {
      if (!on(f)) {
        f++;
        continue;
      }
      let end = f + 1;
      while (end < n && on(end)) end++;
      let from = f === 0 ? 0 : Math.max(0, f - lead);
      let to = end === n ? n : Math.min(n, end + lag);
      if (to - from < 1 || (lead < 0 && end - f < 4)) [from, to] = [f, end];
      for (let g = from; g < to; g++) out[g] |= 1 << b;
      f = end;
    }
  }
  return out;
}
