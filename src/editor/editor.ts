/**
 * The editor: puts scene, planner, playback and stage together. Parts draw from its state and call its methods; planning
 * and motion are the worker's.
 */
import { render } from "lit";
import { writeBvh } from "../core/capture/bvh-write.ts";
import * as commands from "../core/scene/commands.ts";
import { History } from "../core/scene/history.ts";
import { resultDocument } from "../core/scene/result.ts";
import { parseScene, readScene, serializeScene } from "../core/scene/schema.ts";
import type { TaskCategory } from "../core/scene/task-types.ts";
import type { Scene } from "../core/scene/types.ts";
import { JOINT_COUNT } from "../core/skeleton/joints.ts";
import { createSkeleton } from "../core/skeleton/skeleton.ts";
import type { Footprint } from "../view/footprints.ts";
import { Stage } from "../view/stage.ts";
import type { MeshRequest, MeshResponse } from "../workers/mesh-worker.ts";
import type { PlannerResponse } from "../workers/protocol.ts";
import { download } from "./download.ts";
import { EXAMPLES, type Example } from "./examples.ts";
import { Markers } from "./markers.ts";
import { MotionStore } from "./motion-store.ts";
import { helpSheet } from "./parts/help-sheet.ts";
import { overlayChips } from "./parts/overlay.ts";
import { panel } from "./parts/panel.ts";
import { timeline } from "./parts/timeline.ts";
import { toolRail } from "./parts/tool-rail.ts";
import { topBar } from "./parts/top-bar.ts";
import { drawPath } from "./path-tool.ts";
import { PlannerClient } from "./planner-client.ts";
import { createEditorStore, type EditorState, type Store, type Tool } from "./state.ts";
import { saveScene } from "./storage.ts";

const Q = 4 * JOINT_COUNT;
/** Milliseconds without a change before the scene is kept. */
const SAVE_AFTER = 500;

interface Places {
  top: HTMLElement;
  viewport: HTMLElement;
  panel: HTMLElement;
  timeline: HTMLElement;
  live: HTMLElement;
  canvas: HTMLCanvasElement;
}

/** What happened between page and planner, in order: for tests and for the curious. */
export interface LogEntry {
  what: PlannerResponse["type"] | "asked" | "drawn" | "changed-over";
  id: number;
  /** Milliseconds since the page was asked for. */
  at: number;
}

export class Editor {
  readonly store: Store;
  readonly stage: Stage;
  readonly motion = new MotionStore();
  readonly examples: readonly Example[] = EXAMPLES;
  readonly tables = new Set<string>();
  readonly log: LogEntry[] = [];
  tracksSize = { width: 800, height: 120 };
  private history: History;
  private readonly planner: PlannerClient;
  private readonly markers: Markers;
  private meshWorker: Worker;
  private meshDeaths = 0;
  private meshId = 0;
  private askedId = 0;
  private plannedId = 0;
  private gesture = false;
  private lastTick = 0;
  private drawing = false;
  private saveTimer = 0;
  private toastTimer = 0;
  private begun = false;

  constructor(
    private readonly places: Places,
    scene: Scene,
    theme: EditorState["theme"],
  ) {
    this.store = createEditorStore(scene, theme);
    this.history = new History(scene);
    this.stage = new Stage(places.canvas);
    this.markers = new Markers(this, places.viewport.querySelector(".overlay") as HTMLElement);
    this.stage.onDraw = () => this.markers.draw();
    this.planner = new PlannerClient(new URL("generated/library.bin", document.baseURI).href, {
      message: (m) => this.hear(m),
      restarted: () => this.say("The planner restarted. Nothing was lost.", false),
    });
    this.meshWorker = this.startMesh();
    this.store.subscribe(() => this.draw());
    document.documentElement.dataset.theme = theme;
    this.stage.setTheme(theme);
    this.stage.setScene(scene, null);
    this.resize();
    new ResizeObserver(() => this.resize()).observe(places.viewport);
    new ResizeObserver(() => this.resize()).observe(places.timeline);
    this.frameScene();
    this.askMesh();
    this.ask();
    this.draw();
    // A hidden tab may never be shown again: what waits is kept now.
    document.addEventListener("visibilitychange", () => {
      if (document.hidden && this.saveTimer !== 0) this.save();
    });
    places.canvas.addEventListener("pointerdown", (e) => this.canvasDown(e));
    places.canvas.addEventListener("pointermove", (e) => this.canvasMove(e));
  }

  // ---- drawing -------------------------------------------------------------------------------------------------

