import { readdirSync, readFileSync } from "node:fs";
import fc from "fast-check";
import { describe, expect, it } from "vitest";
import * as commands from "../../src/core/scene/commands.ts";
import { defaultScene } from "../../src/core/scene/default-scene.ts";
import { History } from "../../src/core/scene/history.ts";
import { propsOfTask } from "../../src/core/scene/props.ts";
import { parseScene, readScene, serializeScene } from "../../src/core/scene/schema.ts";
import { TASK_CATEGORIES } from "../../src/core/scene/task-types.ts";
import { budget } from "../support/fuzz.ts";

describe("scene documents", () => {
  it("fills in every default", () => {
    const s = parseScene({ version: 1 });
    expect(s).toMatchObject({
      seed: 1,
      tasks: [],
      order: [],
      terrain: { kind: "flat" },
      crowd: null,
      character: { height: 1.75 },
    });
  });

  it("what is written is read back", () => {
    const s = defaultScene();
    expect(readScene(serializeScene(s), "x.json")).toEqual(s);
  });

  const task = { id: "a", category: "write", position: [0, 1, 2] };
  it.each([
    [{}, "version: this field is needed"],
    [{ version: 2 }, "version: version 1 is needed, found 2."],
    [
      { version: 1, tasks: [task, { ...task, id: "b" }, { ...task, id: "c", yaw: "left" }] },
      'tasks[2].yaw: a number is needed, found "left".',
    ],
    [{ version: 1, tasks: [{ ...task, position: [0, 1] }] }, "tasks[0].position"],
    [
      { version: 1, tasks: [{ ...task, category: "dance" }] },
      'tasks[0].category: one of write, lift, place, sit, stand, turn is needed, found "dance".',
    ],
    [{ version: 1, tasks: [task, task] }, "tasks[1].id: an id of its own is needed"],
    [{ version: 1, order: ["x"] }, "order[0]: no task, path or stone has the id"],
    [{ version: 1, colour: 3 }, "colour: no such field is known."],
    [{ version: 1, character: { height: 3 } }, "character.height: at most 2.3 is possible, found 3."],
    [{ version: 1, seed: Number.NaN }, "seed"],
  ])("says what is wrong and where (%#)", (bad, message) => {
    expect(() => parseScene(bad)).toThrow(message);
  });

  it("anything at all gives a scene or one sentence (seed 5)", () => {
    fc.assert(
      fc.property(fc.anything(), (value) => {
        try {
          parseScene(value);
        } catch (error) {
          expect((error as Error).name).toBe("SceneError");
        }
      }),
      { seed: 5, numRuns: 300 },
    );
  });

  it("every example scene is valid", () => {
    for (const f of readdirSync("assets/scenes")) readScene(readFileSync(`assets/scenes/${f}`, "utf8"), f);
  });
});

