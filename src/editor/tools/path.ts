/**
 * The path tool: a stroke on the floor, smoothed as it is drawn, becomes a path that the character follows at once.
 */
import { smoothStroke } from "../../core/styles/path.ts";
import { ICONS } from "../icons.ts";
import { ref } from "../selection.ts";
import type { Tool } from "./tool.ts";

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

/** A stroke of less than 0.6 m leaves the scene as it was. */
export const pathTool: Tool = {
  id: "path",
  label: "Path",
  icon: ICONS.path,
  key: "P",
  order: 20,
  cursor: "crosshair",
  down(e, p) {
    const first = p.level(0);
    if (!first) return null;
    const samples: [number, number][] = [first];
    let id: string | null = null;
    return {
      move(m) {
        const at = m.level(0);
        if (!at) return;
        samples.push(at);
        const points = thin(smoothStroke(samples));
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
  },
};
