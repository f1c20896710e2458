/**
 * `<stepwright-scene>` and what goes with it. Importing this module registers the element where there are elements, and does nothing
 * in Node and on servers.
 */
import { defineElement } from "./define.ts";

defineElement();

export { type SceneEventDetails, StepwrightScene } from "./element.ts";
export { connectFrame, type SceneFrame } from "./frame-client.ts";
export {
  FRAME_EVENTS,
  FRAME_VERSION,
  type FrameEvent,
  type FrameSettings,
  type FrameState,
} from "./frame-protocol.ts";
export { configure, type Resources } from "./resources.ts";
export { defineElement };
