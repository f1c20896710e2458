/** Runs of one value in a contact bit. */
import type { ContactTrack } from "../steps/types.ts";
import { LEG_ROW, type MotionTrack, POINT } from "./motion-track.ts";

/** Runs of `value` shorter than `shortest` that touch neither end take the other value. */
export function dropShort(track: Uint8Array, value: 0 | 1, shortest: number): void {
  let from = 0;
  for (let f = 1; f <= track.length; f++) {
    if (f < track.length && track[f] === track[from]) continue;
    if (track[from] === value && f - from < shortest && from > 0 && f < track.length)
      track.fill(1 - value, from, f);
    from = f;
  }
}

/** Faster than this over the ground nothing rests, metres a second at a leg of 0.93 m; and frames taken off an end at most. */
const MOVING = 0.9;
const MOST_OFF = 4;
const HEEL = [POINT.heel] as const;
const TOE = [POINT.toe, POINT.ball, POINT.tip] as const;

/** Takes frames off a plant's ends in which none of its points rests: the foot is still arriving, or leaving already. */
export function dropMoving(labels: ContactTrack, track: MotionTrack): void {
  const n = labels.length;
  const limit = (MOVING * track.leg) / 0.93;
  const moves = (f: number, bit: number): boolean => {
    const side = bit >> 1;
    return (bit % 2 === 0 ? HEEL : TOE).every((point) => {
      const a = (2 * f + side) * LEG_ROW + point;
      const b = a + 2 * LEG_ROW;
      const p = track.points;
      return 60 * Math.hypot(p[b] - p[a], p[b + 2] - p[a + 2]) > limit;
    });
  };
  for (let bit = 0; bit < 4; bit++) {
    const on = (f: number): boolean => ((labels[f] >> bit) & 1) === 1;
    for (let f = 0; f < n; f++) {
      if (!on(f)) continue;
      let from = f;
      let to = f;
      while (to < n && on(to)) to++;
      f = to;
      const least = from + 4;
      if (from > 0)
        for (let k = 0; k < MOST_OFF && to > least && moves(from, bit); k++) labels[from++] &= ~(1 << bit);
      if (to < n)
        for (let k = 0; k < MOST_OFF && to > from + 4 && moves(to - 2, bit); k++) labels[--to] &= ~(1 << bit);
    }
  }
}
