/** Furniture: few, rounded, low in colour. */
import {
  BoxGeometry,
  CanvasTexture,
  CylinderGeometry,
  Group,
  Mesh,
  MeshBasicMaterial,
  MeshStandardMaterial,
  type Object3D,
  PlaneGeometry,
  SRGBColorSpace,
} from "three";
import { RoundedBoxGeometry } from "three/addons/geometries/RoundedBoxGeometry.js";
import type { SceneProp } from "../core/scene/types.ts";

const material = (color: string, roughness = 0.6): MeshStandardMaterial =>
  new MeshStandardMaterial({ color, roughness });

const top = material("#eeedea", 0.5);
const birch = material("#d8c4a3", 0.55);
const cardboard = material("#cdb48c", 0.8);
const tape = material("#bfa47a", 0.6);
const board = material("#fbfbfa", 0.35);
const frame = material("#b4b8bc", 0.4);
const wall = material("#d9d8d4", 0.9);
const pens = ["#2c3a63", "#b5483a", "#2f6f5a"].map((c) => material(c, 0.4));
const SHARED = new Set([top, birch, cardboard, tape, board, frame, wall, ...pens]);

/** A soft dark spot: grounds what stands. */
export function blob(width: number, depth: number, strength: number): Mesh {
  const mesh = new Mesh(new PlaneGeometry(width, depth).rotateX(-Math.PI / 2), blobMaterial(strength));
  mesh.position.y = 0.001;
  mesh.renderOrder = 1;
  return mesh;
}

let blobTexture: CanvasTexture | null = null;
function blobMaterial(opacity: number): MeshBasicMaterial {
  if (!blobTexture) {
    const c = document.createElement("canvas");
    c.width = c.height = 64;
    const g = c.getContext("2d");
    if (g) {
      const r = g.createRadialGradient(32, 32, 0, 32, 32, 32);
      r.addColorStop(0, "rgba(10,14,20,1)");
      r.addColorStop(0.5, "rgba(10,14,20,0.45)");
      r.addColorStop(1, "rgba(10,14,20,0)");
      g.fillStyle = r;
      g.fillRect(0, 0, 64, 64);
    }
    blobTexture = new CanvasTexture(c);
  }
  return new MeshBasicMaterial({
    map: blobTexture,
    transparent: true,
    opacity,
    depthWrite: false,
    toneMapped: false,
  });
}

function rounded(w: number, h: number, d: number, m: MeshStandardMaterial, radius = 0.01): Mesh {
  const mesh = new Mesh(new RoundedBoxGeometry(w, h, d, 3, Math.min(radius, w / 2.1, h / 2.1, d / 2.1)), m);
  mesh.castShadow = true;
  mesh.receiveShadow = true;
  return mesh;
}

function table(p: SceneProp): Object3D {
  const [w, h, d] = p.size;
  const g = new Group();
  const slab = rounded(w, 0.032, d, top, 0.012);
  slab.position.y = h - 0.016;
  g.add(slab);
  for (const x of [-1, 1]) {
    for (const z of [-1, 1]) {
      const leg = new Mesh(new CylinderGeometry(0.022, 0.017, h - 0.03, 20), birch);
      leg.position.set(x * (w / 2 - 0.07), (h - 0.03) / 2, z * (d / 2 - 0.07));
      leg.castShadow = true;
      g.add(leg);
      const spot = blob(0.16, 0.16, 0.35);
      spot.position.set(leg.position.x, 0.001, leg.position.z);
      g.add(spot);
    }
  }
  const rail = rounded(w - 0.16, 0.05, 0.018, birch, 0.006);
  rail.position.set(0, h - 0.06, d / 2 - 0.07);
  const rail2 = rail.clone();
  rail2.position.z = -rail.position.z;
  g.add(rail, rail2);
  return g;
}

function stool(p: SceneProp): Object3D {
  const [w, h] = p.size;
  const g = new Group();
  const seat = new Mesh(new CylinderGeometry(w / 2, w / 2 - 0.012, 0.034, 48), birch);
  seat.position.y = h - 0.017;
  seat.castShadow = true;
  seat.receiveShadow = true;
  g.add(seat);
  for (let k = 0; k < 4; k++) {
    const a = Math.PI / 4 + (k * Math.PI) / 2;
    const leg = new Mesh(new CylinderGeometry(0.015, 0.012, h - 0.03, 16), birch);
    const r = w / 2 - 0.05;
    leg.position.set(Math.sin(a) * (r + 0.015), (h - 0.03) / 2, Math.cos(a) * (r + 0.015));
    leg.rotation.set(Math.cos(a) * -0.07, 0, Math.sin(a) * 0.07);
    leg.castShadow = true;
    g.add(leg);
  }
  const ring = new Mesh(new CylinderGeometry(w / 2 - 0.04, w / 2 - 0.04, 0.014, 40, 1, true), birch);
  ring.position.y = 0.18;
  g.add(ring, blob(0.55, 0.55, 0.4));
  return g;
}

/** A cardboard box about its centre. */
export function boxMesh(size: readonly [number, number, number]): Object3D {
  const [w, h, d] = size;
  const g = new Group();
  g.add(rounded(w, h, d, cardboard, 0.008));
  const strip = rounded(0.05, h + 0.002, d + 0.002, tape, 0.004);
  g.add(strip);
  return g;
}

