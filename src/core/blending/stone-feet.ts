/** Which foot steps on which stone: alternate feet where the user says nothing, without crossing legs. */
import { type GroundPose, toLocal } from "../math/frame2.ts";
import type { Foot } from "../steps/types.ts";

export interface StonePlace extends GroundPose {
  /** Forced by the user; null for free. */
  foot: Foot | null;
}

/** Price of the same foot twice, and of each metre that a foot lands on the other's side. */
const AGAIN = 0.9;
const CROSS = 3;
/** A foot lands at least this far to its own side for nothing, metres. */
const APART = 0.1;

/**
 * Feet for stones stepped on in order, cheapest over the whole way.
 *
 * @param start where left and right foot stand before.
 */
export function feetForStones(
  start: readonly [GroundPose, GroundPose],
  stones: readonly StonePlace[],
): Foot[] {
  const n = stones.length;
  if (n === 0) return [];
  // cost[k][f]: the best way to have stone k under foot f (0 left, 1 right).
  const cost: number[][] = [];
  const from: number[][] = [];
  const crossing = (own: GroundPose, other: GroundPose, f: number): number => {
    const p = toLocal({ ...other, yaw: own.yaw }, own);
    return CROSS * Math.max(0, APART - (f === 0 ? p.x : -p.x));
  };
  for (let k = 0; k < n; k++) {
    const row = [0, 1].map((f) => {
      const forced = stones[k].foot;
      if (forced !== null && (forced === "left") !== (f === 0)) return { price: 1e6, by: 1 - f };
      if (k === 0) return { price: crossing(stones[0], start[1 - f], f), by: -1 };
      const alternate = cost[k - 1][1 - f] + crossing(stones[k], stones[k - 1], f);
      const again = cost[k - 1][f] + AGAIN;
      return alternate <= again ? { price: alternate, by: 1 - f } : { price: again, by: f };
    });
    cost.push(row.map((r) => r.price));
    from.push(row.map((r) => r.by));
  }
  const out: Foot[] = new Array(n);
  let f = cost[n - 1][0] <= cost[n - 1][1] ? 0 : 1;
  for (let k = n - 1; k >= 0; k--) {
    out[k] = f === 0 ? "left" : "right";
    f = from[k][f];
  }
  return out;
}
