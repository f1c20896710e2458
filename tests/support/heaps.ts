/** Memory in use by a page and by its workers, once their garbage has gone, over the browser's own debugging protocol. */
import type { Page } from "@playwright/test";

interface Usage {
  usedSize: number;
  backingStorageSize?: number;
}

export interface Heaps {
  /** Bytes of script objects and array buffers: the page's, and all its workers'. */
  read(): Promise<{ page: number; workers: number }>;
}

const bytes = (u: Usage): number => u.usedSize + (u.backingStorageSize ?? 0);
/** A worker that dies while it is asked never answers. */
const PATIENCE = 20_000;

/** Listens from now on: workers made before are not seen. */
export async function watchHeaps(page: Page): Promise<Heaps> {
  const session = await page.context().newCDPSession(page);
  const workers = new Set<string>();
  const waiting = new Map<number, (result: Usage) => void>();
  let asked = 0;
  session.on("Target.attachedToTarget", (e) => workers.add(e.sessionId));
  session.on("Target.detachedFromTarget", (e) => workers.delete(e.sessionId));
  session.on("Target.receivedMessageFromTarget", (e) => {
    const answer = JSON.parse(e.message) as { id: number; result: Usage };
    waiting.get(answer.id)?.(answer.result);
    waiting.delete(answer.id);
  });
  await session.send("Target.setAutoAttach", {
    autoAttach: true,
    waitForDebuggerOnStart: false,
    flatten: false,
  });
  const ask = (sessionId: string, method: string): Promise<Usage> =>
    new Promise((resolve, reject) => {
      const id = ++asked;
      waiting.set(id, resolve);
      setTimeout(() => reject(new Error(`${method}: a worker does not answer.`)), PATIENCE).unref();
      session
        .send("Target.sendMessageToTarget", { sessionId, message: JSON.stringify({ id, method }) })
        .catch(reject);
    });
  return {
    async read() {
      let held = 0;
      for (const id of [...workers]) {
        await ask(id, "HeapProfiler.collectGarbage");
        held += bytes(await ask(id, "Runtime.getHeapUsage"));
      }
      await session.send("HeapProfiler.collectGarbage");
      return { page: bytes((await session.send("Runtime.getHeapUsage")) as Usage), workers: held };
    },
  };
}
