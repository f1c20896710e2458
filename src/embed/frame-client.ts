/** The page's side of the message API: requests as promises, events as callbacks. */

import type { SceneEventDetails } from "./element.ts";
import {
  FRAME_VERSION,
  type FrameAct,
  type FrameEvent,
  type FrameSettings,
  type FrameState,
  isFrameMessage,
} from "./frame-protocol.ts";

export interface SceneFrame {
  load(scene: unknown): Promise<void>;
  loadFrom(src: string): Promise<void>;
  play(): Promise<void>;
  pause(): Promise<void>;
  seek(seconds: number): Promise<void>;
  set(values: FrameSettings): Promise<void>;
  state(): Promise<FrameState>;
  /** Calls `hear` for each event of that name. */
  on<K extends FrameEvent>(name: K, hear: (detail: SceneEventDetails[K]) => void): Promise<void>;
  /** Stops listening; requests under way are refused. */
  close(): void;
}

/**
 * Talks with a frame that shows `embed.html`.
 *
 * @param frame the frame; its address must name this page's origin: `embed.html?origin=https://school.example`.
 * @param origin the origin that `embed.html` comes from. Messages of others are not heard.
 * @returns once the frame has answered. @throws Error when it has not within `patience` milliseconds.
 */
export async function connectFrame(
  frame: HTMLIFrameElement,
  origin: string,
  patience = 20_000,
): Promise<SceneFrame> {
  let nextId = 1;
  const waiting = new Map<number, { resolve(value: unknown): void; reject(error: Error): void }>();
  const listeners = new Map<FrameEvent, Set<(detail: never) => void>>();
  let greeted: () => void = () => undefined;

  const hear = (event: MessageEvent): void => {
    if (event.source !== frame.contentWindow || event.origin !== origin || !isFrameMessage(event.data))
      return;
    const m = event.data;
    if (m.event === "hello") greeted();
    else if (typeof m.event === "string")
      for (const f of listeners.get(m.event as FrameEvent) ?? []) f(m.detail as never);
    else if (typeof m.id === "number") {
      const w = waiting.get(m.id);
      waiting.delete(m.id);
      if (m.ok === true) w?.resolve(m.value);
      else w?.reject(new Error(String(m.error)));
    }
  };
  window.addEventListener("message", hear);

  const ask = (request: FrameAct): Promise<unknown> =>
    new Promise((resolve, reject) => {
      const id = nextId++;
      waiting.set(id, { resolve, reject });
      frame.contentWindow?.postMessage(
        { stepwright: FRAME_VERSION, id, ...request },
        origin === "null" ? "*" : origin,
      );
    });
  const done = async (request: FrameAct): Promise<void> => {
    await ask(request);
  };
  const close = (): void => {
    window.removeEventListener("message", hear);
    for (const w of waiting.values()) w.reject(new Error("The connection to the frame was closed."));
    waiting.clear();
  };

  await new Promise<void>((resolve, reject) => {
    const timer = setTimeout(() => {
      reject(new Error(`The frame at ${origin} did not answer.`));
      close();
    }, patience);
    greeted = () => {
      clearTimeout(timer);
      resolve();
    };
    // It may be there already, or still be on its way: then it says hello itself, or is asked again once loaded.
    const greet = () => void ask({ do: "hello" }).then(greeted, () => undefined);
    frame.addEventListener("load", greet, { once: true });
    greet();
  });

  return {
    load: (scene) => done({ do: "load", scene }),
    loadFrom: (src) => done({ do: "load", src }),
    play: () => done({ do: "play" }),
    pause: () => done({ do: "pause" }),
    seek: (time) => done({ do: "seek", time }),
    set: (values) => done({ do: "set", values }),
    state: async () => (await ask({ do: "state" })) as FrameState,
    on(name, listener) {
      const all = listeners.get(name) ?? new Set();
      all.add(listener);
      listeners.set(name, all);
      return done({ do: "subscribe", events: [...listeners.keys()] });
    },
    close,
  };
}
