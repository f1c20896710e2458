// @vitest-environment happy-dom
/** The editor driven without a browser: tools, selection, one history for everything; links that carry scenes. */
import fc from "fast-check";
import { render } from "lit";
import { describe, expect, it, vi } from "vitest";
import { copyThings, pasteThings, readFragment } from "../../src/core/scene/clipboard.ts";
import { defaultScene } from "../../src/core/scene/default-scene.ts";
import { fieldsOf, type ThingName } from "../../src/core/scene/fields.ts";
import { parseScene } from "../../src/core/scene/schema.ts";
import type { Editor } from "../../src/editor/editor.ts";
import { EXAMPLES } from "../../src/editor/examples.ts";
import { allKeys, chord } from "../../src/editor/keys.ts";
import { readNumber } from "../../src/editor/parts/number-field.ts";
import { schemaRows } from "../../src/editor/parts/schema-rows.ts";
import { ref } from "../../src/editor/selection.ts";
import { carriesScene, sceneFromHash, sceneToHash } from "../../src/editor/session/share.ts";
import { createTestEditor } from "../support/test-editor.ts";

vi.mock("../../src/editor/session/storage.ts", () => ({
  saveScene: () => Promise.resolve(true),
  keepVersion: () => Promise.resolve(true),
  listVersions: () => Promise.resolve([]),
  dropVersion: () => Promise.resolve(),
}));

const scene = (e: Editor) => e.store.getState().scene;
const text = (e: Editor): string => JSON.stringify(scene(e));

describe("tools", () => {
  it("task: a click puts one down, selects it and gives the select tool back; one entry", () => {
    const { editor, drag } = createTestEditor();
    const before = text(editor);
    editor.tools.use("task", "turn");
    drag([
      [1, 1],
      [1.5, 1.2],
    ]);
    expect(scene(editor).tasks.at(-1)).toMatchObject({ category: "turn", position: [1.5, 0, 1.2] });
    expect(editor.store.getState().tool).toBe("select");
    expect(editor.store.getState().selection).toEqual([ref("task", "turn")]);
    editor.scene.undo();
    expect(text(editor)).toBe(before);
  });

  it.each(["task", "path"])("%s: Escape goes back to the mark, nothing is left in the history", (tool) => {
    const { editor, drag } = createTestEditor();
    const before = text(editor);
    editor.tools.use(tool);
    drag(
      [
        [0, 0],
        [1, 0.4],
        [2, 1],
        [3, 1],
      ],
      { bail: true },
    );
    expect(text(editor)).toBe(before);
    expect(editor.store.getState().canUndo).toBe(false);
  });

  it("path: a stroke becomes a path in one entry", () => {
    const { editor, drag } = createTestEditor();
    editor.tools.use("path");
    drag(Array.from({ length: 20 }, (_, i): [number, number] => [0.15 * i, Math.sin(0.3 * i)]));
    expect(scene(editor).paths).toHaveLength(1);
    editor.scene.undo();
    expect(scene(editor).paths).toHaveLength(0);
    expect(editor.store.getState().canUndo).toBe(false);
  });

  it("select: a box with Shift takes what lies in it", () => {
    const { editor, drag } = createTestEditor();
    drag(
      [
        [-3, -3],
        [3, 3],
      ],
      { shift: true },
    );
    const kinds = new Set(editor.store.getState().selection.map((r) => r.kind));
    expect(kinds.has("task")).toBe(true);
    expect(editor.store.getState().selection.filter((r) => r.kind === "task")).toHaveLength(4);
  });
});

