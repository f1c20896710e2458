/** Planned footsteps as things: moved, turned, pinned, swapped; Delete gives them back to the planner. */
import { editFootstep, releaseFootsteps } from "../../core/scene/commands.ts";
import { type FootstepEdit, PLANT_MODES, type PlantMode, type Scene } from "../../core/scene/types.ts";
import { otherFoot } from "../../core/tasks/draft.ts";
import { nameOfStep, stepOfEdit } from "../../core/tasks/edits.ts";
import type { Plan, PlannedStep } from "../../core/tasks/plan-types.ts";
import { CATEGORY_WORDS } from "../../view/tokens.ts";
import type { Editor } from "../editor.ts";
import { ICONS } from "../icons.ts";
import { type Ref, ref } from "../selection.ts";
import type { ThingKind } from "./thing.ts";

/** The task's id in a reference; "" for steps that lead to none. */
const taskOf = (r: Ref): string | null => (r.id === "" ? null : r.id);

/** The reference of a step of the plan. */
export function stepRef(plan: Plan, index: number): Ref {
  const name = nameOfStep(plan, index);
  return ref("step", name.task ?? "", name.step);
}

/** Index in the plan of what a reference means; -1 when the plan has none such now. */
export function indexOfStep(plan: Plan, r: Ref): number {
  const named = { task: taskOf(r), step: r.index };
  return stepOfEdit(
    named,
    plan.steps,
    plan.tasks.map((t) => t.id),
  );
}

/** What the user has asked of a footstep; null when it is the planner's own. */
export function editOf(scene: Scene, r: Ref): FootstepEdit | null {
  return scene.edits.find((x) => x.task === taskOf(r) && x.step === r.index) ?? null;
}

/** Changes what is asked of a footstep. */
export function changeStep(e: Editor, r: Ref, change: Parameters<typeof editFootstep>[3]): void {
  e.edit((scene) => editFootstep(scene, taskOf(r), r.index, change));
}

/** The selected footsteps with their planned steps. */
export function selectedSteps(e: Editor): { ref: Ref; index: number; step: PlannedStep }[] {
  const { plan, selection } = e.store.getState();
  if (!plan) return [];
  return selection.flatMap((r) => {
    const index = r.kind === "step" ? indexOfStep(plan, r) : -1;
    return index >= 0 ? [{ ref: r, index, step: plan.steps[index] }] : [];
  });
}

/** The other foot takes the selected steps. */
export function swapFeet(e: Editor): void {
  for (const s of selectedSteps(e)) changeStep(e, s.ref, { foot: otherFoot(s.step.foot) });
}

/** Pins the selected footsteps where they are, or lets them go when all are pinned. */
export function togglePins(e: Editor): void {
  const { scene } = e.store.getState();
  const list = selectedSteps(e);
  const pin = !list.every((s) => editOf(scene, s.ref)?.pinned);
  for (const { ref: r, step } of list)
    changeStep(e, r, { pinned: pin, ...(pin ? { position: [step.x, step.y, step.z], yaw: step.yaw } : {}) });
}

/** What is made of the plants that the selected footsteps begin, one entry of the history. */
export function setPlants(e: Editor, plant: PlantMode): void {
  const list = selectedSteps(e);
  const done = e.edit((scene) =>
    list.reduce((s, { ref: r }) => editFootstep(s, taskOf(r), r.index, { plant }), scene),
  );
  if (done) e.announce(`Plant: ${PLANT_WORDS[plant].toLowerCase()}.`);
}

export const PLANT_WORDS: Record<PlantMode, string> = { auto: "Auto", enforce: "Enforce", never: "Never" };

/** The next of auto, enforced, never, for all selected footsteps. */
export function cyclePlants(e: Editor): void {
  const { scene } = e.store.getState();
  const first = selectedSteps(e)[0];
  if (!first) return;
  const now = editOf(scene, first.ref)?.plant ?? "auto";
  setPlants(e, PLANT_MODES[(PLANT_MODES.indexOf(now) + 1) % PLANT_MODES.length]);
}

/** Selects the footstep after the selected one, or before it; the one stood on when none is selected. */
export function walkSteps(e: Editor, by: 1 | -1): void {
  const { plan, time } = e.store.getState();
  if (!plan || plan.steps.length === 0) return;
  const now = selectedSteps(e)[0]?.index;
  const standing = plan.steps.reduce((k, s, i) => (s.land <= time ? i : k), 0);
  const to = now === undefined ? standing : now + by;
  e.scene.select([stepRef(plan, Math.max(0, Math.min(plan.steps.length - 1, to)))]);
}

export const footstepThings: ThingKind = {
  kind: "step",
  title: "Footsteps",
  noun: "Footstep",
  order: 90,
  handle: "selected",
  listed: false,
  tab: "footstep",
  hint: "Drag to move",
  list(e) {
    const { plan } = e.store.getState();
    if (!plan) return [];
    return plan.steps.map((s, i) => ({
      ref: stepRef(plan, i),
      label: `${s.foot === "left" ? "Left" : "Right"}, ${CATEGORY_WORDS[s.category].toLowerCase()}`,
      fact: `${s.land.toFixed(2)} s`,
      icon: ICONS.foot,
      position: [s.x, s.y, s.z],
      yaw: s.yaw,
    }));
  },
  place: (scene, r, position, yaw) =>
    editFootstep(scene, taskOf(r), r.index, { position: [position[0], position[1], position[2]], yaw }),
  remove: (scene, refs) =>
    releaseFootsteps(
      scene,
      refs.map((r) => ({ task: taskOf(r), step: r.index })),
    ),
  grab: (e, r, p) => e.markers.drag(r, "move", p),
};
