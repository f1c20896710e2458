/** The timeline's strips: what rests of each foot, when, and of which step. */
import { feetSvg } from "../../plots/timeline-strip.ts";
import { CATEGORY_COLOURS, CATEGORY_WORDS } from "../../view/tokens.ts";
import type { Lane } from "./lane.ts";

const NONE = new Uint8Array(0);

export const feetLane: Lane = {
  id: "feet",
  order: 30,
  shown: () => true,
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
        })),
        colours: CATEGORY_COLOURS,
        words: CATEGORY_WORDS,
        hover: s.hoverStep,
      },
      frame.x,
      frame.height,
    );
  },
  hover(e, target) {
    const step = target?.closest("[data-step]")?.getAttribute("data-step");
    e.hoverStep(step ? Number(step) : -1);
  },
};
