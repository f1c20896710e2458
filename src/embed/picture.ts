/** Where an element draws: a stage on a canvas, or nothing but a sentence where the browser has no WebGL 2. */
import { Stage } from "../view/stage.ts";
import type { Theme } from "../view/tokens.ts";
import { el } from "./dom.ts";

export interface Picture {
  stage: Stage | null;
  /** What is wrong, one sentence; null when it draws. */
  problem: string | null;
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
      stage,
      problem: null,
      resize: (width, height) => stage.resize(width, height, { left: 0, top: 0, right: 0, bottom: 0 }),
      setTheme: (t) => stage.setTheme(t),
      dispose: () => stage.dispose(),
    };
  } catch {
    canvas.remove();
    return {
      stage: null,
      problem: "This browser cannot draw the room: WebGL 2 is needed.",
      resize: () => undefined,
      setTheme: () => undefined,
      dispose: () => undefined,
    };
  }
}
