/** The frame's side of the message API: hears the pages it was told to, and acts on its element. */

import { setCharacter } from "../core/scene/commands.ts";
import { parseScene } from "../core/scene/schema.ts";
import type { StepwrightScene } from "./element.ts";
import {
  FRAME_EVENTS,
  FRAME_VERSION,
  type FrameEvent,
  type FrameRequest,
  type FrameSettings,
  type FrameState,
  isFrameMessage,
} from "./frame-protocol.ts";

const SWITCHES = ["controls", "autoplay", "loop", "locked"] as const;

function needed(what: string, found: unknown): Error {
  return new Error(`${what}, found ${shown(found)}.`);
}

/** A value in a few words. Messages may carry what JSON cannot: circles, big integers. */
function shown(found: unknown): string {
  try {
    return JSON.stringify(found)?.slice(0, 80) ?? "nothing";
  } catch {
    return `a ${typeof found}`;
  }
}

function number(name: string, value: unknown, least: number, most: number): number {
  if (typeof value !== "number" || !(value >= least && value <= most))
    throw needed(`${name}: a number from ${least} to ${most} is needed`, value);
  return value;
}

function applySettings(element: StepwrightScene, values: FrameSettings): void {
  if (typeof values !== "object" || values === null) throw needed("values: an object is needed", values);
  for (const [name, value] of Object.entries(values)) {
    if ((SWITCHES as readonly string[]).includes(name)) {
      if (typeof value !== "boolean") throw needed(`${name}: true or false is needed`, value);
      element.toggleAttribute(name, value);
    } else if (name === "panels" || name === "theme") {
      if (typeof value !== "string") throw needed(`${name}: text is needed`, value);
      element.setAttribute(name, value);
    } else if (name === "speed") element.playbackRate = number("speed", value, 0.05, 8);
    else if (name === "height") {
      const height = number("height", value, 1, 2.5);
      element.edit((scene) => setCharacter(scene, height, scene.character.proportions.leg));
    } else throw new Error(`${name}: no such setting is known.`);
  }
}

/** Does what a request says. @returns the answer's value. @throws Error with one sentence. */
export async function act(
  element: StepwrightScene,
  request: FrameRequest,
  subscribe: (events: readonly FrameEvent[]) => void,
): Promise<unknown> {
  switch (request.do) {
    case "hello":
      return { version: FRAME_VERSION };
    case "load":
      if ("src" in request) {
        if (typeof request.src !== "string") throw needed("src: an address is needed", request.src);
        element.scene = null;
        element.src = request.src;
      } else element.scene = parseScene(request.scene);
      return null;
    case "play":
      element.play();
      return null;
    case "pause":
      element.pause();
      return null;
    case "seek":
      element.seek(number("time", request.time, 0, 1e6));
      return null;
    case "set":
      applySettings(element, request.values);
      return null;
    case "subscribe": {
      if (!Array.isArray(request.events)) throw needed("events: a list of names is needed", request.events);
      const stranger = request.events.find((e) => !FRAME_EVENTS.includes(e));
      if (stranger !== undefined) throw new Error(`events: ${shown(stranger)} is no event.`);
      subscribe(request.events);
      return null;
    }
    case "state": {
      const state: FrameState = {
        time: element.currentTime,
        duration: element.duration,
        playing: !element.paused,
        footsteps: element.plan?.steps.length ?? 0,
        plannedIn: element.plannedIn,
        scene: element.scene,
      };
      return state;
    }
    default:
      throw needed(
        "do: hello, load, play, pause, seek, set, subscribe or state is needed",
        (request as { do?: unknown }).do,
      );
  }
}

/**
 * Listens to the pages of `origins` ("null" stands for frames and files without an origin) that hold this frame, or were opened by it.
 *
 * @returns what stops it.
 */
export function listen(
  element: StepwrightScene,
  origins: readonly string[],
  holder: Window = window.parent,
): () => void {
  const stops = new Map<FrameEvent, () => void>();
  // An origin that is "null" cannot be addressed; the message then goes to the window that was heard.
  const send = (to: Window, origin: string, message: object): void =>
    to.postMessage({ stepwright: FRAME_VERSION, ...message }, origin === "null" ? "*" : origin);
  const hear = (event: MessageEvent): void => {
    if (event.source !== holder || !origins.includes(event.origin) || !isFrameMessage(event.data)) return;
    const request = event.data as unknown as FrameRequest;
    const { origin } = event;
    const id = request.id ?? null;
    if (request.stepwright !== FRAME_VERSION) {
      send(holder, origin, {
        id,
        ok: false,
        error: `stepwright: version ${FRAME_VERSION} is needed, found ${request.stepwright}.`,
      });
      return;
    }
    const subscribe = (events: readonly FrameEvent[]): void => {
      for (const stop of stops.values()) stop();
      stops.clear();
      for (const name of events) {
        const tell = (e: Event) => send(holder, origin, { event: name, detail: (e as CustomEvent).detail });
        element.addEventListener(name, tell);
        stops.set(name, () => element.removeEventListener(name, tell));
      }
    };
    act(element, request, subscribe).then(
      (value) => send(holder, origin, { id, ok: true, value }),
      (error: unknown) =>
        send(holder, origin, {
          id,
          ok: false,
          error: error instanceof Error ? error.message : String(error),
        }),
    );
  };
  window.addEventListener("message", hear);
  if (holder !== window) {
    // Said to the page that holds the frame, if it is one of those allowed.
    const at = location.ancestorOrigins?.[0];
    for (const origin of origins)
      if (origin !== "null" && (at === undefined || at === origin))
        send(holder, origin, { event: "hello", detail: { version: FRAME_VERSION } });
  }
  return () => {
    window.removeEventListener("message", hear);
    for (const stop of stops.values()) stop();
  };
}
