/**
 * A performance that no library is made of: two writes, a sit, a box carried from one table to another, as the sequence
 * that [TaskLoco §7] captured to compare with. It is planned from the others and laid beside itself.
 */
import type { Score } from "./score.ts";
import { performance } from "./set.ts";

const DEG = Math.PI / 180;

/** The left-out sequence; `seed` varies the performer's steps, not the places. */
export function leftOutScore(seed = 901): Score {
  return performance("two-writes-sit-box", seed, { x: 0.3, z: -2.1, yaw: 0.2 }, [
    { category: "write", x: -0.6, y: 1.38, z: 0, yaw: 0, hold: 1.6 },
    { category: "write", x: 0.85, y: 1.26, z: 0, yaw: 0, hold: 1.4 },
    { category: "sit", x: -1.5, y: 0.46, z: -2.2, yaw: 35 * DEG, hold: 2.3 },
    { category: "lift", x: 1.75, y: 0.85, z: -1.5, yaw: 95 * DEG },
    { category: "place", x: -1.7, y: 0.9, z: -0.6, yaw: -80 * DEG },
  ]);
}
