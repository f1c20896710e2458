import { describe, expect, it } from "vitest";
import type { MotionChunk } from "../../src/core/motion/types.ts";
import { defaultScene } from "../../src/core/scene/default-scene.ts";
import { JOINT_COUNT } from "../../src/core/skeleton/joints.ts";
import { MotionStore } from "../../src/editor/session/motion-store.ts";
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

  it("in the middle of synthesis: what has come is kept until the next one has the same frame again", () => {
    const { client, workers, heard } = setup();
    workers[0].ready();
    const id = client.plan(defaultScene(), null);
    const motion = new MotionStore();
    const chunk = (first: number, height: number): MotionChunk => ({
      first,
      frames: 10,
      root: new Float32Array(30).fill(height),
      rotations: new Float32Array(40 * JOINT_COUNT),
      contacts: new Uint8Array(10),
    });
    motion.begin(id, 30);
    expect(motion.add(id, chunk(0, 1), 5)).toBe(true);
    workers[0].die();
    // The same request, under the same id: its answer replaces the half one.
    expect(workers[1].sent.at(-1)).toMatchObject({ type: "plan", id });
    motion.begin(id, 30);
    // A picture is there all the while.
    expect(motion.current?.filled).toBe(10);
    for (let first = 0; first < 30; first += 10) motion.add(id, chunk(first, 2), 5);
    motion.finish(id, [], []);
    expect(motion.current?.filled).toBe(30);
    expect(motion.current?.root.every((v) => v === 2)).toBe(true);
    expect(heard.map((m) => m.type)).toEqual(["ready"]);
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
