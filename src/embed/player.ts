/**
 * Plays a scene: asks the page's planner, keeps the frames that arrive, moves the playing time, and draws on a stage when it has one.
 * It knows nothing of buttons and attributes.
 */
import { elapsed } from "../core/math/elapsed.ts";
import type { QualityFigures } from "../core/motion/types.ts";
import { History } from "../core/scene/history.ts";
import { parseScene } from "../core/scene/schema.ts";
import type { Scene } from "../core/scene/types.ts";
import { JOINT_COUNT } from "../core/skeleton/joints.ts";
import { createSkeleton } from "../core/skeleton/skeleton.ts";
import type { Plan } from "../core/tasks/plan-types.ts";
import { MotionStore } from "../editor/session/motion-store.ts";
import { COARSE } from "../view/character/fineness.ts";
import type { Footprint } from "../view/footprints.ts";
import type { PlannerResponse } from "../workers/protocol.ts";
import { characterMesh } from "./mesh-hub.ts";
import { PlannerHub } from "./planner-hub.ts";
import type { SceneView } from "./scene-view.ts";

const Q = 4 * JOINT_COUNT;

export interface PlayerEvents {
  /** Footsteps are known; the motion follows. */
  planned(plan: Plan): void;
  /** All frames have arrived. */
  solved(quality: QualityFigures): void;
  /** The playing time changed, by playing or by seeking. */
  time(seconds: number): void;
  /** Playing began or ended; `ended` at the motion's end. */
  playing(playing: boolean, ended: boolean): void;
  /** The user, or a call, changed the scene. */
  changed(scene: Scene): void;
  failed(message: string): void;
}

export class Player {
  readonly motion = new MotionStore();
  plan: Plan | null = null;
  quality: QualityFigures | null = null;
  time = 0;
  playing = false;
  loop = true;
  speed = 1;
  /** Plays as soon as there is something to play. */
  autoplay = false;
  /** A drag is under way. */
  dragging = false;
  private history: History;
  private readonly hub = PlannerHub.shared();
  private readonly asker: number;
  private stage: SceneView | null = null;
  private asked = 0;
  private lastTick = 0;
  private ticking = 0;
  private paused = true;
  private begun = false;
  private meshKey = "";
  private selected: readonly string[] = [];

  constructor(
    scene: Scene,
    private readonly events: PlayerEvents,
  ) {
    this.history = new History(scene);
    this.asker = this.hub.join((m) => this.hear(m));
    this.ask(false);
  }

  get scene(): Scene {
    return this.history.scene;
  }
  get duration(): number {
    return this.plan?.duration ?? 0;
  }
  get canUndo(): boolean {
    return this.history.canUndo;
  }
  /** Where the planner of this page runs. */
  get where(): "worker" | "page" {
    return this.hub.where;
  }

  /** Draws on `stage` from now on; null for nowhere. */
  attach(stage: SceneView | null): void {
    this.stage = stage;
    this.meshKey = "";
    if (!stage) return;
    stage.setScene(this.scene, this.selected);
    this.frame();
    this.skin();
    this.show();
  }

  /** Fits the scene into the picture. */
  frame(): void {
    const { start, tasks, paths, stones } = this.scene;
    this.stage?.frame([
      [start.position[0], 0, start.position[1]],
      ...tasks.map((t) => t.position),
      ...paths.flatMap((p) => p.points.map((q): [number, number, number] => [q[0], 0, q[1]])),
      ...stones.map((s) => s.position),
    ]);
  }

  /** Off screen nothing is drawn and no time passes. */
  setPaused(paused: boolean): void {
    if (this.paused === paused) return;
    this.paused = paused;
    if (!paused && this.playing) this.startTicking();
  }

  // ---- scene -----------------------------------------------------------------------------------------------------

  /** Another scene, from its start. Undo forgets what was before. */
  load(scene: Scene): void {
    this.history = new History(scene);
    this.selected = [];
    this.time = 0;
    this.begun = false;
    this.stage?.setScene(scene, []);
    this.frame();
    this.skin();
    this.ask(true);
    this.show();
  }

  /** One change of the scene. @throws SceneError when the schema refuses the outcome; the scene is then as it was. */
  edit(change: (scene: Scene) => Scene): void {
    const scene = change(this.scene);
    if (scene === this.scene) return;
    parseScene(scene);
    this.history.apply(scene);
    this.changed();
  }

  beginDrag(): void {
    this.dragging = true;
    this.stage?.setOrbit(false);
    this.history.begin();
  }

  endDrag(keep: boolean): void {
    this.dragging = false;
    this.stage?.setOrbit(true);
    if (keep) this.history.commit();
    else {
      this.history.cancel();
      this.changed();
    }
  }

  undo(): void {
    if (this.history.undo()) this.changed();
  }

  select(id: string | null): void {
    if ((this.selected[0] ?? null) === id) return;
    this.selected = id === null ? [] : [id];
    this.stage?.setScene(this.scene, this.selected);
    this.show();
  }

  private changed(): void {
    this.stage?.setScene(this.scene, this.selected);
    this.skin();
    this.ask(true);
    this.show();
    this.events.changed(this.scene);
  }

