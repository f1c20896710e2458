/**
 * The numbers that shape a gait: foot pitch over the cycle, the swing's path, where the pressure runs, how the hips
 * rise and fall. One set a speed; between speeds they are blended.
 *
 * Each set begins at textbook values [Perry, Gait Analysis; Winter, Biomechanics and Motor Control] and was fitted by
 * least squares to averages over many cycles of real walkers (see docs/studio.md), with feet that stay put and balance
 * kept. No frame and no single curve of a capture is in it.
 */

import { harmonicsOf, readHarmonics } from "../core/math/interpolate.ts";
import { FITTED } from "./gait-shapes.ts";
import { type Actor, paceOf } from "./score.ts";

export interface GaitShape {
  /** Speed that it is for, metres a second at a leg of 0.93 m. */
  speed: number;
  /** Foot pitch at toe-off and at heel strike of a full step, degrees. */
  push: number;
  strike: number;
  /** Seconds from strike to flat; share of the swing time before toe-off at which the heel begins to rise, and the power of that rise. */
  flat: number;
  heelRise: number;
  heelPower: number;
  /** Shares of push and strike pitch over the swing, in tenths (the first of push and the last of strike are 1). */
  pushOverSwing: readonly number[];
  strikeOverSwing: readonly number[];
  /** Share of the way over the swing, in tenths, from 0 to 1. */
  way: readonly number[];
  /** Ankle height over the straight line between its ends, in tenths, metres at a full step. */
  rise: readonly number[];
  /** Full step: foot's travel in leg lengths at which push, strike and rise are whole. */
  full: number;
  /** Pressure ahead of the ankle at strike, flat, middle, heel-off, toe-off; to the outer side; metres. */
  pressure: readonly [number, number, number, number, number];
  outward: number;
  /** Share of double support after which the weight begins to have passed over. */
  passOver: number;
  /** How early in a stance between two flights the body pushes: 1 evenly, less earlier, see flight.ts. */
  early: number;
  /** Hip joints' height from a strike to the next, in tenths, leg lengths. */
  heights: readonly number[];
  /** Degrees: turning of the pelvis about up and its phase lead (radians); list; tilt and its swing. */
  pelvisYaw: number;
  pelvisLead: number;
  pelvisList: number;
  pelvisTilt: number;
  /** Trunk's lean beyond upright, degrees. */
  lean: number;
  /**
   * What goes with the stride, degrees; lags in radians of the stride, after the strike of the own side: the chest's counter-turn;
   * the upper arm forwards and outwards; the elbow's flexion and its second harmonic.
   */
  chestYaw: number;
  chestLag: number;
  armMean: number;
  armSwing: number;
  armLag: number;
  armOut: number;
  armOpen: number;
  armOpenLag: number;
  elbowMean: number;
  elbowSwing: number;
  elbowLag: number;
  elbowTwice: number;
  elbowTwiceLag: number;
}

/** Weighted mean of two shapes. */
function mix(a: GaitShape, b: GaitShape, u: number): GaitShape {
  const out: Record<string, number | number[]> = {};
  for (const key of Object.keys(a) as (keyof GaitShape)[]) {
    const x = a[key];
    const y = b[key];
    out[key] =
      typeof x === "number"
        ? x + u * ((y as number) - x)
        : (x as readonly number[]).map((v, i) => v + u * ((y as readonly number[])[i] - v));
  }
  out.heights = mixPeriodic(a.heights, b.heights, u);
  return out as unknown as GaitShape;
}

/**
 * Mean of two periodic curves, brought into step first: slow walkers are highest just before a strike, quicker ones earlier,
 * and a plain mean of the two would be flatter than either.
 */
function mixPeriodic(a: readonly number[], b: readonly number[], u: number): number[] {
  const curves = [a, b].map((keys) => harmonicsOf(keys, Math.floor((keys.length - 1) / 2)));
  const [late, later] = curves.map((c) => Math.atan2(c[2], c[1]) / (2 * Math.PI));
  const apart = later - late - Math.round(later - late);
  return a.map((_, i) => {
    const at = i / a.length;
    return (
      (1 - u) * readHarmonics(curves[0], at - u * apart) + u * readHarmonics(curves[1], at + (1 - u) * apart)
    );
  });
}

/** The shape of an actor's gait, by the speed of the pace and whether it runs; beyond the sets' range, the nearest. */
export function shapeOf(actor: Actor): GaitShape {
  if (actor.shape) return actor.shape;
  const pace = paceOf(actor);
  const speed = pace.length / pace.time;
  const sets = pace.stance < 0.5 ? FITTED.runs : FITTED.walks;
  if (speed <= sets[0].speed) return sets[0];
  for (let i = 0; i + 1 < sets.length; i++)
    if (speed <= sets[i + 1].speed)
      return mix(sets[i], sets[i + 1], (speed - sets[i].speed) / (sets[i + 1].speed - sets[i].speed));
  return sets[sets.length - 1];
}
