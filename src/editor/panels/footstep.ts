/** The footstep chosen: what the plan made of it, and what the user asks of it. */
import { html, nothing, type TemplateResult } from "lit";
import { PLANT_MODES, type PlantMode } from "../../core/scene/types.ts";
import { restOf } from "../../core/tasks/edits.ts";
import { CATEGORY_COLOURS, CATEGORY_WORDS } from "../../view/tokens.ts";
import type { Editor } from "../editor.ts";
import { ICONS } from "../icons.ts";
import { numberField } from "../parts/number-field.ts";
import { schemaRows } from "../parts/schema-rows.ts";
import {
  changeStep,
  editOf,
  footstepThings,
  PLANT_WORDS,
  selectedSteps,
  setPlants,
  swapFeet,
  togglePins,
} from "../things/footsteps.ts";
import type { PanelTab } from "./panel-tab.ts";

const PHASE_WORDS = { exit: "Exit", locomotion: "Locomotion", enter: "Enter" } as const;

export const footstepTab: PanelTab = {
  id: "footstep",
  order: 20,
  label: () => "Footstep",
  shown: (e) => selectedSteps(e).length > 0,
  draw(e) {
    const list = selectedSteps(e);
    return list.length === 1 ? one(e, list[0]) : several(e, list.length);
  },
};

function several(e: Editor, count: number): TemplateResult {
  return html`<section class="section">
    <header><h2>${count} footsteps</h2></header>
    <p class="note">Arrows move them together; Q swaps their feet.</p>
    ${plants(e, shared(e))}
    ${actions(e)}
  </section>`;
}

/** What the plants of all selected footsteps have in common; null when they differ. */
function shared(e: Editor): PlantMode | null {
  const { scene } = e.store.getState();
  const modes = new Set(selectedSteps(e).map((s) => editOf(scene, s.ref)?.plant ?? "auto"));
  return modes.size === 1 ? ([...modes][0] ?? null) : null;
}

function actions(e: Editor): TemplateResult {
  const { scene, selection } = e.store.getState();
  const touched = selectedSteps(e).some((s) => editOf(scene, s.ref));
  return html`<div class="actions">
    <button class="button" @click=${() => swapFeet(e)}>Swap the foot <span class="kbd">Q</span></button>
    ${touched ? html`<button class="plain" @click=${() => e.edit((s) => footstepThings.remove(s, selection))}>Back to the plan</button>` : nothing}
  </div>`;
}

/** Whether the plant that follows the landing is held, left to the capture, or rolls as planned. */
function plants(e: Editor, now: PlantMode | null): TemplateResult {
  return html`<div class="row"><span>Plant</span><div class="segments" role="group" aria-label="Plant">
    ${PLANT_MODES.map((m) => html`<button aria-pressed=${m === now} title=${PLANT_HINTS[m]} @click=${() => setPlants(e, m)}>${PLANT_WORDS[m]}</button>`)}
  </div></div>`;
}

const PLANT_HINTS: Record<PlantMode, string> = {
  auto: "Heel and toe rest as the capture rolls them",
  enforce: "Heel and toe rest from landing to lift",
  never: "Nothing holds the foot; no contact is claimed",
};

function one(e: Editor, { ref: r, index, step }: ReturnType<typeof selectedSteps>[number]): TemplateResult {
  const { scene, plan } = e.store.getState();
  const edit = editOf(scene, r);
  // Where the plan has it, which is where it was put unless no leg reaches there.
  const where = { position: [step.x, step.y, step.z], yaw: step.yaw };
  const rest = plan ? restOf(plan.steps, index) : null;
  const which = edit ? scene.edits.indexOf(edit) : -1;
  const warning = plan?.warnings.find((w) => w.startsWith(`edits[${which}]`));
  const own = edit ? "" : "from the plan";
  return html`<section class="section">
    <div class="subject"><span class="glyph" style="background: ${CATEGORY_COLOURS[step.category].fill}; color: ${CATEGORY_COLOURS[step.category].mark}">${ICONS.foot}</span><div><h2>${step.foot === "left" ? "Left foot" : "Right foot"}</h2><span class="note">${CATEGORY_WORDS[step.category]} · ${index + 1} of ${plan?.steps.length ?? 0} · ${step.lift.toFixed(2)} to ${step.land.toFixed(2)} s</span></div></div>
    <div class="row"><span>In the air</span>${numberField(e, "Seconds in the air", "", (step.land - step.lift).toFixed(2), "s", (v) => changeStep(e, r, { lift: step.lift, land: step.lift + Math.max(0.1, v) }))}</div>
    ${schemaRows(e, "edit", {
      values: edit ? { ...edit, ...where, rest } : { ...where, pinned: false, plant: "auto", rest },
      except: rest === null ? ["rest"] : [],
      hints: PLANT_HINTS,
      set(key, value) {
        if (key === "pinned") togglePins(e);
        else if (key === "plant") setPlants(e, value as PlantMode);
        else
          changeStep(
            e,
            r,
            key === "position"
              ? { position: value as [number, number, number], yaw: step.yaw }
              : { [key]: value },
          );
      },
    })}
    <div class="row"><span>Phase</span><span>${PHASE_WORDS[step.phase]}<span class="from-plan">${own}</span></span></div>
    ${warning ? html`<p class="error">${warning.replace(/^edits\[\d+\](\.\w+)?: /, "")}</p>` : nothing}
    ${actions(e)}
  </section>`;
}