  /** The character's skin, when its build is another than the one drawn. */
  private skin(): void {
    const { stage } = this;
    if (!stage?.setCharacter) return;
    const { height, proportions } = this.scene.character;
    const key = JSON.stringify([height, proportions]);
    if (key === this.meshKey) return;
    this.meshKey = key;
    const wanted = () => this.stage === stage && this.meshKey === key;
    const wear = async (fineness: number) => {
      const mesh = await characterMesh(height, proportions, fineness);
      if (!wanted()) return;
      stage.setCharacter?.(createSkeleton(height, proportions), mesh);
      this.show();
    };
    // A coarse skin at once, so that the character stands there; then the one that is looked at.
    wear(COARSE)
      .then(() => (wanted() ? wear(1) : undefined))
      .catch((error: unknown) => this.events.failed(error instanceof Error ? error.message : String(error)));
  }

  // ---- planner ---------------------------------------------------------------------------------------------------

  private ask(urgent: boolean): void {
    const now = this.begun && this.time > 0 && this.time < this.duration - 0.01 ? this.time : null;
    this.asked = this.hub.plan(this.asker, this.scene, now, urgent);
  }

  private hear(m: PlannerResponse): void {
    switch (m.type) {
      case "planned":
        if (m.id !== this.asked) return;
        this.plan = m.plan;
        this.time = Math.min(this.time, m.plan.duration);
        this.motion.begin(m.id, m.frames);
        this.drawFootprints();
        this.events.planned(m.plan);
        break;
      case "motion":
        if (m.id !== this.asked) return;
        if (this.motion.add(m.id, m.chunk, Math.floor(this.time * 60)) && !this.begun) {
          this.begun = true;
          if (this.autoplay) this.play();
        }
        this.show();
        break;
      case "finished":
        if (m.id !== this.asked) return;
        this.motion.finish(m.id, m.boxes, m.ink);
        this.quality = m.quality;
        this.show();
        this.events.solved(m.quality);
        break;
      case "failed":
        this.events.failed(m.message);
        break;
      case "ready":
      case "dropped":
      case "overtaken":
        break;
    }
  }

  // ---- playing ---------------------------------------------------------------------------------------------------

  play(): void {
    if (this.playing) return;
    if (this.time >= this.duration - 0.02) this.rewind(0);
    this.playing = true;
    this.events.playing(true, false);
    this.startTicking();
  }

  pause(): void {
    if (!this.playing) return;
    this.playing = false;
    this.events.playing(false, false);
  }

  /** Shows a time, seconds, held to the motion's; playing goes on from there. */
  seek(time: number): void {
    this.rewind(Math.max(0, Math.min(this.duration, time)));
    this.show();
    this.events.time(this.time);
  }

  private rewind(time: number): void {
    // Boxes that the motion carried are where the scene has them.
    if (time < this.time) this.stage?.setScene(this.scene, this.selected);
    this.time = time;
  }

  private startTicking(): void {
    if (this.ticking !== 0 || this.paused) return;
    this.lastTick = performance.now();
    this.ticking = requestAnimationFrame(() => this.tick());
  }

  private tick(): void {
    this.ticking = 0;
    if (!this.playing || this.paused) return;
    const now = performance.now();
    const passed = elapsed(this.lastTick, now);
    this.lastTick = now;
    let time = this.time + passed * this.speed;
    const m = this.motion.current;
    if (!m || m.filled < m.frames) time = Math.min(time, Math.max(this.time, ((m?.filled ?? 1) - 1) / 60));
    let ended = false;
    if (time >= this.duration) {
      if (this.loop && !this.dragging) time = 0;
      else {
        time = this.duration;
        ended = true;
      }
    }
    this.rewind(time);
    this.show();
    this.events.time(time);
    if (ended) {
      this.playing = false;
      this.events.playing(false, true);
    } else this.ticking = requestAnimationFrame(() => this.tick());
  }

  /** Draws the present time. */
  show(): void {
    const { stage } = this;
    if (!stage) return;
    const m = this.motion.current;
    if (m && m.filled > 0) {
      const f = Math.max(0, Math.min(m.filled - 1, Math.floor(this.time * 60)));
      stage.setPose(m.root, 3 * f, m.rotations, Q * f);
      stage.setBoxes(m.boxes, f);
      stage.setInk(m.ink, this.time);
    }
    this.drawFootprints();
  }

  private drawFootprints(): void {
    const { plan, time } = this;
    if (!plan || !this.stage) return;
    const prints: Footprint[] = [
      ...plan.start.map(
        (f): Footprint => ({ ...f, category: null, phase: null, state: time > 0.5 ? "past" : "now" }),
      ),
      ...plan.steps.map(
        (p): Footprint => ({
          foot: p.foot,
          x: p.x,
          y: p.y,
          z: p.z,
          yaw: p.yaw,
          category: p.category,
          phase: p.phase,
          state: p.land < time - 0.9 ? "past" : p.land <= time ? "now" : "next",
        }),
      ),
    ];
    this.stage.setFootprints(prints, "category");
  }

  dispose(): void {
    cancelAnimationFrame(this.ticking);
    this.playing = false;
    this.hub.leave(this.asker);
    this.stage = null;
  }
}
