/** Crowds that plan their footsteps [Footsteps]. */
import { crowdAlone, crowdSession } from "../crowd/crowd-session.ts";
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
    // A crowd alone has no footsteps to show over time: the timeline is its transport.
    const fold = (): void => {
      document.documentElement.classList.toggle("crowd-alone", crowdAlone(e.store.getState().scene));
    };
    fold();
    e.store.subscribe((s) => {
      fold();
      if (s.selection === last) return;
      last = s.selection;
      const picked = s.selection.find((r) => r.kind === "crowd-walker")?.index ?? -1;
      if (picked !== session.picked) session.pick(picked);
    });
  },
};
