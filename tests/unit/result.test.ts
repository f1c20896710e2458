/** Result documents: what a plan writes is read as it was, and each mistake is one sentence with its place. */
import { describe, expect, it } from "vitest";
import { defaultScene } from "../../src/core/scene/default-scene.ts";
import { footstepsOf, type ResultDocument, resultDocument } from "../../src/core/scene/result.ts";
import { parseResult, readResult, readSceneOrResult } from "../../src/core/scene/result-schema.ts";
import { parseScene, serializeScene } from "../../src/core/scene/schema.ts";
import type { Scene } from "../../src/core/scene/types.ts";
import { solveScene } from "../../src/core/solve-scene.ts";
import { studio } from "../support/library.ts";

function resultOf(scene: Scene): ResultDocument {
  const { plan, contacts, quality } = solveScene(scene, studio().library);
  return resultDocument(scene, plan, contacts, quality);
}

const made = resultOf(defaultScene());
const text = JSON.stringify(made);
const copy = (): ResultDocument => JSON.parse(text) as ResultDocument;

describe("result documents", () => {
  it("what is planned and written is read as it was", () => {
    const again = readResult(text, "a.json");
    expect(again).toEqual(copy());
    expect(parseResult(JSON.parse(JSON.stringify(again)))).toEqual(again);
    expect(made.footsteps.length).toBeGreaterThan(10);
    expect(footstepsOf(again).steps).toHaveLength(made.footsteps.length - 2);
  });

  it("a scene without tasks has the two stances alone", () => {
    const standing = resultOf(parseScene({ version: 1 }));
    expect(parseResult(JSON.parse(JSON.stringify(standing))).footsteps).toHaveLength(2);
  });

  it("is told apart from a scene", () => {
    expect(readSceneOrResult(text, "a.json").result?.footsteps).toHaveLength(made.footsteps.length);
    expect(readSceneOrResult(serializeScene(made.scene), "a.json")).toEqual({
      scene: made.scene,
      result: null,
    });
    expect(() => readSceneOrResult("{}", "a.json")).toThrow("a.json: version: this field is needed");
    expect(() => readSceneOrResult('{"scene": {}, "footsteps": []}', "a.json")).toThrow(
      "a.json: version: this field is needed",
    );
  });

  const last = made.footsteps.length - 1;
  // A value anywhere in a copy, by its path, is another.
  const faults: [path: (string | number)[], value: unknown, said: string][] = [
    [["version"], 2, "version: version 1 is needed, found 2."],
    [["more"], 1, "more: no such field is known."],
    [["<b>\n"], 1, '"<b>\\n": no such field is known.'],
    [["scene", "version"], 7, "scene.version: version 1 is needed, found 7."],
    [["scene", "tasks", 1, "yaw"], "left", 'scene.tasks[1].yaw: a number is needed, found "left".'],
    [["scene"], 3, "scene: an object is needed, found 3."],
    [["footsteps", 3, "land"], "late", 'footsteps[3].land: a number is needed, found "late".'],
    [["footsteps", 3, "position"], [0, 1], "footsteps[3].position[2]: a number is needed, found nothing."],
    [["footsteps", 3, "position", 1], null, "footsteps[3].position[1]: a number is needed, found null."],
    [["footsteps", 0, "foot"], "right", "footsteps[0]: the left start stance, with lift null, is needed."],
    [["footsteps", 1, "lift"], 0, "footsteps[1]: the right start stance, with lift null, is needed."],
    [["footsteps"], [], "footsteps[0]: the left start stance, with lift null, is needed."],
    [
      ["footsteps", 2, "category"],
      null,
      "footsteps[2].category: only the two start stances have none, found null.",
    ],
    [["footsteps", 2, "category"], "Hop", "footsteps[2].category: one of HeelPivot"],
    [["footsteps", 2, "lift"], null, "footsteps[2].lift: only the two start stances have none, found null."],
    [["footsteps", 2, "lift"], 900, "footsteps[2].land: a time after its lift at 900 is needed"],
    [["footsteps", 2, "task"], "nobody", 'footsteps[2].task: timing.tasks has no "nobody".'],
    [["footsteps", last, "land"], 900, `footsteps[${last}].land: contacts end at `],
    [["contacts", 5, 2], 2, "contacts[5][2]: 0 or 1 is needed, found 2."],
    [["contacts", 5], 3, "contacts[5]: four bits are needed, found 3."],
    [["timing", "rate"], 30, "timing.rate: 60 is needed, found 30."],
    [["timing", "tasks", 0, "id"], "nobody", 'timing.tasks[0].id: the scene has no "nobody".'],
    [
      ["timing", "tasks", 0, "end"],
      0,
      "timing.tasks[0]: start, contact and end one after the other are needed",
    ],
    [["quality", "skate"], "1 mm", 'quality.skate: a number is needed, found "1 mm".'],
    [["quality", "limitViolations"], null, "quality.limitViolations: a number is needed, found null."],
    [["quality"], {}, "quality.skate: this field is needed, found nothing."],
    [["warnings", 0], 1, "warnings[0]: a text is needed, found 1."],
  ];
  it.each(faults)("%j as %j", (path, value, said) => {
    const broken: unknown = copy();
    let at = broken as Record<string | number, unknown>;
    for (const key of path.slice(0, -1)) at = at[key] as Record<string | number, unknown>;
    at[path[path.length - 1]] = value;
    expect(() => parseResult(broken)).toThrow(said);
    expect(() => readResult(JSON.stringify(broken), "a.json")).toThrow(`a.json: ${said}`);
  });
});
