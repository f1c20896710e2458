/** Tasks: put down, moved, planned for; the plan and its motion as files [TaskLoco]. */
import { bvhExport } from "../formats/bvh.ts";
import { resultExport } from "../formats/result-json.ts";
import { feetLane } from "../lanes/feet.ts";
import { taskLane } from "../lanes/tasks.ts";
import { footprintLayer } from "../layers/footprints.ts";
import { planTab } from "../panels/plan.ts";
import { taskTab } from "../panels/task.ts";
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
  exports: [bvhExport, resultExport],
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
