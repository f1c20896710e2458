/**
 * Plants that a motion clearly has and its contacts do not claim: a heel, or a ball or tip, that rests low and still for a
 * tenth of a second [DESIGN of motion quality, `missedPlants`].
 */
import type { Skeleton } from "../skeleton/skeleton.ts";
import type { MotionPoints } from "./measure.ts";

/** Surely down: lower than this over the ground, metres, slower than this, m/s (leg of 0.85 m), for so many frames. */
const HEIGHT = 0.015;
const SPEED = 0.12;
const LEAST = 6;

export interface MissedPlant {
  side: "left" | "right";
  end: "heel" | "toe";
  /** First frame and the one after the last. */
  from: number;
  to: number;
}

/** The sure plants of which more than half is not claimed. Soles are over a ground at y = 0. */
export function missedPlants(points: MotionPoints, skeleton: Skeleton): MissedPlant[] {
  const scale = skeleton.legLength / 0.85;
  const { frames, soles } = points;
  const out: MissedPlant[] = [];
  const rests = (f: number, side: number, point: number): boolean => {
    const o = (2 * f + side) * 9 + 3 * point;
    if (soles[o + 1] >= HEIGHT * scale) return false;
    const a = (2 * Math.max(0, f - 1) + side) * 9 + 3 * point;
    const b = (2 * Math.min(frames - 1, f + 1) + side) * 9 + 3 * point;
    const time = (Math.min(frames - 1, f + 1) - Math.max(0, f - 1)) / 60;
    return (
      Math.hypot(soles[b] - soles[a], soles[b + 1] - soles[a + 1], soles[b + 2] - soles[a + 2]) <
      SPEED * scale * time
    );
  };
  for (let side = 0; side < 2; side++) {
    for (let end = 0; end < 2; end++) {
      const bit = 1 << (2 * side + end);
      let from = -1;
      for (let f = 0; f <= frames; f++) {
        const down = f < frames && (end === 0 ? rests(f, side, 0) : rests(f, side, 1) || rests(f, side, 2));
        if (down && from < 0) from = f;
        if (down || from < 0) continue;
        if (f - from >= LEAST) {
          let unclaimed = 0;
          for (let k = from + 1; k < f - 1; k++) if (!(points.contacts[k] & bit)) unclaimed++;
          if (unclaimed > 0.5 * (f - from - 2))
            out.push({ side: side === 0 ? "left" : "right", end: end === 0 ? "heel" : "toe", from, to: f });
        }
        from = -1;
      }
    }
  }
  return out;
}