/** Hand-drawn ink for the board: strokes as paths in a canvas. */
function drawing(w: number, h: number): CanvasTexture {
  const c = document.createElement("canvas");
  c.width = 1024;
  c.height = Math.round((1024 * h) / w);
  const g = c.getContext("2d");
  if (g) {
    g.fillStyle = "#fbfbfa";
    g.fillRect(0, 0, c.width, c.height);
    g.lineWidth = 4;
    g.lineCap = "round";
    g.lineJoin = "round";
    const H = c.height;
    const stroke = (colour: string, points: [number, number][]) => {
      g.strokeStyle = colour;
      g.beginPath();
      points.forEach(([x, y], i) => {
        if (i === 0) g.moveTo(x * 1024, y * H);
        else g.lineTo(x * 1024, y * H);
      });
      g.stroke();
    };
    const blue = "#2c3a63";
    stroke(blue, [
      [0.07, 0.1],
      [0.071, 0.4],
      [0.36, 0.403],
    ]);
    const wave = (x0: number, y0: number, a: number, colour: string, f: number) =>
      stroke(
        colour,
        Array.from({ length: 60 }, (_, i) => [
          x0 + (0.27 * i) / 59,
          y0 - a * Math.abs(Math.sin((i / 59) * Math.PI * f)),
        ]),
      );
    wave(0.08, 0.385, 0.2, "#b5483a", 2);
    wave(0.08, 0.39, 0.12, "#2f6f5a", 3);
    // A triangle with its centre: barycentric weights.
    stroke(blue, [
      [0.62, 0.78],
      [0.9, 0.84],
      [0.74, 0.5],
      [0.62, 0.78],
    ]);
    for (const corner of [
      [0.62, 0.78],
      [0.9, 0.84],
      [0.74, 0.5],
    ] as [number, number][])
      stroke("#b5483a", [[0.755, 0.7], corner]);
    g.fillStyle = blue;
    g.font = `italic ${Math.round(0.085 * H)}px Georgia, serif`;
    g.fillText("q = w\u2081p\u2081 + w\u2082p\u2082 + w\u2083p\u2083", 0.45 * 1024, 0.24 * H);
    // Footprints.
    g.strokeStyle = "#2f6f5a";
    for (let i = 0; i < 6; i++) {
      g.save();
      g.translate((0.11 + 0.055 * i) * 1024, (0.72 + (i % 2 ? 0.07 : -0.04) - 0.015 * i) * H);
      g.rotate(1.15);
      g.beginPath();
      g.ellipse(0, 0, 13, 26, 0, 0, 7);
      g.stroke();
      g.beginPath();
      g.ellipse(2, 38, 9, 11, 0, 0, 7);
      g.stroke();
      g.restore();
    }
  }
  const t = new CanvasTexture(c);
  t.colorSpace = SRGBColorSpace;
  t.anisotropy = 8;
  return t;
}

/** A whiteboard about its middle, its face towards -Z of its frame (the writer looks along +Z). */
function whiteboard(p: SceneProp): Object3D {
  const [w, h, d] = p.size;
  const g = new Group();
  const panel = rounded(w, h, d, frame, 0.012);
  panel.position.z = d / 2 + 0.012;
  const face = new Mesh(new PlaneGeometry(w - 0.05, h - 0.05), board.clone());
  (face.material as MeshStandardMaterial).map = drawing(w, h);
  face.rotation.y = Math.PI;
  face.position.z = 0.011;
  face.receiveShadow = true;
  const tray = rounded(0.5, 0.016, 0.06, frame, 0.006);
  tray.position.set(0, -h / 2 - 0.004, -0.01);
  g.add(panel, face, tray);
  pens.forEach((m, i) => {
    const pen = new Mesh(new CylinderGeometry(0.008, 0.008, 0.11, 12).rotateZ(Math.PI / 2), m);
    pen.position.set(0.14 - 0.13 * i, -h / 2 + 0.013, -0.015);
    g.add(pen);
  });
  // Hung boards show their posts, so that they do not float in mid-room.
  for (const x of [-1, 1]) {
    const post = rounded(0.03, p.position[1] + h / 2, 0.03, frame, 0.008);
    post.position.set(x * (w / 2 - 0.1), -(p.position[1] + h / 2) / 2 + h / 2, d + 0.03);
    g.add(post);
    const base = rounded(0.05, 0.025, 0.42, frame, 0.01);
    base.position.set(x * (w / 2 - 0.1), -p.position[1] + 0.0125, d + 0.12);
    g.add(base);
  }
  return g;
}

/** What the shape of a prop depends on: props of one key differ in where they stand and how they are turned alone. */
export function propShape(p: SceneProp): string {
  // A board's posts reach the ground.
  return JSON.stringify([p.kind, p.size, p.kind === "board" ? p.position[1] : 0]);
}

/** Gives back what an object of blobs and furniture holds on the graphics card; what they share stays. */
export function disposeProp(o: Object3D): void {
  o.traverse((part) => {
    if (!(part instanceof Mesh)) return;
    part.geometry.dispose();
    const m = part.material as MeshStandardMaterial;
    if (SHARED.has(m)) return;
    if (m.map !== blobTexture) m.map?.dispose();
    m.dispose();
  });
}

/** The object of a prop, unplaced. */
export function createProp(p: SceneProp): Object3D {
  let o: Object3D;
  if (p.kind === "table") o = table(p);
  else if (p.kind === "stool") o = stool(p);
  else if (p.kind === "board") o = whiteboard(p);
  else if (p.kind === "box") o = boxMesh(p.size);
  else {
    const solid =
      p.kind === "pillar"
        ? new Mesh(new CylinderGeometry(p.size[0] / 2, p.size[0] / 2, p.size[1], 48), wall)
        : new Mesh(new BoxGeometry(...p.size), wall);
    solid.position.y = p.size[1] / 2;
    solid.castShadow = true;
    solid.receiveShadow = true;
    o = new Group().add(solid);
  }
  return new Group().add(o);
}
