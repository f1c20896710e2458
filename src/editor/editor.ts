/**
 * The editor: joins the scene, the plan, the clock, the stage and what the features add. Parts draw from its state and
 * call its sessions; planning and motion are the worker's.
 */
import { render } from "lit";
import type { Scene } from "../core/scene/types.ts";
import { Stage } from "../view/stage.ts";
import { ALL_FEATURES } from "./features/all.ts";
import { Registry } from "./features/feature.ts";
import { LayerHost } from "./layers/layer.ts";
import { edges } from "./parts/edges.ts";
import { overlayChips } from "./parts/overlay.ts";
import { panel } from "./parts/panel.ts";
import { timeline } from "./parts/timeline.ts";
import { toolRail } from "./parts/tool-rail.ts";
import { topBar } from "./parts/top-bar.ts";
import { CharacterSession } from "./session/character-session.ts";
import { Files } from "./session/files.ts";
import { GuestSession } from "./session/guest-session.ts";
import { LongWork } from "./session/long-work.ts";
import { PlanSession } from "./session/plan-session.ts";
import { Playback } from "./session/playback.ts";
import { SceneSession } from "./session/scene-session.ts";
import { createEditorStore, type EditorState, type Store } from "./state.ts";
import type { Thing } from "./things/thing.ts";
import { ToolHost } from "./tools/tool-host.ts";
import { Markers } from "./viewport/markers.ts";

/** Metres and radians that snapping rounds to, and metres that feet stand before a seat. */
const SNAP_PLACE = 0.05;
const FEET_BEFORE_SEAT = 0.6;
const SNAP_TURN = Math.PI / 12;
const snapTo = (v: number, step: number): number => Math.round(v / step) * step;

export interface Places {
  top: HTMLElement;
  viewport: HTMLElement;
  panel: HTMLElement;
  timeline: HTMLElement;
  live: HTMLElement;
  edges: HTMLElement;
  canvas: HTMLCanvasElement;
}

export class Editor {
  readonly store: Store;
  readonly stage: Stage;
  readonly registry = new Registry(ALL_FEATURES);
  readonly scene: SceneSession;
  readonly plan: PlanSession;
  readonly playback: Playback;
  readonly character: CharacterSession;
  readonly files: Files;
  readonly guest: GuestSession;
  readonly work: LongWork;
  readonly layers: LayerHost;
  readonly tools: ToolHost;
  readonly markers: Markers;
  /** Plots shown as tables, by name. */
  readonly tables = new Set<string>();
  tracksSize = { width: 800, height: 120 };
  private drawing = false;
  private toastTimer = 0;

  /** @throws Error when the browser has no WebGL 2. */
  constructor(
    private readonly places: Places,
    scene: Scene,
    name: string,
    theme: EditorState["theme"],
  ) {
    this.store = createEditorStore(scene, name, theme);
    // Planner and skin first: they work while the room is made.
    this.plan = new PlanSession(this);
    this.plan.ask();
    this.character = new CharacterSession(this);
    this.character.follow();
    // A worker hears nothing while its page is held up, and making the room's shaders holds it up: the planner gets its scene
    // first, and plans meanwhile.
    this.stage = new Stage(places.canvas, this.plan.started());
    this.layers = new LayerHost(this);
    this.markers = new Markers(this, places.viewport.querySelector(".overlay") as HTMLElement);
    this.stage.onDraw = () => this.markers.draw();
    this.stage.onLost = () =>
      this.fail(
        "The browser has taken the drawing away and does not give it back. Save the scene (Ctrl S), then reload the page.",
      );
    this.tools = new ToolHost(this, places.canvas);
    this.playback = new Playback(this);
    this.scene = new SceneSession(this, scene);
    this.files = new Files(this);
    this.guest = new GuestSession(this);
    this.work = new LongWork(this);
    this.store.subscribe(() => this.redraw());
    document.documentElement.dataset.theme = theme;
    this.stage.setTheme(theme);
    for (const make of this.registry.layers) this.layers.add(make(this));
    this.resize();
    new ResizeObserver(() => this.resize()).observe(places.viewport);
    new ResizeObserver(() => this.resize()).observe(places.timeline);
    this.frameScene();
    for (const f of this.registry.features) f.start?.(this);
    this.redraw();
  }

  /** Changes the state; the page is drawn anew. */
  set(change: Partial<EditorState>): void {
    this.store.setState(change);
  }

  /** Draws the page's parts, once for all changes of a moment. */
  redraw(): void {
    if (this.drawing) return;
    this.drawing = true;
    queueMicrotask(() => {
      this.drawing = false;
      render(topBar(this), this.places.top);
      render(panel(this), this.places.panel);
      render(timeline(this), this.places.timeline);
      const chips = this.places.viewport.querySelector(".chips") as HTMLElement;
      render([toolRail(this), overlayChips(this)], chips);
      edges(this, this.places.edges);
    });
  }

