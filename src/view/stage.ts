/**
 * The three-dimensional stage: draws what it is told, when it is told, and answers where things are on screen.
 *
 * It plans nothing. Drawing is on demand: `invalidate()` asks for a frame, an idle stage costs nothing.
 */
import {
  Box3,
  BufferGeometry,
  Float32BufferAttribute,
  Line,
  LineBasicMaterial,
  NeutralToneMapping,
  type Object3D,
  PerspectiveCamera,
  Plane,
  Raycaster,
  Scene as ThreeScene,
  Vector2,
  Vector3,
  VSMShadowMap,
  WebGLRenderer,
} from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import type { BoxTrack, InkStroke } from "../core/motion/types.ts";
import type { Scene } from "../core/scene/types.ts";
import type { Skeleton } from "../core/skeleton/skeleton.ts";
import type { CharacterMesh } from "./character/build-mesh.ts";
import { Figure } from "./character/figure.ts";
import type { Guest } from "./character/guest.ts";
import { keepContext } from "./context-loss.ts";
import { type Footprint, FootprintLayer, type FootprintMode } from "./footprints.ts";
import { FrameBudget } from "./frame-budget.ts";
import { Furniture } from "./furniture.ts";
import { createRoom, type Room } from "./room.ts";
import { TaskMarks } from "./task-marks.ts";
import { ROOMS, type Theme } from "./tokens.ts";

/** Free part of the viewport in CSS pixels: what panels leave. */
export interface FreeRect {
  left: number;
  top: number;
  right: number;
  bottom: number;
}

/** A body at a point that is framed: its height, and the room left around it, metres; how near a scene is framed from. */
const BODY = 1.8;
const AROUND = 0.6;
const NEAREST = 5.5;

/** The pen of the board. */
const INK = new LineBasicMaterial({ color: "#b5483a" });

export class Stage {
  private readonly renderer: WebGLRenderer;
  private readonly scene = new ThreeScene();
  readonly camera = new PerspectiveCamera(26, 1, 0.1, 60);
  private readonly controls: OrbitControls;
  private readonly room: Room;
  private readonly footprints = new FootprintLayer();
  /** The newest skin, and the one that is in the room: the newest may still be on its way. */
  private figure: Figure | null = null;
  private worn: Figure | null = null;
  private guest: Guest | null = null;
  private readonly furniture = new Furniture();
  private readonly marks = new TaskMarks();
  private readonly inkLines = new Map<number, Line>();
  private theme: Theme = "light";
  private waiting = 0;
  /** Farthest that a scene is framed from, metres. */
  private farthest = 14;
  private figureShown = true;
  private held = false;
  private recorded = false;
  private warming = false;
  private shaders = false;
  private readonly budget = new FrameBudget(() => this.drawFull());
  /** Whether the last picture was drawn in full while frames are spared. */
  private full = true;
  private free: FreeRect = { left: 0, top: 0, right: 0, bottom: 0 };
  private size = { width: 1, height: 1 };
  /** What was framed last, until the viewer takes the camera elsewhere. */
  private framed: readonly (readonly [number, number, number])[] | null = null;
  /** Called after each drawn frame, for what lies over the canvas. */
  onDraw: () => void = () => undefined;
  /** Called when the drawing context was lost and does not come back. */
  onLost: () => void = () => undefined;
  private readonly forgetContext: () => void;

  /**
   * @param begin the first picture is not drawn before this.
   * @throws Error when the browser has no WebGL 2.
   */
  constructor(
    readonly canvas: HTMLCanvasElement,
    private readonly begin: Promise<void> = Promise.resolve(),
  ) {
    this.renderer = new WebGLRenderer({ canvas, antialias: true });
    this.renderer.toneMapping = NeutralToneMapping;
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = VSMShadowMap;
    this.camera.position.set(-0.4, 3.75, -8.2);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.target.set(0, 0.62, 0.3);
    this.controls.enableDamping = false;
    this.controls.minDistance = 1.2;
    this.controls.maxDistance = 14;
    this.controls.minPolarAngle = (8 * Math.PI) / 180;
    this.controls.maxPolarAngle = (80 * Math.PI) / 180;
    this.controls.update();
    this.room = createRoom(this.scene);
    this.controls.addEventListener("start", () => {
      this.framed = null;
    });
    this.controls.addEventListener("change", () => {
      this.room.seenFrom(this.controls.getDistance());
      this.invalidate();
    });
    this.scene.add(this.furniture.group, this.marks.group, this.footprints.group);
    this.setTheme("light");
    this.forgetContext = keepContext(canvas, { back: () => this.invalidate(), gone: () => this.onLost() });
  }

