import { afterAll, beforeAll, expect, test, vi } from "vitest";
import { defaultScene } from "../../src/core/scene/default-scene.ts";
import type { StepwrightScene } from "../../src/embed/element.ts";
import { act } from "../../src/embed/frame-api.ts";
import type { FrameRequest } from "../../src/embed/frame-protocol.ts";
import { PlannerHub } from "../../src/embed/planner-hub.ts";
import type { PlannerRequest, PlannerResponse } from "../../src/workers/protocol.ts";

// Addresses are taken from the document's, of which there is none here.
beforeAll(() => {
  vi.stubGlobal("document", { baseURI: "http://localhost/" });
});
afterAll(() => {
  vi.unstubAllGlobals();
});

/** A worker that only notes what it is sent. */
class FakeWorker {
  static all: FakeWorker[] = [];
  sent: PlannerRequest[] = [];
  stopped = false;
  onmessage: ((e: { data: PlannerResponse }) => void) | null = null;
  onerror: ((e: { preventDefault(): void }) => void) | null = null;
  constructor() {
    FakeWorker.all.push(this);
  }
  postMessage(m: PlannerRequest): void {
    this.sent.push(m);
  }
  terminate(): void {
    this.stopped = true;
  }
  say(data: PlannerResponse): void {
    this.onmessage?.({ data });
  }
  die(): void {
    this.onerror?.({ preventDefault: () => undefined });
  }
}

function hubWithWorker(): { hub: PlannerHub; worker: () => FakeWorker } {
  FakeWorker.all = [];
  const hub = new PlannerHub(() => new FakeWorker() as unknown as Worker);
  return { hub, worker: () => FakeWorker.all[FakeWorker.all.length - 1] };
}

const READY: PlannerResponse = { type: "ready", templates: 1, clips: 1, transitions: [] };
const finished = (id: number): PlannerResponse => ({
  type: "finished",
  id,
  boxes: [],
  ink: [],
  quality: {} as never,
  motionMs: 1,
});
const planned = (w: FakeWorker): number[] => w.sent.flatMap((m) => (m.type === "plan" ? [m.id] : []));

test("several askers share one worker: one after the other, each hears its own answers", () => {
  const { hub, worker } = hubWithWorker();
  const heard: string[] = [];
  const a = hub.join((m) => heard.push(`a ${m.type}`));
  const b = hub.join((m) => heard.push(`b ${m.type}`));
  const first = hub.plan(a, defaultScene(), null, false);
  const second = hub.plan(b, defaultScene(), null, false);
  expect(FakeWorker.all.length).toBe(1);
  expect(planned(worker())).toEqual([]);
  worker().say(READY);
  expect(planned(worker())).toEqual([first]);
  worker().say(finished(first));
  expect(planned(worker())).toEqual([first, second]);
  worker().say(finished(second));
  expect(heard).toEqual(["a ready", "b ready", "a finished", "b finished"]);
});

test("what is dragged interrupts others, whose plan is then made again", () => {
  const { hub, worker } = hubWithWorker();
  const a = hub.join(() => undefined);
  const b = hub.join(() => undefined);
  const first = hub.plan(a, defaultScene(), null, false);
  worker().say(READY);
  const drag = hub.plan(b, defaultScene(), 1, true);
  expect(planned(worker())).toEqual([first, drag]);
  worker().say({ type: "dropped", id: first });
  expect(planned(worker())).toEqual([first, drag]);
  worker().say(finished(drag));
  expect(planned(worker())).toEqual([first, drag, first]);
});

test("an asker's newer request overtakes its older one, and only the newer is answered", () => {
  const { hub, worker } = hubWithWorker();
  const heard: number[] = [];
  const a = hub.join((m) => "id" in m && heard.push(m.id));
  worker().say(READY);
  const older = hub.plan(a, defaultScene(), null, false);
  const newer = hub.plan(a, defaultScene(), null, false);
  worker().say({ type: "dropped", id: older });
  worker().say(finished(newer));
  expect(heard).toEqual([newer]);
  expect(planned(worker())).toEqual([older, newer]);
});

test("a worker that dies after it has answered is replaced and asked again", () => {
  const { hub, worker } = hubWithWorker();
  const a = hub.join(() => undefined);
  worker().say(READY);
  const id = hub.plan(a, defaultScene(), null, false);
  const dead = worker();
  dead.die();
  expect(dead.stopped).toBe(true);
  expect(FakeWorker.all.length).toBe(2);
  worker().say(READY);
  expect(planned(worker())).toEqual([id]);
});

/** An element's outside, as far as the frame's messages touch it. */
function fakeElement() {
  const calls: string[] = [];
  const element = {
    toggleAttribute: (name: string, on: boolean) => calls.push(`${name} ${on}`),
    setAttribute: (name: string, value: string) => calls.push(`${name}=${value}`),
    seek: (t: number) => calls.push(`seek ${t}`),
    play: () => calls.push("play"),
    set scene(s: unknown) {
      calls.push(`scene ${JSON.stringify(s).length > 0}`);
    },
    set playbackRate(v: number) {
      calls.push(`speed ${v}`);
    },
  };
  return { element: element as unknown as StepwrightScene, calls };
}

test("frame messages: what they do, and one sentence for what they cannot", async () => {
  const { element, calls } = fakeElement();
  const ask = (request: Record<string, unknown>) =>
    act(element, { stepwright: 1, ...request } as unknown as FrameRequest, (events) =>
      calls.push(`subscribed ${events.join(" ")}`),
    );
  await ask({ do: "play" });
  await ask({ do: "seek", time: 1.5 });
  await ask({ do: "set", values: { controls: false, theme: "dark", speed: 2 } });
  await ask({ do: "subscribe", events: ["ended", "planned"] });
  await ask({ do: "load", scene: { version: 1 } });
  expect(calls).toEqual([
    "play",
    "seek 1.5",
    "controls false",
    "theme=dark",
    "speed 2",
    "subscribed ended planned",
    "scene true",
  ]);
  expect(await ask({ do: "hello" })).toEqual({ version: 1 });
  await expect(ask({ do: "seek", time: "soon" })).rejects.toThrow(
    'time: a number from 0 to 1000000 is needed, found "soon".',
  );
  await expect(ask({ do: "set", values: { colour: 1 } })).rejects.toThrow(
    "colour: no such setting is known.",
  );
  await expect(ask({ do: "subscribe", events: ["explode"] })).rejects.toThrow(
    'events: "explode" is no event.',
  );
  await expect(ask({ do: "load", scene: { version: 1, tasks: "none" } })).rejects.toThrow("tasks:");
  await expect(ask({ do: "dance" })).rejects.toThrow('found "dance".');
});
