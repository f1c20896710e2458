/** The planner in a worker of its own. */
import { createPlanner } from "./planner-service.ts";
import type { PlannerRequest, PlannerResponse } from "./protocol.ts";

const page = self as unknown as { postMessage(m: PlannerResponse, t: Transferable[]): void };
const receive = createPlanner((message, transfer = []) => page.postMessage(message, transfer));

self.onmessage = (event: MessageEvent<PlannerRequest>) => receive(event.data);