  private draw(): void {
    if (this.drawing) return;
    this.drawing = true;
    queueMicrotask(() => {
      this.drawing = false;
      render(topBar(this), this.places.top);
      render(panel(this), this.places.panel);
      render(timeline(this), this.places.timeline);
      const chips = this.places.viewport.querySelector(".chips") as HTMLElement;
      render([toolRail(this), overlayChips(this)], chips);
      helpSheet(this);
    });
  }

  private set(change: Partial<EditorState>): void {
    this.store.setState(change);
  }

  private resize(): void {
    const box = this.places.viewport.getBoundingClientRect();
    const narrow = window.innerWidth < 1200 && window.innerWidth >= 760;
    this.stage.resize(box.width, box.height, { left: 56, top: 0, right: narrow ? 284 : 0, bottom: 0 });
    const tracks = this.places.timeline.getBoundingClientRect();
    this.tracksSize = { width: Math.max(240, tracks.width - 24), height: Math.max(80, tracks.height - 54) };
    this.draw();
  }

  frameScene(): void {
    const { scene } = this.store.getState();
    this.stage.frame([
      [scene.start.position[0], 0, scene.start.position[1]],
      ...scene.tasks.map((t): [number, number, number] => t.position),
      ...scene.paths.flatMap((p) => p.points.map((q): [number, number, number] => [q[0], 0, q[1]])),
    ]);
  }

  private drawFootprints(): void {
    const s = this.store.getState();
    const { plan, time } = s;
    if (!plan) return;
    const at = new Map<number, { x: number; z: number; yaw: number }>();
    if (s.showBefore)
      for (const t of plan.traces) for (const [k, b] of t.before.entries()) at.set(t.first + k, b);
    const prints: Footprint[] = [
      ...plan.start.map(
        (f): Footprint => ({ ...f, category: null, phase: null, state: time > 0.5 ? "past" : "now" }),
      ),
      ...plan.steps.map((p, i): Footprint => {
        const place = at.get(i) ?? p;
        return {
          foot: p.foot,
          x: place.x,
          y: p.y,
          z: place.z,
          yaw: place.yaw,
          category: p.category,
          phase: p.phase,
          state: p.land < time - 0.9 ? "past" : p.land <= time ? "now" : "next",
        };
      }),
    ];
    this.stage.setFootprints(prints, s.colouring);
  }

  // ---- the planner ---------------------------------------------------------------------------------------------

  private ask(): void {
    const s = this.store.getState();
    const duration = this.duration();
    const now = this.begun && s.time > 0 && s.time < duration - 0.01 ? s.time : null;
    this.askedId = this.planner.plan(s.scene, now);
    this.log.push({ what: "asked", id: this.askedId, at: performance.now() });
  }

  private hear(m: PlannerResponse): void {
    if ("id" in m) this.log.push({ what: m.type, id: m.id, at: performance.now() });
    if (this.log.length > 5000) this.log.splice(0, 2500);
    switch (m.type) {
      case "ready":
        this.set({ status: null, transitions: m.transitions });
        break;
      case "planned":
        if (m.id !== this.askedId) return;
        this.plannedId = m.id;
        this.motion.begin(m.id, m.frames);
        this.set({ plan: m.plan, planMs: m.planMs });
        // Footprints answer at once; the motion follows.
        this.drawFootprints();
        this.log.push({ what: "drawn", id: m.id, at: performance.now() });
        break;
      case "motion": {
        if (m.id !== this.plannedId) return;
        const shown = Math.floor(this.store.getState().time * 60);
        if (this.motion.add(m.id, m.chunk, shown)) {
          this.log.push({ what: "changed-over", id: m.id, at: performance.now() });
          this.begin();
        }
        this.show();
        break;
      }
      case "finished":
        if (m.id !== this.plannedId) return;
        this.motion.finish(m.id, m.boxes, m.ink);
        this.set({ quality: m.quality });
        this.show();
        if (!this.gesture) this.announce();
        break;
      case "failed":
        this.set({ error: m.message });
        this.say(m.message, false);
        break;
      case "dropped":
      case "overtaken":
        break;
    }
  }

  /** The first motion starts by itself, unless less motion is wished for. */
  private begin(): void {
    if (this.begun) return;
    this.begun = true;
    if (!matchMedia("(prefers-reduced-motion: reduce)").matches) this.setPlaying(true);
  }

  private announce(): void {
    const s = this.store.getState();
    if (!s.plan || !s.quality) return;
    this.places.live.textContent = `${s.plan.steps.length} footsteps; skate ${(s.quality.skate ?? 0).toFixed(1)} millimetres, reach ${(s.quality.reach ?? 0).toFixed(1)} millimetres.`;
  }

