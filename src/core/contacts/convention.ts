/**
 * What a label of a capture means, and what a step needs.
 *
 * People, and rules that follow them, call a frame planted when the point rests before or after it: labels begin before the point
 * has come to rest and go on after it has left. Exact contacts, and steps that are made of them, begin when it has. By how much
 * is a habit of those who label: it is learned from labels, beside what an oracle of exact contacts says of the same motions.
 */
import type { ContactTrack } from "../steps/types.ts";

/** Frames at 60 Hz that labels begin before, and end after, the rest itself. */
export interface Habit {
  heelLead: number;
  heelLag: number;
  toeLead: number;
  toeLag: number;
}

/** The habit that `learnHabit` finds in the hand-checked captures (benchmark of contacts); what ships is made with it. */
export const HABIT: Habit = { heelLead: 2, heelLag: 2, toeLead: 2, toeLag: 1 };

/** Exact contacts as a person would label them. */
export const asLabelled = (exact: ContactTrack, habit: Habit = HABIT): ContactTrack =>
  shifted(exact, habit, 1);

/** Labels as when the points rest: plants of fewer than four frames stay as they are. */
export const asRested = (labels: ContactTrack, habit: Habit = HABIT): ContactTrack =>
  shifted(labels, habit, -1);

/**
 * The habit of labels: the middle of what plants in both differ by at their begins and ends.
 *
 * @param pairs exact contacts and labels of the same motions, a byte a frame at 60 Hz.
 * @returns whole frames, never negative; 0 where nothing can be compared.
 */
export function learnHabit(pairs: readonly { exact: ContactTrack; labels: ContactTrack }[]): Habit {
  const leads: [number[], number[]] = [[], []];
  const lags: [number[], number[]] = [[], []];
  for (const { exact, labels } of pairs) {
    for (let b = 0; b < 4; b++) {
      const marks = plantsOf(labels, b);
      for (const [from, to] of plantsOf(exact, b)) {
        // Plants that are the same, and not several in one.
        const [mark, other] = marks.filter((m) => m[0] < to && m[1] > from);
        if (!mark || other) continue;
        if (from > 0 && mark[0] > 0) leads[b % 2].push(from - mark[0]);
        if (to < exact.length && mark[1] < labels.length) lags[b % 2].push(mark[1] - to);
      }
    }
  }
  const middle = (values: number[]): number =>
    Math.max(0, values.sort((x, y) => x - y)[values.length >> 1] ?? 0);
  return {
    heelLead: middle(leads[0]),
    heelLag: middle(lags[0]),
    toeLead: middle(leads[1]),
    toeLag: middle(lags[1]),
  };
}

/** First frame and one past the last of every plant of a bit. */
function plantsOf(track: ContactTrack, bit: number): [number, number][] {
  const out: [number, number][] = [];
  const on = (f: number): boolean => ((track[f] >> bit) & 1) === 1;
  for (let f = 0; f < track.length; f++) {
    if (!on(f)) continue;
    const from = f;
    while (f < track.length && on(f)) f++;
    out.push([from, f]);
  }
  return out;
}

/** Every plant's ends moved outwards (1) or inwards (-1); a plant that the motion's ends cut is not moved there. */
function shifted(track: ContactTrack, habit: Habit, way: 1 | -1): ContactTrack {
  const n = track.length;
  const out = new Uint8Array(n);
  for (let b = 0; b < 4; b++) {
    const [lead, lag] = b % 2 === 0 ? [habit.heelLead, habit.heelLag] : [habit.toeLead, habit.toeLag];
    for (const [first, end] of plantsOf(track, b)) {
      let from = first === 0 ? 0 : Math.max(0, first - way * lead);
      let to = end === n ? n : Math.min(n, end + way * lag);
      if (to - from < 1 || (way < 0 && end - first < 4)) [from, to] = [first, end];
      for (let g = from; g < to; g++) out[g] |= 1 << b;
    }
  }
  return out;
}
