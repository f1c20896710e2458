/** How an agent chose its step, as plain data to draw: the search tree, the path taken, and what each step costs. */
import { type Crowd, searchAgain, stepsOf } from "./crowd.ts";
import { wasJudged } from "./planner.ts";
import { boundAt } from "./sight.ts";
import { KIND, P, STEP } from "./state.ts";
import { BODY_RADIUS, FOOT_RADIUS, SHOULDER } from "./types.ts";

export interface PlanStory {
  agent: number;
  /** Nodes of the search: x, z and parent's index (-1 for the root), best total cost, whether it was looked at. */
  x: number[];
  z: number[];
  parent: number[];
  f: number[];
  judged: boolean[];
  expanded: number;
  generated: number;
  judgements: number;
  /** Nodes of the path taken, root left out. */
  path: number[];
  /** Each step of the path: kind, seconds, energies of eqs. 14-16 and nearness, J/kg. */
  steps: {
    kind: keyof typeof KIND;
    seconds: number;
    fixed: number;
    speed: number;
    bend: number;
    nearness: number;
    footX: number;
    footZ: number;
    side: number;
  }[];
  /** The five circles now: x, z, radius. */
  circles: [number, number, number][];
}

const NAMES = Object.keys(KIND) as (keyof typeof KIND)[];

/** Searches once more for an agent from where its step leads, changing nothing. Null for one who has arrived. */
export function tellPlan(crowd: Crowd, agent: number): PlanStory | null {
  if (!crowd.people[agent]?.here) return null;
  if (!searchAgain(crowd, agent)) return null;
  const { planner: p } = crowd;
  const story: PlanStory = {
    agent,
    x: [],
    z: [],
    parent: [],
    f: [],
    judged: [],
    expanded: p.expanded,
    generated: p.generated,
    judgements: p.judgements,
    path: Array.from(p.path.subarray(0, p.pathLength)),
    steps: [],
    circles: circlesOf(crowd, agent, crowd.tick),
  };
  for (let n = 0; n < p.nodes; n++) {
    story.x.push(p.places[2 * n]);
    story.z.push(p.places[2 * n + 1]);
    story.parent.push(p.parent[n]);
    story.f.push(p.f[n]);
    story.judged.push(wasJudged(p, n));
  }
  for (const n of story.path) {
    const q = n * STEP;
    story.steps.push({
      kind: NAMES[p.steps[q + P.kind]],
      seconds: p.steps[q + P.duration],
      fixed: p.steps[q + P.fixedEnergy],
      speed: p.steps[q + P.speedEnergy],
      bend: p.steps[q + P.bendEnergy],
      nearness: p.steps[q + P.nearness],
      footX: p.steps[q + P.footX],
      footZ: p.steps[q + P.footZ],
      side: p.steps[q + P.side],
    });
  }
  return story;
}

/** Torso, shoulders and the planted foot of an agent on a tick [Footsteps Figure 1c]. */
function circlesOf(crowd: Crowd, agent: number, tick: number): [number, number, number][] {
  const o = boundAt(crowd.sight, agent, tick);
  const b = crowd.sight.bound;
  const p = stepsOf(agent);
  const out: [number, number, number][] = [-1, 0, 1].map((s) => [
    b[o] + s * SHOULDER * b[o + 3],
    b[o + 1] - s * SHOULDER * b[o + 2],
    BODY_RADIUS,
  ]);
  out.push([b[o + 4], b[o + 5], FOOT_RADIUS]);
  out.push([crowd.steps[p + P.footX], crowd.steps[p + P.footZ], FOOT_RADIUS]);
  return out;
}
