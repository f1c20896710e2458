/** The worker behind the page: asks for the newest walk, hands on what comes, starts again when the worker dies. */

import type { Layer } from "../studio/score.ts";
import type { WalkSettings } from "../studio/walk-score.ts";
import type { StudioRequest, StudioResponse, Walked } from "../workers/studio-protocol.ts";

/** Deaths after which the worker is left alone. */
const MOST_DEATHS = 3;

export class WalkSession {
  private worker: Worker;
  private deaths = 0;
  private id = 0;
  private last: StudioRequest | null = null;

  constructor(
    private readonly heard: {
      walked(walk: Walked): void;
      saved(name: string, text: string): void;
      failed(message: string): void;
    },
  ) {
    this.worker = this.start();
  }

  walk(settings: WalkSettings): void {
    this.ask({ type: "walk", id: ++this.id, settings });
  }

  score(text: string, without: readonly Layer[]): void {
    this.ask({ type: "score", id: ++this.id, text, without });
  }

  save(what: "bvh" | "score"): void {
    this.worker.postMessage({ type: "save", id: this.id, what } satisfies StudioRequest);
  }

  private ask(request: StudioRequest): void {
    this.last = request;
    this.worker.postMessage(request);
  }

  private start(): Worker {
    const worker = new Worker(new URL("../workers/studio-worker.ts", import.meta.url), { type: "module" });
    worker.onmessage = (event: MessageEvent<StudioResponse>) => {
      const answer = event.data;
      if (answer.id !== this.id) return;
      if (answer.type === "walked") this.heard.walked(answer);
      else if (answer.type === "saved") this.heard.saved(answer.name, answer.text);
      else if (answer.type === "failed") this.heard.failed(answer.message);
    };
    worker.onerror = (event) => {
      event.preventDefault();
      worker.terminate();
      if (this.deaths++ >= MOST_DEATHS) {
        this.heard.failed("The studio stops each time it walks. Reload the page.");
        return;
      }
      this.worker = this.start();
      if (this.last) this.worker.postMessage(this.last);
      this.heard.failed("The studio restarted. Nothing was lost.");
    };
    return worker;
  }
}
