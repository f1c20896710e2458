/** The timeline's strips: what rests of each foot, when, and of which step. */
import { restOf } from "../../core/tasks/edits.ts";
import { feetSvg } from "../../plots/timeline-strip.ts";
import { CATEGORY_COLOURS, CATEGORY_WORDS } from "../../view/tokens.ts";
import { crowdAlone } from "../crowd/crowd-session.ts";
import type { Editor } from "../editor.ts";
import type { Ref } from "../selection.ts";
import { changeStep, selectedSteps, stepRef } from "../things/footsteps.ts";
import type { Gesture } from "../tools/tool.ts";
import type { Lane, LaneFrame } from "./lane.ts";

const NONE = new Uint8Array(0);

/** The lift is dragged: the foot rests longer or shorter, and what follows moves along. */
function stretchRest(e: Editor, r: Ref, index: number, ev: PointerEvent, frame: LaneFrame): Gesture | null {
  const { plan } = e.store.getState();
  const rest = plan ? restOf(plan.steps, index) : null;
  if (!plan || rest === null) return null;
  const { land } = plan.steps[index];
  const perPixel = (frame.seconds(frame.x(land) + 100) - land) / 100;
  return {
    move: (p) => changeStep(e, r, { rest: Math.max(0.05, rest + (p.event.clientX - ev.clientX) * perPixel) }),
  };
}

export const feetLane: Lane = {
  id: "feet",
  order: 30,
  shown: (e) => !crowdAlone(e.store.getState().scene),
  height: () => 76,
  draw(e, frame) {
    const s = e.store.getState();
    const motion = e.plan.motion.current;
    return feetSvg(
      {
        time: s.time,
        contacts: motion ? motion.contacts.subarray(0, motion.filled) : NONE,
        steps: (s.plan?.steps ?? []).map((p, index) => ({
          foot: p.foot,
          category: p.category,
          lift: p.lift,
          land: p.land,
          index,
          plant: p.plant,
        })),
        colours: CATEGORY_COLOURS,
        words: CATEGORY_WORDS,
        hover: s.hoverStep,
        selected: selectedSteps(e).map((x) => x.index),
      },
      frame.x,
      frame.height,
    );
  },
  down(e, target, frame, ev) {
    const { plan } = e.store.getState();
    const edge = target.closest("[data-edge]")?.getAttribute("data-edge");
    const bar = target.closest("[data-step]")?.getAttribute("data-step");
    const end = target.closest("[data-lift]")?.getAttribute("data-lift");
    const index = Number(edge ?? end ?? bar ?? -1);
    const step = plan?.steps[index];
    if (!plan || !step) return null;
    const r = stepRef(plan, index);
    e.scene.select([r]);
    if (end) return stretchRest(e, r, index, ev, frame);
    if (!edge) return { plain: true, move: () => undefined };
    // The landing is dragged: the foot is longer or shorter in the air, and what follows moves along.
    const { lift, land } = step;
    const perPixel = frame.seconds(frame.x(lift) + 100) - lift;
    return {
      move(p) {
        const by = ((p.event.clientX - ev.clientX) * perPixel) / 100;
        changeStep(e, r, { lift, land: Math.max(lift + 0.1, land + by) });
      },
    };
  },
  keydown(e, target, ev) {
    const { plan } = e.store.getState();
    const bar = target.closest("[data-step]")?.getAttribute("data-step");
    if (!plan || bar === null || bar === undefined || (ev.key !== "Enter" && ev.key !== " ")) return false;
    e.scene.select([stepRef(plan, Number(bar))]);
    return true;
  },
  hover(e, target) {
    const step = target?.closest("[data-step]")?.getAttribute("data-step");
    e.hoverStep(step ? Number(step) : -1);
  },
};
