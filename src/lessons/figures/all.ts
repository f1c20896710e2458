/** Every figure by the name that pages give it; loaded when first needed. */
import type { MountFigure } from "../kit/figure.ts";

export const FIGURES: Record<string, () => Promise<MountFigure>> = {
  "plan-scene": async () => (await import("./plan-scene.ts")).mount,
  "fit-steps": async () => (await import("./fit-steps.ts")).mount,
  "next-foot-task": async () => (await import("./next-foot.ts")).mountTask,
};
