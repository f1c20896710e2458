/** A crowd run to its end and noted at 20 Hz. */
import {
  type Crowd,
  type CrowdOptions,
  type CrowdStatistics,
  createCrowd,
  stepCrowd,
  stepsOf,
} from "./crowd.ts";
import { type CrowdFootstep, createFootfallMemory, footfallsOf, plantedFeet } from "./footfalls.ts";
import { boundAt } from "./sight.ts";
import { type CrowdWorld, FOOT_RADIUS, TICK } from "./types.ts";

export interface CrowdTrack {
  dt: number;
  /** frames x agents: [x, z] or null. */
  positions: ([number, number] | null)[][];
  /** Facing of the torso, unit vectors: angles are made for files alone. */
  facing: ([number, number] | null)[][];
  /** Planted feet: x, z, radius. */
  feet: ([number, number, number][] | null)[][];
  footsteps: CrowdFootstep[];
  statistics: CrowdStatistics;
  arrived: number;
}

export interface SimulateHooks extends CrowdOptions {
  /** After each tick, with how many are still on their way; false ends the run. */
  tick?: (tick: number, left: number, crowd: Crowd) => boolean;
}

/** Runs a crowd until all have arrived or `seconds` are over. */
export function simulateCrowd(world: CrowdWorld, seconds: number, hooks: SimulateHooks = {}): CrowdTrack {
  const crowd = createCrowd(world, hooks);
  const track: CrowdTrack = {
    dt: TICK,
    positions: [],
    facing: [],
    feet: [],
    footsteps: [],
    statistics: crowd.statistics,
    arrived: 0,
  };
  const { sight, steps, people } = crowd;
  const memory = createFootfallMemory(people.length);
  const aside = (i: number): number => people[i].gait.footAside;
  for (let i = 0; i < people.length; i++)
    if (people[i].here) track.footsteps.push(...footfallsOf(memory, i, steps, stepsOf(i), aside(i), true));
  crowd.onStep = (i) => {
    track.footsteps.push(...footfallsOf(memory, i, steps, stepsOf(i), aside(i)));
  };
  const round = (v: number): number => Math.round(v * 1e5) / 1e5;
  const planted = new Float64Array(4);
  for (let t = 0; t <= seconds / TICK; t++) {
    const left = stepCrowd(crowd);
    const positions: ([number, number] | null)[] = [];
    const facing: ([number, number] | null)[] = [];
    const feet: ([number, number, number][] | null)[] = [];
    for (let i = 0; i < people.length; i++) {
      if (!people[i].here) {
        positions.push(null);
        facing.push(null);
        feet.push(null);
        continue;
      }
      const o = boundAt(sight, i, t);
      positions.push([round(sight.bound[o]), round(sight.bound[o + 1])]);
      facing.push([sight.bound[o + 2], sight.bound[o + 3]]);
      const count = plantedFeet(planted, steps, stepsOf(i), t * TICK, aside(i));
      const row: [number, number, number][] = [];
      for (let k = 0; k < count; k++)
        row.push([round(planted[2 * k]), round(planted[2 * k + 1]), FOOT_RADIUS]);
      feet.push(row);
    }
    track.positions.push(positions);
    track.facing.push(facing);
    track.feet.push(feet);
    if (left === 0 || hooks.tick?.(t, left, crowd) === false) break;
  }
  track.arrived = people.filter((q) => !q.here).length;
  return track;
}
