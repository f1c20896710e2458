/**
 * Plants that a motion clearly has and its contacts do not claim, and claims that the motion denies [motion quality:
 * missedPlants]: a result that claims few plants to look clean is found out here.
 */

/** "Certainly a plant": height over the ground, speed, and for how long; metres, m/s and seconds at LEG. */
const SURE = { height: 0.015, speed: 0.12, seconds: 0.1 };
/** A claim is denied over this height or speed. */
const DENIED = { height: 0.03, speed: 0.5 };
/** Thigh and shank that the lengths above are for, metres. */
const LEG = 0.85;
/** Sole points a foot: heel, ball, tip; x, y, z each. */
const ROW = 9;

export interface Claims {
  /** Certain plants less than half of which is claimed. */
  missed: number;
  /** Claimed frames whose point is in the air or moves as no planted point does, shares of the claims. */
  tooHigh: number;
  tooFast: number;
}

/**
 * Checks a motion's contacts against its soles.
 *
 * @param soles frames x 2 x 9: heel, ball and tip of left and right, metres.
 * @param contacts bits a frame: left heel 1, left toe 2, right heel 4, right toe 8.
 * @param ground height of the ground under left and right foot, frames each.
 * @param leg thigh and shank, metres.
 */
export function checkClaims(
  soles: Float64Array,
  contacts: Uint8Array,
  ground: readonly [Float64Array, Float64Array],
  frames: number,
  rate: number,
  leg: number,
): Claims {
  const s = leg / LEG;
  const speed = (f: number, o: number): number => {
    const a = Math.max(0, f - 1);
    const b = Math.min(frames - 1, f + 1);
    if (a === b) return 0;
    const i = 2 * ROW * a + o;
    const j = 2 * ROW * b + o;
    return (
      (Math.hypot(soles[j] - soles[i], soles[j + 1] - soles[i + 1], soles[j + 2] - soles[i + 2]) * rate) /
      (b - a)
    );
  };
  const least = Math.max(2, Math.round(SURE.seconds * rate));
  const sure = new Uint8Array(frames);
  let missed = 0;
  let claimed = 0;
  let high = 0;
  let fast = 0;
  for (let bit = 0; bit < 4; bit++) {
    const side = bit >> 1;
    const points = bit % 2 === 0 ? [ROW * side] : [ROW * side + 3, ROW * side + 6];
    for (let f = 0; f < frames; f++) {
      sure[f] = 0;
      let lowest = Number.POSITIVE_INFINITY;
      let slowest = Number.POSITIVE_INFINITY;
      for (const o of points) {
        const y = soles[2 * ROW * f + o + 1] - ground[side][f];
        const v = speed(f, o);
        if (y < SURE.height * s && v < SURE.speed * s) sure[f] = 1;
        lowest = Math.min(lowest, y);
        slowest = Math.min(slowest, v);
      }
      if (((contacts[f] >> bit) & 1) === 0) continue;
      claimed++;
      if (lowest > DENIED.height * s) high++;
      if (slowest > DENIED.speed * s) fast++;
    }
    for (let f = 0; f < frames; f++) {
      if (!sure[f]) continue;
      let end = f;
      while (end < frames && sure[end]) end++;
      // Its inside must be claimed: one frame off each end.
      if (end - f >= least && end - f > 2) {
        let unclaimed = 0;
        for (let k = f + 1; k < end - 1; k++) unclaimed += 1 - ((contacts[k] >> bit) & 1);
        if (unclaimed > 0.5 * (end - f - 2)) missed++;
      }
      f = end;
    }
  }
  return { missed, tooHigh: high / Math.max(claimed, 1), tooFast: fast / Math.max(claimed, 1) };
}
