/** Crowds that plan their footsteps [Footsteps]. */
import { crowdSession } from "../crowd/crowd-session.ts";
import { steerImport } from "../formats/steersuite.ts";
import { crowdLayer } from "../layers/crowd.ts";
import { crowdTab } from "../panels/crowd.ts";
import { agentThings, goalThings, regionThings, walkerThings } from "../things/crowd.ts";
import { crowdTool } from "../tools/crowd.ts";
import type { Feature } from "./feature.ts";

export const crowds: Feature = {
  id: "crowds",
  tools: [crowdTool],
  things: [regionThings, agentThings, goalThings, walkerThings],
  tabs: [crowdTab],
  layers: [crowdLayer],
  imports: [steerImport],
  start(e) {
    const session = crowdSession(e);
    let last = e.store.getState().selection;
    e.store.subscribe((s) => {
      if (s.selection === last) return;
      last = s.selection;
      const picked = s.selection.find((r) => r.kind === "crowd-walker")?.index ?? -1;
      if (picked !== session.picked) session.pick(picked);
    });
  },
};
