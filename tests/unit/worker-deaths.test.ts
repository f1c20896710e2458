// @vitest-environment happy-dom
/** Workers that die at work, one client after the other: replaced, asked again, and left alone when they die each time. */
import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { defaultScene } from "../../src/core/scene/default-scene.ts";
import { parseScene } from "../../src/core/scene/schema.ts";
import type { Scene } from "../../src/core/scene/types.ts";
import { CompareSession } from "../../src/editor/compare/session.ts";
import { CrowdSession } from "../../src/editor/crowd/crowd-session.ts";
import type { Editor } from "../../src/editor/editor.ts";
import { CharacterSession } from "../../src/editor/session/character-session.ts";
import { walkTool } from "../../src/editor/tools/walk.ts";
import { START } from "../../src/studio-page/settings.ts";
import { WalkSession } from "../../src/studio-page/walk-session.ts";

/** A worker whose life the test decides. */
class Mortal {
  static all: Mortal[] = [];
  onerror: ((e: { preventDefault(): void }) => void) | null = null;
  readonly sent: { type?: string }[] = [];
  ended = false;
  constructor() {
    Mortal.all.push(this);
  }
  postMessage(message: { type?: string }): void {
    this.sent.push(message);
  }
  terminate(): void {
    this.ended = true;
  }
}
const newest = (): Mortal => Mortal.all[Mortal.all.length - 1];
const die = (): void => newest().onerror?.({ preventDefault: () => undefined });
const kinds = (w: Mortal): (string | undefined)[] => w.sent.map((m) => m.type);

beforeEach(() => {
  Mortal.all = [];
  vi.stubGlobal("Worker", Mortal);
  vi.stubGlobal("requestAnimationFrame", () => 0);
  vi.stubGlobal("cancelAnimationFrame", () => undefined);
  vi.stubGlobal("matchMedia", () => ({ matches: true }));
});
afterEach(() => {
  vi.unstubAllGlobals();
});

/** As much of an editor as the sessions ask. */
function editor(scene: Scene): { e: Editor; said: string[] } {
  const said: string[] = [];
  const note = (text: string): void => void said.push(text);
  const e = {
    store: { getState: () => ({ scene }) },
    say: note,
    fail: note,
    announce: note,
    redraw: () => 0,
  };
  return { e: e as unknown as Editor, said };
}

describe("a worker that dies", () => {
  it("the crowd's: the crowd begins again; after three it is left alone, with one sentence", () => {
    const { e, said } = editor(
      parseScene({ version: 1, crowd: { agents: [{ position: [0, 0], goals: [[3, 0]] }] } }),
    );
    new CrowdSession(e).follow();
    expect(kinds(newest())).toEqual(["meshes", "start"]);
    for (let k = 0; k < 3; k++) {
      die();
      expect(Mortal.all[k].ended).toBe(true);
      expect(kinds(newest())).toEqual(["meshes", "start"]);
    }
    die();
    expect(Mortal.all).toHaveLength(4);
    expect(said.slice(0, 3)).toEqual(Array(3).fill("The crowd restarted. Nothing of the scene was lost."));
    expect(said.slice(3)).toEqual([
      "The crowd cannot be simulated: its worker stops each time. Reload the page.",
    ]);
  });

  it("the skin's: asked again for the same build; after three it is left alone, with one sentence", () => {
    const { e, said } = editor(defaultScene());
    new CharacterSession(e).follow();
    expect(newest().sent).toMatchObject([{ height: 1.75 }]);
    for (let k = 0; k < 3; k++) {
      die();
      expect(newest().sent).toMatchObject([{ height: 1.75 }]);
    }
    die();
    expect(Mortal.all).toHaveLength(4);
    expect(Mortal.all.every((w) => w.ended)).toBe(true);
    expect(said).toEqual(["The character cannot be drawn: its worker stops each time. Reload the page."]);
  });

  it("the studio's: walks again what was asked last; after three it is left alone", () => {
    const said: string[] = [];
    const none = (): void => undefined;
    const session = new WalkSession({ walked: none, saved: none, failed: (text) => said.push(text) });
    session.walk(START);
    for (let k = 0; k < 3; k++) {
      die();
      expect(kinds(newest())).toEqual(["walk"]);
    }
    die();
    expect(Mortal.all).toHaveLength(4);
    expect(said.at(-1)).toBe("The studio stops each time it walks. Reload the page.");
  });

  it("that of walking by hand: the tool is put down, with one sentence, and begins anew when taken up", () => {
    const { e, said } = editor(defaultScene());
    const state: { status: string | null; tools: string[] } = { status: null, tools: [] };
    Object.assign(e, {
      playback: { setPlaying: () => 0, show: () => 0 },
      plan: { motion: { current: null } },
      set: (change: { status: string | null }) => Object.assign(state, change),
      tools: {
        use(id: string) {
          state.tools.push(id);
          walkTool.leave?.(e);
        },
      },
    });
    walkTool.enter?.(e);
    expect(kinds(newest())).toEqual(["start"]);
    die();
    expect(newest().ended).toBe(true);
    expect(state).toEqual({ status: null, tools: ["select"] });
    expect(said).toEqual(["The walk stopped. Take the tool up again."]);
    walkTool.enter?.(e);
    expect(Mortal.all).toHaveLength(2);
    expect(kinds(newest())).toEqual(["start"]);
  });

  it("that of the left-out performance: one sentence, and the next try has a new one", () => {
    const { e, said } = editor(defaultScene());
    const session = new CompareSession(e);
    session.leftOut();
    session.leftOut();
    // One at a time.
    expect(Mortal.all).toHaveLength(1);
    die();
    expect(said.at(-1)).toBe("The left-out sequence could not be performed: its worker stopped. Try again.");
    session.leftOut();
    expect(Mortal.all.map((w) => w.ended)).toEqual([true, false]);
    expect(kinds(newest())).toEqual(["left-out"]);
  });
});
