/** The oracle that nobody had to label: the studio's captures with their exact contacts, worn like captured ones. */
import { trackOf } from "../core/contacts/motion-track.ts";
import { type LabelledTrack, type Oracle, OWN_ORACLE, trainOracle } from "../core/contacts/oracle.ts";
import { wearTrack } from "../core/contacts/wear.ts";
import { renderScore } from "./render.ts";
import { studioSet } from "./set.ts";

/** One frame in this many is learned: neighbours in time say the same. */
const EVERY = 4;
/** Spreads of the slow tremble by turns, metres; the quick one is a third. */
const WEAR = [0.006, 0.01, 0.014];

/** Made anew from the studio, deterministic, in about three seconds. */
export function startingOracle(): Oracle {
  const sources: LabelledTrack[] = studioSet().map(({ score }, i) => {
    const { clip, contacts } = renderScore(score);
    const slow = WEAR[i % WEAR.length];
    return {
      track: wearTrack(trackOf(clip), { slow, quick: slow / 3, seed: i + 1 }),
      labels: contacts,
      mask: Uint8Array.from(contacts, (_, f) => (f % EVERY === i % EVERY ? 1 : 0)),
    };
  });
  return trainOracle(sources, OWN_ORACLE);
}
