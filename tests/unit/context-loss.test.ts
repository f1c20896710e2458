/** A drawing context that is lost: it is let back, drawn anew, and what does not come back is said. */
import { afterEach, beforeEach, expect, it, vi } from "vitest";
import { keepContext } from "../../src/view/context-loss.ts";

beforeEach(() => {
  vi.useFakeTimers();
});
afterEach(() => {
  vi.useRealTimers();
});

function canvas() {
  const target = new EventTarget();
  const told: string[] = [];
  const stop = keepContext(target, { back: () => told.push("back"), gone: () => told.push("gone") });
  /** @returns whether the loss was dealt with: only then do browsers give the context back. */
  const lose = (): boolean => !target.dispatchEvent(new Event("webglcontextlost", { cancelable: true }));
  const restore = (): boolean => target.dispatchEvent(new Event("webglcontextrestored"));
  return { told, stop, lose, restore };
}

it("a context that is lost may come back, and is drawn anew then", () => {
  const c = canvas();
  expect(c.lose()).toBe(true);
  vi.advanceTimersByTime(4000);
  expect(c.told).toEqual([]);
  c.restore();
  expect(c.told).toEqual(["back"]);
  vi.advanceTimersByTime(20_000);
  expect(c.told).toEqual(["back"]);
});

it("one that does not come back is said once, and may still come", () => {
  const c = canvas();
  c.lose();
  c.lose();
  vi.advanceTimersByTime(20_000);
  expect(c.told).toEqual(["gone"]);
  c.restore();
  expect(c.told).toEqual(["gone", "back"]);
});

it("a stage that is put away hears no more of it", () => {
  const c = canvas();
  c.lose();
  c.stop();
  vi.advanceTimersByTime(20_000);
  expect(c.lose()).toBe(false);
  c.restore();
  expect(c.told).toEqual([]);
});