  /** A worker for the character's skin; one that dies is replaced, three times in all. */
  private startMesh(): Worker {
    const worker = new Worker(new URL("../workers/mesh-worker.ts", import.meta.url), { type: "module" });
    worker.onmessage = (event: MessageEvent<MeshResponse>) => this.hearMesh(event.data);
    worker.onerror = (event) => {
      event.preventDefault();
      worker.terminate();
      if (this.meshDeaths++ >= 3) {
        this.fail("The character cannot be drawn: its worker stops each time. Reload the page.");
        return;
      }
      this.meshWorker = this.startMesh();
      this.askMesh();
    };
    return worker;
  }

  private askMesh(): void {
    const { height, proportions } = this.store.getState().scene.character;
    const request: MeshRequest = { id: ++this.meshId, height, proportions };
    this.meshWorker.postMessage(request);
  }

  private hearMesh(answer: MeshResponse): void {
    if (answer.id !== this.meshId) return;
    const { height, proportions } = this.store.getState().scene.character;
    this.stage.setCharacter(createSkeleton(height, proportions), answer.mesh);
    this.show();
  }

  // ---- playback ------------------------------------------------------------------------------------------------

  duration(): number {
    return this.store.getState().plan?.duration ?? 0;
  }

  /** Shows the present time: pose, boxes, ink, footprints' state. */
  private show(): void {
    const m = this.motion.current;
    const { time } = this.store.getState();
    if (m && m.filled > 0) {
      const f = Math.max(0, Math.min(m.filled - 1, Math.floor(time * 60)));
      this.stage.setPose(m.root, 3 * f, m.rotations, Q * f);
      if (!this.gesture || m.boxes.length > 0) this.stage.setBoxes(m.boxes, f);
      this.stage.setInk(m.ink, time);
    }
    this.drawFootprints();
  }

  setPlaying(playing: boolean): void {
    const s = this.store.getState();
    if (playing && s.time >= this.duration() - 0.02) this.set({ time: 0 });
    this.set({ playing });
    if (playing) {
      this.lastTick = performance.now();
      requestAnimationFrame(() => this.tick());
    }
  }

  togglePlay(): void {
    this.setPlaying(!this.store.getState().playing);
  }

  private tick(): void {
    const s = this.store.getState();
    if (!s.playing) return;
    const now = performance.now();
    // A hidden tab does not catch up, and a clock that jumps back stops nothing.
    const passed = Math.max(0, Math.min(0.1, (now - this.lastTick) / 1000));
    this.lastTick = now;
    let time = s.time + passed * s.speed;
    const duration = this.duration();
    const m = this.motion.current;
    if (m && m.filled < m.frames) time = Math.min(time, (m.filled - 1) / 60);
    if (time >= duration) {
      if (s.loop && !this.gesture) {
        time = 0;
        this.stage.setScene(s.scene, s.selected);
      } else {
        time = duration;
        this.set({ playing: false });
      }
    }
    this.set({ time });
    this.show();
    requestAnimationFrame(() => this.tick());
  }

  seek(time: number): void {
    const before = this.store.getState().time;
    this.set({ time: Math.max(0, Math.min(this.duration(), time)), playing: false });
    if (time < before) this.stage.setScene(this.store.getState().scene, this.store.getState().selected);
    this.show();
  }

  stepFrame(by: number): void {
    this.seek(Math.round(this.store.getState().time * 60 + by) / 60);
  }

  toggleLoop(): void {
    this.set({ loop: !this.store.getState().loop });
  }

  setSpeed(speed: number): void {
    this.set({ speed });
  }

  /** Index in the order of the task being come to or done at the present time. */
  currentTask(): number {
    const s = this.store.getState();
    const tasks = s.plan?.tasks ?? [];
    const i = tasks.findIndex((t) => s.time <= t.end);
    return i < 0 ? tasks.length - 1 : i;
  }

  // ---- editing -------------------------------------------------------------------------------------------------

  /** One change of the scene by a command; planned at once. */
  edit(change: (scene: Scene, c: typeof commands) => Scene): void {
    const scene = change(this.history.scene, commands);
    if (scene === this.history.scene) return;
    try {
      // What the schema refuses is not done: numbers out of range and the like.
      parseScene(scene);
    } catch (error) {
      this.fail(error instanceof Error ? error.message : String(error));
      return;
    }
    this.history.apply(scene);
    this.changed(true);
  }

