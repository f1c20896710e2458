import { afterAll, afterEach, describe, expect, it, vi } from "vitest";
import { defaultScene } from "../../src/core/scene/default-scene.ts";

/** What the database does next. */
let openNext: () => Promise<unknown> = () => Promise.reject(new Error("closed"));
vi.mock("idb", () => ({ openDB: () => openNext() }));
const { dropVersion, keepVersion, listVersions, loadName, loadScene, saveScene } = await import(
  "../../src/editor/session/storage.ts"
);

const kept = new Map<string, unknown>();
const working = () =>
  Promise.resolve({
    get: (_: string, key: string) => Promise.resolve(kept.get(key)),
    put: (_: string, value: unknown, key: string) => {
      kept.set(key, value);
      return Promise.resolve(key);
    },
    delete: (_: string, key: string) => {
      kept.delete(key);
      return Promise.resolve();
    },
    getAllKeys: (_: string, range: { lower: string; upper: string }) =>
      Promise.resolve(within(range).map(([key]) => key)),
    getAll: (_: string, range: { lower: string; upper: string }) =>
      Promise.resolve(within(range).map(([, value]) => value)),
  });
const within = (range: { lower: string; upper: string }) =>
  [...kept].filter(([key]) => key >= range.lower && key <= range.upper).sort(([a], [b]) => (a < b ? -1 : 1));
vi.stubGlobal("IDBKeyRange", { bound: (lower: string, upper: string) => ({ lower, upper }) });

afterAll(() => {
  vi.unstubAllGlobals();
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
    // What could not be read is put aside, not lost.
    expect(kept.get("unreadable")).toEqual({ version: 7 });
  });

  it("versions: newest first, forty at most, damaged ones passed over, one removed by its key", async () => {
    vi.spyOn(console, "warn").mockReturnValue();
    openNext = working;
    for (let at = 1; at <= 43; at++) expect(await keepVersion(`v${at}`, defaultScene(), at)).toBe(true);
    const list = await listVersions();
    expect(list).toHaveLength(40);
    expect(list[0]).toMatchObject({ name: "v43", at: 43, scene: defaultScene() });
    expect(list[39].name).toBe("v4");
    await dropVersion(list[0].key);
    kept.set(list[1].key, { name: "v42", at: 42, scene: { version: 7 } });
    expect((await listVersions()).map((v) => v.name).slice(0, 2)).toEqual(["v41", "v40"]);
    expect(await saveScene(defaultScene(), "Mine")).toBe(true);
    expect(await loadName()).toBe("Mine");
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
