// @vitest-environment happy-dom
/** What comes from strangers: links that carry scenes, and messages to the frame. */
import { readFileSync } from "node:fs";
import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { readScene } from "../../src/core/scene/schema.ts";
import type { Scene } from "../../src/core/scene/types.ts";
import { carriesScene, sceneFromHash, sceneToHash } from "../../src/editor/session/share.ts";
import type { StepwrightScene } from "../../src/embed/element.ts";
import { act, listen } from "../../src/embed/frame-api.ts";
import { type FrameRequest, isFrameMessage } from "../../src/embed/frame-protocol.ts";
import { brokenText, budget, expectFinite, limit, survives } from "../support/fuzz.ts";

const SCENE = readScene(readFileSync("assets/scenes/moving-boxes.json", "utf8"), "scene");

/** The outcome of what may fail: a value, or one clear sentence. */
async function outcome<T>(work: () => Promise<T>, place: string): Promise<T | null> {
  let value: T | null = null;
  let failure: unknown = null;
  try {
    value = await work();
  } catch (error) {
    failure = error;
  }
  survives(() => {
    if (failure !== null) throw failure;
  }, place);
  return value;
}

describe("links", () => {
  it("broken ones give a scene or one sentence (seed 7)", { timeout: limit(10_000) }, async () => {
    const sound = await sceneToHash(SCENE, "boxes");
    await fc.assert(
      fc.asyncProperty(
        fc.oneof(
          brokenText(sound),
          fc.string({ unit: "binary" }).map((s) => `#s=${s}`),
        ),
        async (hash) => {
          if (!carriesScene(hash)) return;
          const shared = await outcome(() => sceneFromHash(hash), "This link");
          if (shared) expectFinite(shared.scene);
        },
      ),
      budget(200),
    );
  });

  it("documents of other kinds inside sound ones give one sentence (seed 7)", async () => {
    const { deflateSync, strToU8 } = await import("fflate");
    const link = (text: string): string =>
      `#s=${btoa(String.fromCharCode(...deflateSync(strToU8(text))))
        .replaceAll("+", "-")
        .replaceAll("/", "_")}`;
    await fc.assert(
      fc.asyncProperty(
        fc.oneof(fc.json(), fc.string(), fc.constantFrom("null", "5", "[]", '"s"')),
        async (text) => {
          await outcome(() => sceneFromHash(link(text)), "This link");
        },
      ),
      budget(100),
    );
  });
});

it("a link that unfolds to more than the page can hold is refused while it unfolds", async () => {
  const { Deflate } = await import("fflate");
  // Some two hundred kilobytes, two hundred megabytes unfolded.
  let text = "";
  const deflate = new Deflate({ level: 9 }, (chunk) => {
    for (const byte of chunk) text += String.fromCharCode(byte);
  });
  const zeros = new Uint8Array(1_000_000);
  for (let k = 0; k < 200; k++) deflate.push(zeros, k === 199);
  const hash = `#s=${btoa(text).replaceAll("+", "-").replaceAll("/", "_")}`;
  const before = process.resourceUsage().maxRSS;
  await expect(sceneFromHash(hash)).rejects.toThrow("This link holds more than 4 MB");
  // Kilobytes: at once, it would take all two hundred megabytes and more.
  expect(process.resourceUsage().maxRSS - before).toBeLessThan(60_000);
}, 60_000);

/** An element that only keeps what it is told, and refuses what is no scene. */
function listener() {
  const told = {
    attributes: new Map<string, string>(),
    scene: null as Scene | null,
    time: 0,
    rate: 1,
    src: "",
  };
  const element = {
    play: () => undefined,
    pause: () => undefined,
    seek(time: number) {
      told.time = time;
    },
    toggleAttribute(name: string, on: boolean) {
      told.attributes.set(name, String(on));
    },
    setAttribute(name: string, value: string) {
      told.attributes.set(name, value);
    },
    edit(change: (scene: Scene) => Scene) {
      told.scene = change(SCENE);
    },
    set playbackRate(rate: number) {
      told.rate = rate;
    },
    set scene(scene: Scene | null) {
      told.scene = scene;
    },
    get scene() {
      return told.scene;
    },
    set src(src: string) {
      told.src = src;
    },
    currentTime: 0,
    duration: 0,
    paused: true,
    plan: null,
    plannedIn: "page",
  };
  return { told, element: element as unknown as StepwrightScene };
}