  private changed(plan: boolean): void {
    const { scene } = this.history;
    this.set({ scene, canUndo: this.history.canUndo, canRedo: this.history.canRedo, error: null });
    this.stage.setScene(scene, this.store.getState().selected);
    if (plan) this.ask();
    this.show();
    window.clearTimeout(this.saveTimer);
    this.set({ saved: "saving" });
    this.saveTimer = window.setTimeout(() => this.save(), SAVE_AFTER);
  }

  private save(): void {
    window.clearTimeout(this.saveTimer);
    this.saveTimer = 0;
    const { scene } = this.history;
    void saveScene(scene).then((ok) => {
      // A newer scene that waits to be kept says so itself.
      if (this.saveTimer === 0) this.set({ saved: ok ? "saved" : "off" });
    });
  }

  beginGesture(): void {
    this.gesture = true;
    this.stage.setOrbit(false);
    this.history.begin();
  }

  endGesture(commit: boolean): void {
    this.gesture = false;
    this.stage.setOrbit(true);
    if (commit) this.history.commit();
    else {
      this.history.cancel();
      this.changed(true);
    }
    this.set({ canUndo: this.history.canUndo, canRedo: this.history.canRedo });
    this.announce();
  }

  undo(): void {
    if (this.history.undo()) this.restored();
  }

  redo(): void {
    if (this.history.redo()) this.restored();
  }

  private restored(): void {
    const before = this.store.getState().scene.character;
    const { selected } = this.store.getState();
    if (selected && !this.history.scene.tasks.some((t) => t.id === selected)) this.set({ selected: null });
    this.changed(true);
    if (JSON.stringify(before) !== JSON.stringify(this.history.scene.character)) this.askMesh();
  }

  select(id: string | null, open: boolean): void {
    this.set({ selected: id, tab: id && open ? "task" : this.store.getState().tab });
    this.stage.setScene(this.store.getState().scene, id);
    this.show();
  }

  setTool(tool: Tool): void {
    this.set({ tool });
  }

  private canvasDown(e: PointerEvent): void {
    const s = this.store.getState();
    if (e.button !== 0) return;
    const box = this.places.canvas.getBoundingClientRect();
    if (s.tool === "select") {
      if (s.menu !== "none") this.set({ menu: "none" });
      return;
    }
    if (s.tool === "path") {
      drawPath(this, this.places.canvas, e, (p) =>
        this.stage.levelPoint(p.clientX - box.left, p.clientY - box.top, 0),
      );
      return;
    }
    const point = this.stage.levelPoint(e.clientX - box.left, e.clientY - box.top, 0);
    if (!point) return;
    this.add(s.tool, point[0], point[1]);
  }

  private canvasMove(e: PointerEvent): void {
    if (this.gesture || e.buttons !== 0) return;
    const box = this.places.canvas.getBoundingClientRect();
    const i = this.stage.pickFootprint(e.clientX - box.left, e.clientY - box.top) - 2;
    this.hoverStep(i);
  }

  hoverStep(index: number): void {
    if (this.store.getState().hoverStep === index) return;
    this.set({ hoverStep: index });
    this.stage.setSelectedFootprint(index >= 0 ? index + 2 : -1);
  }

  /** Puts a task down, facing away from the viewer, and selects it. */
  add(category: TaskCategory, x: number, z: number): void {
    const added = commands.addTask(this.history.scene, category, x, z, category === "sit" ? Math.PI : 0);
    this.history.apply(added.scene);
    this.set({ tool: "select", selected: added.id, tab: "task" });
    this.changed(true);
  }

  duplicate(): void {
    const { selected } = this.store.getState();
    if (!selected) return;
    const copy = commands.duplicateTask(this.history.scene, selected);
    this.history.apply(copy.scene);
    this.set({ selected: copy.id, tab: "task" });
    this.changed(true);
  }

  remove(): void {
    const { selected } = this.store.getState();
    if (!selected) return;
    this.history.apply(commands.removeTask(this.history.scene, selected));
    this.set({ selected: null, tab: "scene" });
    this.changed(true);
    this.say("Task deleted.", true);
  }

  /** How far along its way the character is at the present time, 0 to 1: by the distance that its hips have gone. */
  shareOfPath(): number {
    const m = this.motion.current;
    if (!m || m.filled < 2) return 0.5;
    const now = Math.min(m.filled - 1, Math.floor(this.store.getState().time * 60));
    let gone = 0;
    let all = 0;
    for (let f = 1; f < m.filled; f++) {
      all += Math.hypot(m.root[3 * f] - m.root[3 * f - 3], m.root[3 * f + 2] - m.root[3 * f - 1]);
      if (f === now) gone = all;
    }
    return all > 0 ? gone / all : 0.5;
  }

