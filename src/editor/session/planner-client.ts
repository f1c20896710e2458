/**
 * The page's side of the planner worker: the newest scene wins, and a worker that dies is replaced.
 */
import type { Scene } from "../../core/scene/types.ts";
import type { PlannerRequest, PlannerResponse } from "../../workers/protocol.ts";

export interface PlannerClientEvents {
  message(message: PlannerResponse): void;
  /** The worker threw or died and was replaced; the newest scene has been sent again. */
  restarted(): void;
}

type StyleRequest = Extract<PlannerRequest, { type: "style" }>;
type CycleRequest = Extract<PlannerRequest, { type: "cycle" }>;
type Wishes = Pick<Extract<PlannerRequest, { type: "plan" }>, "paths" | "lambda4">;

/** Restarts in a row after which the worker is left alone. */
const MOST_RESTARTS = 3;

export class PlannerClient {
  private worker: Worker | null = null;
  private nextId = 1;
  private newest: Extract<PlannerRequest, { type: "plan" }> | null = null;
  private restarts = 0;
  /** The visitor's styles, by name: a worker that takes over is told of them again. */
  private readonly styles = new Map<string, StyleRequest>();
  /** Captures that steps on stones are blended of, by name, likewise. */
  private readonly cycles = new Map<string, CycleRequest>();
  private own: Uint8Array | null = null;

  constructor(
    private readonly libraryUrl: string,
    private readonly events: PlannerClientEvents,
    private readonly create: () => Worker = () =>
      new Worker(new URL("../../workers/planner-worker.ts", import.meta.url), { type: "module" }),
  ) {
    this.start();
  }

  private start(): void {
    const worker = this.create();
    this.worker = worker;
    worker.onmessage = (event: MessageEvent<PlannerResponse>) => {
      // A worker that was replaced may have had answers on their way.
      if (worker !== this.worker) return;
      const message = event.data;
      if (message.type === "finished") this.restarts = 0;
      this.events.message(message);
    };
    worker.onerror = (event) => {
      event.preventDefault();
      if (worker === this.worker) this.restart();
    };
    worker.onmessageerror = () => {
      if (worker === this.worker) this.restart();
    };
    this.send({ type: "load", url: this.libraryUrl });
    if (this.own) this.send({ type: "own", bytes: this.own });
    for (const style of this.styles.values()) this.send(style);
    for (const cycle of this.cycles.values()) this.send(cycle);
    // The worker plans as soon as it has the library; nothing has to come back first.
    if (this.newest) this.send(this.newest);
  }

  /** A person's own library beside the shipped one, or none; the newest scene is planned anew with it. */
  useOwn(bytes: Uint8Array | null): void {
    this.own = bytes;
    this.send({ type: "own", bytes });
    if (this.newest) this.send(this.newest);
  }

  /** Replaces the worker; the newest request is sent again. */
  restart(): void {
    this.worker?.terminate();
    if (this.restarts++ >= MOST_RESTARTS) {
      this.events.message({
        type: "failed",
        id: this.newest?.id ?? 0,
        message: "The planner stops each time it is started. Reload the page.",
      });
      return;
    }
    this.start();
    this.events.restarted();
  }

  private send(request: PlannerRequest): void {
    this.worker?.postMessage(request);
  }

  /** A straight sample becomes a style; answered by `style` or `style-failed`. */
  addStyle(name: string, file: string, text: string): void {
    const request: StyleRequest = { type: "style", name, file, text };
    this.styles.set(name, request);
    this.send(request);
  }

  /** Takes a style back; one that failed is forgotten too. */
  forgetStyle(name: string): void {
    if (this.styles.delete(name)) this.send({ type: "forget-style", name });
  }

  /** A capture to blend steps on stones of; answered by `cycle` or `cycle-failed`. Plans made from then on use it. */
  addCycle(name: string, clip: CycleRequest["clip"], contacts: Uint8Array): void {
    const request: CycleRequest = { type: "cycle", name, clip, contacts };
    this.cycles.set(name, request);
    this.send(request);
  }

  /** Takes it back; one that failed is forgotten too. */
  forgetCycle(name: string): void {
    if (this.cycles.delete(name)) this.send({ type: "forget-cycle", name });
  }

  /** Asks for a plan; what was asked before is overtaken. @returns the request's id. */
  plan(scene: Scene, now: number | null, wishes: Wishes = {}): number {
    const id = this.nextId++;
    this.newest = { type: "plan", id, client: 0, scene, now, fromFrame: 0, ...wishes };
    this.send(this.newest);
    return id;
  }

  dispose(): void {
    this.worker?.terminate();
  }
}
