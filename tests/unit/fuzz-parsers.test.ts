/** Every parser on broken files: it answers with finite numbers or with one sentence that names the place. */

import { readFileSync } from "node:fs";
import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { writeBvh } from "../../src/core/capture/bvh-write.ts";
import type { Clip } from "../../src/core/capture/clip.ts";
import { importBvh } from "../../src/core/capture/import.ts";
import { parseSidecar } from "../../src/core/capture/sidecar-file.ts";
import { contactsCsv, parseContactsCsv } from "../../src/core/contacts/csv.ts";
import { decodeOracle, encodeOracle } from "../../src/core/contacts/model-file.ts";
import { trackOf } from "../../src/core/contacts/motion-track.ts";
import { trainOracle } from "../../src/core/contacts/oracle.ts";
import { readSteerCase } from "../../src/core/crowd/steer-case.ts";
import { resultDocument } from "../../src/core/scene/result.ts";
import { readResult } from "../../src/core/scene/result-schema.ts";
import { readScene } from "../../src/core/scene/schema.ts";
import { JOINT_COUNT } from "../../src/core/skeleton/joints.ts";
import { solveScene } from "../../src/core/solve-scene.ts";
import { buildLibrary } from "../../src/core/templates/build-library.ts";
import { decodeLibrary, encodeLibrary } from "../../src/core/templates/library-file.ts";
import { renderScore } from "../../src/studio/render.ts";
import { studioSet } from "../../src/studio/set.ts";
import {
  brokenBytes,
  brokenJson,
  brokenText,
  budget,
  expectFinite,
  limit,
  survives,
} from "../support/fuzz.ts";
import { headOf, repacked } from "../support/packed.ts";

const short = (clip: Clip, frames: number): Clip => ({
  ...clip,
  frames,
  root: clip.root.slice(0, 3 * frames),
  rotations: clip.rotations.slice(0, 4 * JOINT_COUNT * frames),
});

const first = studioSet()[0];
const rendered = renderScore(first.score);
const BVH = writeBvh(short(rendered.clip, 24));
const SIDECAR = JSON.stringify({ ...rendered.sidecar, tasks: rendered.sidecar.tasks.slice(0, 3) }, null, 2);
const library = buildLibrary([{ name: first.name, clip: rendered.clip, tasks: rendered.sidecar.tasks }]);
const LIBRARY = encodeLibrary(library);
const CSV = contactsCsv(library.clips[0].contacts, 60, 60, 40);
const SCENE = readFileSync("assets/scenes/moving-boxes.json", "utf8");
const turn = readScene(
  JSON.stringify({ version: 1, tasks: [{ id: "t", category: "turn", position: [0.4, 0, 1.2], yaw: 1 }] }),
  "turn",
);
const solved = solveScene(turn, library);
const result = resultDocument(turn, solved.plan, solved.contacts, solved.quality);
const RESULT = JSON.stringify(result);
/** The same with few rows of contacts, or most faults would fall on those. */
const HEAD = JSON.stringify({
  ...result,
  contacts: result.contacts.slice(0, 3),
  footsteps: result.footsteps.slice(0, 2),
});
const MODEL = encodeOracle(
  trainOracle([
    {
      track: trackOf(short(rendered.clip, 60)),
      labels: library.clips[0].contacts.slice(0, 60),
    },
  ]),
);
const CASE = `<?xml version="1.0"?>
<SteerBenchTestCase xmlns="http://www.magix.ucla.edu/steerbench">
  <header><version>1.0</version><name>crossing</name>
    <worldBounds><xmin>-20</xmin><xmax>20</xmax><ymin>0</ymin><ymax>0</ymax><zmin>-20</zmin><zmax>20</zmax></worldBounds></header>
  <obstacle><xmin>-1</xmin><xmax>1</xmax><ymin>0</ymin><ymax>1</ymax><zmin>-3</zmin><zmax>3</zmax></obstacle>
  <circleObstacle><radius>0.5</radius><height>1</height><position><x>4</x><y>0</y><z>1</z></position></circleObstacle>
  <orientedBoxObstacle><thetaY>30</thetaY><position><x>6</x><y>0</y><z>1</z></position><size><x>1</x><y>1</y><z>2</z></size></orientedBoxObstacle>
  <obstacleRegion><numObstacles>4</numObstacles><obstacleSize>1</obstacleSize><obstacleHeight>1</obstacleHeight>
    <regionBounds><xmin>-9</xmin><xmax>-5</xmax><zmin>-9</zmin><zmax>9</zmax></regionBounds></obstacleRegion>
  <agentRegion><numAgents>5</numAgents>
    <regionBounds><xmin>-15</xmin><xmax>-11</xmax><zmin>-5</zmin><zmax>5</zmax></regionBounds>
    <initialConditions><direction><random>true</random></direction><radius>0.3</radius><speed>0</speed></initialConditions>
    <goalSequence><seekStaticTarget><targetLocation><x>10</x><y>0</y><z>0</z></targetLocation>
      <desiredSpeed>1.3</desiredSpeed><timeDuration>1000</timeDuration></seekStaticTarget></goalSequence></agentRegion>
  <agent><initialConditions><position><x>10</x><y>0</y><z>1</z></position><direction><x>-1</x><y>0</y><z>0</z></direction>
    <radius>0.3</radius><speed>0</speed></initialConditions>
    <goalSequence><seekAxisAlignedBoxRegion><goalRegionBounds><xmin>-12</xmin><xmax>-11</xmax><ymin>0</ymin><ymax>0</ymax><zmin>0</zmin><zmax>1</zmax></goalRegionBounds></seekAxisAlignedBoxRegion></goalSequence></agent>
</SteerBenchTestCase>
`;