  setTheme(theme: Theme): void {
    this.theme = theme;
    this.renderer.toneMappingExposure = ROOMS[theme].exposure;
    this.room.setTheme(theme);
    this.footprints.setTheme(theme);
    this.worn?.setTheme(theme);
    if (this.figure !== this.worn) this.figure?.setTheme(theme);
    this.invalidate();
  }

  /** A wide floor without walls, seen from farther off: for crowds. */
  setOpen(open: boolean): void {
    this.room.setOpen(open);
    this.farthest = open ? 45 : 14;
    this.controls.maxDistance = this.farthest + 1;
    this.camera.far = open ? 120 : 60;
    this.camera.updateProjectionMatrix();
    this.invalidate();
  }

  /** Shows or hides the one character. */
  setFigureShown(shown: boolean): void {
    this.figureShown = shown;
    if (this.worn) this.worn.group.visible = shown && this.guest === null;
    if (this.guest) this.guest.group.visible = shown;
    this.invalidate();
  }

  /** Furniture of a scene and the rings under its tasks; `selected` names tasks. */
  setScene(scene: Scene, selected: readonly string[], dragged: readonly string[] = []): void {
    this.furniture.set(scene);
    this.marks.set(scene.tasks, selected, ROOMS[this.theme].ink, dragged);
    this.invalidate();
  }

  setCharacter(skeleton: Skeleton, mesh: CharacterMesh): void {
    const figure = new Figure(skeleton, mesh);
    this.figure = figure;
    figure.setTheme(this.theme);
    // Its shaders are made while the page goes on; until then the one before is shown.
    void this.renderer.compileAsync(figure.group, this.camera, this.scene).then(() => {
      // A newer one has come meanwhile: this one is never shown.
      if (this.figure !== figure) {
        figure.dispose();
        return;
      }
      if (this.worn) {
        this.scene.remove(this.worn.group);
        this.worn.dispose();
      }
      this.worn = figure;
      figure.group.visible = this.guest === null && this.figureShown;
      this.scene.add(figure.group);
      this.invalidate();
    });
  }

  /** A character from a file instead of our own; null for our own again. */
  setGuest(guest: Guest | null): void {
    if (this.guest) this.scene.remove(this.guest.group);
    this.guest = guest;
    if (guest) this.scene.add(guest.group);
    if (this.worn) this.worn.group.visible = guest === null && this.figureShown;
    this.invalidate();
  }

  get hasCharacter(): boolean {
    return this.figure !== null;
  }

  setPose(root: ArrayLike<number>, r: number, rotations: ArrayLike<number>, o: number): void {
    this.worn?.setPose(root, r, rotations, o);
    if (this.figure !== this.worn) this.figure?.setPose(root, r, rotations, o);
    this.guest?.setPose(root, r, rotations, o);
    this.invalidate();
  }

  /** @param chosen indices of prints that are selected. */
  setFootprints(prints: Footprint[], mode: FootprintMode, chosen: readonly number[] = []): void {
    this.footprints.set(prints, mode, chosen);
    this.invalidate();
  }

  setSelectedFootprint(index: number): void {
    this.footprints.setSelected(index);
    this.invalidate();
  }

  /** Boxes where the motion has them at a frame; those not carried then stay at the nearer end of their way. */
  setBoxes(tracks: readonly BoxTrack[], frame: number): void {
    this.furniture.setBoxes(tracks, frame);
    this.invalidate();
  }

  /** Ink drawn up to a time. */
  setInk(strokes: readonly InkStroke[], time: number): void {
    strokes.forEach((s, i) => {
      let line = this.inkLines.get(i);
      if (!line || line.userData.stroke !== s) {
        if (line) {
          this.scene.remove(line);
          line.geometry.dispose();
        }
        const g = new BufferGeometry();
        g.setAttribute("position", new Float32BufferAttribute(s.points, 3));
        line = new Line(g, INK);
        line.frustumCulled = false;
        line.userData.stroke = s;
        this.inkLines.set(i, line);
        this.scene.add(line);
      }
      let n = 0;
      while (n < s.times.length && s.times[n] <= time) n++;
      line.geometry.setDrawRange(0, n);
      line.visible = n > 1;
    });
    for (const [i, line] of this.inkLines) {
      if (i < strokes.length) continue;
      this.scene.remove(line);
      line.geometry.dispose();
      this.inkLines.delete(i);
    }
    this.invalidate();
  }

