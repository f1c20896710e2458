/** The crowd of the scene as it runs: its worker, its clock, and the walker that is looked at. */

import type { CrowdFootstep } from "../../core/crowd/footfalls.ts";
import { crowdOfScene } from "../../core/crowd/from-scene.ts";
import type { PlanStory } from "../../core/crowd/plan-story.ts";
import type { CrowdWorld } from "../../core/crowd/types.ts";
import { elapsed } from "../../core/math/elapsed.ts";
import type { Scene } from "../../core/scene/types.ts";
import type { CharacterMesh } from "../../view/character/build-mesh.ts";
import type { CrowdFrame, CrowdRequest, CrowdResponse } from "../../workers/crowd-protocol.ts";
import type { Editor } from "../editor.ts";

const MOST_DEATHS = 3;
/** Milliseconds between looks at the picked walker's plan. */
const LOOK_EVERY = 120;

export class CrowdSession {
  /** Seconds on the crowd's clock. */
  seconds = 0;
  running = false;
  agents = 0;
  left = 0;
  picked = -1;
  frame: CrowdFrame | null = null;
  story: PlanStory | null = null;
  footsteps: CrowdFootstep[] = [];
  figures: Extract<CrowdResponse, { type: "frame" }>["figures"] | null = null;
  repairs: readonly string[] = [];
  meshes: CharacterMesh[] | null = null;
  ready = false;
  /** Drawn anew: a frame, meshes or marks have come. */
  onFrame: () => void = () => undefined;
  private onHash: (hash: string) => void = () => undefined;
  private worker: Worker | null = null;
  private deaths = 0;
  private id = 0;
  private asking = false;
  private spare: CrowdFrame | null = null;
  private lastTick = 0;
  private lastLook = 0;
  private lastDraw = 0;
  private shown: { crowd: Scene["crowd"]; props: Scene["props"]; seed: number } | null = null;

  constructor(private readonly e: Editor) {}

  get hasCrowd(): boolean {
    return this.e.store.getState().scene.crowd !== null;
  }

  /** Follows the scene: a crowd that is new begins, one whose walls or goals changed goes on among them. */
  follow(): void {
    const { scene } = this.e.store.getState();
    const same =
      this.shown !== null &&
      this.shown.crowd === scene.crowd &&
      this.shown.seed === scene.seed &&
      (scene.crowd === null || this.shown.props === scene.props);
    if (same) return;
    const before = this.shown?.crowd ?? null;
    this.shown = { crowd: scene.crowd, props: scene.props, seed: scene.seed };
    if (!scene.crowd) {
      this.stop();
      return;
    }
    const world = crowdOfScene(scene, "scene");
    this.repairs = world.repairs;
    this.id++;
    if (before === null || !this.ready) this.begin(world);
    else this.send({ type: "change", id: this.id, world });
  }

  /** From the start again. */
  restart(): void {
    const { scene } = this.e.store.getState();
    if (!scene.crowd) return;
    this.id++;
    this.begin(crowdOfScene(scene, "scene"));
  }

  setRunning(running: boolean): void {
    if (running === this.running) return;
    this.running = running;
    if (running) {
      this.lastTick = performance.now();
      requestAnimationFrame(() => this.tick());
    }
    this.e.redraw();
  }

  /** The scene's crowd simulated from its start in the worker: a hash of all its trajectories. */
  hash(seconds: number): Promise<string> {
    const world = crowdOfScene(this.e.store.getState().scene, "scene");
    return new Promise((resolve) => {
      this.onHash = resolve;
      this.send({ type: "simulate", id: this.id, world, seconds });
    });
  }

  /** Looks at a walker; -1 for none. */
  pick(agent: number): void {
    this.picked = agent;
    this.story = null;
    this.footsteps = [];
    this.lastLook = 0;
    this.ask();
    this.onFrame();
    this.e.redraw();
  }

