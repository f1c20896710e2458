/**
 * The page's side of the worker of captures: a promise a request, progress, cancel; a worker that dies is replaced.
 *
 * The worker starts with the first request: it reads a model that most visits have no need of.
 */
import type { ContactsRequest, ContactsResponse } from "../../workers/contacts-protocol.ts";

/** A request that has an answer, without its id. */
export type Ask = ContactsRequest extends infer R
  ? R extends { id: number }
    ? Omit<R, "id">
    : never
  : never;
type Answer<T extends ContactsResponse["type"]> = Extract<ContactsResponse, { type: T }>;
export type Progress = Answer<"progress">;

/** What was asked was cancelled: nothing to say. */
export class CancelledError extends Error {
  override name = "CancelledError";
}

interface Waiting {
  resolve(answer: ContactsResponse): void;
  reject(error: Error): void;
}

export interface ContactsClientEvents {
  progress(p: Progress): void;
  ready(examples: number): void;
  /** The worker died and was replaced: what was open in it must be opened again. */
  restarted(): void;
  failed(message: string): void;
}

const MOST_RESTARTS = 3;

export class ContactsClient {
  private worker: Worker | null = null;
  private waiting = new Map<number, Waiting>();
  private nextId = 1;
  private restarts = 0;
  private model: Extract<ContactsRequest, { type: "model" }>;

  constructor(
    modelUrl: string,
    private readonly events: ContactsClientEvents,
    private readonly create: () => Worker = () =>
      new Worker(new URL("../../workers/contacts-worker.ts", import.meta.url), { type: "module" }),
  ) {
    this.model = { type: "model", url: modelUrl };
  }

  private running(): Worker {
    this.worker ??= this.start();
    return this.worker;
  }

  private start(): Worker {
    const worker = this.create();
    worker.onmessage = (event: MessageEvent<ContactsResponse>) => {
      if (worker === this.worker) this.hear(event.data);
    };
    worker.onerror = (event) => {
      event.preventDefault();
      if (worker === this.worker) this.restart();
    };
    worker.postMessage(this.model);
    return worker;
  }

  private hear(m: ContactsResponse): void {
    if (m.type === "progress") {
      this.events.progress(m);
      return;
    }
    if (m.type === "ready") {
      this.restarts = 0;
      this.events.ready(m.examples);
      return;
    }
    const waiting = this.waiting.get(m.id);
    this.waiting.delete(m.id);
    if (m.type === "failed" && !waiting) this.events.failed(m.message);
    else if (m.type === "failed") waiting?.reject(new Error(m.message));
    else if (m.type === "cancelled") waiting?.reject(new CancelledError());
    else waiting?.resolve(m);
  }

  private restart(): void {
    this.worker?.terminate();
    this.worker = null;
    const lost = [...this.waiting.values()];
    this.waiting.clear();
    for (const w of lost) w.reject(new Error("The worker of captures stopped."));
    if (this.restarts++ >= MOST_RESTARTS) {
      this.events.failed("Captures cannot be read: their worker stops each time. Reload the page.");
      return;
    }
    this.events.restarted();
  }

  /** Another model to begin with. */
  useModel(bytes: Uint8Array, name: string): void {
    this.model = { type: "model", bytes, name };
    if (this.worker) this.worker.postMessage(this.model);
    else this.running();
  }

  close(key: string): void {
    this.worker?.postMessage({ type: "close", key } satisfies ContactsRequest);
  }

  cancel(id: number): void {
    this.worker?.postMessage({ type: "cancel", id } satisfies ContactsRequest);
  }

  /** Asks; `id` is known at once, for `cancel`. */
  ask<T extends ContactsResponse["type"]>(ask: Ask, _answer: T): { id: number; answer: Promise<Answer<T>> } {
    const id = this.nextId++;
    const answer = new Promise<Answer<T>>((resolve, reject) => {
      this.waiting.set(id, { resolve: (m) => resolve(m as Answer<T>), reject });
    });
    this.running().postMessage({ ...ask, id } as ContactsRequest);
    return { id, answer };
  }
}
