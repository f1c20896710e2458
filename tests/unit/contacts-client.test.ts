/** The page's side of the worker of captures: what was asked is answered or refused, whatever becomes of the worker. */
import { expect, it } from "vitest";
import { CancelledError, ContactsClient } from "../../src/editor/captures/client.ts";
import type { ContactsRequest, ContactsResponse } from "../../src/workers/contacts-protocol.ts";

/** A worker that only notes what it is sent. */
class StillWorker {
  onmessage: ((event: { data: ContactsResponse }) => void) | null = null;
  onerror: ((event: { preventDefault(): void }) => void) | null = null;
  readonly sent: ContactsRequest[] = [];
  ended = false;
  postMessage(message: ContactsRequest): void {
    this.sent.push(message);
  }
  terminate(): void {
    this.ended = true;
  }
  die(): void {
    this.onerror?.({ preventDefault: () => undefined });
  }
  answer(data: ContactsResponse): void {
    this.onmessage?.({ data });
  }
}

function client() {
  const workers: StillWorker[] = [];
  const told: string[] = [];
  const made = new ContactsClient(
    "oracle.bin",
    {
      progress: () => told.push("progress"),
      ready: () => told.push("ready"),
      restarted: () => told.push("restarted"),
      failed: (message) => told.push(message),
    },
    () => {
      const w = new StillWorker();
      workers.push(w);
      return w as unknown as Worker;
    },
  );
  return { made, workers, told };
}

const ask = { type: "save" } as const;

it("starts its worker with the first request, model first", () => {
  const { made, workers } = client();
  expect(workers).toHaveLength(0);
  made.close("a");
  made.cancel(1);
  expect(workers).toHaveLength(0);
  made.ask(ask, "saved").answer.catch(() => undefined);
  expect(workers[0].sent.map((m) => m.type)).toEqual(["model", "save"]);
});

it("a worker that dies at work: what waits is refused, the next request has a new one with the same model", async () => {
  const { made, workers, told } = client();
  const first = made.ask(ask, "saved").answer;
  workers[0].die();
  await expect(first).rejects.toThrow("The worker of captures stopped.");
  expect(workers[0].ended).toBe(true);
  expect(told).toEqual(["restarted"]);
  const second = made.ask(ask, "saved");
  expect(workers[1].sent.map((m) => m.type)).toEqual(["model", "save"]);
  // The dead one's last words are not heard.
  workers[0].answer({ type: "cancelled", id: second.id });
  workers[1].answer({ type: "failed", id: second.id, message: "a.bvh: no." });
  await expect(second.answer).rejects.toThrow("a.bvh: no.");
});

it("one that always dies is left alone, and says so", async () => {
  const { made, workers, told } = client();
  for (let k = 0; k < 4; k++) {
    const { answer } = made.ask(ask, "saved");
    workers[k].die();
    await expect(answer).rejects.toThrow("stopped");
  }
  expect(told.filter((t) => t === "restarted")).toHaveLength(3);
  expect(told.at(-1)).toMatch(/stops each time/);
});

it("what was cancelled is told apart from what failed", async () => {
  const { made, workers } = client();
  const { id, answer } = made.ask(ask, "saved");
  workers[0].answer({ type: "cancelled", id });
  await expect(answer).rejects.toBeInstanceOf(CancelledError);
});
