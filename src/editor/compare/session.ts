/** Which performance, or which kept plan, is shown beside the plan, and how it got there. */
import { type Beside, besidePerformance } from "../../core/quality/footstep-distance.ts";
import type { ResultDocument } from "../../core/scene/result.ts";
import type { Scene } from "../../core/scene/types.ts";
import type { StudioRequest, StudioResponse } from "../../workers/studio-protocol.ts";
import type { Capture } from "../captures/capture.ts";
import type { Editor } from "../editor.ts";
import { type Performance, performanceOf, type Shown, sceneOf, shownOf, shownResult } from "./comparison.ts";

const sessions = new WeakMap<Editor, CompareSession>();

/** The editor's one comparison. */
export function compareSession(e: Editor): CompareSession {
  const found = sessions.get(e) ?? new CompareSession(e);
  sessions.set(e, found);
  return found;
}

export class CompareSession {
  shown: Shown | null = null;
  private working = false;

  constructor(private readonly e: Editor) {}

  /** Plans what a capture shows, and lays the capture beside it. */
  capture(c: Capture): void {
    try {
      this.perform(performanceOf(c));
      if (c.inLibrary)
        this.e.say(`${c.key} is in your library: take it out, or its plan may be a copy of it.`, false);
    } catch (error) {
      this.e.fail(error instanceof Error ? error.message : String(error));
    }
  }

  /** The studio's own sequence, which no library is made of: rendered by a worker of its own, which then ends. */
  leftOut(): void {
    if (this.working) return;
    this.working = true;
    this.e.announce("The left-out sequence is performed.");
    const worker = new Worker(new URL("../../workers/studio-worker.ts", import.meta.url), { type: "module" });
    const end = (): void => {
      this.working = false;
      worker.terminate();
    };
    worker.onmessage = ({ data }: MessageEvent<StudioResponse>) => {
      end();
      if (data.type === "performed") this.perform({ ...data, name: "Two writes, a sit, a box" });
      else if (data.type === "failed") this.e.fail(data.message);
    };
    worker.onerror = (event) => {
      event.preventDefault();
      end();
      this.e.fail("The left-out sequence could not be performed: its worker stopped. Try again.");
    };
    const request: StudioRequest = { type: "left-out", id: 1 };
    worker.postMessage(request);
  }

  /** Opens a result's scene, and lays its footsteps beside the plan that is made of it now. */
  result(r: ResultDocument, name: string): void {
    this.show(shownResult(r), r.scene, name);
  }

  private perform(p: Performance): void {
    this.show(shownOf(p), sceneOf(p), `${p.name}, beside its plan`);
  }

  private show(shown: Shown, scene: Scene, name: string): void {
    this.e.tools.use("select");
    this.e.scene.replace(scene, name);
    this.shown = shown;
    this.e.set({ tab: "beside" });
    this.e.layers.update("plan");
    this.e.playback.show();
  }

  /** Another scene has been opened: what is shown is not of it. */
  follow(): void {
    const { order } = this.e.store.getState().scene;
    if (this.shown && !this.shown.ids.every((id) => order.includes(id))) this.shown = null;
  }

  close(): void {
    this.shown = null;
    this.e.set({ tab: "scene" });
    this.e.layers.update("plan");
    this.e.redraw();
  }

  /** The figures of both; null until there is a plan of the same tasks. */
  figures(): Beside | null {
    const { plan } = this.e.store.getState();
    const p = this.shown;
    if (!p || !plan) return null;
    return besidePerformance(p, { steps: plan.steps, contacts: plan.tasks.map((t) => t.contact) });
  }
}
