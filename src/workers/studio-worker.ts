/** Renders walks for the studio page off its thread: the newest request wins. */

import type { StudioRequest } from "./studio-protocol.ts";
import { StudioService } from "./studio-service.ts";

const service = new StudioService((answer, transfer) => {
  (self as unknown as { postMessage(m: unknown, t: Transferable[]): void }).postMessage(answer, transfer);
});
self.onmessage = (event: MessageEvent<StudioRequest>) => service.hear(event.data);
