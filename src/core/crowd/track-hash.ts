/** A number for all trajectories of a crowd, to compare engines bit for bit. */
import { createCrowd, stepCrowd } from "./crowd.ts";
import { boundAt } from "./sight.ts";
import { POSE } from "./state.ts";
import { type CrowdWorld, TICK } from "./types.ts";

/**
 * Runs a crowd and hashes every pose of every agent on every tick, all 64 bits of each number (FNV-1a over 32-bit words).
 *
 * @returns eight hexadecimal digits, how many arrived, and ticks.
 */
export function hashCrowd(
  world: CrowdWorld,
  seconds: number,
): { hash: string; arrived: number; ticks: number } {
  const crowd = createCrowd(world);
  const number = new Float64Array(1);
  const words = new Uint32Array(number.buffer);
  let hash = 0x811c9dc5;
  let ticks = 0;
  for (; ticks < seconds / TICK; ticks++) {
    const left = stepCrowd(crowd);
    for (let i = 0; i < crowd.people.length; i++) {
      if (!crowd.people[i].here) continue;
      const o = boundAt(crowd.sight, i, crowd.tick - 1);
      for (let k = 0; k < POSE; k++) {
        number[0] = crowd.sight.bound[o + k];
        hash = Math.imul(hash ^ words[0], 0x01000193);
        hash = Math.imul(hash ^ words[1], 0x01000193);
      }
    }
    if (left === 0) break;
  }
  const arrived = crowd.people.filter((p) => !p.here).length;
  return { hash: (hash >>> 0).toString(16).padStart(8, "0"), arrived, ticks };
}
