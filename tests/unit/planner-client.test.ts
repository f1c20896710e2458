import { describe, expect, it } from "vitest";
import { defaultScene } from "../../src/core/scene/default-scene.ts";
import { PlannerClient } from "../../src/editor/session/planner-client.ts";
import type { PlannerRequest, PlannerResponse } from "../../src/workers/protocol.ts";

/** A worker whose life the test decides. */
class Fake {
  onmessage: ((e: { data: PlannerResponse }) => void) | null = null;
  onerror: ((e: { preventDefault(): void }) => void) | null = null;
  onmessageerror: (() => void) | null = null;
  sent: PlannerRequest[] = [];
  ended = false;
  postMessage(m: PlannerRequest): void {
    this.sent.push(m);
  }
  terminate(): void {
    this.ended = true;
  }
  ready(): void {
    this.onmessage?.({ data: { type: "ready", templates: 1, clips: 1, transitions: [] } });
  }
  die(): void {
    this.onerror?.({ preventDefault: () => undefined });
  }
}

function setup() {
  const workers: Fake[] = [];
  const heard: PlannerResponse[] = [];
  let restarts = 0;
  const client = new PlannerClient(
    "library.bin",
    { message: (m) => heard.push(m), restarted: () => restarts++ },
    () => {
      const w = new Fake();
      workers.push(w);
      return w as unknown as Worker;
    },
  );
  return { client, workers, heard, restarts: () => restarts };
}

describe("a planner that dies", () => {
  it("in the middle of planning: the newest scene alone is sent to the next one", () => {
    const { client, workers, restarts } = setup();
    workers[0].ready();
    client.plan(defaultScene(), null);
    const newest = client.plan({ ...defaultScene(), seed: 9 }, 1.5);
    workers[0].die();
    expect(restarts()).toBe(1);
    expect(workers[0].ended).toBe(true);
    // It plans once it has the library: nothing has to come back first.
    expect(workers[1].sent.map((m) => m.type)).toEqual(["load", "plan"]);
    expect(workers[1].sent[1]).toMatchObject({ type: "plan", id: newest, now: 1.5, scene: { seed: 9 } });
    expect(workers[1].sent).toHaveLength(2);
  });

  it("is told again of the captures that steps are blended of", () => {
    const { client, workers } = setup();
    const clip = {
      frames: 1,
      rate: 60,
      height: 1.75,
      root: new Float32Array(3),
      rotations: new Float32Array(88),
    };
    client.addCycle("mine", clip, new Uint8Array(1));
    client.addCycle("gone", clip, new Uint8Array(1));
    client.forgetCycle("gone");
    workers[0].die();
    expect(workers[1].sent.map((m) => ("name" in m ? m.name : m.type))).toEqual(["load", "mine"]);
  });

  it("answers of the dead one are not heard, and it dies once", () => {
    const { workers, heard, restarts } = setup();
    workers[0].ready();
    workers[0].die();
    workers[0].die();
    workers[0].onmessageerror?.();
    workers[0].onmessage?.({ data: { type: "dropped", id: 1 } });
    expect(restarts()).toBe(1);
    expect(heard.map((m) => m.type)).toEqual(["ready"]);
  });

  it("each time it starts is left alone after three, with one sentence", () => {
    const { client, workers, heard, restarts } = setup();
    const id = client.plan(defaultScene(), null);
    for (let k = 0; k < 10; k++) workers[workers.length - 1].die();
    expect(restarts()).toBe(3);
    expect(workers.every((w) => w.ended)).toBe(true);
    expect(heard[0]).toEqual({
      type: "failed",
      id,
      message: "The planner stops each time it is started. Reload the page.",
    });
  });
});
