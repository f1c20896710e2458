import { afterEach, describe, expect, it, vi } from "vitest";
import { defaultScene } from "../../src/core/scene/default-scene.ts";

/** What the database does next. */
let openNext: () => Promise<unknown> = () => Promise.reject(new Error("closed"));
vi.mock("idb", () => ({ openDB: () => openNext() }));
const { loadScene, saveScene } = await import("../../src/editor/session/storage.ts");

const kept = new Map<string, unknown>();
const working = () =>
  Promise.resolve({
    get: (_: string, key: string) => Promise.resolve(kept.get(key)),
    put: (_: string, value: unknown, key: string) => {
      kept.set(key, value);
      return Promise.resolve(key);
    },
  });

describe("storage that fails", () => {
  afterEach(() => {
    vi.useRealTimers();
    vi.restoreAllMocks();
    kept.clear();
  });

  it("closed, then open again: the next scene is kept", async () => {
    vi.spyOn(console, "warn").mockReturnValue();
    openNext = () => Promise.reject(new Error("closed"));
    expect(await saveScene(defaultScene())).toBe(false);
    expect(await loadScene()).toBeNull();
    openNext = working;
    expect(await saveScene(defaultScene())).toBe(true);
    expect(await loadScene()).toEqual(defaultScene());
    kept.set("current", { version: 7 });
    expect(await loadScene()).toBeNull();
  });

  it("full, and blocked for ever: said within three seconds", async () => {
    vi.spyOn(console, "warn").mockReturnValue();
    // A module of its own: nothing is open yet.
    vi.resetModules();
    const fresh = await import("../../src/editor/session/storage.ts");
    vi.useFakeTimers();
    openNext = () => new Promise(() => undefined);
    const saved = fresh.saveScene(defaultScene());
    const loaded = fresh.loadScene();
    await vi.advanceTimersByTimeAsync(3100);
    expect(await saved).toBe(false);
    expect(await loaded).toBeNull();
    vi.useRealTimers();
    openNext = () =>
      Promise.resolve({ put: () => Promise.reject(new DOMException("full", "QuotaExceededError")) });
    expect(await fresh.saveScene(defaultScene())).toBe(false);
  });
});
