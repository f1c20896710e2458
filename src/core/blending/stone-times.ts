/**
 * When the feet lift and land on a track of footsteps: the clips' own rhythm where no time is given, warped where one is
 * [Barycentric §5, time warping].
 */
import type { GroundPose } from "../math/frame2.ts";
import type { Foot } from "../steps/types.ts";
import type { BlendLibrary } from "./library.ts";
import { createChoice, createMix } from "./mix.ts";
import { createStepQuery, DURATION, mixMoves, queryStep, SWING } from "./step-query.ts";

export interface TrackPlace extends GroundPose {
  foot: Foot;
  /** Wanted landing, seconds from the first lift; null for the clips' own time. */
  time: number | null;
}

export interface TrackTime {
  lift: number;
  land: number;
}

/** Shortest and longest time between landings that is given where none is wanted, seconds. */
const QUICKEST = 0.34;
const SLOWEST = 0.95;
/** Least time between landings that a wanted time can ask for; shortest and longest swing. */
const LEAST = 0.25;
const SHORT_SWING = 0.2;
const LONG_SWING = 0.75;
/** A foot that steps twice in a row waits this long on the ground. */
const AGAIN = 0.3;

/**
 * Times of a track.
 *
 * @param start where left and right foot stand. @param first seconds of the first lift.
 * @param onLate called with the index of a footstep whose wanted time comes too soon after the one before.
 */
export function timesFor(
  library: BlendLibrary,
  start: readonly [GroundPose, GroundPose],
  track: readonly TrackPlace[],
  first: number,
  onLate: (index: number) => void = () => undefined,
): TrackTime[] {
  const query = createStepQuery();
  const mix = createMix();
  const choice = createChoice();
  const weights = new Float64Array(library.names.length);
  const places = [{ ...start[0] }, { ...start[1] }];
  const landed = [Number.NEGATIVE_INFINITY, Number.NEGATIVE_INFINITY];
  const out: TrackTime[] = [];
  track.forEach((p, k) => {
    const side = p.foot === "left" ? 0 : 1;
    query.side = side;
    Object.assign(query.from, places[side]);
    Object.assign(query.support, places[1 - side]);
    Object.assign(query.target, { x: p.x, z: p.z, yaw: p.yaw });
    const before = Math.max(landed[0], landed[1]);
    // The clips' time depends on where the root is at the lift, which depends on the time: three rounds settle it.
    let duration = 0.55;
    let swing = 0.4;
    for (let round = 0; round < 3; round++) {
      query.since = k === 0 ? Number.POSITIVE_INFINITY : duration;
      query.air = swing;
      queryStep(query, mix, choice, library, weights);
      duration = Math.max(QUICKEST, Math.min(SLOWEST, mixMoves(library, mix, side, DURATION)));
      swing = mixMoves(library, mix, side, SWING);
    }
    let land = k === 0 ? first + swing : before + duration;
    let air = swing;
    if (p.time !== null) {
      land = first + p.time;
      const least = k === 0 ? first + SHORT_SWING : before + LEAST;
      if (land < least) {
        onLate(k);
        land = least;
      }
      const since = k === 0 ? land - first : land - before;
      const natural = k === 0 ? swing : duration;
      air =
        since >= natural
          ? Math.min(LONG_SWING, swing * Math.min(1.25, since / natural))
          : (swing * since) / natural;
      air = Math.max(SHORT_SWING, air);
      if (k === 0) air = Math.min(air, land - first);
    }
    // A foot stays down a moment between two of its own steps, the longer when the other one has not stepped in between.
    const again = k > 0 && track[k - 1].foot === p.foot;
    const rest = landed[side] + (again ? AGAIN : 0.1);
    let lift = land - air;
    if (lift < rest) {
      lift = rest;
      if (p.time === null) land = Math.max(land, lift + air);
      else lift = Math.min(lift, land - SHORT_SWING);
    }
    out.push({ lift, land });
    places[side] = { x: p.x, z: p.z, yaw: p.yaw };
    landed[side] = land;
  });
  return out;
}