  private resize(): void {
    const box = this.places.viewport.getBoundingClientRect();
    const floats = window.innerWidth < 1200 && window.innerWidth >= 760;
    const narrow = window.innerWidth < 760;
    // The figures stand at the top; at the bottom the legend, or a tool's choices over the sheet's edge.
    this.stage.resize(box.width, box.height, {
      left: narrow ? 0 : 56,
      top: 40,
      right: floats ? 284 : 0,
      bottom: narrow ? 84 : 40,
    });
    // The scene of now: a path that opens its lanes takes some of the viewport.
    if (this.stage.framing && !this.tools.busy) this.frameScene();
    const tracks = this.places.timeline.getBoundingClientRect();
    this.tracksSize = { width: Math.max(240, tracks.width - 24), height: Math.max(60, tracks.height - 54) };
    this.redraw();
  }

  /** Every thing that can be selected, kind by kind, in the order of the plan. */
  things(): Thing[] {
    return this.registry.things.flatMap((kind) => kind.list(this));
  }

  /** Frames what is at hand: a layer's own figures while they are shown, else the scene. */
  frameScene(): void {
    const own = this.layers.frames();
    if (own) {
      this.stage.frame(own);
      return;
    }
    const { scene } = this.store.getState();
    this.stage.frame([
      [scene.start.position[0], 0, scene.start.position[1]],
      ...this.things().map((t): [number, number, number] => [t.position[0], t.position[1], t.position[2]]),
      // Who sits has the feet before the seat.
      ...scene.tasks
        .filter((t) => t.category === "sit")
        .map(({ position: [x, , z], yaw }): [number, number, number] => [
          x + FEET_BEFORE_SEAT * Math.sin(yaw),
          0,
          z + FEET_BEFORE_SEAT * Math.cos(yaw),
        ]),
      // Walls are seen to their ends.
      ...scene.props
        .filter((p) => p.kind === "wall")
        .flatMap(({ position: [x, , z], yaw, size: [width] }) =>
          [-width / 2, width / 2].map((a): [number, number, number] => [
            x + a * Math.cos(yaw),
            0,
            z - a * Math.sin(yaw),
          ]),
        ),
      ...scene.paths.flatMap((p) => p.points.map((q): [number, number, number] => [q[0], 0, q[1]])),
    ]);
  }

  /** The scene is another: drawn, planned, shown. */
  sceneChanged(): void {
    // The planner first: it plans while the page draws.
    this.plan.ask();
    this.layers.update("scene");
    this.character.follow();
    this.playback.show();
  }

  /** One change of the scene by a command. @returns whether it was done. */
  edit(...change: Parameters<SceneSession["edit"]>): boolean {
    return this.scene.edit(...change);
  }

  /** Whether places and turns snap now: Shift frees them while it is held. */
  snaps(ev: { shiftKey: boolean } = { shiftKey: false }): boolean {
    return this.store.getState().snap && !ev.shiftKey;
  }

  /** A place on the ground at whole 5 cm, unless snapping is off or freed. */
  snapped(at: readonly [number, number], ev?: { shiftKey: boolean }): [number, number] {
    return this.snaps(ev) ? [snapTo(at[0], SNAP_PLACE), snapTo(at[1], SNAP_PLACE)] : [at[0], at[1]];
  }

  /** A yaw at whole 15 degrees, unless snapping is off or freed. */
  snappedYaw(yaw: number, ev?: { shiftKey: boolean }): number {
    return this.snaps(ev) ? snapTo(yaw, SNAP_TURN) : yaw;
  }

  // ---- the rest of the page ------------------------------------------------------------------------------------

  hoverStep(index: number): void {
    if (this.store.getState().hoverStep === index) return;
    this.set({ hoverStep: index });
    this.stage.setSelectedFootprint(index >= 0 ? index + 2 : -1);
  }

  /** Opens a menu, or closes the one that is open. */
  setMenu(menu: string | null): void {
    this.set({ menu: this.store.getState().menu === menu ? null : menu });
  }

  toggleTheme(): void {
    const theme = this.store.getState().theme === "light" ? "dark" : "light";
    document.documentElement.dataset.theme = theme;
    this.stage.setTheme(theme);
    this.set({ theme });
    this.layers.theme(theme);
    this.layers.update("look");
    this.playback.show();
  }

  toggleTable(name: string): void {
    if (!this.tables.delete(name)) this.tables.add(name);
    this.redraw();
  }

  /** Shows footprints by category or phase, as laid or as optimised. */
  showFootprints(change: Partial<Pick<EditorState, "colouring" | "showBefore">>): void {
    this.set(change);
    this.layers.update("look");
    this.playback.show();
  }

  /** For screen readers, politely. */
  announce(text: string): void {
    this.places.live.textContent = text;
  }

  /** A sentence at the bottom of the viewport, for six seconds. */
  say(text: string, undo: boolean, warns = false): void {
    window.clearTimeout(this.toastTimer);
    this.set({ toast: { text, undo, warns } });
    this.toastTimer = window.setTimeout(() => this.set({ toast: null }), 6000);
  }

  /** A sentence that is hovered or focused stays; it goes six seconds after. */
  holdToast(held: boolean): void {
    window.clearTimeout(this.toastTimer);
    if (!held) this.toastTimer = window.setTimeout(() => this.set({ toast: null }), 6000);
  }

  fail(message: string): void {
    this.set({ error: message });
    this.say(message, false, true);
  }
}
