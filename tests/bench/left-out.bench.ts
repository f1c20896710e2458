/**
 * The sequence of [TaskLoco §7, ground truth]: two writes, a sit and a box, performed in the studio and left out of the
 * library, planned from all the others and laid beside the performance. Five performers of the same score.
 *
 * The peer is what copying costs: the same scene planned with the performance left in.
 */

import { nearestDistances } from "../../src/core/quality/footstep-distance.ts";
import { parseScene } from "../../src/core/scene/schema.ts";
import { planScene } from "../../src/core/tasks/plan-scene.ts";
import type { Plan } from "../../src/core/tasks/plan-types.ts";
import { assembleLibrary, prepareClip } from "../../src/core/templates/build-library.ts";
import { leftOutScore } from "../../src/studio/left-out.ts";
import { type Rendered, renderScore } from "../../src/studio/render.ts";
import { studio } from "../support/library.ts";
import { figure, median } from "./measure.ts";
import type { BenchModule, Figure } from "./types.ts";

const SEEDS = [901, 902, 903, 904, 905];

/** The performance as a scene: its places, its yaws, its holds. */
function sceneOf({ sidecar }: Rendered, start: { x: number; z: number; yaw: number }) {
  return parseScene({
    version: 1,
    start: { position: [start.x, start.z], yaw: start.yaw },
    tasks: sidecar.tasks.map((t, i) => ({
      id: `t${i}`,
      category: t.category,
      effort: t.effort,
      position: t.position,
      yaw: t.yaw,
      ...(t.hand === "both" ? {} : { hand: t.hand }),
    })),
  });
}

/** Seconds between neighbouring contacts. */
const gaps = (contacts: readonly number[]): number[] => contacts.slice(1).map((c, i) => c - contacts[i]);

const bench: BenchModule = {
  name: "left-out",
  async run(options) {
    const others = studio().rendered.map((r) =>
      prepareClip({ name: r.name, clip: r.clip, tasks: r.sidecar.tasks }),
    );
    const library = assembleLibrary(others, true);
    const apart: number[] = [];
    const strays: number[] = [];
    const copied: number[] = [];
    const counts: number[] = [];
    const times: number[] = [];
    for (const seed of SEEDS) {
      options.progress(`left-out: performer ${seed}`);
      const score = leftOutScore(seed);
      const performed = renderScore(score);
      const real = performed.sidecar.steps ?? [];
      const start = { x: 0.3, z: -2.1, yaw: 0.2 };
      const scene = sceneOf(performed, start);
      const { skeleton } = performed.clip;
      const plan = planScene(scene, library, skeleton);
      apart.push(...nearestDistances(real, plan.steps));
      strays.push(...nearestDistances(plan.steps, real));
      counts.push(Math.abs(plan.steps.length - real.length));
      const own = gaps(performed.sidecar.tasks.map((t) => t.contact));
      const planned = gaps(plan.tasks.map((t) => t.contact));
      times.push(...planned.map((t, i) => Math.abs(t - own[i]) / own[i]));
      const all = assembleLibrary(
        [
          ...others,
          prepareClip({ name: "performance", clip: performed.clip, tasks: performed.sidecar.tasks }),
        ],
        true,
      );
      const kept: Plan = planScene(scene, all, skeleton);
      copied.push(...nearestDistances(real, kept.steps));
    }
    const peerMedian = median(copied);
    const nearest: Figure = {
      ...figure("left out, performed to nearest planned footstep", "m", apart, null, () => true),
      peer: "the performance left in",
      peerMedian,
      ratio: median(apart) / peerMedian,
    };
    return [
      nearest,
      figure("left out, planned to nearest performed footstep", "m", strays, null, () => true),
      figure("left out, steps more or fewer", "steps", counts, null, () => true),
      figure("left out, time from task to task, off by", "of it", times, null, () => true),
    ];
  },
};

export default bench;
