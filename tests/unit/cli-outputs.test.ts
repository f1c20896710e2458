import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { afterAll, describe, expect, it } from "vitest";
import { outputs } from "../../src/cli/args.ts";
import { crowdCommand } from "../../src/cli/commands/crowd.ts";
import { planCommand } from "../../src/cli/commands/plan.ts";

const folder = mkdtempSync(join(tmpdir(), "stepwright-out-"));
afterAll(() => rmSync(folder, { recursive: true }));

describe("where results go", () => {
  it("several into a folder that need not be there yet, one into the file named", () => {
    expect(outputs(["a/x.bvh", "b/y.bvh"], join(folder, "new/"), "csv")).toEqual([
      join(folder, "new/x.csv"),
      join(folder, "new/y.csv"),
    ]);
    expect(existsSync(join(folder, "new"))).toBe(true);
    expect(outputs(["x.bvh"], join(folder, "deep/er/z.csv"), "csv")).toEqual([join(folder, "deep/er/z.csv")]);
    expect(existsSync(join(folder, "deep/er"))).toBe(true);
  });

  it("two inputs that would be written to one file are told before the work", () => {
    expect(() => outputs(["a/x.bvh", "b/x.bvh"], join(folder, "new/"), "csv")).toThrow(
      `b/x.bvh: its result would take the place of that of a/x.bvh, ${join(folder, "new/x.csv")}.`,
    );
  });

  it("a result that would overwrite its input is told before the work", () => {
    const scene = join(folder, "scene.json");
    expect(() => outputs([scene], `${folder}/`, "json")).toThrow(
      `${scene}: its result would take its own place; another folder is needed.`,
    );
    expect(outputs([scene], `${folder}/`, "csv")).toEqual([join(folder, "scene.csv")]);
  });

  it("a folder that cannot be made is told before the work", () => {
    writeFileSync(join(folder, "file"), "");
    expect(() => outputs(["a", "b"], join(folder, "file/in"), "csv")).toThrow(
      `${join(folder, "file/in")}: could not be made`,
    );
  });

  it("crowds and plans of several scenes", () => {
    const crowd = join(folder, "crowd.json");
    const goal = { position: [0, 0], yaw: 0, goals: [[0, 2]] };
    writeFileSync(crowd, JSON.stringify({ version: 1, crowd: { agents: [goal] } }));
    const out = join(folder, "made/");
    crowdCommand.run(["--case", crowd, crowd, "--out", out, "--seconds", "4"]);
    expect(existsSync(join(out, "crowd.json"))).toBe(true);
    const path = join(folder, "path.json");
    writeFileSync(
      path,
      JSON.stringify({
        version: 1,
        paths: [
          {
            id: "p",
            points: [
              [0, 0],
              [0, 3],
            ],
          },
        ],
      }),
    );
    const plans = join(folder, "plans/");
    planCommand.run(["--scene", path, path, "--out", plans]);
    expect(existsSync(join(plans, "path.json"))).toBe(true);
    expect(existsSync(join(plans, "path.bvh"))).toBe(true);
    // What it wrote is planned anew, to the same plan.
    const again = planCommand.run(["--scene", join(plans, "path.json"), "--out", join(folder, "again.json")]);
    expect(again).toMatchObject({ beside: { distance: 0, distance90: 0, seconds: null } });
    const read = (path: string): unknown => JSON.parse(readFileSync(path, "utf8"));
    expect(read(join(folder, "again.json"))).toEqual(read(join(plans, "path.json")));
  });
});
