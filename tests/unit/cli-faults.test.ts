/** What people get wrong at the command line: one line that says what and where; 1 for bad input, 2 for wrong usage; never a hang. */
import { existsSync, mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { afterAll, afterEach, beforeAll, beforeEach, describe, expect, it, vi } from "vitest";
import { main } from "../../src/cli/main.ts";
import { writeBvh } from "../../src/core/capture/bvh-write.ts";
import { renderScore } from "../../src/studio/render.ts";
import { studioSet } from "../../src/studio/set.ts";

const folder = mkdtempSync(join(tmpdir(), "stepwright-faults-"));
const at = (name: string): string => join(folder, name);
const SCENE = "assets/scenes/moving-boxes.json";
let said: string[] = [];

beforeAll(() => {
  const { clip } = renderScore(studioSet()[0].score);
  const bvh = writeBvh({ ...clip, frames: 60, root: clip.root.slice(0, 180) });
  writeFileSync(at("a.bvh"), bvh);
  writeFileSync(at("cut.bvh"), bvh.slice(0, bvh.length / 2));
  writeFileSync(at("nan.bvh"), bvh.replace(/(Frame Time: .*\n)\S+/, "$1NaN"));
  writeFileSync(at("text.bvh"), "hello");
  writeFileSync(at("file"), "");
  writeFileSync(at("cut.bin"), "SWL1");
  mkdirSync(at("empty"));
  const json = (name: string, value: unknown): void => writeFileSync(at(name), JSON.stringify(value));
  const path = (points: number[][], style = "walking") => ({
    version: 1,
    paths: [{ id: "p", points, styles: [{ at: 0, style }] }],
  });
  writeFileSync(at("broken.json"), "{");
  json("wrong.json", { version: 1, tasks: [{ id: "a", category: "write", position: [0, 1, "x"] }] });
  json(
    "style.json",
    path(
      [
        [0, 0],
        [0, 5],
      ],
      "constructor",
    ),
  ); // prettier-ignore
  json("one.json", path([[0, 0]]));
  json(
    "same.json",
    path([
      [0, 0],
      [0, 0],
    ]),
  ); // prettier-ignore
  json("result.json", { version: 1, scene: { version: 1 }, footsteps: [{ foot: "middle" }] });
});
afterAll(() => rmSync(folder, { recursive: true }));
beforeEach(() => {
  said = [];
  vi.spyOn(console, "error").mockImplementation((text: string) => void said.push(text));
  vi.spyOn(console, "log").mockImplementation(() => undefined);
});
afterEach(() => {
  vi.restoreAllMocks();
});

/** Arguments, the exit code and how the last thing said begins; files of the test's folder stand as @name. */
const faults: [line: string, code: number, begins: string][] = [
  ["import --bvh @none.bvh", 1, "@none.bvh: could not be read: no such file or directory."],
  ["import --bvh @empty", 1, "@empty: could not be read: this is no file."],
  ["import --bvh @text.bvh", 1, "@text.bvh, line 1: HIERARCHY is expected; this is no BVH file."],
  ["import --bvh @cut.bvh", 1, "@cut.bvh, line "],
  ["import --bvh @nan.bvh", 1, "@nan.bvh, line "],
  ["import", 2, "--bvh is needed."],
  ["import --bvh", 2, "--bvh: a value is needed."],
  ["import --bvh @a.bvh --into x", 2, "--into: no such option is known."],
  ["import @a.bvh", 2, "@a.bvh: no word is expected here."],
  ["contacts --bvh @a.bvh --method magic --out @a.csv", 2, "--method: one of oracle, height, speed"],
  ["contacts --bvh @a.bvh --model @none --out @a.csv", 1, "@none: could not be read: no such file"],
  ["contacts --bvh @a.bvh --method both --out /proc/none/a.csv", 1, "/proc/none: could not be made: "],
  ["contacts --bvh @a.bvh --method both --out @file/a.csv", 1, "@file: could not be made: a file of that"],
  ["contacts-train --pairs @a.bvh --out @m.bin", 2, "--pairs: @a.bvh: CLIP.bvh=LABELS.csv is needed."],
  ["clean --bvh @cut.bvh --method both --out @c.bvh", 1, "@cut.bvh, line "],
  ["plan --scene @none.json --out @r.json", 1, "@none.json: could not be read: no such file or directory."],
  ["plan --scene @broken.json --out @r.json", 1, "@broken.json: no JSON: "],
  ["plan --scene @wrong.json --out @r.json", 1, "@wrong.json: tasks[0].position[2]: a number is needed"],
  ["plan --scene @result.json --out @r.json", 1, "@result.json: footsteps[0].foot: one of left, right"],
  ["plan --scene @style.json --out @r.json", 1, "@style.json: paths[0].styles[0].style: one of walking"],
  ["plan --scene @one.json --out @r.json", 1, "@one.json: paths[0].points: two at least are needed."],
  [
    "plan --scene @same.json --out @r.json",
    1,
    "@same.json: paths[0].points: two different points are needed",
  ],
  [`plan --scene ${SCENE} --library @none.bin --out @r.json`, 1, "@none.bin: could not be read: no such"],
  [`plan --scene ${SCENE} --library @cut.bin --out @r.json`, 1, "@cut.bin: library: "],
  [`plan --scene ${SCENE} --cycles @nan.bvh --out @r.json`, 1, "@nan.bvh, line "],
  [`plan --scene ${SCENE} --out @r.json more`, 2, "more: no word is expected here."],
  ["crowd --case @wrong.json --out @k.json", 1, "@wrong.json: tasks[0].position[2]: a number is needed"],
  ["crowd --case @text.bvh --out @k.json", 1, "@text.bvh: no <SteerBenchTestCase> was found."],
  [`crowd --case ${SCENE} --out @k.json --seconds soon`, 2, "--seconds: a number up to 3600 is needed."],
  ["library --clips @none --out @l.bin", 1, "@none: could not be read: no such file or directory."],
  ["library --clips @empty --out @l.bin", 1, "@empty: no BVH file is in it."],
  ["library merge --out @l.bin", 2, "merge: files are needed."],
  ["library merge @none.bin --out @l.bin", 1, "@none.bin: could not be read: no such file or directory."],
  ["studio --out /proc/none --only walk-and-turn", 1, "/proc/none: could not be made: "],
  ["studio --out @s --only nobody", 2, '--only: no capture is called "nobody".'],
  ["studio --out @s --score @none.json", 1, "@none.json: could not be read: no such file or directory."],
  ["studio --out @s --score @broken.json", 1, "@broken.json: no JSON: "],
  ["studio --out @s --without legs", 2, "--without: one of roll"],
  ["nothing", 2, "nothing: no such command is known."],
];
describe("faults at the command line", () => {
  it.each(faults)("%s", async (line, code, begins) => {
    const here = (text: string): string => text.replaceAll("@", `${folder}/`);
    expect(await main(here(line).split(" "))).toBe(code);
    const last = said.at(-1) ?? "";
    expect(last.slice(0, here(begins).length)).toBe(here(begins));
    // Usage is a line of its own below what is wrong.
    if (code === 1) expect(last).not.toContain("\n");
  });

  it("help of everything and of one command", async () => {
    expect(await main(["--help"])).toBe(0);
    expect(said.at(-1)).toContain("bench [--only NAME]");
    expect(await main(["plan", "--help"])).toBe(0);
    expect(said.at(-1)).toMatch(/^plan --scene F/);
  });

  it("one input into a folder that is there takes the input's name", async () => {
    const out = at("there");
    mkdirSync(out);
    expect(await main(["contacts", "--bvh", at("a.bvh"), "--method", "both", "--out", out])).toBe(0);
    expect(readFileSync(join(out, "a.csv"), "utf8")).toMatch(/^frame,left_heel/);
    expect(existsSync(at("r.json"))).toBe(false);
  });
});
