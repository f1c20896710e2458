/** The clock of playback: hidden tabs, clocks that jump, motion that is not there yet. */
import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { elapsed } from "../../src/core/math/elapsed.ts";
import type { Editor } from "../../src/editor/editor.ts";
import { Playback } from "../../src/editor/session/playback.ts";

interface Shown {
  time: number;
  playing: boolean;
  loop: boolean;
  speed: number;
}

let now = 0;
let frames: (() => void)[] = [];

beforeEach(() => {
  now = 5000;
  frames = [];
  vi.stubGlobal("performance", { now: () => now });
  vi.stubGlobal("requestAnimationFrame", (act: () => void) => frames.push(act));
});
afterEach(() => {
  vi.unstubAllGlobals();
});

/** An editor that only keeps its state, with a motion of ten seconds. */
function playing(filled = 600, loop = false): { readonly shown: Shown; frame(ms: number): void } {
  let state: Shown = { time: 0, playing: false, loop, speed: 1 };
  const editor = {
    store: { getState: () => state },
    set: (change: Partial<Shown>) => {
      state = { ...state, ...change };
    },
    plan: { duration: 10, motion: { current: { filled, frames: 600 } } },
    layers: { time: () => undefined, update: () => undefined },
    scene: { inGesture: false },
  };
  const playback = new Playback(editor as unknown as Editor);
  playback.setPlaying(true);
  return {
    get shown() {
      return state;
    },
    frame(ms) {
      now += ms;
      for (const act of frames.splice(0)) act();
    },
  };
}

describe("playback", () => {
  it("goes with the clock", () => {
    const p = playing();
    for (let k = 0; k < 60; k++) p.frame(16);
    expect(p.shown.time).toBeCloseTo(0.96, 6);
  });

  it("a tab that was hidden does not catch up: it goes on where it was", () => {
    const p = playing();
    p.frame(16);
    p.frame(3_600_000);
    expect(p.shown.time).toBeLessThanOrEqual(0.116 + 1e-9);
    p.frame(16);
    expect(p.shown.time).toBeLessThan(0.14);
    expect(p.shown.playing).toBe(true);
  });

  it("a clock that jumps back stops nothing and takes nothing back", () => {
    const p = playing();
    for (let k = 0; k < 10; k++) p.frame(16);
    const before = p.shown.time;
    p.frame(-100_000);
    expect(p.shown.time).toBe(before);
    p.frame(16);
    expect(p.shown.time).toBeCloseTo(before + 0.016, 9);
  });

  it("waits for motion that has not arrived, and ends or begins anew at the end", () => {
    const slow = playing(31);
    for (let k = 0; k < 100; k++) slow.frame(16);
    expect(slow.shown.time).toBeCloseTo(0.5, 9);
    const once = playing();
    for (let k = 0; k < 700; k++) once.frame(16);
    expect(once.shown).toMatchObject({ time: 10, playing: false });
    const again = playing(600, true);
    for (let k = 0; k < 700; k++) again.frame(16);
    expect(again.shown.playing).toBe(true);
    expect(again.shown.time).toBeLessThan(2);
  });
});

describe("every clock of the pages", () => {
  it("goes on by what passed, a tenth of a second at most, and never back", () => {
    expect(elapsed(1000, 1016)).toBeCloseTo(0.016, 12);
    expect(elapsed(1000, 61_000)).toBe(0.1);
    expect(elapsed(1000, -5e9)).toBe(0);
    expect(elapsed(1000, 1e15)).toBe(0.1);
  });
});
