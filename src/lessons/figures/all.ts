/** Every figure by the name that pages give it; loaded when first needed. */
import type { MountFigure } from "../kit/figure.ts";

export const FIGURES: Record<string, () => Promise<MountFigure>> = {
  "plan-scene": async () => (await import("./plan-scene.ts")).mount,
  "fit-steps": async () => (await import("./fit-steps.ts")).mount,
  "next-foot-task": async () => (await import("./next-foot.ts")).mountTask,
  thresholds: async () => (await import("./thresholds.ts")).mount,
  neighbours: async () => (await import("./neighbours.ts")).mount,
  "loop-joint": async () => (await import("./loop-joint.ts")).mount,
  "blend-length": async () => (await import("./blend-length.ts")).mount,
  "stride-scale": async () => (await import("./stride-scale.ts")).mount,
  triangles: async () => (await import("./triangles.ts")).mount,
  polar: async () => (await import("./polar.ts")).mount,
  "next-foot-pendulum": async () => (await import("./next-foot.ts")).mountPendulum,
  "one-step": async () => (await import("./one-step.ts")).mount,
  search: async () => (await import("./search.ts")).mount,
};
