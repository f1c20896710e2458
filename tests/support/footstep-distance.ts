/** How far planned footsteps lie from performed ones. */

interface Place {
  foot: "left" | "right";
  x: number;
  z: number;
}

/** Metres from each of `from` to the nearest of the same foot in `to`; 9 where there is none. */
export function nearestDistances(from: readonly Place[], to: readonly Place[]): number[] {
  return from.map((s) =>
    Math.min(9, ...to.filter((p) => p.foot === s.foot).map((p) => Math.hypot(p.x - s.x, p.z - s.z))),
  );
}
