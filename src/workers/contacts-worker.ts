/** Captures in a worker of their own. */
import type { ContactsRequest, ContactsResponse } from "./contacts-protocol.ts";
import { createContactsService } from "./contacts-service.ts";

const page = self as unknown as { postMessage(m: ContactsResponse, t: Transferable[]): void };
const receive = createContactsService((message, transfer = []) => page.postMessage(message, transfer));

self.onmessage = (event: MessageEvent<ContactsRequest>) => void receive(event.data);
