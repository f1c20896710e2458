/**
 * One planner for all elements of a page. Requests of one asker overtake each other, those of several wait their turn; what a
 * user drags goes first. Where no worker can start, the page's own thread plans, in slices.
 */
import type { Scene } from "../core/scene/types.ts";
import type { PlannerRequest, PlannerResponse } from "../workers/protocol.ts";
import { absolute, libraryBytes, places } from "./resources.ts";

/** Frames made at a stretch on the page's own thread. */
const PAGE_SLICE = 20;
const MOST_RESTARTS = 3;

type PlanRequest = Extract<PlannerRequest, { type: "plan" }>;
type Hear = (message: PlannerResponse) => void;

interface Asker {
  hear: Hear;
  /** Newest request that is not finished. */
  wanted: PlanRequest | null;
}

/** What takes requests and may be stopped: a worker, or the page itself. */
interface Host {
  send(message: PlannerRequest): void;
  stop(): void;
}

export class PlannerHub {
  private static common: PlannerHub | null = null;
  private readonly askers = new Map<number, Asker>();
  private host: Host | null = null;
  private ready: Extract<PlannerResponse, { type: "ready" }> | null = null;
  private nextId = 1;
  private nextAsker = 1;
  private restarts = 0;
  /** The request that the planner works on. */
  private current: PlanRequest | null = null;
  /** Where it runs: known once it has answered. */
  where: "worker" | "page" = "worker";

  /** The page's planner, started when it is first asked for. */
  static shared(): PlannerHub {
    PlannerHub.common ??= new PlannerHub();
    return PlannerHub.common;
  }

  constructor(private readonly create: () => Worker = createWorker) {}

  /** @returns an asker's number; `hear` gets the answers to its own requests, and `ready`. */
  join(hear: Hear): number {
    const id = this.nextAsker++;
    this.askers.set(id, { hear, wanted: null });
    if (this.ready) hear(this.ready);
    if (!this.host) this.startWorker();
    return id;
  }

  /** Its requests are forgotten. The planner stays for those that come later. */
  leave(asker: number): void {
    this.askers.delete(asker);
    if (this.current?.client === asker) this.host?.send({ type: "cancel", id: this.current.id });
  }

  /**
   * Asks for a plan; an older request of the same asker is overtaken.
   *
   * @param now playing time in seconds when an earlier answer is played, else null.
   * @param urgent whether it may interrupt what is planned for others.
   * @returns the request's id.
   */
  plan(asker: number, scene: Scene, now: number | null, urgent: boolean): number {
    const id = this.nextId++;
    const a = this.askers.get(asker);
    if (!a) return id;
    a.wanted = { type: "plan", id, client: asker, scene, now, fromFrame: 0 };
    if (!this.ready) return id;
    if (!this.current || this.current.client === asker || urgent) this.send(a.wanted);
    return id;
  }

  private send(request: PlanRequest): void {
    this.current = request;
    this.host?.send(request);
  }

  private next(): void {
    this.current = null;
    for (const a of this.askers.values())
      if (a.wanted) {
        this.send(a.wanted);
        return;
      }
  }

  private receive(message: PlannerResponse): void {
    if (message.type === "ready") {
      this.ready = message;
      for (const a of this.askers.values()) a.hear(message);
      this.next();
      return;
    }
    if (!("id" in message) || (message.type === "failed" && message.id === 0)) {
      for (const a of this.askers.values()) a.hear(message);
      return;
    }
    if (message.type === "finished") this.restarts = 0;
    for (const a of this.askers.values())
      if (a.wanted?.id === message.id) {
        if (message.type === "finished" || message.type === "failed") a.wanted = null;
        a.hear(message);
      }
    const ended = message.type === "finished" || message.type === "failed" || message.type === "dropped";
    if (ended && (this.current === null || this.current.id === message.id)) this.next();
  }

  private startWorker(): void {
    let worker: Worker;
    try {
      worker = this.create();
    } catch {
      // Another origin's script, or a frame without an origin.
      void this.startPage();
      return;
    }
    let answered = false;
    const host: Host = { send: (m) => worker.postMessage(m), stop: () => worker.terminate() };
    this.host = host;
    worker.onmessage = (event: MessageEvent<PlannerResponse>) => {
      answered = true;
      if (this.host === host) this.receive(event.data);
    };
    worker.onerror = (event) => {
      event.preventDefault();
      if (this.host !== host) return;
      host.stop();
      this.host = null;
      if (!answered) void this.startPage();
      else this.restart();
    };
    host.send({ type: "load", url: places().library });
  }

  private restart(): void {
    this.ready = null;
    this.current = null;
    if (this.restarts++ < MOST_RESTARTS) {
      this.startWorker();
      return;
    }
    for (const a of this.askers.values())
      a.hear({
        type: "failed",
        id: a.wanted?.id ?? 0,
        message: "The planner stops each time it is started. Reload the page.",
      });
  }

  /** The planner on the page's own thread. */
  private async startPage(): Promise<void> {
    this.where = "page";
    try {
      const [{ createPlanner }, bytes] = await Promise.all([
        import("../workers/planner-service.ts"),
        libraryBytes(places().library),
      ]);
      const receive = createPlanner((message) => this.receive(message), PAGE_SLICE);
      this.host = { send: receive, stop: () => undefined };
      receive({ type: "load", bytes });
    } catch (error) {
      this.receive({
        type: "failed",
        id: 0,
        message: error instanceof Error ? error.message : String(error),
      });
    }
  }
}

function createWorker(): Worker {
  const { workers } = places();
  if (workers !== null)
    return new Worker(new URL("planner-worker.js", absolute(`${workers.replace(/\/?$/, "/")}`)), {
      type: "module",
    });
  return new Worker(new URL("../workers/planner-worker.ts", import.meta.url), { type: "module" });
}
