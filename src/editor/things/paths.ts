/** Paths as things: listed and removed as a whole; their handle stands at the start. */
import { removePath, reshapePath } from "../../core/scene/commands.ts";
import { ICONS } from "../icons.ts";
import { ref } from "../selection.ts";
import type { ThingKind } from "./thing.ts";

export const pathThings: ThingKind = {
  kind: "path",
  title: "Paths",
  noun: "Path",
  order: 20,
  handle: "dot",
  hint: "Drag to move the path",
  list: (e) =>
    e.store.getState().scene.paths.map((p, i) => ({
      ref: ref("path", p.id),
      label: `Path ${i + 1}`,
      fact: `${p.points.length} points`,
      icon: ICONS.path,
      position: [p.points[0]?.[0] ?? 0, 0, p.points[0]?.[1] ?? 0],
      yaw: null,
    })),
  place(scene, r, position) {
    const path = scene.paths.find((p) => p.id === r.id);
    if (!path || path.points.length === 0) return scene;
    const dx = position[0] - path.points[0][0];
    const dz = position[2] - path.points[0][1];
    return reshapePath(
      scene,
      r.id,
      path.points.map((q) => [q[0] + dx, q[1] + dz]),
    );
  },
  remove: (scene, refs) => refs.reduce((s, r) => removePath(s, r.id), scene),
};
