/** Cost of crowds that plan footsteps: per plan, per agent and tick, and the longest tick. */
import { createCrowd, stepCrowd } from "../../src/core/crowd/crowd.ts";
import type { CrowdWorld } from "../../src/core/crowd/types.ts";
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

const bench: BenchModule = {
  name: "crowd",
  async run(options) {
    const figures: Figure[] = [];
    for (const agents of [50, 200]) {
      options.progress(`crowd: ${agents} agents ...`);
      const crowd = createCrowd(hallway(agents));
      const ticks: number[] = [];
      for (let t = 0; t < 600; t++) {
        const begun = performance.now();
        const left = stepCrowd(crowd);
        ticks.push(performance.now() - begun);
        if (left === 0) break;
      }
      const warm = ticks.slice(20);
      const { plans, expanded, generated, worstExpanded } = crowd.statistics;
      const total = warm.reduce((a, b) => a + b, 0);
      figures.push(
        // The mean: ticks in which few plan are cheap.
        figure(
          `crowd, ${agents} agents: an agent and tick`,
          "ms",
          [total / warm.length / agents],
          "<= 0.02 ms",
          (v) => v <= 0.02,
        ),
        figure(`crowd, ${agents} agents: a plan`, "ms", [total / plans], "<= 0.3 ms", (v) => v <= 0.3),
        figure(
          `crowd, ${agents} agents: longest tick`,
          "ms",
          [Math.max(...warm)],
          agents === 50 ? "<= 16 ms" : null,
          (v) => v <= 16,
        ),
        figure(`crowd, ${agents} agents: nodes expanded a plan`, "", [expanded / plans], null, () => true),
        figure(`crowd, ${agents} agents: nodes generated a plan`, "", [generated / plans], null, () => true),
        figure(`crowd, ${agents} agents: most nodes expanded`, "", [worstExpanded], null, () => true),
      );
    }
    return figures;
  },
};

export default bench;
