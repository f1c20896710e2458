/** Cost of crowds that plan footsteps: per plan, per agent and tick, and the longest tick. */
import { createCrowd, stepCrowd } from "../../src/core/crowd/crowd.ts";
import { type CrowdWorld, TICK } from "../../src/core/crowd/types.ts";
import { createRandom } from "../../src/core/math/random.ts";
import { figure } from "./measure.ts";
import type { BenchModule, Figure } from "./types.ts";

/** Two streams in a hallway 8 m wide, drawn from a seed. */
function hallway(agents: number): CrowdWorld {
  const r = createRandom(3);
  const length = 20 + agents / 3;
  const world: CrowdWorld = { name: "hallway", obstacles: [], agents: [], repairs: [] };
  for (const z of [-4.5, 4.5])
    world.obstacles.push({ x: 0, z, halfX: 2 * length, halfZ: 0.5, cos: 1, sin: 0, round: false });
  while (world.agents.length < agents) {
    const east = world.agents.length % 2 === 0;
    const x = (east ? -1 : 1) * r.between(2, length);
    const z = r.between(-3.5, 3.5);
    if (world.agents.some((a) => (a.x - x) ** 2 + (a.z - z) ** 2 < 0.8)) continue;
    world.agents.push({
      x,
      z,
      dirX: east ? 1 : -1,
      dirZ: 0,
      goals: [{ x: east ? length + 10 : -length - 10, z, box: null, speed: 1.3, patience: 1e9 }],
    });
  }
  return world;
}

/** A room of 50 that empties through a door 1.2 m wide. */
function egress(): CrowdWorld {
  const r = createRandom(5);
  const world: CrowdWorld = { name: "egress", obstacles: [], agents: [], repairs: [] };
  for (const [x, z, halfX, halfZ] of [
    [-3.8, 0, 3.2, 0.1],
    [3.8, 0, 3.2, 0.1],
    [-7, -7, 0.1, 7],
    [7, -7, 0.1, 7],
    [0, -14, 7, 0.1],
  ])
    world.obstacles.push({ x, z, halfX, halfZ, cos: 1, sin: 0, round: false });
  while (world.agents.length < 50) {
    const x = r.between(-6.3, 6.3);
    const z = r.between(-13, -1);
    if (world.agents.some((a) => (a.x - x) ** 2 + (a.z - z) ** 2 < 0.8)) continue;
    world.agents.push({
      x,
      z,
      dirX: 0,
      dirZ: 1,
      goals: [{ x: r.between(-4, 4), z: 12, box: null, speed: 1.3, patience: 1e9 }],
    });
  }
  return world;
}

/** A Detour crowd of the same agents: milliseconds an agent and tick, and the share of agents that overlap by 5 cm at some tick. */
async function detour(world: CrowdWorld, seconds: number): Promise<{ ms: number; overlapping: number }> {
  const { Crowd, init, NavMeshQuery } = await import("recast-navigation");
  const { generateSoloNavMesh } = await import("recast-navigation/generators");
  await init();
  const length = Math.max(...world.agents.map((a) => Math.abs(a.x))) + 20;
  const wide = 3.9;
  const made = generateSoloNavMesh(
    [-length, 0, -wide, length, 0, -wide, length, 0, wide, -length, 0, wide],
    [0, 2, 1, 0, 3, 2],
    { cs: 0.2, ch: 0.2, walkableRadius: 1 },
  );
  if (!made.success) throw new Error(`recast: ${made.error}`);
  const query = new NavMeshQuery(made.navMesh);
  const crowd = new Crowd(made.navMesh, { maxAgents: world.agents.length, maxAgentRadius: 0.3 });
  const agents = world.agents.map((a) => {
    const agent = crowd.addAgent(
      { x: a.x, y: 0, z: a.z },
      { radius: 0.25, height: 1.75, maxSpeed: 1.3, maxAcceleration: 4 },
    );
    const goal = query.findClosestPoint({ x: a.goals[0].x, y: 0, z: a.goals[0].z });
    agent.requestMoveTarget(goal.point);
    return agent;
  });
  const overlapping = new Set<number>();
  let spent = 0;
  const ticks = seconds / TICK;
  for (let t = 0; t < ticks; t++) {
    const begun = performance.now();
    crowd.update(TICK);
    spent += performance.now() - begun;
    if (t % 20 !== 0) continue;
    const at = agents.map((a) => a.position());
    at.forEach((p, i) => {
      for (let k = i + 1; k < at.length; k++)
        if ((p.x - at[k].x) ** 2 + (p.z - at[k].z) ** 2 < 0.45 * 0.45) overlapping.add(i).add(k);
    });
  }
  return { ms: spent / ticks / agents.length, overlapping: overlapping.size / agents.length };
}

interface Run {
  figures: Figure[];
  perAgentTick: number;
}

function measure(world: CrowdWorld, name: string, goal: number | null, most: number): Run {
  const agents = world.agents.length;
  const crowd = createCrowd(world);
  const ticks: number[] = [];
  const plans: number[] = [];
  let present = 0;
  for (let t = 0; t < most; t++) {
    const before = crowd.statistics.plans;
    const begun = performance.now();
    const left = stepCrowd(crowd);
    const ms = performance.now() - begun;
    if (t >= 20) {
      ticks.push(ms);
      present += left;
      const made = crowd.statistics.plans - before;
      if (made > 0) plans.push(ms / made);
    }
    if (left === 0) break;
  }
  const { plans: count, expanded, generated, worstExpanded, worstGenerated } = crowd.statistics;
  const perAgentTick = ticks.reduce((a, b) => a + b, 0) / present;
  const limit = goal ?? 0;
  const f = (what: string, unit: string, value: number): Figure =>
    figure(`crowd, ${name}: ${what}`, unit, [value], null, () => true);
  return {
    perAgentTick,
    figures: [
      // The mean: ticks in which few plan are cheap.
      figure(
        `crowd, ${name}: an agent and tick`,
        "ms",
        [perAgentTick],
        goal === null ? null : `<= ${goal} ms`,
        (v) => v <= limit,
      ),
      figure(`crowd, ${name}: a plan`, "ms", plans, "<= 0.3 ms", (v) => v <= 0.3),
      figure(
        `crowd, ${name}: longest tick`,
        "ms",
        [Math.max(...ticks)],
        agents === 50 ? "<= 16 ms" : agents >= 2000 ? "<= 50 ms in the mean" : null,
        (v) => (agents === 50 ? v <= 16 : perAgentTick * agents <= 50),
      ),
      f("nodes expanded a plan", "", expanded / count),
      f("nodes generated a plan", "", generated / count),
      f("most nodes expanded", "", worstExpanded),
      f("most nodes generated", "", worstGenerated),
    ],
  };
}

const bench: BenchModule = {
  name: "crowd",
  async run(options) {
    const figures: Figure[] = [];
    for (const [world, name, goal, ticks] of [
      [hallway(50), "50 agents", 0.02, 600],
      [hallway(200), "200 agents", 0.02, 600],
      [egress(), "egress of 50", 0.04, 1600],
      [hallway(2000), "2,000 agents", 0.025, 160],
    ] as const) {
      options.progress(`crowd: ${name} ...`);
      const run = measure(world, name, goal, ticks);
      if (world.name === "hallway") {
        const peer = await detour(world, 8);
        Object.assign(run.figures[0], {
          peer: `Detour crowd, no footsteps, ${(100 * peer.overlapping).toFixed(1)} % overlap`,
          peerMedian: peer.ms,
          ratio: run.perAgentTick / peer.ms,
        });
      }
      figures.push(...run.figures);
    }
    return figures;
  },
};

export default bench;
