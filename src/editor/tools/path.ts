/**
 * The path tool, freehand or point by point. A stroke is smoothed as it is drawn and becomes a path of few points that can be
 * bent afterwards; with points, a click on the floor adds one at the end and a click on the path puts one there.
 */
import { html, svg } from "lit";
import { type MotionPath, nearestOnPath, simplifyStroke, smoothStroke } from "../../core/styles/path.ts";
import type { Editor } from "../editor.ts";
import { ICONS } from "../icons.ts";
import { markFloor, pathNear } from "../layers/path-bands.ts";
import { onlyId, ref } from "../selection.ts";
import type { Gesture, Tool, ToolPointer } from "./tool.ts";

/** Shortest stroke that is taken for a path; how near its points keep to it, and how far apart they are at most; metres. */
const SHORTEST = 0.6;
const KEEPS = 0.03;
const APART = 1.2;

function lengthOf(points: readonly (readonly [number, number])[]): number {
  let sum = 0;
  for (let i = 1; i < points.length; i++)
    sum += Math.hypot(points[i][0] - points[i - 1][0], points[i][1] - points[i - 1][1]);
  return sum;
}

/** A stroke of less than 0.6 m leaves the scene as it was. */
function stroke(e: Editor, first: [number, number]): Gesture {
  const samples: [number, number][] = [first];
  let id: string | null = null;
  return {
    move(m) {
      const at = m.level(0);
      if (!at) return;
      samples.push(at);
      const points = simplifyStroke(smoothStroke(samples), KEEPS, APART);
      if (points.length < 2 || lengthOf(points) < SHORTEST) return;
      e.edit((scene, c) => {
        if (id !== null) return c.reshapePath(scene, id, points);
        const added = c.addPath(scene, points);
        id = added.id;
        return added.scene;
      });
    },
    up() {
      if (id === null) return false;
      e.tools.use("select");
      e.scene.select([ref("path", id)]);
      return true;
    },
  };
}

/** First point of a path that has only one yet. */
let pending: [number, number] | null = null;

function setPending(e: Editor, at: [number, number] | null): void {
  pending = at;
  markFloor(e, at);
}

/** The path that points are added to: the selected one; else a new one begins. */
function target(e: Editor): string | null {
  const { selection, scene } = e.store.getState();
  const chosen = onlyId(selection, "path") ?? onlyId(selection, "point");
  return chosen !== null && scene.paths.some((p) => p.id === chosen) ? chosen : null;
}

function point(e: Editor, at: [number, number], p: ToolPointer): Gesture | null {
  const place = e.snapped(at, p.event);
  const near = pathNear(e, at);
  const path = e.scene.scene.paths.find((x) => x.id === (near?.id ?? target(e)));
  if (!path) {
    if (!pending) {
      setPending(e, place);
      return { plain: true, move: () => undefined };
    }
    const first = pending;
    setPending(e, null);
    return drag(e, () => {
      let id = "";
      e.edit((scene, c) => {
        const added = c.addPath(scene, [first, place]);
        id = added.id;
        return added.scene;
      });
      return { id, index: 1 };
    });
  }
  const index = near ? indexAt(path.points, near.curve, near.metres) : path.points.length;
  return drag(e, () => {
    const to = near ? at : place;
    e.edit((scene, c) =>
      c.reshapePath(scene, path.id, [...path.points.slice(0, index), to, ...path.points.slice(index)]),
    );
    return { id: path.id, index };
  });
}

/** Where a point at a distance along the curve stands in the list of points. */
function indexAt(points: readonly (readonly [number, number])[], curve: MotionPath, metres: number): number {
  let k = 1;
  while (k < points.length - 1 && nearestOnPath(curve, points[k][0], points[k][1]).at < metres) k++;
  return k;
}

/** A new point follows the pointer until it is let go. */
function drag(e: Editor, add: () => { id: string; index: number }): Gesture {
  let mine: { id: string; index: number } | null = null;
  const begin = () => {
    mine ??= add();
    return mine;
  };
  return {
    move(m) {
      const at = m.level(0);
      if (!at) return;
      const { id, index } = begin();
      const to = e.snapped(at, m.event);
      e.edit((scene, c) => {
        const path = scene.paths.find((x) => x.id === id);
        return path
          ? c.reshapePath(
              scene,
              id,
              path.points.map((q, k) => (k === index ? to : q)),
            )
          : scene;
      });
    },
    up() {
      const { id, index } = begin();
      e.scene.select([ref("point", id, index)]);
      return true;
    },
  };
}

const small = (body: ReturnType<typeof svg>) =>
  html`<svg viewBox="0 0 18 18" aria-hidden="true">${body}</svg>`;

export const pathTool: Tool = {
  id: "path",
  label: "Path",
  icon: ICONS.path,
  key: "P",
  order: 20,
  cursor: "crosshair",
  choices: [
    { id: "draw", label: "Draw", icon: small(svg`<path d="M3 14c3-9 5 3 7-3s3-6 5-7" />`), key: "" },
    {
      id: "points",
      label: "Points",
      icon: small(
        svg`<path d="M4 14L9 6l5 5" /><circle cx="4" cy="14" r="1.600" /><circle cx="9" cy="6" r="1.600" /><circle cx="14" cy="11" r="1.600" />`,
      ),
      key: "",
    },
  ],
  enter: (e) => e.set({ tab: "path" }),
  leave: (e) => setPending(e, null),
  down(e, p) {
    const first = p.level(0);
    if (!first) return null;
    return e.store.getState().choice === "points" ? point(e, first, p) : stroke(e, first);
  },
  hover(e, p) {
    if (e.store.getState().choice !== "points") return;
    const at = p.level(0);
    if (!pending) markFloor(e, at && pathNear(e, at) ? at : null);
  },
  keydown(e, ev) {
    if (ev.key !== "Enter" || e.store.getState().choice !== "points") return false;
    setPending(e, null);
    e.tools.use("select");
    return true;
  },
};