  /** Whether the camera is where `frame` put it: the viewer has not moved it since. */
  get framing(): boolean {
    return this.framed !== null;
  }

  /** Edges of the free part of the viewport, CSS pixels of the canvas. */
  get freeRoom(): FreeRect {
    const { left, top, right, bottom } = this.free;
    return { left, top, right: this.size.width - right, bottom: this.size.height - bottom };
  }

  /** Where a world point is in CSS pixels of the canvas, and whether it is before the camera. */
  project(x: number, y: number, z: number): { x: number; y: number; visible: boolean } {
    const v = new Vector3(x, y, z).project(this.camera);
    return { x: ((v.x + 1) / 2) * this.size.width, y: ((1 - v.y) / 2) * this.size.height, visible: v.z < 1 };
  }

  /** Whether the room's own floor is drawn. */
  showFloor(shown: boolean): void {
    this.room.showFloor(shown);
    this.invalidate();
  }

  /** Adds something of a feature's own to what is drawn. */
  add(object: Object3D): void {
    this.scene.add(object);
    this.invalidate();
  }

  remove(object: Object3D): void {
    this.scene.remove(object);
    this.invalidate();
  }

  /** The ray through a canvas point, CSS pixels. */
  ray(x: number, y: number): Raycaster {
    const r = new Raycaster();
    r.setFromCamera(new Vector2((x / this.size.width) * 2 - 1, 1 - (y / this.size.height) * 2), this.camera);
    return r;
  }

  /** Where the ray through a canvas point meets the level at `height`; null when it does not within 40 m. */
  levelPoint(x: number, y: number, height: number): [number, number] | null {
    const hit = this.ray(x, y).ray.intersectPlane(new Plane(new Vector3(0, 1, 0), -height), new Vector3());
    return hit && hit.distanceTo(this.camera.position) < 40 ? [hit.x, hit.z] : null;
  }

  /** Id of the furniture that a ray meets first; null for none. */
  propOn(ray: Raycaster): string | null {
    return this.furniture.on(ray);
  }

  /** Index of the footprint that a ray meets first; -1 for none. */
  footprintOn(ray: Raycaster): number {
    return ray.intersectObject(this.footprints.fill, false)[0]?.instanceId ?? -1;
  }

  setOrbit(enabled: boolean): void {
    this.controls.enabled = enabled;
  }

  /** Frames points, with a body standing at each, inside the free part of the viewport; the view's direction stays. */
  frame(points: readonly (readonly [number, number, number])[]): void {
    if (points.length === 0) return;
    this.framed = points;
    const box = new Box3();
    for (const p of points) box.expandByPoint(new Vector3(p[0], 0.62, p[2]));
    const c = box.getCenter(new Vector3());
    const back = this.camera.position.clone().sub(this.controls.target).normalize();
    const right = new Vector3(0, 1, 0).cross(back).normalize();
    const up = back.clone().cross(right);
    // Half of what is seen of the free part, at one metre.
    const tan = Math.tan((this.camera.fov * Math.PI) / 360) / this.size.height;
    const wide = tan * Math.max(60, this.size.width - this.free.left - this.free.right);
    const high = tan * Math.max(60, this.size.height - this.free.top - this.free.bottom);
    let distance = 0;
    for (const p of points)
      for (const y of [0, BODY]) {
        const q = new Vector3(p[0], y, p[2]).sub(c);
        const near = q.dot(back);
        distance = Math.max(
          distance,
          near + (Math.abs(q.dot(right)) + AROUND) / wide,
          near + (Math.abs(q.dot(up)) + AROUND / 2) / high,
        );
      }
    // A narrow picture is taken from farther off, or its sides are cut.
    const farthest = this.farthest * Math.min(1.6, Math.max(1, (1.25 * high) / wide));
    this.controls.target.copy(c);
    this.controls.maxDistance = farthest + 1;
    this.camera.position.copy(c).addScaledVector(back, Math.max(NEAREST, Math.min(farthest, distance)));
    this.controls.update();
    this.invalidate();
  }

