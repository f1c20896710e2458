/**
 * The scene seen from above, in SVG: for browsers without WebGL 2. The same footprints, furniture and places as in the room, so that the
 * same handles work; the character is its shoulders and a nose.
 */
import type { BoxTrack } from "../core/motion/types.ts";
import type { Scene } from "../core/scene/types.ts";
import type { Footprint } from "../view/footprints.ts";
import { FOREFOOT, HEEL } from "../view/sole-outline.ts";
import { CATEGORY_COLOURS } from "../view/tokens.ts";
import { svgEl } from "./dom.ts";
import type { SceneView } from "./scene-view.ts";

/** Metres left about what is framed. */
const MARGIN = 0.9;
/** Floor that is ruled, metres from the middle, one line a metre. */
const FLOOR = 12;
/** Radius of a task's ring and of a stone, metres. */
const RING = 0.3;
const STONE = 0.2;
/** Columns of a row of a box's track. */
const BOX_ROW = 7;
const TURN = 180 / Math.PI;

export class PlanView implements SceneView {
  readonly element = svgEl("svg", {
    class: "plan",
    role: "img",
    "aria-label": "The room from above, with a character and its footprints on the floor.",
  });
  private readonly world = svgEl("g");
  private readonly things = svgEl("g");
  private readonly prints = svgEl("g");
  private readonly figure = svgEl(
    "g",
    { class: "figure" },
    svgEl("ellipse", { rx: 0.23, ry: 0.13 }),
    svgEl("path", { d: "M-0.05-0.1L0-0.19L0.05-0.1Z" }),
    svgEl("circle", { r: 0.11 }),
  );
  private size = { width: 1, height: 1 };
  /** What is fitted: least and most of x and z, metres. */
  private bounds = { x0: -2, x1: 2, z0: -2, z1: 2 };
  private carried = new Map<string, SVGElement>();

  /** @param drawn called after each change. */
  constructor(private readonly drawn: () => void) {
    const floor = svgEl("g", { class: "floor" });
    for (let k = -FLOOR; k <= FLOOR; k++)
      floor.append(
        svgEl("line", { x1: k, x2: k, y1: -FLOOR, y2: FLOOR }),
        svgEl("line", { x1: -FLOOR, x2: FLOOR, y1: k, y2: k }),
      );
    this.figure.setAttribute("visibility", "hidden");
    this.world.append(floor, this.things, this.prints, this.figure);
    this.element.append(this.world);
  }

  /** Pixels a metre, and where x = z = 0 lies: as the room is first seen, +X to the left and +Z away. */
  private get scale(): { by: number; x: number; y: number } {
    const { x0, x1, z0, z1 } = this.bounds;
    const by = Math.min(this.size.width / (x1 - x0), this.size.height / (z1 - z0));
    return {
      by,
      x: this.size.width / 2 + ((x0 + x1) / 2) * by,
      y: this.size.height / 2 + ((z0 + z1) / 2) * by,
    };
  }

  resize(width: number, height: number): void {
    this.size = { width: Math.max(1, width), height: Math.max(1, height) };
    this.lay();
  }

  private lay(): void {
    const { by, x, y } = this.scale;
    this.world.setAttribute("transform", `translate(${x} ${y}) scale(${by})`);
    this.drawn();
  }

  frame(points: readonly (readonly [number, number, number])[]): void {
    if (points.length === 0) return;
    const xs = points.map((p) => p[0]);
    const zs = points.map((p) => p[2]);
    this.bounds = {
      x0: Math.min(...xs) - MARGIN,
      x1: Math.max(...xs) + MARGIN,
      z0: Math.min(...zs) - MARGIN,
      z1: Math.max(...zs) + MARGIN,
    };
    this.lay();
  }

