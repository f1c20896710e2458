/** The plan's footprints on the floor, and which of them is under the pointer. */
import type { Footprint } from "../../view/footprints.ts";
import { crowdAlone } from "../crowd/crowd-session.ts";
import type { Editor } from "../editor.ts";
import { indexOfStep, stepRef } from "../things/footsteps.ts";
import type { ViewportLayer } from "./layer.ts";

export function footprintLayer(e: Editor): ViewportLayer {
  const draw = (time: number): void => {
    const s = e.store.getState();
    const { plan } = s;
    if (!plan) return;
    if (crowdAlone(s.scene)) {
      e.stage.setFootprints([], s.colouring);
      return;
    }
    const at = new Map<number, { x: number; z: number; yaw: number }>();
    if (s.showBefore)
      for (const t of plan.traces) for (const [k, b] of t.before.entries()) at.set(t.first + k, b);
    const prints: Footprint[] = [
      ...plan.start.map(
        (f): Footprint => ({ ...f, category: null, phase: null, state: time > 0.5 ? "past" : "now" }),
      ),
      ...plan.steps.map((p, i): Footprint => {
        const place = at.get(i) ?? p;
        return {
          foot: p.foot,
          x: place.x,
          y: p.y,
          z: place.z,
          yaw: place.yaw,
          category: p.category,
          phase: p.phase,
          state: p.land < time - 0.9 ? "past" : p.land <= time ? "now" : "next",
        };
      }),
    ];
    const chosen = s.selection.flatMap((r) => (r.kind === "step" ? indexOfStep(plan, r) + 2 : []));
    e.stage.setFootprints(prints, s.colouring, chosen);
  };
  return {
    id: "footprints",
    update: () => draw(e.store.getState().time),
    time: (_, seconds) => draw(seconds),
    pick(ray) {
      const i = e.stage.footprintOn(ray) - 2;
      const { plan } = e.store.getState();
      return plan && i >= 0 && i < plan.steps.length ? stepRef(plan, i) : null;
    },
  };
}