describe("messages to the frame", () => {
  const anything = fc.anything({ withBigInt: true, withDate: true, withMap: true, withSet: true });
  const request = fc.oneof(
    fc.record({ do: fc.constantFrom("hello", "play", "pause", "state"), id: anything }),
    fc.record({ do: fc.constant("load"), scene: anything }),
    fc.record({ do: fc.constant("load"), src: anything }),
    fc.record({ do: fc.constant("seek"), time: anything }),
    fc.record({
      do: fc.constant("set"),
      values: fc.oneof(
        anything,
        fc.dictionary(
          fc.constantFrom("controls", "panels", "theme", "speed", "height", "onclick", "src"),
          anything,
        ),
      ),
    }),
    fc.record({ do: fc.constant("subscribe"), events: fc.oneof(anything, fc.array(anything)) }),
    fc.record({ do: anything }),
  );

  it("whatever they hold: done, or one sentence; nothing but what is allowed is set (seed 7)", async () => {
    await fc.assert(
      fc.asyncProperty(request, async (message) => {
        const { told, element } = listener();
        try {
          await act(element, message as FrameRequest, () => undefined);
        } catch (error) {
          expect((error as Error).name).not.toMatch(/TypeError|RangeError|SyntaxError|ReferenceError/);
          expect((error as Error).message).not.toMatch(/[\r\n]/);
        }
        for (const name of told.attributes.keys())
          expect(["controls", "autoplay", "loop", "locked", "panels", "theme"]).toContain(name);
        expect(Number.isFinite(told.time) && Number.isFinite(told.rate)).toBe(true);
        if (told.scene) expectFinite(told.scene);
      }),
      budget(400),
    );
  });

  it("what is no message of ours is not one (seed 7)", () => {
    fc.assert(
      fc.property(anything, (data) => {
        const ours =
          typeof data === "object" &&
          data !== null &&
          typeof (data as { stepwright?: unknown }).stepwright === "number";
        expect(isFrameMessage(data)).toBe(ours);
      }),
      budget(200),
    );
  });
});

describe("who the frame listens to", () => {
  /** A page that holds the frame, and hears what the frame answers. */
  function held(origins: readonly string[]) {
    const heard: { to: string; message: { ok?: boolean; error?: string; event?: string } }[] = [];
    const holder = { postMessage: (message: object, to: string) => heard.push({ to, message }) };
    const { told, element } = listener();
    const stop = listen(element, origins, holder as unknown as Window);
    heard.length = 0;
    const say = async (data: unknown, origin: string, source: unknown = holder): Promise<void> => {
      const event = new Event("message");
      Object.assign(event, { data, origin, source });
      window.dispatchEvent(event);
      await new Promise((r) => setTimeout(r, 0));
    };
    return { heard, told, say, stop };
  }
  const seek = (time: number) => ({ stepwright: 1, id: 1, do: "seek", time });

  it("the page that holds it, from an origin it was told: answered there and nowhere else", async () => {
    const f = held(["https://mine.example"]);
    await f.say(seek(1.5), "https://mine.example");
    expect(f.told.time).toBe(1.5);
    expect(f.heard).toMatchObject([{ to: "https://mine.example", message: { ok: true } }]);
    f.stop();
    await f.say(seek(2.5), "https://mine.example");
    expect(f.told.time).toBe(1.5);
  });

  it("another origin is not heard and gets no answer", async () => {
    const f = held(["https://mine.example"]);
    for (const origin of ["https://other.example", "https://mine.example.other", "null", ""])
      await f.say(seek(2), origin);
    expect(f.told.time).toBe(0);
    expect(f.heard).toEqual([]);
    f.stop();
  });

  it("another window of an allowed origin is not heard", async () => {
    const f = held(["https://mine.example"]);
    await f.say(seek(2), "https://mine.example", { postMessage: () => undefined });
    expect(f.told.time).toBe(0);
    expect(f.heard).toEqual([]);
    f.stop();
  });

  it("another version is told so, and does nothing", async () => {
    const f = held(["https://mine.example"]);
    await f.say({ ...seek(2), stepwright: 9 }, "https://mine.example");
    expect(f.told.time).toBe(0);
    expect(f.heard).toMatchObject([
      { message: { ok: false, error: "stepwright: version 1 is needed, found 9." } },
    ]);
    f.stop();
  });
});
