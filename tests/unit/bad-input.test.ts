/** One broken input a guard, with the sentence that is said: fuzzing finds new ones, these stay found. */
import { describe, expect, it } from "vitest";
import { writeBvh } from "../../src/core/capture/bvh-write.ts";
import { importBvh } from "../../src/core/capture/import.ts";
import { parseSidecar } from "../../src/core/capture/sidecar-file.ts";
import { parseContactsCsv } from "../../src/core/contacts/csv.ts";
import { decodeOracle, encodeOracle } from "../../src/core/contacts/model-file.ts";
import { trackOf } from "../../src/core/contacts/motion-track.ts";
import { trainOracle } from "../../src/core/contacts/oracle.ts";
import { readSteerCase } from "../../src/core/crowd/steer-case.ts";
import { JOINT_COUNT } from "../../src/core/skeleton/joints.ts";
import { buildLibrary } from "../../src/core/templates/build-library.ts";
import { decodeLibrary, encodeLibrary } from "../../src/core/templates/library-file.ts";
import { renderScore } from "../../src/studio/render.ts";
import { studioSet } from "../../src/studio/set.ts";
import { headOf, repacked } from "../support/packed.ts";

const { clip, contacts, sidecar } = renderScore(studioSet()[0].score);
const short = {
  ...clip,
  frames: 30,
  root: clip.root.slice(0, 90),
  rotations: clip.rotations.slice(0, 4 * JOINT_COUNT * 30),
};
const bvh = writeBvh(short);
const library = encodeLibrary(buildLibrary([{ name: "one", clip, tasks: sidecar.tasks }]));
const model = encodeOracle(trainOracle([{ track: trackOf(short), labels: contacts.slice(0, 30) }]));

describe("bad input", () => {
  it("BVH: a number that is none", () => {
    const lines = bvh.split("\n");
    const row = lines.findIndex((l) => l.startsWith("Frame Time")) + 4;
    for (const odd of ["NaN", "Infinity", "-", "1e308", "0x", "1,5"]) {
      const text = lines.map((l, i) => (i === row ? l.replace(/^\S+/, odd) : l)).join("\n");
      expect(() => importBvh(text, "a.bvh")).toThrow(
        `a.bvh, line ${row + 1}: a number is needed, found ${JSON.stringify(odd)}.`,
      );
    }
  });

  it("BVH: a head that promises more than the file can hold costs nothing", () => {
    const text = bvh.replace(/Frames: \d+/, "Frames: 1900000");
    expect(() => importBvh(text, "a.bvh")).toThrow(
      /^a\.bvh, line \d+: 1900000 frames of \d+ numbers are promised; the file is too short/,
    );
  });

  it("contact CSV: what is no bit", () => {
    expect(() =>
      parseContactsCsv("frame,left_heel,left_toe,right_heel,right_toe\n0,1,0,0.5,0\n", "a.csv"),
    ).toThrow("a.csv, line 2: 0 or 1 is needed, found 0.5.");
  });

  it("sidecar: a task without a place", () => {
    const text = JSON.stringify({ version: 1, tasks: [{ ...sidecar.tasks[0], position: [1, "2", 3] }] });
    expect(() => parseSidecar(text, "a.json")).toThrow("a.json: tasks.0.position.1: a number is needed.");
  });

  it("SteerSuite: more walkers than can be simulated, one by one or in a region", () => {
    const head =
      "<SteerBenchTestCase><header><worldBounds><xmin>-20</xmin><xmax>20</xmax><ymin>0</ymin><ymax>0</ymax><zmin>-20</zmin><zmax>20</zmax></worldBounds></header>";
    const walker = (tag: string, more: string) =>
      `<${tag}>${more}<initialConditions><position><x>1</x><y>0</y><z>1</z></position><direction><x>1</x><y>0</y><z>0</z></direction><radius>0.3</radius><speed>0</speed></initialConditions><goalSequence><seekStaticTarget><targetLocation><x>10</x><y>0</y><z>0</z></targetLocation><desiredSpeed>1.3</desiredSpeed><timeDuration>1000</timeDuration></seekStaticTarget></goalSequence></${tag}>`;
    const many = `${head}${walker("agent", "").repeat(5001)}</SteerBenchTestCase>`;
    expect(() => readSteerCase(many, "a.xml")).toThrow("a.xml: 5001 agents, at most 5000 are simulated.");
    const region = walker(
      "agentRegion",
      "<numAgents>6000</numAgents><regionBounds><xmin>0</xmin><xmax>5</xmax><zmin>0</zmin><zmax>5</zmax></regionBounds>",
    );
    expect(() => readSteerCase(`${head}${region}</SteerBenchTestCase>`, "a.xml")).toThrow(
      /^a\.xml, line 1: 6000 agents more, at most 5000 are simulated\./,
    );
  });

  it("library: a head with a step outside of the schema", () => {
    const bytes = repacked(library, headOf(library).replace('"height":1.75', '"height":"tall"'));
    expect(() => decodeLibrary(bytes)).toThrow(/^library: .*clips\.0\.height/);
  });

  it("contact model: a value that is no number", () => {
    const bytes = repacked(model, headOf(model), (raw) => {
      const out = raw.slice();
      new DataView(out.buffer).setFloat32(8, Number.NaN, true);
      return out;
    });
    expect(() => decodeOracle(bytes, "a.model")).toThrow(
      "a.model: the contact model is damaged or cut short.",
    );
  });
});