describe("one history for everything", () => {
  it("100 random edits undone and done again give the identical documents", () => {
    const pick = fc.record({
      what: fc.nat(8),
      which: fc.nat(20),
      x: fc.double({ min: -3, max: 3, noNaN: true }),
      z: fc.double({ min: -3, max: 3, noNaN: true }),
    });
    fc.assert(
      fc.property(fc.array(pick, { minLength: 100, maxLength: 100 }), (acts) => {
        const { editor: e } = createTestEditor();
        const states = [text(e)];
        for (const a of acts) {
          const things = e.things();
          const t = things[a.which % Math.max(1, things.length)];
          if (a.what === 0) e.edit((s, c) => c.addTask(s, "turn", a.x, a.z, a.x).scene);
          else if (a.what === 1 && t) {
            e.scene.select([t.ref]);
            e.scene.duplicate();
          } else if (a.what === 2 && t) {
            e.scene.select([t.ref]);
            e.scene.remove();
          } else if (a.what === 3 && t) {
            e.scene.select([t.ref, ...(things[0] ? [things[0].ref] : [])]);
            e.scene.nudge(a.x / 10, a.z / 10, a.x);
          } else if (a.what === 4)
            e.edit((s, c) => c.editFootstep(s, null, a.which, { position: [a.x, 0, a.z], pinned: a.x > 0 }));
          else if (a.what === 5)
            e.edit(
              (s, c) =>
                c.addPath(s, [
                  [a.x, a.z],
                  [a.z, a.x + 1],
                ]).scene,
            );
          else if (a.what === 6)
            e.edit(
              (s) =>
                pasteThings(s, copyThings(s, new Set(s.tasks.slice(0, 2).map((x) => x.id))), 0.5, 0.5).scene,
            );
          else if (a.what === 7) {
            // A drag: many edits, one entry.
            e.scene.beginGesture();
            for (let k = 1; k < 4; k++)
              e.edit((s, c) => c.setCharacter(s, 1.6 + 0.1 * Math.abs(a.x) + 0.01 * k, 1));
            e.scene.endGesture(a.z > -2);
          } else e.edit((s, c) => c.releaseFootsteps(s, [{ task: null, step: a.which }]));
          if (text(e) !== states.at(-1)) states.push(text(e));
        }
        parseScene(scene(e));
        for (let i = states.length - 2; i >= 0; i--) {
          e.scene.undo();
          expect(text(e)).toBe(states[i]);
        }
        expect(e.store.getState().canUndo).toBe(false);
        for (let i = 1; i < states.length; i++) {
          e.scene.redo();
          expect(text(e)).toBe(states[i]);
        }
      }),
      { seed: 11, numRuns: 12 },
    );
  });

  it("what the schema refuses is not done, and said with its place", () => {
    const { editor, said } = createTestEditor();
    const before = text(editor);
    expect(editor.edit((s, c) => c.changeTask(s, "write", { duration: 900 }))).toBe(false);
    expect(text(editor)).toBe(before);
    expect(said.join()).toContain("tasks[0].duration: at most 600");
  });
});

describe("examples", () => {
  it("are scenes without a mistake, each under a name of its own", () => {
    expect(new Set(EXAMPLES.map((x) => x.name)).size).toBe(EXAMPLES.length);
    for (const x of EXAMPLES) {
      const scene = x.scene();
      expect(parseScene(scene)).toEqual(scene);
      expect(scene.order.length + (scene.crowd ? 1 : 0)).toBeGreaterThan(0);
    }
  });
});

describe("clipboard", () => {
  it("tasks bring their furniture along, under ids of their own", () => {
    const s = defaultScene();
    const fragment = readFragment(JSON.stringify(copyThings(s, new Set(["lift"]))));
    expect(fragment?.props.map((p) => p.kind).sort()).toEqual(["box", "table"]);
    const pasted = pasteThings(s, fragment!, 0.5, 0.5);
    expect(pasted.tasks).toEqual(["lift-2"]);
    expect(parseScene(pasted.scene).tasks).toHaveLength(5);
    expect(readFragment("some words")).toBeNull();
    expect(readFragment('{"a":1}')).toBeNull();
    expect(() => readFragment('{"stepwright":1,"tasks":[{"id":"x"}]}')).toThrow("tasks[0].category");
  });
});

describe("links", () => {
  it("carry any scene there and back, short enough for an address", async () => {
    const s = defaultScene();
    const hash = await sceneToHash(s, "Two tables");
    expect(carriesScene(hash)).toBe(true);
    expect(hash.length).toBeLessThan(2000);
    expect(await sceneFromHash(hash)).toEqual({ scene: s, name: "Two tables" });
  });

  it("damaged, cut short, hostile: one sentence", async () => {
    const hash = await sceneToHash(defaultScene(), "x");
    for (const bad of [hash.slice(0, 60), "#s=%%%", "#s=", `${hash.slice(0, 40)}AAAA${hash.slice(44)}`])
      await expect(sceneFromHash(bad)).rejects.toThrow(/^This link/);
    const evil = await sceneToHash({ ...defaultScene(), tasks: "none" } as never, "x");
    await expect(sceneFromHash(evil)).rejects.toThrow("This link: tasks");
    const bomb = await sceneToHash({ note: "a".repeat(9_000_000) } as never, "x");
    await expect(sceneFromHash(bomb)).rejects.toThrow("more than 4 MB");
  });
});

