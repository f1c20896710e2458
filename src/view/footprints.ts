/**
 * Footprints on the floor: heel and forefoot apart, filled with the step category's colour, a mark as second cue, a hairline
 * about them. Two instanced meshes, so a plan of any length is a few draw calls.
 */
import {
  CanvasTexture,
  Color,
  DynamicDrawUsage,
  Group,
  InstancedBufferAttribute,
  InstancedMesh,
  Matrix4,
  MeshBasicMaterial,
  PlaneGeometry,
  Quaternion,
  Shape,
  ShapeGeometry,
  SRGBColorSpace,
  Vector3,
} from "three";
import { type Foot, type Phase, STEP_CATEGORIES, type StepCategory } from "../core/steps/types.ts";
import { CATEGORY_COLOURS, ROOMS, type Theme } from "./tokens.ts";

export interface Footprint {
  foot: Foot;
  x: number;
  y: number;
  z: number;
  yaw: number;
  category: StepCategory | null;
  phase: Phase | null;
  /** Past, standing on it, or to come. */
  state: "past" | "now" | "next";
}

export type FootprintMode = "category" | "phase";

const PHASE_COLOURS: Record<Phase, string> = { exit: "#474d55", locomotion: "#a3a8ae", enter: "#16191d" };
const MOST = 600;
/** Prints are drawn a little larger than soles. */
const SCALE = 1.16;

/** Forefoot of a right sole about the ankle, forward = +y; mirrored for the left. */
function forefoot(grow: number): Shape {
  const s = new Shape();
  const g = grow;
  s.moveTo(-0.034 - g, 0.045 - g);
  s.bezierCurveTo(-0.04 - g, 0.09, -0.05 - g, 0.11, -0.05 - g, 0.142);
  s.bezierCurveTo(-0.05 - g, 0.192 + g, -0.012, 0.214 + g, 0.006, 0.21 + g);
  s.bezierCurveTo(0.04 + g, 0.2 + g, 0.046 + g, 0.15, 0.043 + g, 0.115);
  s.bezierCurveTo(0.041 + g, 0.09, 0.034 + g, 0.07, 0.033 + g, 0.045 - g);
  s.closePath();
  return s;
}

function heel(grow: number): Shape {
  const s = new Shape();
  const g = grow;
  s.moveTo(-0.033 - g, 0.026 + g);
  s.lineTo(0.033 + g, 0.026 + g);
  s.bezierCurveTo(0.037 + g, -0.03, 0.025 + g, -0.062 - g, 0, -0.064 - g);
  s.bezierCurveTo(-0.025 - g, -0.062 - g, -0.037 - g, -0.03, -0.033 - g, 0.026 + g);
  return s;
}

function merged(shapes: Shape[]): ShapeGeometry {
  const g = new ShapeGeometry(shapes, 10);
  // Shape plane (x, y) to floor (x, z), seen from above; the mirror comes with the instance.
  g.rotateX(Math.PI / 2);
  return g;
}

/** The marks of all categories in one texture, a cell each. */
function markTexture(): CanvasTexture {
  const cell = 128;
  const c = document.createElement("canvas");
  c.width = cell * STEP_CATEGORIES.length;
  c.height = cell;
  const g = c.getContext("2d");
  if (g) {
    STEP_CATEGORIES.forEach((category, i) => {
      g.save();
      g.translate(i * cell + cell / 2, cell / 2);
      g.strokeStyle = g.fillStyle = CATEGORY_COLOURS[category].mark;
      g.lineWidth = 11;
      g.lineCap = g.lineJoin = "round";
      const path = (points: [number, number][]) => {
        g.beginPath();
        points.forEach(([x, y], k) => {
          if (k === 0) g.moveTo(x, y);
          else g.lineTo(x, y);
        });
        g.stroke();
      };
      const dot = (y: number) => {
        g.beginPath();
        g.arc(0, y, 11, 0, 7);
        g.fill();
      };
      if (category === "HeelPivot" || category === "ToePivot") {
        const up = category === "HeelPivot" ? -1 : 1;
        dot(up * -30);
        g.beginPath();
        g.arc(
          0,
          up * 10,
          34,
          up < 0 ? Math.PI * 1.15 : Math.PI * 0.15,
          up < 0 ? Math.PI * 1.85 : Math.PI * 0.85,
        );
        g.stroke();
      } else if (category === "SideStep") {
        path([
          [-34, 0],
          [34, 0],
        ]);
        path([
          [12, -20],
          [34, 0],
          [12, 20],
        ]);
      } else if (category === "TurnAndStep") {
        path([
          [-24, 34],
          [-24, 4],
          [-8, -14],
          [28, -14],
        ]);
        path([
          [10, -34],
          [30, -14],
          [10, 6],
        ]);
      } else if (category === "ForwardStepDuringTask")
        path([
          [-30, 16],
          [0, -16],
          [30, 16],
        ]);
      else if (category === "BackwardStepDuringTask")
        path([
          [-30, -16],
          [0, 16],
          [30, -16],
        ]);
      g.restore();
    });
  }
  const t = new CanvasTexture(c);
  t.colorSpace = SRGBColorSpace;
  t.anisotropy = 4;
  return t;
}