  removePath(id: string): void {
    this.edit((scene, c) => c.removePath(scene, id));
    this.say("Path deleted.", true);
  }

  /** Height and legs; `done` when the slider is let go. */
  setBuild(height: number, leg: number, done: boolean): void {
    if (!this.gesture) this.beginGesture();
    this.edit((scene, c) => c.setCharacter(scene, height, leg));
    this.askMesh();
    if (done) this.endGesture(true);
  }

  // ---- scenes and files ----------------------------------------------------------------------------------------

  private replace(scene: Scene, name: string): void {
    this.history.apply(scene);
    this.set({ selected: null, tab: "scene", menu: "none", time: 0 });
    this.begun = false;
    this.changed(true);
    this.askMesh();
    this.frameScene();
    this.say(`${name} opened.`, true);
  }

  openExample(example: Example): void {
    this.replace(example.scene(), example.name);
  }

  newScene(): void {
    this.replace(parseScene({ version: 1 }), "An empty room");
  }

  openFile(): void {
    const input = document.createElement("input");
    input.type = "file";
    input.accept = ".json,application/json";
    input.onchange = () => {
      const file = input.files?.[0];
      if (file) void this.openText(file);
    };
    input.click();
  }

  async openText(file: File): Promise<void> {
    try {
      this.replace(readScene(await file.text(), file.name), file.name);
    } catch (error) {
      this.fail(error instanceof Error ? error.message : String(error));
    }
  }

  exportScene(): void {
    this.set({ menu: "none" });
    download("scene.json", serializeScene(this.history.scene), "application/json");
  }

  exportBvh(): void {
    this.set({ menu: "none" });
    const m = this.motion.current;
    if (!m || m.filled < m.frames) {
      this.fail("The motion is not finished yet.");
      return;
    }
    const { height, proportions } = this.history.scene.character;
    const clip = {
      name: "scene",
      skeleton: createSkeleton(height, proportions),
      rate: 60,
      frames: m.frames,
      root: Float64Array.from(m.root),
      rotations: Float64Array.from(m.rotations),
    };
    download("motion.bvh", writeBvh(clip), "text/plain");
  }

  exportResult(): void {
    this.set({ menu: "none" });
    const s = this.store.getState();
    const m = this.motion.current;
    if (!s.plan || !s.quality || !m) {
      this.fail("The motion is not finished yet.");
      return;
    }
    download(
      "result.json",
      `${JSON.stringify(resultDocument(s.scene, s.plan, m.contacts, s.quality))}\n`,
      "application/json",
    );
  }

  exportPicture(): void {
    this.set({ menu: "none" });
    this.stage.onDraw = () => {
      this.stage.onDraw = () => this.markers.draw();
      this.places.canvas.toBlob((blob) => {
        if (blob) download("room.png", blob, "image/png");
      });
    };
    this.stage.invalidate();
  }

  // ---- the rest of the page ------------------------------------------------------------------------------------

  setTab(tab: EditorState["tab"]): void {
    this.set({ tab });
  }

  setMenu(menu: EditorState["menu"]): void {
    this.set({ menu: this.store.getState().menu === menu ? "none" : menu });
  }

  setHelp(help: boolean): void {
    this.set({ help });
  }

  toggleTheme(): void {
    const theme = this.store.getState().theme === "light" ? "dark" : "light";
    document.documentElement.dataset.theme = theme;
    this.stage.setTheme(theme);
    this.set({ theme });
    this.stage.setScene(this.history.scene, this.store.getState().selected);
    this.show();
  }

  toggleTable(name: string): void {
    if (!this.tables.delete(name)) this.tables.add(name);
    this.draw();
  }

  setColouring(colouring: EditorState["colouring"]): void {
    this.set({ colouring });
    this.drawFootprints();
  }

  setShowBefore(showBefore: boolean): void {
    this.set({ showBefore });
    this.drawFootprints();
  }

  /** A sentence at the bottom of the viewport, for six seconds. */
  say(text: string, undo: boolean): void {
    window.clearTimeout(this.toastTimer);
    this.set({ toast: { text, undo } });
    this.toastTimer = window.setTimeout(() => this.set({ toast: null }), 6000);
  }

  fail(message: string): void {
    this.set({ error: message });
    this.say(message, false);
  }

  /** The worker is ended as if it had died: it is replaced and the scene sent again. */
  restartPlanner(): void {
    this.planner.restart();
  }
}
