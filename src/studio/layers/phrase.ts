/**
 * What a performer does over several strides: arms that see-saw on a beam, a sag on every second stride, a cheer.
 *
 * A gait's rhythm repeats every stride; many styles do not, and are lost when a loop of two steps is cut from them
 * [Express §8: "balancing" and "excited"]. A phrase is a few harmonics over so many strides of the gait's phase, so that the
 * performance repeats, but only as a whole.
 */
import type { BodyAngles } from "./body.ts";
import type { Gait } from "./gait.ts";

/** What a line of a phrase moves; degrees, but `sink` in metres. */
export const PHRASE_PARTS = [
  "lean",
  "tip",
  "twist",
  "nod",
  "shake",
  "sink",
  "leftOut",
  "leftSwing",
  "leftElbow",
  "leftTurn",
  "rightOut",
  "rightSwing",
  "rightElbow",
  "rightTurn",
] as const;

export type PhrasePart = (typeof PHRASE_PARTS)[number];

export interface PhraseLine {
  part: PhrasePart;
  /** Times it comes and goes in a phrase. */
  times: number;
  amount: number;
  /** When it is largest, as a share of the phrase. */
  at: number;
}

export interface Phrase {
  strides: number;
  lines: readonly PhraseLine[];
}

const DEG = Math.PI / 180;

/** Lays a phrase over the upper body, as far as there is a rhythm. */
export function addPhrase(b: BodyAngles, gait: Gait, phrase: Phrase): void {
  const frames = gait.phase.length;
  for (const line of phrase.lines) {
    const tracks = tracksOf(b, line.part);
    const unit = line.part === "sink" ? -1 : DEG;
    for (let f = 0; f < frames; f++) {
      const u = gait.phase[f] / (2 * Math.PI * phrase.strides) - line.at;
      const value =
        Math.min(1, 1.7 * gait.amount[f]) * line.amount * unit * Math.cos(2 * Math.PI * line.times * u);
      for (const [track, share] of tracks) track[f] += share * value;
    }
  }
}

/** The tracks that a part moves, with the share of each. */
function tracksOf(b: BodyAngles, part: PhrasePart): [Float64Array, number][] {
  switch (part) {
    case "lean":
      return [
        [b.chestPitch, 1],
        [b.pelvisPitch, 0.25],
      ];
    case "tip":
      return [
        [b.chestRoll, 1],
        [b.pelvisRoll, 0.35],
        [b.headRoll, 0.5],
      ];
    case "twist":
      return [
        [b.chestYaw, 1],
        [b.headYaw, 0.4],
      ];
    case "nod":
      return [[b.headPitch, 1]];
    case "shake":
      return [[b.headYaw, 1]];
    case "sink":
      return [[b.hipHeight, 1]];
    default: {
      const arm = b.arms[part.startsWith("left") ? 0 : 1];
      const name = part.replace(/^(left|right)/, "").toLowerCase() as "out" | "swing" | "elbow" | "turn";
      return [[arm[name], 1]];
    }
  }
}
