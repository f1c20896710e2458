/** Planned footsteps edited by hand: the planner answers around them. */
import type { Editor } from "../editor.ts";
import { footstepTab } from "../panels/footstep.ts";
import {
  cyclePlants,
  footstepThings,
  selectedSteps,
  swapFeet,
  togglePins,
  walkSteps,
} from "../things/footsteps.ts";
import type { Feature } from "./feature.ts";

const some = (e: Editor): boolean => selectedSteps(e).length > 0;

export const footsteps: Feature = {
  id: "footsteps",
  things: [footstepThings],
  tabs: [footstepTab],
  keys: [
    { keys: ["Q"], label: "Swap the foot", group: "Selected", when: some, run: swapFeet },
    { keys: ["I"], label: "Pin the footstep", group: "Selected", when: some, run: togglePins },
    { keys: ["M"], label: "Plant: auto, enforced, never", group: "Selected", when: some, run: cyclePlants },
    { keys: ["]"], label: "Select the next footstep", group: "Selected", run: (e) => walkSteps(e, 1) },
    { keys: ["["], label: "Select the footstep before", group: "Selected", run: (e) => walkSteps(e, -1) },
  ],
};