  private begin(world: CrowdWorld): void {
    this.seconds = 0;
    this.picked = -1;
    this.story = null;
    this.footsteps = [];
    this.ready = false;
    if (!this.meshes) this.send({ type: "meshes" });
    this.send({ type: "start", id: this.id, world });
    if (!window.matchMedia("(prefers-reduced-motion: reduce)").matches) this.setRunning(true);
  }

  private stop(): void {
    this.running = false;
    this.ready = false;
    this.agents = 0;
    this.picked = -1;
    this.story = null;
    this.footsteps = [];
    this.frame = null;
    this.onFrame();
  }

  private send(request: CrowdRequest, transfer: Transferable[] = []): void {
    this.worker ??= this.start();
    this.worker.postMessage(request, transfer);
  }

  private start(): Worker {
    const worker = new Worker(new URL("../../workers/crowd-worker.ts", import.meta.url), { type: "module" });
    worker.onmessage = (event: MessageEvent<CrowdResponse>) => this.hear(event.data);
    worker.onerror = (event) => {
      event.preventDefault();
      worker.terminate();
      this.worker = null;
      this.asking = false;
      this.spare = null;
      if (this.deaths++ >= MOST_DEATHS) {
        this.e.fail("The crowd cannot be simulated: its worker stops each time. Reload the page.");
        return;
      }
      this.e.say("The crowd restarted. Nothing of the scene was lost.", false);
      this.restart();
    };
    return worker;
  }

  private tick(): void {
    if (!this.running) return;
    const now = performance.now();
    const passed = elapsed(this.lastTick, now);
    this.lastTick = now;
    // The clock waits while the worker catches up.
    if (this.ready && !this.asking) {
      this.seconds += passed;
      this.ask();
    }
    requestAnimationFrame(() => this.tick());
  }

  /** Asks for the present moment, one request at a time. */
  private ask(): void {
    if (!this.ready || this.asking) return;
    this.asking = true;
    const now = performance.now();
    const look = this.picked >= 0 && now - this.lastLook > LOOK_EVERY;
    if (look) this.lastLook = now;
    const frame = this.spare;
    this.spare = null;
    this.send(
      { type: "show", id: this.id, seconds: this.seconds, picked: look ? this.picked : -1, frame },
      frame ? [frame.matrices.buffer, frame.places.buffer, frame.here.buffer] : [],
    );
  }

  private hear(answer: CrowdResponse): void {
    switch (answer.type) {
      case "meshes":
        this.meshes = answer.meshes;
        this.onFrame();
        break;
      case "ready":
        if (answer.id !== this.id) return;
        this.ready = true;
        this.agents = this.left = answer.agents;
        this.ask();
        this.e.redraw();
        break;
      case "changed":
        if (answer.id === this.id && answer.again) {
          this.seconds = 0;
          this.ready = false;
        }
        break;
      case "frame":
        this.asking = false;
        this.spare = this.frame;
        this.frame = answer.frame;
        this.left = answer.left;
        this.figures = answer.figures;
        if (answer.story) this.story = answer.story;
        if (answer.story || answer.footsteps.length > 0) this.footsteps = answer.footsteps;
        if (!answer.reached) this.ask();
        if (this.left === 0 && this.running) this.setRunning(false);
        this.onFrame();
        if (performance.now() - this.lastDraw > 250) {
          this.lastDraw = performance.now();
          this.e.redraw();
        }
        break;
      case "simulated":
        this.onHash(answer.hash);
        break;
      case "failed":
        this.asking = false;
        this.e.fail(answer.message);
        break;
    }
  }
}

/** Whether a scene is its crowd's alone: the one character has nothing to do in it, and is not there. */
export const crowdAlone = (scene: Scene): boolean => scene.crowd !== null && scene.order.length === 0;

const sessions = new WeakMap<Editor, CrowdSession>();

/** The editor's crowd. */
export function crowdSession(e: Editor): CrowdSession {
  let s = sessions.get(e);
  if (!s) {
    s = new CrowdSession(e);
    sessions.set(e, s);
  }
  return s;
}
