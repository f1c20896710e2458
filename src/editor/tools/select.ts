/** The select tool: a click on the floor lets go of the selection; dragging the room turns the camera. */
import type { Editor } from "../editor.ts";
import { ICONS } from "../icons.ts";
import { hasRef } from "../selection.ts";
import type { Gesture, Tool, ToolPointer } from "./tool.ts";

/** Pixels that a click may wander. */
const CLICK = 4;

/** A box drawn over the viewport: things whose handles lie in it are selected, with those that were. */
function boxSelect(e: Editor, from: ToolPointer): Gesture {
  const before = e.store.getState().selection;
  const box = document.createElement("div");
  box.className = "select-box";
  e.markers.overlay.append(box);
  return {
    plain: true,
    move(p) {
      const [x0, x1] = [Math.min(from.x, p.x), Math.max(from.x, p.x)];
      const [y0, y1] = [Math.min(from.y, p.y), Math.max(from.y, p.y)];
      Object.assign(box.style, {
        left: `${x0}px`,
        top: `${y0}px`,
        width: `${x1 - x0}px`,
        height: `${y1 - y0}px`,
      });
      const inside = e
        .things()
        .filter((t) => e.registry.thing(t.ref.kind)?.shown?.(e) !== false)
        .filter((t) => {
          const at = e.stage.project(...t.position);
          return at.visible && at.x >= x0 && at.x <= x1 && at.y >= y0 && at.y <= y1;
        })
        .map((t) => t.ref);
      e.scene.select([...before, ...inside.filter((r) => !hasRef(before, r))], false);
    },
    up() {
      box.remove();
      return true;
    },
    cancel() {
      box.remove();
      e.scene.select(before, false);
    },
  };
}

export const selectTool: Tool = {
  id: "select",
  label: "Select",
  icon: ICONS.select,
  key: "V",
  order: 0,
  down(e, p) {
    if (p.event.shiftKey) return boxSelect(e, p);
    const hit = e.layers.pick(p.x, p.y);
    if (hit) {
      const gesture = e.registry.thing(hit.kind)?.grab?.(e, hit, p) ?? null;
      e.scene.select([hit]);
      return gesture;
    }
    // The camera turns; only a click that goes nowhere lets go of the selection.
    window.addEventListener(
      "pointerup",
      (up) => {
        if (Math.hypot(up.clientX - p.event.clientX, up.clientY - p.event.clientY) < CLICK)
          e.scene.select([]);
      },
      { once: true },
    );
    return null;
  },
  hover(e, p) {
    const hit = e.layers.pick(p.x, p.y);
    e.hoverStep(hit?.kind === "step" ? hit.index : -1);
  },
};
