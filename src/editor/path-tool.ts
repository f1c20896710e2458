/**
 * The path tool: a stroke on the floor, smoothed as it is drawn, becomes a path that the character follows at once.
 */
import type { Scene } from "../core/scene/types.ts";
import { smoothStroke } from "../core/styles/path.ts";
import type { Editor } from "./editor.ts";

/** Shortest stroke that is taken for a path, metres; and the room between its points. */
const SHORTEST = 0.6;
const SPACING = 0.3;

/** Points of a stroke some way apart, its ends included. */
function thin(stroke: readonly [number, number][]): [number, number][] {
  const out: [number, number][] = [];
  stroke.forEach((p, i) => {
    const last = out[out.length - 1];
    if (!last || Math.hypot(p[0] - last[0], p[1] - last[1]) >= SPACING) out.push(p);
    else if (i === stroke.length - 1 && out.length > 1) out[out.length - 1] = p;
  });
  return out;
}

function lengthOf(points: readonly [number, number][]): number {
  let sum = 0;
  for (let i = 1; i < points.length; i++)
    sum += Math.hypot(points[i][0] - points[i - 1][0], points[i][1] - points[i - 1][1]);
  return sum;
}

/**
 * Draws a path from a pointer that is down until it is let go: one entry of the history; Escape or a stroke of less than
 * 0.6 m leaves the scene as it was.
 *
 * @param at the floor under a pointer event, or null beyond it.
 */
export function drawPath(
  editor: Editor,
  canvas: HTMLElement,
  down: PointerEvent,
  at: (e: PointerEvent) => [number, number] | null,
): void {
  const first = at(down);
  if (!first) return;
  const samples: [number, number][] = [first];
  let id: string | null = null;
  editor.beginGesture();
  canvas.setPointerCapture(down.pointerId);
  const redraw = (): void => {
    const points = thin(smoothStroke(samples));
    if (points.length < 2 || lengthOf(points) < SHORTEST) return;
    editor.edit((scene: Scene, c) => {
      if (id !== null) return c.reshapePath(scene, id, points);
      const added = c.addPath(scene, points);
      id = added.id;
      return added.scene;
    });
  };
  const move = (e: PointerEvent): void => {
    const p = at(e);
    if (!p) return;
    samples.push(p);
    redraw();
  };
  const end = (commit: boolean): void => {
    canvas.removeEventListener("pointermove", move);
    canvas.removeEventListener("pointerup", up);
    canvas.removeEventListener("pointercancel", cancel);
    window.removeEventListener("keydown", key, true);
    editor.endGesture(commit && id !== null);
    if (commit && id !== null) editor.setTool("select");
  };
  const up = (): void => end(true);
  const cancel = (): void => end(false);
  const key = (e: KeyboardEvent): void => {
    if (e.key !== "Escape") return;
    e.preventDefault();
    e.stopPropagation();
    end(false);
  };
  canvas.addEventListener("pointermove", move);
  canvas.addEventListener("pointerup", up);
  canvas.addEventListener("pointercancel", cancel);
  window.addEventListener("keydown", key, true);
}
