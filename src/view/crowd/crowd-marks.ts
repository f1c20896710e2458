/** What a crowd's plan looks like on the floor: areas, goals, surfaces, and a picked walker's circles, search tree and way. */
import {
  BufferGeometry,
  Color,
  Float32BufferAttribute,
  Group,
  LineBasicMaterial,
  LineSegments,
  Mesh,
  MeshBasicMaterial,
} from "three";
import { ROOMS, type Theme } from "../tokens.ts";

export interface CrowdMarksData {
  /** x0, x1, z0, z1. */
  regions: readonly { bounds: readonly [number, number, number, number]; selected: boolean }[];
  surfaces: readonly (readonly [number, number, number, number])[];
  goals: readonly { x: number; z: number; selected: boolean }[];
  /** x, z, radius. */
  circles: readonly (readonly [number, number, number])[];
  /** Pairs of points x, z: edges of the search tree, and of the path taken. */
  tree: readonly number[];
  path: readonly number[];
}

/** Heights over the floor, metres: bands, marks and lines lie on each other without a flicker. */
const SURFACE = 0.0012;
const AREA = 0.0018;
const LINE = 0.006;

export class CrowdMarks {
  readonly group = new Group();
  private readonly lines: LineSegments[];
  private readonly fills: Mesh[];
  private data: CrowdMarksData | null = null;

  constructor() {
    const line = (opacity: number): LineSegments =>
      new LineSegments(
        new BufferGeometry(),
        new LineBasicMaterial({
          transparent: true,
          opacity,
          depthWrite: false,
          toneMapped: false,
          fog: false,
        }),
      );
    const fill = (opacity: number): Mesh =>
      new Mesh(
        new BufferGeometry(),
        new MeshBasicMaterial({
          transparent: true,
          opacity,
          depthWrite: false,
          toneMapped: false,
          fog: false,
        }),
      );
    // Quiet outlines, the tree, the path taken, the circles.
    this.lines = [line(0.55), line(0.16), line(0.9), line(0.75)];
    this.fills = [fill(0.05), fill(0.09), fill(0.1)];
    for (const m of [...this.fills, ...this.lines]) {
      m.frustumCulled = false;
      m.renderOrder = 3;
      this.group.add(m);
    }
    this.setTheme("light");
  }

  setTheme(theme: Theme): void {
    const ink = new Color(ROOMS[theme].ink);
    for (const m of [...this.fills, ...this.lines])
      (m.material as MeshBasicMaterial | LineBasicMaterial).color.copy(ink);
  }

  set(data: CrowdMarksData): void {
    if (data === this.data) return;
    this.data = data;
    const outline: number[] = [];
    const quiet: number[] = [];
    const chosen: number[] = [];
    const surface: number[] = [];
    for (const r of data.regions) {
      rectangle(r.selected ? chosen : quiet, r.bounds, AREA);
      border(outline, r.bounds, LINE);
    }
    for (const s of data.surfaces) rectangle(surface, s, SURFACE);
    for (const g of data.goals) {
      ring(outline, g.x, g.z, 0.3, LINE);
      ring(outline, g.x, g.z, 0.06, LINE);
      if (g.selected) ring(outline, g.x, g.z, 0.34, LINE);
    }
    const circles: number[] = [];
    for (const [x, z, r] of data.circles) ring(circles, x, z, r, LINE + 0.002);
    put(this.fills[0], quiet);
    put(this.fills[1], chosen);
    put(this.fills[2], surface);
    put(this.lines[0], outline);
    put(this.lines[1], flat(data.tree, LINE));
    put(this.lines[2], flat(data.path, LINE + 0.001));
    put(this.lines[3], circles);
  }

  dispose(): void {
    for (const m of [...this.fills, ...this.lines]) {
      m.geometry.dispose();
      (m.material as MeshBasicMaterial).dispose();
    }
  }
}

function put(m: Mesh | LineSegments, positions: number[]): void {
  m.geometry.dispose();
  m.geometry = new BufferGeometry();
  m.geometry.setAttribute("position", new Float32BufferAttribute(positions, 3));
  m.visible = positions.length > 0;
}

const flat = (points: readonly number[], y: number): number[] => {
  const out: number[] = [];
  for (let k = 0; k + 1 < points.length; k += 2) out.push(points[k], y, points[k + 1]);
  return out;
};

function rectangle(
  out: number[],
  [x0, x1, z0, z1]: readonly [number, number, number, number],
  y: number,
): void {
  out.push(x0, y, z0, x0, y, z1, x1, y, z1, x0, y, z0, x1, y, z1, x1, y, z0);
}

function border(out: number[], [x0, x1, z0, z1]: readonly [number, number, number, number], y: number): void {
  out.push(x0, y, z0, x1, y, z0, x1, y, z0, x1, y, z1, x1, y, z1, x0, y, z1, x0, y, z1, x0, y, z0);
}

function ring(out: number[], x: number, z: number, r: number, y: number): void {
  const n = 28;
  for (let k = 0; k < n; k++)
    for (const i of [k, k + 1]) {
      const a = (i / n) * 2 * Math.PI;
      out.push(x + r * Math.cos(a), y, z + r * Math.sin(a));
    }
}
