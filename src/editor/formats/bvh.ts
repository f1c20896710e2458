/** The motion as BVH. */
import { writeBvh } from "../../core/capture/bvh-write.ts";
import { createSkeleton } from "../../core/skeleton/skeleton.ts";
import type { ExportFormat } from "./format.ts";
import { motionMissing } from "./motion-ready.ts";

export const bvhExport: ExportFormat = {
  id: "bvh",
  label: "Motion, BVH at 60 Hz",
  file: "motion.bvh",
  type: "text/plain",
  order: 0,
  blocked: motionMissing,
  make(e) {
    const m = e.plan.motion.current;
    if (!m) throw new Error("there is no motion.");
    const { height, proportions } = e.store.getState().scene.character;
    return writeBvh({
      name: "scene",
      skeleton: createSkeleton(height, proportions),
      rate: 60,
      frames: m.frames,
      root: Float64Array.from(m.root),
      rotations: Float64Array.from(m.rotations),
    });
  },
};
