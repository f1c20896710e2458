/** Paths as things: a path is picked and moved on the floor as a whole; each of its points has a handle. */
import { removePath, reshapePath } from "../../core/scene/commands.ts";
import type { Scene } from "../../core/scene/types.ts";
import type { Editor } from "../editor.ts";
import { ICONS } from "../icons.ts";
import { type Ref, ref } from "../selection.ts";
import type { ThingKind } from "./thing.ts";

type Point = [number, number];

const pathOf = (scene: Scene, id: string) => scene.paths.find((p) => p.id === id);

function lengthOf(points: readonly (readonly [number, number])[]): number {
  let sum = 0;
  for (let i = 1; i < points.length; i++)
    sum += Math.hypot(points[i][0] - points[i - 1][0], points[i][1] - points[i - 1][1]);
  return sum;
}

function shifted(scene: Scene, id: string, dx: number, dz: number): Scene {
  const path = pathOf(scene, id);
  return path
    ? reshapePath(
        scene,
        id,
        path.points.map((q): Point => [q[0] + dx, q[1] + dz]),
      )
    : scene;
}

export const pathThings: ThingKind = {
  kind: "path",
  title: "Paths",
  noun: "Path",
  order: 20,
  handle: "none",
  tab: "path",
  list: (e) =>
    e.store.getState().scene.paths.map((p, i) => ({
      ref: ref("path", p.id),
      label: `Path ${i + 1}`,
      fact: `${lengthOf(p.points).toFixed(1)} m`,
      icon: ICONS.path,
      position: [p.points[0]?.[0] ?? 0, 0, p.points[0]?.[1] ?? 0],
      yaw: null,
    })),
  place(scene, r, position) {
    const start = pathOf(scene, r.id)?.points[0];
    return start ? shifted(scene, r.id, position[0] - start[0], position[2] - start[1]) : scene;
  },
  remove: (scene, refs) => refs.reduce((s, r) => removePath(s, r.id), scene),
  grab(e, r, p) {
    const from = p.level(0);
    const start = pathOf(e.scene.scene, r.id)?.points[0];
    if (!from || !start) return null;
    return {
      move(m) {
        const at = m.level(0);
        if (!at) return;
        const to = e.snapped([start[0] + at[0] - from[0], start[1] + at[1] - from[1]], m.event);
        e.edit((scene) => pathThings.place(scene, r, [to[0], 0, to[1]], 0));
      },
    };
  },
};

/** Whether points have their handles: the path tool is at hand, or the path or a point of it is selected. */
function open(e: Editor, id: string): boolean {
  const { tool, selection, tab } = e.store.getState();
  return tool === "path" || tab === "path" || selection.some((r) => r.id === id);
}

/** A path without some of its points; without the path when fewer than two are left. */
function without(scene: Scene, id: string, gone: ReadonlySet<number>): Scene {
  const path = pathOf(scene, id);
  if (!path) return scene;
  const left = path.points.filter((_, k) => !gone.has(k));
  return left.length < 2 ? removePath(scene, id) : reshapePath(scene, id, left);
}

export const pathPointThings: ThingKind = {
  kind: "point",
  title: "Points",
  noun: "Point",
  order: 21,
  handle: "dot",
  listed: false,
  tab: "path",
  hint: "Drag to bend. Double-click removes",
  list: (e) =>
    e.store.getState().scene.paths.flatMap((p, i) =>
      open(e, p.id)
        ? p.points.map((q, k) => ({
            ref: ref("point", p.id, k),
            label: `Path ${i + 1}, point ${k + 1}`,
            icon: ICONS.path,
            position: [q[0], 0, q[1]] as const,
            yaw: null,
          }))
        : [],
    ),
  place(scene, r, position) {
    const path = pathOf(scene, r.id);
    return path
      ? reshapePath(
          scene,
          r.id,
          path.points.map((q, k): Point => (k === r.index ? [position[0], position[2]] : [q[0], q[1]])),
        )
      : scene;
  },
  remove(scene, refs) {
    const gone = new Map<string, Set<number>>();
    for (const r of refs) gone.set(r.id, (gone.get(r.id) ?? new Set()).add(r.index));
    return [...gone].reduce((s, [id, points]) => without(s, id, points), scene);
  },
  activate: (e, r) => void removePoint(e, r),
};

/** Takes a point away; the path goes when fewer than two would be left. */
export function removePoint(e: Editor, r: Ref): void {
  e.scene.select([]);
  e.edit((scene) => pathPointThings.remove(scene, [r]));
}
