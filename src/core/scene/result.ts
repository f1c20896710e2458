/** The result document: what a plan and its motion say, as JSON. */
import type { QualityFigures } from "../motion/types.ts";
import type { Plan } from "../tasks/plan-types.ts";
import type { Scene } from "./types.ts";

/** The document of the contract: starts with the two start stances, times in seconds, contacts one row a frame. */
export function resultDocument(scene: Scene, plan: Plan, contacts: Uint8Array, quality: QualityFigures) {
  return {
    version: 1,
    scene,
    footsteps: [
      ...plan.start.map((f) => ({
        foot: f.foot,
        position: [f.x, f.y, f.z],
        yaw: f.yaw,
        category: null,
        phase: null,
        task: null,
        template: null,
        lift: null,
        land: 0,
      })),
      ...plan.steps.map((s) => ({
        foot: s.foot,
        position: [s.x, s.y, s.z],
        yaw: s.yaw,
        category: s.category,
        phase: s.phase,
        task: s.task >= 0 ? (plan.tasks[s.task]?.id ?? null) : null,
        template: s.template,
        lift: s.lift,
        land: s.land,
      })),
    ],
    contacts: Array.from(contacts, (c) => [c & 1, (c >> 1) & 1, (c >> 2) & 1, (c >> 3) & 1]),
    timing: {
      rate: 60,
      tasks: plan.tasks.map((t) => ({ id: t.id, start: t.start, contact: t.contact, end: t.end })),
    },
    quality,
    warnings: plan.warnings,
  };
}
