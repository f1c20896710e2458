/** Room, furniture and character as the motion has them at the time shown. */
import { JOINT_COUNT } from "../../core/skeleton/joints.ts";
import type { Editor } from "../editor.ts";
import { idsOf } from "../selection.ts";
import type { ViewportLayer } from "./layer.ts";

const Q = 4 * JOINT_COUNT;

export function characterLayer(e: Editor): ViewportLayer {
  return {
    id: "character",
    update(_, what) {
      if (what === "plan") return;
      const { scene, selection } = e.store.getState();
      e.stage.setScene(scene, idsOf(selection, "task"), idsOf(e.markers.dragged, "task"));
      this.time?.(e, e.store.getState().time);
    },
    time(_, seconds) {
      const m = e.plan.motion.current;
      if (!m || m.filled === 0) return;
      const f = Math.max(0, Math.min(m.filled - 1, Math.floor(seconds * 60)));
      e.stage.setPose(m.root, 3 * f, m.rotations, Q * f);
      if (!e.scene.inGesture || m.boxes.length > 0) e.stage.setBoxes(m.boxes, f);
      e.stage.setInk(m.ink, seconds);
    },
  };
}
