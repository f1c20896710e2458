/** The plan and its motion: asks the planner for the newest scene, and takes its answers in. */
import type { PathOptions } from "../../core/styles/synthesise-path.ts";
import type { PlannerResponse } from "../../workers/protocol.ts";
import type { Editor } from "../editor.ts";
import { MotionStore } from "./motion-store.ts";
import { PlannerClient } from "./planner-client.ts";

/** What happened between page and planner, in order: for tests and for the curious. */
export interface LogEntry {
  what: PlannerResponse["type"] | "asked" | "drawn" | "changed-over";
  id: number;
  /** Milliseconds since the page was asked for. */
  at: number;
}

/** Entries of the log that are kept at most; the older half goes then. */
const MOST_NOTED = 2000;
/** Milliseconds that the first picture waits for the planner. */
const MOST_PATIENCE = 1000;

export class PlanSession {
  readonly motion = new MotionStore();
  readonly log: LogEntry[] = [];
  /** For stones: 0 follows the footsteps, 1 the root alone; not part of the scene. */
  lambda4 = 0;
  /** Enhancements of walks along paths that are switched; sent with each request. */
  pathOptions: Partial<PathOptions> = {};
  readonly planner: PlannerClient;
  private readonly listeners = new Set<(m: PlannerResponse) => void>();
  private answered = false;
  private readonly patient: (() => void)[] = [];
  private askedId = 0;
  private plannedId = 0;
  /** Whether the first motion of the scene has begun to play. */
  private begun = false;

  constructor(private readonly e: Editor) {
    this.planner = new PlannerClient(new URL("generated/library.bin", document.baseURI).href, {
      message: (m) => this.hear(m),
      restarted: () => e.say("The planner restarted. Nothing was lost.", false, true),
    });
  }

  /** Seconds. */
  get duration(): number {
    return this.e.store.getState().plan?.duration ?? 0;
  }

  /** Asks for the present scene's plan: steps begun by now are kept while the motion is being shown. */
  ask(): void {
    const s = this.e.store.getState();
    const now = this.begun && s.time > 0 && s.time < this.duration - 0.01 ? s.time : null;
    this.askedId = this.planner.plan(s.scene, now, { paths: this.pathOptions, lambda4: this.lambda4 });
    this.note("asked", this.askedId);
  }

  /** A person's own library beside the shipped one, or none any more. */
  useLibrary(bytes: Uint8Array | null): void {
    this.planner.useOwn(bytes);
  }

  /** Sets lambda_4 and plans anew. */
  follow(lambda4: number): void {
    this.lambda4 = lambda4;
    this.ask();
    this.e.redraw();
  }

  /** The next motion starts by itself, from the beginning. */
  startOver(): void {
    this.begun = false;
  }

  /** Hears every answer of the planner that is not out of date, after the session has taken it in. */
  listen(listener: (m: PlannerResponse) => void): void {
    this.listeners.add(listener);
  }

  /** Settles when the planner has its first scene, or after a second: until then the page should leave it the time. */
  started(): Promise<void> {
    return new Promise((resolve) => {
      setTimeout(resolve, MOST_PATIENCE);
      this.listen((m) => m.type === "started" && resolve());
    });
  }

  /** Calls back once the first plan has its whole motion or has failed; at once when one has. */
  whenAnswered(act: () => void): void {
    if (this.answered) act();
    else this.patient.push(act);
  }

  private note(what: LogEntry["what"], id: number): void {
    this.log.push({ what, id, at: performance.now() });
    if (this.log.length > MOST_NOTED) this.log.splice(0, MOST_NOTED / 2);
  }

  private hear(m: PlannerResponse): void {
    if ("id" in m) this.note(m.type, m.id);
    this.take(m);
    if (!this.answered && (m.type === "finished" || m.type === "failed")) {
      this.answered = true;
      for (const act of this.patient.splice(0)) act();
    }
    for (const listener of this.listeners) if (!("id" in m) || m.id === this.askedId) listener(m);
  }

  private take(m: PlannerResponse): void {
    const { e } = this;
    switch (m.type) {
      case "ready":
        e.set({ status: null, transitions: m.transitions });
        break;
      case "planned":
        if (m.id !== this.askedId) return;
        this.plannedId = m.id;
        this.motion.begin(m.id, m.frames);
        e.set({ plan: m.plan, planMs: m.planMs });
        // Footprints answer at once; the motion follows.
        e.layers.update("plan");
        this.note("drawn", m.id);
        break;
      case "motion": {
        if (m.id !== this.plannedId) return;
        const shown = Math.floor(e.store.getState().time * 60);
        if (this.motion.add(m.id, m.chunk, shown)) {
          this.note("changed-over", m.id);
          this.begin();
        }
        e.playback.show();
        break;
      }
      case "finished":
        if (m.id !== this.plannedId) return;
        this.motion.finish(m.id, m.boxes, m.ink);
        e.set({ quality: m.quality });
        e.playback.show();
        if (!e.scene.inGesture) this.announce();
        break;
      case "failed":
        e.fail(m.message);
        break;
      case "started":
      case "dropped":
      case "overtaken":
      case "families":
      case "style":
      case "styles":
      case "style-failed":
      case "cycle":
      case "cycle-failed":
        break;
    }
  }

  /** The first motion starts by itself, unless less motion is wished for. */
  private begin(): void {
    if (this.begun) return;
    this.begun = true;
    if (!matchMedia("(prefers-reduced-motion: reduce)").matches) this.e.playback.setPlaying(true);
  }

  /** Tells screen readers what the planner did; never during a drag. */
  announce(): void {
    const s = this.e.store.getState();
    if (!s.plan || !s.quality) return;
    this.e.announce(
      `${s.plan.steps.length} footsteps; skate ${(s.quality.skate ?? 0).toFixed(1)} millimetres, reach ${(s.quality.reach ?? 0).toFixed(1)} millimetres.`,
    );
  }

  /** Index in the order of the task being come to or done at the present time; -1 when there is none. */
  currentTask(): number {
    const s = this.e.store.getState();
    const tasks = s.plan?.tasks ?? [];
    const i = tasks.findIndex((t) => s.time <= t.end);
    return i < 0 ? tasks.length - 1 : i;
  }

  /** How far along its way the character is at the present time, 0 to 1: by the distance that its hips have gone. */
  shareOfWay(): number {
    const m = this.motion.current;
    if (!m || m.filled < 2) return 0.5;
    const now = Math.min(m.filled - 1, Math.floor(this.e.store.getState().time * 60));
    let gone = 0;
    let all = 0;
    for (let f = 1; f < m.filled; f++) {
      all += Math.hypot(m.root[3 * f] - m.root[3 * f - 3], m.root[3 * f + 2] - m.root[3 * f - 1]);
      if (f === now) gone = all;
    }
    return all > 0 ? gone / all : 0.5;
  }

  /** The worker is ended as if it had died: it is replaced and the scene sent again. */
  restart(): void {
    this.planner.restart();
  }
}