describe("keys and numbers", () => {
  it("no key does two things, and everything shown in the help sheet has words", () => {
    const { editor } = createTestEditor();
    const used = allKeys(editor).flatMap((b) => (b.run ? b.keys : []));
    expect(used.filter((k, i) => used.indexOf(k) !== i)).toEqual([]);
    for (const t of editor.registry.tools) if (t.key !== "") expect(used).toContain(t.key);
  });

  it("chords are named as they are pressed", () => {
    const press = (init: KeyboardEventInit) => chord(new KeyboardEvent("keydown", init));
    expect(press({ key: "z", ctrlKey: true })).toBe("Ctrl+Z");
    expect(press({ key: "Z", metaKey: true, shiftKey: true })).toBe("Ctrl+Shift+Z");
    expect(press({ key: "?", shiftKey: true })).toBe("?");
    expect(press({ key: " " })).toBe("Space");
    expect(press({ key: "ArrowUp", shiftKey: true })).toBe("Shift+ArrowUp");
  });

  it("numbers as people write them", () => {
    expect(readNumber(" 1,5 ")).toBe(1.5);
    expect(readNumber("\u22120.25")).toBe(-0.25);
    expect(readNumber("")).toBeNaN();
    expect(readNumber("two")).toBeNaN();
  });
});

describe("the inspector", () => {
  /** A document with one thing of a kind whose field has a value. */
  const holding: Record<ThingName, (key: string, value: unknown) => object> = {
    task: (key, value) => ({ tasks: [{ id: "a", category: "write", position: [0, 1, 0], [key]: value }] }),
    prop: (key, value) => ({ props: [{ id: "a", kind: "table", position: [0, 0, 0], [key]: value }] }),
    edit: (key, value) => ({ edits: [{ step: 0, [key]: value }] }),
    character: (key, value) => ({ character: { [key]: value } }),
    proportions: (key, value) => ({ character: { proportions: { [key]: value } } }),
  };
  const accepted = (thing: ThingName, key: string, value: unknown): boolean => {
    try {
      parseScene({ version: 1, ...holding[thing](key, value) });
      return true;
    } catch {
      return false;
    }
  };

  for (const thing of ["task", "prop", "edit", "character", "proportions"] as const)
    it(`${thing}: what its fields say they take is what the document takes`, () => {
      const fields = fieldsOf(thing);
      expect(fields.length).toBeGreaterThan(0);
      for (const f of fields) {
        if (f.kind === "number") {
          for (const v of f.range) expect(accepted(thing, f.key, v), `${f.key} ${v}`).toBe(true);
          expect(accepted(thing, f.key, f.range[0] - 0.01)).toBe(false);
          expect(accepted(thing, f.key, f.range[1] + 0.01)).toBe(false);
        }
        if (f.kind === "numbers") {
          expect(
            accepted(
              thing,
              f.key,
              f.axes.map(() => 1),
            ),
          ).toBe(true);
          expect(
            accepted(
              thing,
              f.key,
              f.axes.slice(1).map(() => 1),
            ),
          ).toBe(false);
        }
        if (f.kind === "choice") {
          for (const o of f.options) {
            expect(accepted(thing, f.key, o.value)).toBe(true);
            expect(o.word).toMatch(/^[A-Z]/);
          }
          expect(accepted(thing, f.key, "none such")).toBe(false);
        }
        if (f.slider)
          for (const v of f.slider) expect(accepted(thing, f.key, v), `slider of ${f.key}`).toBe(true);
        expect(accepted(thing, f.key, null)).toBe(f.nullable);
      }
    });

  it("a row for every field, in the schema's order; changes reach the scene as one entry each", () => {
    const { editor } = createTestEditor();
    const place = document.createElement("div");
    const set = (key: string, value: unknown) =>
      editor.edit((s, c) => c.changeTask(s, "write", { [key]: value }));
    const show = () => {
      const task = scene(editor).tasks[0];
      render(schemaRows(editor, "task", { values: { ...task }, of: task.category, set }), place);
    };
    show();
    const named = [...place.querySelectorAll(".row > span:first-child")].map((x) => x.textContent);
    expect(named).toEqual(fieldsOf("task").map((f) => f.label));
    const press = (label: string) =>
      [...place.querySelectorAll("button")].find((b) => b.textContent === label)?.click();
    press("Low");
    press("Left");
    expect(scene(editor).tasks[0]).toMatchObject({ effort: 0, hand: "left" });
    const hold = place.querySelector<HTMLInputElement>('[aria-label="Hold"]')!;
    hold.value = "2,5";
    hold.dispatchEvent(new Event("change"));
    expect(scene(editor).tasks[0].duration).toBe(2.5);
    for (let k = 0; k < 3; k++) editor.scene.undo();
    expect(scene(editor)).toEqual(defaultScene());
    // What means nothing for a turn is not asked.
    render(schemaRows(editor, "task", { values: {}, of: "turn", set }), place);
    expect([...place.querySelectorAll(".row > span:first-child")].map((x) => x.textContent)).toEqual([
      "Position",
      "Facing",
    ]);
  });
});
