/**
 * A crowd that runs while somebody watches and changes its world. It is simulated a little ahead of what is shown, so that every
 * footstep is known before its foot leaves the ground; a change takes it back to just after the moment shown.
 */
import { type Crowd, changeGround, createCrowd, stepCrowd, stepsOf } from "./crowd.ts";
import { arcTangent } from "./elementary.ts";
import { type CrowdFootstep, createFootfallMemory, type FootfallMemory, footfallsOf } from "./footfalls.ts";
import { type CrowdSnapshot, restoreSnapshot, takeSnapshot } from "./snapshot.ts";
import { P } from "./state.ts";
import { type CrowdWorld, TICK } from "./types.ts";

/** How far the simulation is ahead of what is shown, seconds. */
export const LEAD = 1.7;
/** A foot that has left the ground keeps its place: its step has been taken within this time, seconds. */
const BEGUN = 0.6;
/** Between snapshots, ticks; crowds larger than this keep none, and changes reach them later. */
const EVERY = 4;
const MOST_SNAPSHOTS_OF = 400;

/** A torso's turn over the feet through one step, radians: from and to. */
export interface TorsoTwist {
  tick: number;
  agent: number;
  start: number;
  duration: number;
  from: number;
  to: number;
}

interface Kept {
  crowd: CrowdSnapshot;
  memory: FootfallMemory;
}

export interface CrowdSession {
  crowd: Crowd;
  /** Footsteps in order of their steps, with the tick on which each was decided. */
  footsteps: { tick: number; step: CrowdFootstep }[];
  /** Twists of the steps that have any, in order of their steps: taken away by who shows them when they are over. */
  twists: TorsoTwist[];
  memory: FootfallMemory;
  kept: Kept[];
  /** Seconds at which each agent reached its last goal; Infinity before. */
  gone: Float64Array;
}

/** A session at its beginning. */
export function createSession(world: CrowdWorld): CrowdSession {
  const crowd = createCrowd(world);
  const n = crowd.people.length;
  const session: CrowdSession = {
    crowd,
    footsteps: [],
    twists: [],
    memory: createFootfallMemory(n),
    kept: [],
    gone: new Float64Array(n).fill(Number.POSITIVE_INFINITY),
  };
  for (let i = 0; i < n; i++) note(session, i, true);
  crowd.onStep = (i) => note(session, i, false);
  return session;
}

function note(s: CrowdSession, i: number, first: boolean): void {
  const { crowd } = s;
  if (!crowd.people[i].here) return;
  const aside = crowd.people[i].gait.footAside;
  for (const step of footfallsOf(s.memory, i, crowd.steps, stepsOf(i), aside, first))
    s.footsteps.push({ tick: crowd.tick, step });
  noteTwist(s, i);
}

/** Angles under this are no twist, radians. */
const STRAIGHT = 1e-3;

function noteTwist(s: CrowdSession, i: number): void {
  const { steps, tick } = s.crowd;
  const p = stepsOf(i);
  const over = (face: number, head: number): number =>
    arcTangent(
      steps[p + face] * steps[p + head + 1] - steps[p + face + 1] * steps[p + head],
      steps[p + face] * steps[p + head] + steps[p + face + 1] * steps[p + head + 1],
    );
  const from = over(P.fromX, P.fromHeadX);
  const to = over(P.toX, P.headX);
  if (Math.abs(from) < STRAIGHT && Math.abs(to) < STRAIGHT) return;
  s.twists.push({ tick, agent: i, start: steps[p + P.start], duration: steps[p + P.duration], from, to });
}

/**
 * Simulates until the crowd is ahead of `shown` seconds, at most `most` ticks.
 *
 * @returns whether it is.
 */
export function runSession(s: CrowdSession, shown: number, most = 40): boolean {
  const { crowd } = s;
  const until = Math.ceil((shown + LEAD) / TICK);
  for (let k = 0; crowd.tick < until; k++) {
    if (k === most) return false;
    if (crowd.tick % EVERY === 0 && crowd.people.length <= MOST_SNAPSHOTS_OF) {
      s.kept.push({
        crowd: takeSnapshot(crowd),
        memory: { start: s.memory.start.slice(), duration: s.memory.duration.slice() },
      });
      if (s.kept.length > (LEAD + 1) / (EVERY * TICK)) s.kept.shift();
    }
    stepCrowd(crowd);
    for (let i = 0; i < crowd.people.length; i++)
      if (!crowd.people[i].here && s.gone[i] === Number.POSITIVE_INFINITY) s.gone[i] = crowd.tick * TICK;
  }
  return true;
}

/**
 * Changes walls, surfaces and goals of the same agents while `shown` seconds are on show. Footsteps decided after that moment are
 * forgotten and decided anew.
 *
 * @returns false when the agents are others: a new session is needed.
 */
export function changeSession(s: CrowdSession, world: CrowdWorld, shown: number): boolean {
  const { crowd } = s;
  const before = crowd.world.agents;
  const same =
    world.agents.length === before.length &&
    world.agents.every(
      (a, i) => a.x === before[i].x && a.z === before[i].z && a.goals.length === before[i].goals.length,
    );
  if (!same) return false;
  const from = Math.ceil((shown + BEGUN) / TICK);
  const kept = s.kept.find((k) => k.crowd.tick >= from);
  if (kept && kept.crowd.tick < crowd.tick) {
    restoreSnapshot(crowd, kept.crowd);
    s.memory.start.set(kept.memory.start);
    s.memory.duration.set(kept.memory.duration);
    s.kept = s.kept.filter((k) => k.crowd.tick < kept.crowd.tick);
    s.footsteps = s.footsteps.filter((f) => f.tick < crowd.tick);
    s.twists = s.twists.filter((f) => f.tick < crowd.tick);
    for (let i = 0; i < s.gone.length; i++) if (crowd.people[i].here) s.gone[i] = Number.POSITIVE_INFINITY;
  }
  changeGround(crowd, world);
  return true;
}
