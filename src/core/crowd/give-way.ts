/** Two who wait for each other would wait for ever: how they get out of it. */
import { createStraightWay, type LongWay } from "./long-way.ts";

/** Who has not come nearer to the goal for so long is stuck, seconds. */
export const STUCK_AFTER = 2.5;
/** Time in which one who is stuck keeps to a choice, seconds. */
const CHOICE = 1.6;
/** Back, back to either side, to the left: over the way to the goal. */
const CHOICES = [
  [-1, 0],
  [-0.5, 0.8],
  [-0.5, -0.8],
  [0, 1],
] as const;

const aside: LongWay = createStraightWay(0, 0);

/**
 * One who has not come on takes turns, by its number and the time, to make room: back, or to a side.
 *
 * @param waited seconds since it last came nearer. @returns a way to a place two metres off, valid until the next call; null while it
 * goes on trying.
 */
export function giveWay(
  agent: number,
  waited: number,
  x: number,
  z: number,
  aimX: number,
  aimZ: number,
): LongWay | null {
  const turn = Math.floor((waited - STUCK_AFTER) / CHOICE);
  // A small integer hash: the same everywhere.
  const hash = ((agent * 73 + turn * 151 + 7) * 2654435761) >>> 16;
  if (hash % 3 !== 0) return null;
  const dx = aimX - x;
  const dz = aimZ - z;
  const n = Math.sqrt(dx * dx + dz * dz) || 1;
  const [back, side] = CHOICES[(hash >> 2) % 4];
  aside.goalX = x + (2 * (back * dx + side * dz)) / n;
  aside.goalZ = z + (2 * (back * dz - side * dx)) / n;
  return aside;
}