export class FootprintLayer {
  readonly group = new Group();
  readonly fill: InstancedMesh;
  private readonly outline: InstancedMesh;
  private readonly marks: InstancedMesh;
  private readonly cells: InstancedBufferAttribute;
  private prints: Footprint[] = [];
  /** Selected prints have a wider outline. */
  private readonly wide = new Vector3(1.22, 1, 1.12);
  private mode: FootprintMode = "category";
  private theme: Theme = "light";
  /** Under the pointer; -1 for none. */
  private selected = -1;
  private chosen: readonly number[] = [];

  constructor() {
    const unlit = { transparent: true, depthWrite: false, toneMapped: false, fog: false } as const;
    const make = (geometry: ShapeGeometry | PlaneGeometry, material: MeshBasicMaterial, order: number) => {
      const mesh = new InstancedMesh(geometry, material, MOST);
      mesh.instanceMatrix.setUsage(DynamicDrawUsage);
      mesh.frustumCulled = false;
      mesh.renderOrder = order;
      mesh.count = 0;
      this.group.add(mesh);
      return mesh;
    };
    // Mirrored instances turn triangles over: both sides are drawn.
    this.outline = make(
      merged([forefoot(0.005), heel(0.005)]),
      new MeshBasicMaterial({ ...unlit, side: 2, opacity: 0.82 }),
      4,
    );
    this.fill = make(merged([forefoot(0), heel(0)]), new MeshBasicMaterial({ ...unlit, side: 2 }), 5);
    const plane = new PlaneGeometry(0.062, 0.062).rotateX(-Math.PI / 2).rotateY(Math.PI);
    this.cells = new InstancedBufferAttribute(new Float32Array(MOST), 1);
    plane.setAttribute("cell", this.cells);
    const markMaterial = new MeshBasicMaterial({ ...unlit, map: markTexture(), side: 2 });
    markMaterial.onBeforeCompile = (shader) => {
      shader.vertexShader = `attribute float cell;\n${shader.vertexShader}`.replace(
        "#include <uv_vertex>",
        `#include <uv_vertex>\nvMapUv.x = (vMapUv.x + cell) / ${STEP_CATEGORIES.length}.0;`,
      );
    };
    this.marks = make(plane, markMaterial, 6);
    for (const mesh of [this.fill, this.outline]) mesh.setColorAt(0, new Color("#ffffff"));
  }

  setTheme(theme: Theme): void {
    this.theme = theme;
    (this.outline.material as MeshBasicMaterial).opacity = ROOMS[theme].hairlineOpacity;
    this.refresh();
  }

  set(prints: Footprint[], mode: FootprintMode, chosen: readonly number[]): void {
    this.chosen = chosen;
    this.prints = prints;
    this.mode = mode;
    this.refresh();
  }

  setSelected(index: number): void {
    this.selected = index;
    this.refresh();
  }

  private refresh(): void {
    const m = new Matrix4();
    const q = new Quaternion();
    const up = new Vector3(0, 1, 0);
    const colour = new Color();
    const line = new Color(ROOMS[this.theme].hairline);
    const floor = new Color(ROOMS[this.theme].floor);
    let marks = 0;
    const n = Math.min(MOST, this.prints.length);
    for (let i = 0; i < n; i++) {
      const p = this.prints[i];
      q.setFromAxisAngle(up, p.yaw);
      const side = p.foot === "left" ? -1 : 1;
      const big = i === this.selected ? 1.12 : 1;
      m.compose(
        new Vector3(p.x, p.y + 0.004 + i * 2e-6, p.z),
        q,
        new Vector3(-side * SCALE * big, 1, SCALE * big),
      );
      this.fill.setMatrixAt(i, m);
      m.elements[13] -= 0.001;
      if (this.chosen.includes(i)) m.scale(this.wide);
      this.outline.setMatrixAt(i, m);
      const fill =
        this.mode === "phase"
          ? p.phase
            ? PHASE_COLOURS[p.phase]
            : "#fbfbfa"
          : p.category
            ? CATEGORY_COLOURS[p.category].fill
            : "#fbfbfa";
      colour.set(fill);
      if (p.state === "past") colour.lerp(floor, 0.55);
      this.fill.setColorAt(i, colour);
      colour.copy(line);
      if (p.state === "past" && !this.chosen.includes(i)) colour.lerp(floor, 0.55);
      this.outline.setColorAt(i, colour);
      if (p.category && p.category !== "Walk" && this.mode === "category") {
        const heelMark = p.category === "HeelPivot";
        const ahead = (heelMark ? 0.118 : 0.128) * SCALE;
        m.compose(
          new Vector3(p.x + Math.sin(p.yaw) * ahead, p.y + 0.006, p.z + Math.cos(p.yaw) * ahead),
          q,
          new Vector3(side, 1, 1),
        );
        this.marks.setMatrixAt(marks, m);
        this.cells.setX(marks, STEP_CATEGORIES.indexOf(p.category));
        marks++;
      }
    }
    this.fill.count = this.outline.count = n;
    this.marks.count = marks;
    for (const mesh of [this.fill, this.outline, this.marks]) {
      mesh.instanceMatrix.needsUpdate = true;
      if (mesh.instanceColor) mesh.instanceColor.needsUpdate = true;
    }
    this.fill.computeBoundingSphere();
    this.cells.needsUpdate = true;
  }
}