  /** The canvas has another size or free part; what was framed is framed in it, unless the viewer has moved the camera since. */
  resize(width: number, height: number, free: FreeRect): void {
    const before = JSON.stringify([this.size, this.free]);
    this.size = { width: Math.max(1, width), height: Math.max(1, height) };
    this.free = free;
    this.setDetail(this.budget.sparing);
    this.camera.aspect = this.size.width / this.size.height;
    // The middle of the picture is the middle of the free part.
    this.camera.setViewOffset(
      this.size.width,
      this.size.height,
      (free.right - free.left) / 2,
      (free.bottom - free.top) / 2,
      this.size.width,
      this.size.height,
    );
    this.camera.updateProjectionMatrix();
    // Not under a drag, which would go astray.
    if (this.framed && this.controls.enabled && before !== JSON.stringify([this.size, this.free]))
      this.frame(this.framed);
    // A canvas of another size is empty: it is drawn before the page shows it.
    if (this.shaders && !this.held && !this.recorded) this.draw(performance.now());
    else this.invalidate();
  }

  /** Draws at once and in full, for those who read the canvas in the same turn. */
  drawNow(): void {
    this.drawFull();
  }

  /** While on, only `drawNow` draws: who takes frame after frame is not drawn for between them as well. */
  record(on: boolean): void {
    this.recorded = on;
    this.invalidate();
  }

  /** How much lies on the graphics card now: geometries, textures, shader programs. */
  graphics(): { geometries: number; textures: number; programs: number } {
    const { memory, programs } = this.renderer.info;
    return { geometries: memory.geometries, textures: memory.textures, programs: programs?.length ?? 0 };
  }

  /** What is drawn, as a PNG. @throws Error when the browser gives none. */
  picture(): Promise<Blob> {
    // Drawn and read in the same turn: the buffer is not kept afterwards.
    this.drawNow();
    return new Promise((resolve, reject) => {
      this.canvas.toBlob((blob) => {
        if (blob) resolve(blob);
        else reject(new Error("the browser gave no picture."));
      }, "image/png");
    });
  }

  /** The same at once, as a data address: printing does not wait. */
  still(): string {
    this.renderer.render(this.scene, this.camera);
    return this.canvas.toDataURL("image/png");
  }

  /** Draws nothing while held: to measure everything else where there is no graphics card. */
  hold(held: boolean): void {
    this.held = held;
    this.invalidate();
  }

  /** Asks for a frame. */
  invalidate(): void {
    if (this.waiting) return;
    this.waiting = requestAnimationFrame((now) => {
      this.waiting = 0;
      if (this.held || this.recorded) {
        this.onDraw();
        return;
      }
      if (!this.shaders) {
        this.onDraw();
        this.warmUp();
        return;
      }
      this.draw(now);
    });
  }

  private draw(now: number): void {
    if (this.budget.frame(now) || this.full) this.setDetail(this.budget.sparing);
    this.full = false;
    this.renderer.render(this.scene, this.camera);
    this.onDraw();
  }

  /** The room's shaders are made before its first frame, without holding up the page. */
  private warmUp(): void {
    if (this.warming) return;
    this.warming = true;
    const compiled = this.begin.then(() => this.renderer.compileAsync(this.scene, this.camera));
    void compiled.then(() => {
      this.shaders = true;
      this.invalidate();
    });
  }

  /** The picture has come to rest: once more in full. */
  private drawFull(): void {
    if (this.held) return;
    this.setDetail(false);
    this.full = true;
    this.renderer.render(this.scene, this.camera);
  }

  private setDetail(sparing: boolean): void {
    const ratio = sparing ? 1 : Math.min(2, window.devicePixelRatio || 1);
    const now = this.renderer.getSize(new Vector2());
    // A size that is set anew makes the canvas anew, even where it is the same.
    if (ratio !== this.renderer.getPixelRatio()) this.renderer.setPixelRatio(ratio);
    if (now.x !== this.size.width || now.y !== this.size.height)
      this.renderer.setSize(this.size.width, this.size.height, false);
    this.room.setDetail(sparing);
  }

  dispose(): void {
    cancelAnimationFrame(this.waiting);
    this.forgetContext();
    this.controls.dispose();
    this.furniture.dispose();
    this.marks.dispose();
    for (const line of this.inkLines.values()) line.geometry.dispose();
    this.room.dispose();
    this.worn?.dispose();
    if (this.figure !== this.worn) this.figure?.dispose();
    this.renderer.dispose();
    this.canvas.remove();
  }
}