/** A property over broken inputs, and the sound one first. */
function fuzz<T>(inputs: fc.Arbitrary<T>, sound: T, runs: number, check: (input: T) => void): void {
  check(sound);
  fc.assert(fc.property(inputs, check), budget(runs));
}

describe("broken files", () => {
  it(
    "BVH (seed 7)",
    () => {
      fuzz(fc.oneof(brokenText(BVH), fc.string({ unit: "binary" })), BVH, 250, (text) => {
        const result = survives(() => importBvh(text, "a.bvh"), "a.bvh");
        if (result) expectFinite({ clip: result.clip, report: result.report });
      });
    },
    limit(20_000),
  );

  it(
    "contact CSV (seed 7)",
    () => {
      fuzz(fc.oneof(brokenText(CSV), fc.string({ unit: "binary" })), CSV, 500, (text) => {
        survives(() => parseContactsCsv(text, "a.csv"), "a.csv");
      });
    },
    limit(5_000),
  );

  it(
    "scene documents (seed 7)",
    () => {
      fuzz(
        fc.oneof(brokenText(SCENE), brokenJson(SCENE), fc.string({ unit: "binary" })),
        SCENE,
        500,
        (text) => {
          const scene = survives(() => readScene(text, "a.json"), "a.json");
          if (scene) expectFinite(scene);
        },
      );
    },
    limit(5_000),
  );

  it(
    "result documents (seed 7)",
    () => {
      fuzz(
        fc.oneof(brokenText(RESULT), brokenJson(RESULT), brokenJson(HEAD), fc.string({ unit: "binary" })),
        RESULT,
        400,
        (text) => {
          const result = survives(() => readResult(text, "a.json"), "a.json");
          if (result) {
            expectFinite(result);
            // What is taken once is taken again, and stays as it is.
            expect(readResult(JSON.stringify(result), "a.json")).toEqual(result);
          }
        },
      );
    },
    limit(20_000),
  );

  it(
    "sidecars (seed 7)",
    () => {
      fuzz(
        fc.oneof(brokenText(SIDECAR), brokenJson(SIDECAR), fc.string({ unit: "binary" })),
        SIDECAR,
        500,
        (text) => {
          const sidecar = survives(() => parseSidecar(text, "a.json"), "a.json");
          if (sidecar) expectFinite(sidecar.tasks);
        },
      );
    },
    limit(5_000),
  );

  it(
    "SteerSuite cases (seed 7)",
    () => {
      fuzz(fc.oneof(brokenText(CASE), fc.string({ unit: "binary" })), CASE, 400, (text) => {
        const world = survives(() => readSteerCase(text, "a.xml"), "a.xml");
        if (world) expectFinite(world);
      });
    },
    limit(10_000),
  );

  it(
    "libraries (seed 7)",
    () => {
      fuzz(
        fc.oneof(
          brokenBytes(LIBRARY),
          brokenJson(headOf(LIBRARY)).map((h) => repacked(LIBRARY, h)),
          fc.uint8Array(),
        ),
        LIBRARY,
        60,
        (bytes) => {
          const made = survives(() => decodeLibrary(bytes), "library");
          if (made)
            expectFinite(
              made.clips.map((c) => [c.clip.skeleton.offsets, c.clip.root, c.clip.rotations, c.steps]),
            );
        },
      );
    },
    limit(30_000),
  );

  it(
    "contact models (seed 7)",
    () => {
      fuzz(
        fc.oneof(
          brokenBytes(MODEL),
          brokenJson(headOf(MODEL)).map((h) => repacked(MODEL, h)),
          fc.uint8Array(),
        ),
        MODEL,
        150,
        (bytes) => {
          const oracle = survives(() => decodeOracle(bytes, "a.model"), "a.model");
          if (oracle) expectFinite(oracle.sources);
        },
      );
    },
    limit(20_000),
  );
});