describe("commands and undo", () => {
  it("a task takes its furniture along", () => {
    const s = defaultScene();
    const moved = commands.placeTask(s, "lift", [0, 0.95, -2], 1);
    expect(propsOfTask(moved, moved.tasks.find((t) => t.id === "lift")!).map((p) => p.kind)).toEqual([
      "table",
      "box",
    ]);
    expect(moved.props.find((p) => p.id === "table-2")).toEqual(s.props.find((p) => p.id === "table-2"));
  });

  it("removing a task leaves what others use", () => {
    const added = commands.duplicateTask(defaultScene(), "sit");
    const rest = commands.removeTask(added.scene, added.id);
    expect(rest.tasks).toEqual(defaultScene().tasks);
    expect(rest.props).toEqual(defaultScene().props);
  });

  it("undo of 100 random edits gives the same document, redo the edited one (seed 31)", () => {
    fc.assert(
      fc.property(
        fc.array(
          fc.tuple(
            fc.integer({ min: 0, max: 4 }),
            fc.integer({ min: 0, max: 50 }),
            fc.double({ min: -3, max: 3, noNaN: true }),
          ),
          { minLength: 100, maxLength: 100 },
        ),
        (edits) => {
          const history = new History(defaultScene());
          let count = 0;
          for (const [kind, which, amount] of edits) {
            const s = history.scene;
            const id = s.tasks[which % Math.max(1, s.tasks.length)]?.id ?? "";
            const before = history.scene;
            if (kind === 0)
              history.apply(commands.addTask(s, TASK_CATEGORIES[which % 6], amount, -amount, amount).scene);
            else if (kind === 1) history.apply(commands.placeTask(s, id, [amount, 1, amount / 2], amount));
            else if (kind === 2) history.apply(commands.removeTask(s, id));
            else if (kind === 3)
              history.apply(commands.changeTask(s, id, { effort: which % 2 === 0 ? 0 : 1 }));
            else {
              // A drag: many moves, one entry.
              history.begin();
              for (let k = 1; k <= 3; k++)
                history.apply(commands.placeTask(history.scene, id, [amount * k, 1, 0], 0));
              history.commit();
            }
            if (history.scene !== before) count++;
          }
          const end = serializeScene(history.scene);
          for (let i = 0; i < count; i++) expect(history.undo()).toBe(true);
          expect(history.canUndo).toBe(false);
          expect(serializeScene(history.scene)).toBe(serializeScene(defaultScene()));
          for (let i = 0; i < count; i++) history.redo();
          expect(serializeScene(history.scene)).toBe(end);
        },
      ),
      { seed: 31, numRuns: 20 },
    );
  });

  it("a hundred random edits, undone and done again, give the same documents (seed 7)", () => {
    const real = fc.double({ min: -20, max: 20, noNaN: true });
    const edit = fc.record({
      kind: fc.nat(6),
      pick: fc.nat(1000),
      category: fc.constantFrom(...TASK_CATEGORIES),
      x: real,
      z: real,
      yaw: real,
      gesture: fc.nat(3),
    });
    fc.assert(
      fc.property(fc.array(edit, { minLength: 100, maxLength: 100 }), (edits) => {
        const history = new History(defaultScene());
        const documents = [serializeScene(history.scene)];
        const once = (e: (typeof edits)[number], scale: number) => {
          const s = history.scene;
          const id = s.tasks[e.pick % Math.max(1, s.tasks.length)]?.id ?? "none";
          switch (e.kind) {
            case 0:
              return commands.addTask(s, e.category, e.x, e.z, e.yaw).scene;
            case 1:
              return commands.duplicateTask(s, id).scene;
            case 2:
              return commands.removeTask(s, id);
            case 3:
              return commands.changeTask(s, id, { duration: Math.abs(e.x), hand: "left" });
            case 4:
              return commands.setCharacter(s, 1.75 + e.x / 100, 1 + e.z / 100);
            default:
              return commands.placeTask(s, id, [e.x * scale, 1, e.z * scale], e.yaw);
          }
        };
        for (const e of edits) {
          const before = history.scene;
          // A drag of several moves is one entry; one that is given up is none.
          if (e.gesture > 0) {
            history.begin();
            for (let k = 1; k <= 3; k++) history.apply(once(e, k / 3));
            if (e.gesture === 3) history.cancel();
            else history.commit();
          } else history.apply(once(e, 1));
          if (history.scene !== before) documents.push(serializeScene(history.scene));
        }
        for (let k = documents.length - 2; k >= 0; k--) {
          expect(history.undo()).toBe(true);
          expect(serializeScene(history.scene)).toBe(documents[k]);
        }
        expect(history.canUndo).toBe(false);
        for (let k = 1; k < documents.length; k++) {
          expect(history.redo()).toBe(true);
          expect(serializeScene(history.scene)).toBe(documents[k]);
        }
        expect(history.redo()).toBe(false);
        // The last one is valid, and read back as it is.
        const last: unknown = JSON.parse(serializeScene(history.scene));
        expect(parseScene(last)).toEqual(last);
      }),
      { ...budget(8), endOnFailure: true },
    );
  });
});
