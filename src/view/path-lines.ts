/** Paths on the floor: a line each, coloured by the styles painted along it. */
import { BufferGeometry, Float32BufferAttribute, Group, Line, LineBasicMaterial } from "three";
import type { ScenePath } from "../core/scene/types.ts";
import { createPath, placeOnPath } from "../core/styles/path.ts";
import { styleColour } from "./tokens.ts";

/** Height over the floor and distance of the line's points, metres. */
const OVER = 0.006;
const STEP = 0.05;

export class PathLines {
  readonly group = new Group();

  /** Draws paths anew; one that is too short to follow is left out. */
  set(paths: readonly ScenePath[]): void {
    for (const o of this.group.children)
      if (o instanceof Line) {
        o.geometry.dispose();
        o.material.dispose();
      }
    this.group.clear();
    const place = new Float64Array(2);
    for (const p of paths) {
      const [a, b] = [p.points[0], p.points[p.points.length - 1]];
      if (!a || p.points.length < 2 || p.points.every((q) => Math.hypot(q[0] - a[0], q[1] - b[1]) < 1e-3))
        continue;
      const path = createPath(p.points, p.smooth);
      const changes = [{ at: 0, style: "walking" }, ...p.styles];
      changes.forEach((c, i) => {
        const from = c.at * path.length;
        const to = (changes[i + 1]?.at ?? 1) * path.length;
        if (to - from < 1e-6) return;
        const n = Math.max(2, Math.ceil((to - from) / STEP) + 1);
        const points: number[] = [];
        for (let k = 0; k < n; k++) {
          placeOnPath(place, path, from + ((to - from) * k) / (n - 1));
          points.push(place[0], OVER, place[1]);
        }
        const geometry = new BufferGeometry();
        geometry.setAttribute("position", new Float32BufferAttribute(points, 3));
        this.group.add(new Line(geometry, new LineBasicMaterial({ color: styleColour(c.style) })));
      });
    }
  }
}
