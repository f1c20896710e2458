/** What a crowd is at a tick, so that it can be taken back to it when the user changes the scene. */
import type { Crowd, Person } from "./crowd.ts";
import type { Wish } from "./give-way.ts";

export interface CrowdSnapshot {
  tick: number;
  states: Float64Array;
  steps: Float64Array;
  planStates: Float64Array;
  bound: Float64Array;
  told: Float64Array;
  since: Int32Array;
  people: Person[];
  wishes: Wish[];
}

export const takeSnapshot = (c: Crowd): CrowdSnapshot => ({
  tick: c.tick,
  states: c.states.slice(),
  steps: c.steps.slice(),
  planStates: c.planStates.slice(),
  bound: c.sight.bound.slice(),
  told: c.sight.told.slice(),
  since: c.sight.since.slice(),
  people: c.people.map((p) => ({ ...p })),
  wishes: c.wishes.map((w) => ({ ...w })),
});

/** Puts a crowd of as many agents back to where it was. Statistics go on. */
export function restoreSnapshot(c: Crowd, s: CrowdSnapshot): void {
  c.tick = s.tick;
  c.states.set(s.states);
  c.steps.set(s.steps);
  c.planStates.set(s.planStates);
  c.sight.bound.set(s.bound);
  c.sight.told.set(s.told);
  c.sight.since.set(s.since);
  s.people.forEach((p, i) => {
    Object.assign(c.people[i], p);
  });
  s.wishes.forEach((w, i) => {
    Object.assign(c.wishes[i], w);
  });
}
