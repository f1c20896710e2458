/**
 * Planned against real footsteps [TaskLoco §7]: each capture of a person who turns is left out once, the same turn is planned
 * from the others, and its footsteps are laid beside the real ones.
 *
 * The peer is what copying costs: the same turn planned with the capture left in.
 */
import { readFileSync } from "node:fs";
import { basename } from "node:path";
import { importBvh } from "../../src/core/capture/import.ts";
import { wrapAngle } from "../../src/core/math/angle.ts";
import { midPose } from "../../src/core/math/frame2.ts";
import { nearestDistances } from "../../src/core/quality/footstep-distance.ts";
import { parseScene } from "../../src/core/scene/schema.ts";
import { planScene } from "../../src/core/tasks/plan-scene.ts";
import type { Plan } from "../../src/core/tasks/plan-types.ts";
import { assembleLibrary, prepareClip } from "../../src/core/templates/build-library.ts";
import { retargetLibrary } from "../../src/core/templates/retarget-library.ts";
import type { LibraryClip } from "../../src/core/templates/types.ts";
import { captures, hasShared } from "../support/shared.ts";
import { turnTask } from "../support/turning.ts";
import { figure, median } from "./measure.ts";
import type { BenchModule, Figure } from "./types.ts";

/** The capture's turn as a scene, from where its feet stand at first. */
function sceneOf(clip: LibraryClip) {
  const start = midPose(clip.initialStance[0], clip.initialStance[1]);
  const { position, yaw } = clip.tasks[0];
  return parseScene({
    version: 1,
    start: { position: [start.x, start.z], yaw: start.yaw },
    tasks: [{ id: "turn", category: "turn", position: [position[0], 0, position[2]], yaw }],
  });
}

/** The real steps that lead to the turn's end; what follows is another task's. */
const realSteps = (clip: LibraryClip) =>
  clip.steps.filter((s) => s.start < clip.tasks[0].end * clip.clip.rate);

/** Metres from each real footstep up to the turn's end to the nearest planned one of its foot. */
const distances = (clip: LibraryClip, plan: Plan): number[] =>
  nearestDistances(
    realSteps(clip).map((s) => s.to),
    plan.steps,
  );

const bench: BenchModule = {
  name: "ground-truth",
  async run(options) {
    if (!hasShared) {
      options.progress("ground-truth: the captures are not beside the repository; nothing is measured.");
      return [];
    }
    const files = captures().filter((f) => basename(f).includes("walk-turn-"));
    const clips = files.map((f) => {
      const { clip } = importBvh(readFileSync(f, "utf8"), basename(f, ".bvh"));
      return prepareClip({ name: basename(f, ".bvh"), clip, tasks: [turnTask(clip)] });
    });
    const apart: number[] = [];
    const copied: number[] = [];
    const ends: number[] = [];
    const turns: number[] = [];
    const counts: number[] = [];
    const ms: number[] = [];
    clips.forEach((clip, i) => {
      options.progress(`ground-truth: ${i + 1}/${clips.length}`);
      const scene = sceneOf(clip);
      const { skeleton } = clip.clip;
      const others = retargetLibrary(
        assembleLibrary(
          clips.filter((_, k) => k !== i),
          true,
        ),
        skeleton,
      );
      planScene(scene, others, skeleton);
      const begun = performance.now();
      const plan = planScene(scene, others, skeleton);
      ms.push(performance.now() - begun);
      apart.push(...distances(clip, plan));
      const all = retargetLibrary(assembleLibrary(clips, true), skeleton);
      copied.push(...distances(clip, planScene(scene, all, skeleton)));
      counts.push(Math.abs(plan.steps.length - realSteps(clip).length));
      for (const foot of ["left", "right"] as const) {
        const real = realSteps(clip)
          .filter((s) => s.foot === foot)
          .pop();
        const planned = plan.steps.filter((s) => s.foot === foot).pop();
        if (!real || !planned) continue;
        ends.push(Math.hypot(planned.x - real.to.x, planned.z - real.to.z));
        turns.push((Math.abs(wrapAngle(planned.yaw - real.to.yaw)) * 180) / Math.PI);
      }
    });
    const beside = (f: Figure, values: readonly number[]): Figure => {
      const peerMedian = median(values);
      return { ...f, peer: "the capture left in", peerMedian, ratio: f.median / peerMedian };
    };
    return [
      beside(
        figure("ground truth, real to nearest planned footstep", "m", apart, null, () => true),
        copied,
      ),
      figure("ground truth, last footsteps, distance", "m", ends, null, () => true),
      figure("ground truth, last footsteps, yaw", "degrees", turns, null, () => true),
      figure("ground truth, steps more or fewer", "steps", counts, null, () => true),
      figure("ground truth, planning a turn", "ms", ms, "<= 8 ms", (v) => v <= 8),
    ];
  },
};

export default bench;
