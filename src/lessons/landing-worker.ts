/** Where the shipped cyclic clips land, worked out off the page's thread: rendering them takes a second or more. */
import { landingPoints } from "./landing-points.ts";

self.onmessage = () => {
  (self as unknown as { postMessage(m: unknown): void }).postMessage(landingPoints());
};
