/** The result document: what a plan and its motion say, as JSON. `result-schema.ts` reads it. */
import type { QualityFigures } from "../motion/types.ts";
import type { Foot, Footstep, Phase, StepCategory } from "../steps/types.ts";
import type { Plan } from "../tasks/plan-types.ts";
import type { Scene } from "./types.ts";

/** A footstep of a result. The start stances' `category`, `phase` and `lift` are null. Metres, radians, seconds. */
export interface ResultFootstep {
  foot: Foot;
  position: [number, number, number];
  yaw: number;
  category: StepCategory | null;
  phase: Phase | null;
  /** Id of the task that it leads to; null where there is none. */
  task: string | null;
  /** The template that it was made of; null for locomotion. */
  template: string | null;
  lift: number | null;
  land: number;
}

type Bit = 0 | 1;

/** The document of the contract, version 1. */
export interface ResultDocument {
  version: 1;
  scene: Scene;
  /** The two start stances first, the left one before the right. */
  footsteps: ResultFootstep[];
  /** Left heel, left toe, right heel, right toe: one row a frame. */
  contacts: [Bit, Bit, Bit, Bit][];
  timing: { rate: 60; tasks: { id: string; start: number; contact: number; end: number }[] };
  quality: QualityFigures;
  /** One sentence each. */
  warnings: string[];
}

/** The document of a plan and its motion's contacts and figures. */
export function resultDocument(
  scene: Scene,
  plan: Plan,
  contacts: Uint8Array,
  quality: QualityFigures,
): ResultDocument {
  const bit = (c: number, k: number): Bit => (((c >> k) & 1) === 1 ? 1 : 0);
  return {
    version: 1,
    scene,
    footsteps: [
      ...plan.start.map(
        (f): ResultFootstep => ({
          foot: f.foot,
          position: [f.x, f.y, f.z],
          yaw: f.yaw,
          category: null,
          phase: null,
          task: null,
          template: null,
          lift: null,
          land: 0,
        }),
      ),
      ...plan.steps.map(
        (s): ResultFootstep => ({
          foot: s.foot,
          position: [s.x, s.y, s.z],
          yaw: s.yaw,
          category: s.category,
          phase: s.phase,
          task: s.task >= 0 ? (plan.tasks[s.task]?.id ?? null) : null,
          template: s.template,
          lift: s.lift,
          land: s.land,
        }),
      ),
    ],
    contacts: Array.from(contacts, (c) => [bit(c, 0), bit(c, 1), bit(c, 2), bit(c, 3)]),
    timing: {
      rate: 60,
      tasks: plan.tasks.map((t) => ({ id: t.id, start: t.start, contact: t.contact, end: t.end })),
    },
    quality,
    warnings: plan.warnings,
  };
}

/** The footsteps of a result: the two start stances, and the steps after them. */
export function footstepsOf(result: ResultDocument): { start: Footstep[]; steps: Footstep[] } {
  const all = result.footsteps.map(
    (f): Footstep => ({ foot: f.foot, x: f.position[0], y: f.position[1], z: f.position[2], yaw: f.yaw }),
  );
  return { start: all.slice(0, 2), steps: all.slice(2) };
}
