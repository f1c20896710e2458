/**
 * How a capture's ground lies on the plan's while a foot swings: "half of the foot's warp goes to the root"
 * [TaskLoco §6, Figure 11].
 *
 * The frame between the feet (midpoint, mean yaw) of the capture is laid on that of the plan, before and after the
 * step; in between, by a fraction that the caller gives. The midpoint moves by half of
 * what the swing foot does, which is the paper's half.
 */
import { wrapAngle } from "../math/angle.ts";
import { type GroundPose, midPose } from "../math/frame2.ts";

export interface GroundMap {
  /** Capture: x, z of the frame between the feet before and after; plan: likewise. */
  source0: GroundPose;
  source1: GroundPose;
  plan0: GroundPose;
  plan1: GroundPose;
  /** Yaw from capture to plan before and after; the second is unwrapped towards the first. */
  turn0: number;
  turn1: number;
}

/** The map for a step (or a hold, where before and after are the same). */
export function createGroundMap(
  sourceBefore: [GroundPose, GroundPose],
  sourceAfter: [GroundPose, GroundPose],
  planBefore: [GroundPose, GroundPose],
  planAfter: [GroundPose, GroundPose],
): GroundMap {
  const source0 = midPose(...sourceBefore);
  const source1 = midPose(...sourceAfter);
  const plan0 = midPose(...planBefore);
  const plan1 = midPose(...planAfter);
  const turn0 = meanTurn(sourceBefore, planBefore);
  return {
    source0,
    source1,
    plan0,
    plan1,
    turn0,
    turn1: turn0 + wrapAngle(meanTurn(sourceAfter, planAfter) - turn0),
  };
}

/**
 * Mean of both feet's turns from capture to plan. (The difference of the mean yaws would flip by half a turn where the feet
 * point nearly opposite ways, as they do when turning about.)
 */
function meanTurn(source: [GroundPose, GroundPose], plan: [GroundPose, GroundPose]): number {
  const left = wrapAngle(plan[0].yaw - source[0].yaw);
  return left + wrapAngle(plan[1].yaw - source[1].yaw - left) / 2;
}

/** The map's turn at fraction w. */
export function mapTurn(map: GroundMap, w: number): number {
  return map.turn0 + w * (map.turn1 - map.turn0);
}

/** A ground point of the capture in the plan at fraction w: x to out[o], z to out[o + 2]. */
export function mapPoint(
  out: Float64Array,
  o: number,
  map: GroundMap,
  w: number,
  x: number,
  z: number,
): void {
  const turn = mapTurn(map, w);
  const c = Math.cos(turn);
  const s = Math.sin(turn);
  const dx = x - (map.source0.x + w * (map.source1.x - map.source0.x));
  const dz = z - (map.source0.z + w * (map.source1.z - map.source0.z));
  out[o] = map.plan0.x + w * (map.plan1.x - map.plan0.x) + c * dx + s * dz;
  out[o + 2] = map.plan0.z + w * (map.plan1.z - map.plan0.z) - s * dx + c * dz;
}
