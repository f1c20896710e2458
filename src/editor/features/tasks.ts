/** Tasks: put down, moved, planned for; the plan and its motion as files [TaskLoco]. */
import { motionExports } from "../formats/motion.ts";
import { resultExport } from "../formats/result-json.ts";
import { feetLane } from "../lanes/feet.ts";
import { taskLane } from "../lanes/tasks.ts";
import { footprintLayer } from "../layers/footprints.ts";
import { planTab } from "../panels/plan.ts";
import { taskTab } from "../panels/task.ts";
import { stands } from "../parts/timeline.ts";
import { taskThings } from "../things/tasks.ts";
import { taskTool } from "../tools/task.ts";
import type { Feature } from "./feature.ts";

export const tasks: Feature = {
  id: "tasks",
  tools: [taskTool],
  things: [taskThings],
  tabs: [taskTab, planTab],
  lanes: [taskLane, feetLane],
  layers: [footprintLayer],
  exports: [...motionExports, resultExport],
  start(e) {
    e.store.subscribe(() => document.documentElement.classList.toggle("stands", stands(e)));
  },
  keys: [
    {
      keys: ["K"],
      label: "Colours: category, phase",
      group: "Scene",
      run: (e) =>
        e.showFootprints({
          colouring: e.store.getState().colouring === "phase" ? "category" : "phase",
        }),
    },
  ],
};
