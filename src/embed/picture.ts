/** Where an element draws: a stage on a canvas, or a plan seen from above where the browser has no WebGL 2. */
import { Stage } from "../view/stage.ts";
import type { Theme } from "../view/tokens.ts";
import { el } from "./dom.ts";
import { PlanView } from "./plan-view.ts";
import type { SceneView } from "./scene-view.ts";

export interface Picture {
  view: SceneView;
  /** Why it is seen from above, one sentence; null when it is the room. */
  note: string | null;
  resize(width: number, height: number): void;
  setTheme(theme: Theme): void;
  dispose(): void;
}

/** A picture in `box`; `drawnOnce` is called after each frame. */
export function drawOn(box: HTMLElement, theme: Theme, drawnOnce: () => void): Picture {
  const canvas = el("canvas", {
    role: "img",
    "aria-label": "A room with a character and its footprints on the floor.",
  });
  box.prepend(canvas);
  try {
    const stage = new Stage(canvas);
    stage.setTheme(theme);
    stage.onDraw = drawnOnce;
    return {
      view: stage,
      note: null,
      resize: (width, height) => stage.resize(width, height, { left: 0, top: 0, right: 0, bottom: 0 }),
      setTheme: (t) => stage.setTheme(t),
      dispose: () => stage.dispose(),
    };
  } catch {
    canvas.remove();
    const plan = new PlanView(drawnOnce);
    box.prepend(plan.element);
    return {
      view: plan,
      note: "Seen from above: this browser has no WebGL 2, which the room needs.",
      resize: (width, height) => plan.resize(width, height),
      // Its colours are the style sheet's.
      setTheme: () => undefined,
      dispose: () => plan.dispose(),
    };
  }
}
