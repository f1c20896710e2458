/** The character's skin: made by a worker for each build, one that dies is replaced three times. */
import { createSkeleton } from "../../core/skeleton/skeleton.ts";
import type { CharacterMesh } from "../../view/character/build-mesh.ts";
import { COARSE } from "../../view/character/fineness.ts";
import type { MeshRequest, MeshResponse } from "../../workers/mesh-worker.ts";
import type { Editor } from "../editor.ts";

/** Deaths after which the worker is left alone. */
const MOST_DEATHS = 3;

export class CharacterSession {
  private worker: Worker;
  private deaths = 0;
  private id = 0;
  private asked = "";
  /** The skin that is shown; null before the first. */
  mesh: CharacterMesh | null = null;

  constructor(private readonly e: Editor) {
    this.worker = this.start();
  }

  private start(): Worker {
    const worker = new Worker(new URL("../../workers/mesh-worker.ts", import.meta.url), { type: "module" });
    worker.onmessage = (event: MessageEvent<MeshResponse>) => this.hear(event.data);
    worker.onerror = (event) => {
      event.preventDefault();
      worker.terminate();
      if (this.deaths++ >= MOST_DEATHS) {
        this.e.fail("The character cannot be drawn: its worker stops each time. Reload the page.");
        return;
      }
      this.worker = this.start();
      this.asked = "";
      this.follow();
    };
    return worker;
  }

  /** Asks for the skin of the scene's build, when it is not the one asked for last. */
  follow(): void {
    const { height, proportions } = this.e.store.getState().scene.character;
    const key = JSON.stringify([height, proportions]);
    if (key === this.asked) return;
    this.asked = key;
    this.id++;
    this.ask(COARSE);
  }

  private ask(fineness: number): void {
    const { height, proportions } = this.e.store.getState().scene.character;
    const request: MeshRequest = { id: this.id, height, proportions, fineness };
    this.worker.postMessage(request);
  }

  private hear(answer: MeshResponse): void {
    if (answer.id !== this.id) return;
    const { height, proportions } = this.e.store.getState().scene.character;
    this.mesh = answer.mesh;
    this.e.stage.setCharacter(createSkeleton(height, proportions), answer.mesh);
    this.e.playback.show();
    // A coarse skin stands there at once; the one that is looked at waits until the first motion has been planned, so that it
    // does not take the planner's time.
    if (answer.fineness > 1) this.e.plan.whenAnswered(() => answer.id === this.id && this.ask(1));
  }
}
