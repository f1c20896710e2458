/** How far planned footsteps lie from performed ones, and how far apart they are in time [TaskLoco §7, ground truth]. */

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

/** A performance, or its plan: where each foot came to rest, and the seconds at which each task was touched. */
export interface Performed {
  steps: readonly Place[];
  contacts: readonly number[];
}

export interface Beside {
  /** Metres from each performed footstep to the nearest planned one of its foot: median and 90th percentile. */
  distance: number;
  distance90: number;
  /** Footsteps of both. */
  performed: number;
  planned: number;
  /** Seconds from the first task's contact to the last one's, of both; null with fewer than two tasks. */
  seconds: { performed: number; planned: number } | null;
}

/** The plan laid beside the performance; null when either has no footsteps. */
export function besidePerformance(performed: Performed, planned: Performed): Beside | null {
  if (performed.steps.length === 0 || planned.steps.length === 0) return null;
  const apart = nearestDistances(performed.steps, planned.steps).sort((a, b) => a - b);
  const at = (share: number): number => apart[Math.min(apart.length - 1, Math.floor(share * apart.length))];
  const span = (c: readonly number[]): number => c[c.length - 1] - c[0];
  return {
    distance: at(0.5),
    distance90: at(0.9),
    performed: performed.steps.length,
    planned: planned.steps.length,
    seconds:
      performed.contacts.length > 1 && planned.contacts.length === performed.contacts.length
        ? { performed: span(performed.contacts), planned: span(planned.contacts) }
        : null,
  };
}
