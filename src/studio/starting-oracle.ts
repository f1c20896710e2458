/** The oracle that nobody had to label: the studio's captures with their exact contacts, worn like captured ones. */
import { asLabelled, HABIT, type Habit } from "../core/contacts/convention.ts";
import { type Examples, heldFeature } from "../core/contacts/examples.ts";
import { trackOf } from "../core/contacts/motion-track.ts";
import {
  examplesOf,
  type LabelledTrack,
  type Oracle,
  OWN_ORACLE,
  trainOracle,
} from "../core/contacts/oracle.ts";
import { wearTrack } from "../core/contacts/wear.ts";
import { renderScore } from "./render.ts";
import { everyScore } from "./set.ts";

/** One frame in this many is learned: neighbours in time say the same. */
const EVERY = 8;
/** Spreads of the slow tremble by turns, metres; the quick one is a third. */
const WEAR = [0.006, 0.01, 0.014];

/** What it is trained on: worn motions, their exact contacts, and which frames are learned. */
export function startingLessons(): LabelledTrack[] {
  return everyScore().map(({ score }, i) => {
    const { clip, contacts } = renderScore(score);
    const slow = WEAR[i % WEAR.length];
    return {
      track: wearTrack(trackOf(clip), { slow, quick: slow / 3, seed: i + 1 }),
      labels: contacts,
      mask: Uint8Array.from(contacts, (_, f) => (f % EVERY === i % EVERY ? 1 : 0)),
    };
  });
}

/**
 * Made anew from every capture of the studio: tasks, styles, runs, cycles. Deterministic; takes some seconds.
 *
 * @param habit how those label whom it answers as; null for exact contacts.
 */
export function startingOracle(
  habit: Habit | null = HABIT,
  lessons: readonly LabelledTrack[] = startingLessons(),
): Oracle {
  const sources = habit ? lessons.map((l) => ({ ...l, labels: asLabelled(l.labels, habit) })) : lessons;
  const examples: Examples = examplesOf(sources, OWN_ORACLE);
  return trainOracle([], OWN_ORACLE, { ...examples, features: examples.features.map(heldFeature) });
}
