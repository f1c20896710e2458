/**
 * Messages between a page and the frame that shows a scene (`embed.html`), version 1.
 *
 * A request is `{ stepwright: 1, id, do, ... }`. The frame answers `{ stepwright: 1, id, ok: true, value }` or
 * `{ stepwright: 1, id, ok: false, error }`, and sends `{ stepwright: 1, event, detail }` for what was subscribed to, and `hello`
 * once when it starts. Messages of other origins than those allowed are not heard.
 */
import type { SceneEventDetails } from "./element.ts";

export const FRAME_VERSION = 1;

export type FrameEvent = keyof SceneEventDetails;
export const FRAME_EVENTS: readonly FrameEvent[] = [
  "ready",
  "planned",
  "solved",
  "timeupdate",
  "play",
  "pause",
  "ended",
  "change",
  "error",
];

/** What `set` can change. */
export interface FrameSettings {
  controls?: boolean;
  panels?: string;
  autoplay?: boolean;
  loop?: boolean;
  locked?: boolean;
  theme?: "light" | "dark" | "";
  /** Playing speed; 1 is as captured. */
  speed?: number;
  /** The character's height, metres. */
  height?: number;
}

export interface FrameState {
  time: number;
  duration: number;
  playing: boolean;
  footsteps: number;
  plannedIn: "worker" | "page";
  scene: unknown;
}

/** Requests without their envelope. */
export type FrameAct =
  | { do: "hello" }
  | { do: "load"; scene: unknown }
  | { do: "load"; src: string }
  | { do: "play" }
  | { do: "pause" }
  | { do: "seek"; time: number }
  | { do: "set"; values: FrameSettings }
  /** The list replaces the one before. */
  | { do: "subscribe"; events: readonly FrameEvent[] }
  | { do: "state" };

export type FrameRequest = FrameAct & { stepwright: number; id?: string | number };

/** Whether a message is one of ours, whatever its version. */
export function isFrameMessage(data: unknown): data is { stepwright: number } & Record<string, unknown> {
  return (
    typeof data === "object" &&
    data !== null &&
    typeof (data as Record<string, unknown>).stepwright === "number"
  );
}