  setScene(scene: Scene, selected: readonly string[]): void {
    this.carried.clear();
    const furniture = scene.props.map((p) => {
      const depth = Math.max(0.06, p.size[2]);
      const box = svgEl("rect", {
        class: `prop ${p.kind}`,
        x: -p.size[0] / 2,
        y: -depth / 2,
        width: p.size[0],
        height: depth,
        rx: 0.02,
        transform: placed(p.position[0], p.position[2], p.yaw),
      });
      if (p.kind === "box") {
        const task = nearestLift(scene, p.position);
        if (task !== null) this.carried.set(task, box);
      }
      return box;
    });
    const paths = scene.paths.map((p) =>
      svgEl("polyline", { class: "path", points: p.points.map((q) => `${-q[0]},${-q[1]}`).join(" ") }),
    );
    const stones = scene.stones.map((s) =>
      svgEl("circle", { class: "stone", cx: -s.position[0], cy: -s.position[2], r: STONE }),
    );
    const rings = scene.tasks.map((t) =>
      svgEl("circle", {
        class: selected.includes(t.id) ? "ring chosen" : "ring",
        cx: -t.position[0],
        cy: -t.position[2],
        r: RING,
      }),
    );
    this.things.replaceChildren(...furniture, ...stones, ...paths, ...rings);
    this.drawn();
  }

  setFootprints(prints: Footprint[]): void {
    this.prints.replaceChildren(
      ...prints.map((p) => {
        const colour = p.category ? CATEGORY_COLOURS[p.category].fill : "none";
        const side = p.foot === "left" ? -1 : 1;
        return svgEl(
          "g",
          {
            class: "print",
            fill: colour,
            opacity: p.state === "past" ? 0.45 : 1,
            transform: `${placed(p.x, p.z, p.yaw)} scale(${0.00116 * side} 0.00116)`,
          },
          svgEl("path", { d: FOREFOOT }),
          svgEl("path", { d: HEEL }),
        );
      }),
    );
    this.drawn();
  }

  setPose(root: ArrayLike<number>, r: number, rotations: ArrayLike<number>, o: number): void {
    const [x, y, z, w] = [rotations[o], rotations[o + 1], rotations[o + 2], rotations[o + 3]];
    const yaw = Math.atan2(2 * (x * z + w * y), 1 - 2 * (x * x + y * y));
    this.figure.setAttribute("transform", placed(root[r], root[r + 2], yaw));
    this.figure.setAttribute("visibility", "visible");
  }

  setBoxes(tracks: readonly BoxTrack[], frame: number): void {
    for (const t of tracks) {
      const box = this.carried.get(t.lift);
      const row = Math.max(0, Math.min(t.frames - 1, frame - t.first));
      if (!box || t.frames === 0 || frame < t.first) continue;
      const [px, , pz, x, y, z, w] = t.transforms.subarray(BOX_ROW * row, BOX_ROW * (row + 1));
      box.setAttribute("transform", placed(px, pz, Math.atan2(2 * (x * z + w * y), 1 - 2 * (x * x + y * y))));
    }
  }

  /** What is written on a board is not seen from above. */
  setInk(): void {
    return;
  }

  /** A plan is not turned. */
  setOrbit(): void {
    return;
  }

  project(x: number, _y: number, z: number): { x: number; y: number; visible: boolean } {
    const s = this.scale;
    return { x: s.x - x * s.by, y: s.y - z * s.by, visible: true };
  }

  levelPoint(x: number, y: number): [number, number] {
    const s = this.scale;
    return [(s.x - x) / s.by, (s.y - y) / s.by];
  }

  dispose(): void {
    this.element.remove();
  }
}

/** What is drawn about (0, 0) with its front upwards, at a place of the floor. */
function placed(x: number, z: number, yaw: number): string {
  return `translate(${-x} ${-z}) rotate(${-yaw * TURN})`;
}

/** The lift that takes a box: the nearest, within reach of one. */
function nearestLift(scene: Scene, at: readonly [number, number, number]): string | null {
  let best: string | null = null;
  let least = 0.6;
  for (const t of scene.tasks) {
    const d = Math.hypot(t.position[0] - at[0], t.position[2] - at[2]);
    if (t.category === "lift" && d < least) [best, least] = [t.id, d];
  }
  return best;
}
