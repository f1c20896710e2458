import { readFileSync } from "node:fs";
import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { parseBvh } from "../../src/core/capture/bvh-parse.ts";
import { writeBvh } from "../../src/core/capture/bvh-write.ts";
import { importBvh } from "../../src/core/capture/import.ts";
import { mirrorClip } from "../../src/core/capture/mirror.ts";
import { mapJoints } from "../../src/core/capture/names.ts";
import { wholeChunk } from "../../src/core/motion/chunk.ts";
import { motionPoints } from "../../src/core/quality/measure.ts";
import { poppingOf } from "../../src/core/quality/smoothness.ts";
import { forwardKinematics } from "../../src/core/skeleton/forward-kinematics.ts";
import { J, JOINT_COUNT } from "../../src/core/skeleton/joints.ts";
import { prepareClip } from "../../src/core/templates/build-library.ts";
import { renderScore } from "../../src/studio/render.ts";
import { studioSet } from "../../src/studio/set.ts";
import { strideSwings } from "../support/gait-real.ts";
import { captures, hasShared } from "../support/shared.ts";

const short = renderScore(studioSet().find((s) => s.name === "turn-about")!.score).clip;
const small = {
  ...short,
  frames: 40,
  root: short.root.slice(0, 120),
  rotations: short.rotations.slice(0, 160 * JOINT_COUNT),
};
const text = writeBvh(small);

/** From a joint to the next down the limb. */
const bone = (at: Float64Array, joint: number) =>
  [0, 1, 2].map((k) => at[3 * (joint + 1) + k] - at[3 * joint + k]);
const angleBetween = (u: readonly number[], v: readonly number[]) => {
  const cos = u.reduce((s, x, k) => s + x * v[k], 0) / (Math.hypot(...u) * Math.hypot(...v));
  return (Math.acos(Math.min(1, cos)) * 180) / Math.PI;
};

describe("BVH", () => {
  it("writes and reads back feet and knees within 4 mm, and the bones of the arms within half a degree", () => {
    const file = parseBvh(text, "x.bvh");
    expect(file.frames).toBe(40);
    expect(file.joints.map((j) => j.name)).toContain("leftToes");
    const back = importBvh(text, "x.bvh");
    expect(back.report.missing).toEqual([]);
    const a = new Float64Array(3 * JOINT_COUNT);
    const b = new Float64Array(3 * JOINT_COUNT);
    const w = new Float64Array(4 * JOINT_COUNT);
    for (let f = 0; f < 40; f++) {
      forwardKinematics(a, w, small.skeleton, small.root, 3 * f, small.rotations, 4 * JOINT_COUNT * f);
      forwardKinematics(
        b,
        w,
        back.clip.skeleton,
        back.clip.root,
        3 * f,
        back.clip.rotations,
        4 * JOINT_COUNT * f,
      );
      for (const j of [J.leftFoot, J.rightFoot, J.leftLowerLeg, J.rightLowerLeg])
        for (let k = 0; k < 3; k++) expect(Math.abs(a[3 * j + k] - b[3 * j + k])).toBeLessThan(0.004);
      for (const j of [J.leftUpperArm, J.leftLowerArm, J.rightUpperArm, J.rightLowerArm])
        expect(angleBetween(bone(a, j), bone(b, j)), `joint ${j}, frame ${f}`).toBeLessThan(0.5);
    }
  });

  it("a figure that faces backwards keeps its trunk upright", () => {
    const turned = (yaw: number) => {
      const rotations = new Float64Array(4 * JOINT_COUNT * 40);
      for (let i = 3; i < rotations.length; i += 4) rotations[i] = 1;
      for (let f = 0; f < 40; f++)
        rotations.set([0, Math.sin(yaw / 2), 0, Math.cos(yaw / 2)], 4 * JOINT_COUNT * f);
      const { clip } = importBvh(writeBvh({ ...small, rotations }), "x.bvh");
      return clip.rotations;
    };
    const forwards = turned(0);
    const backwards = turned(Math.PI);
    for (const joint of [J.spine, J.chest, J.upperChest, J.neck, J.head])
      for (let k = 0; k < 4; k++)
        expect(Math.abs(backwards[4 * joint + k])).toBeCloseTo(Math.abs(forwards[4 * joint + k]), 5);
  });

  it.each([
    ["", "x.bvh, line 1: HIERARCHY is expected"],
    [text.replace("Frames: 40", "Frames: 0"), "at least one frame is needed"],
    [text.replace("Frames: 40", "Frames: 41"), "the file ends after 40 of 41 frames"],
    [text.replace(/Frame Time: \S+/, "Frame Time: 0"), "a Frame Time between"],
    [text.slice(0, 900), "x.bvh, line"],
    [text.replace("leftHand", "rightHand"), 'the joint "rightHand" stands twice'],
    [text.replace(/\n(\S+) (\S+) /, "\nNaN $2 "), "x.bvh, line"],
    [text.replace("leftFoot", "thing").replace("leftUpperLeg", "other"), "no joint was found for"],
  ])("says what is wrong and where (%#)", (bad, message) => {
    expect(() => importBvh(bad, "x.bvh")).toThrow(message);
  });

  it("broken files never hang, never give NaN, and errors name the line (seed 99)", () => {
    fc.assert(
      fc.property(
        fc.integer({ min: 0, max: text.length - 1 }),
        fc.string({ maxLength: 12 }),
        fc.integer({ min: 0, max: 60 }),
        (at, put, cut) => {
          const bad = text.slice(0, at) + put + text.slice(at + cut);
          try {
            const file = parseBvh(bad, "f.bvh");
            expect(file.values.every(Number.isFinite)).toBe(true);
          } catch (error) {
            expect((error as Error).message).toMatch(/^f\.bvh, line \d+: /);
          }
        },
      ),
      { seed: 99, numRuns: 300 },
    );
  });

  it("mirroring twice gives the clip back", () => {
    const twice = mirrorClip(mirrorClip(small));
    expect([...twice.root]).toEqual([...small.root]);
    expect([...twice.rotations]).toEqual([...small.rotations]);
  });
});

describe("joint names", () => {
  const chain = (names: string[], parents: number[]) => mapJoints(names, parents);
  it.each([
    [
      "Mixamo",
      [
        "mixamorig:Hips",
        "mixamorig:LeftUpLeg",
        "mixamorig:LeftLeg",
        "mixamorig:LeftFoot",
        "mixamorig:LeftToeBase",
      ],
      [-1, 0, 1, 2, 3],
    ],
    ["LaFAN1", ["Hips", "LeftUpLeg", "LeftLeg", "LeftFoot", "LeftToe"], [-1, 0, 1, 2, 3]],
    ["Bandai-Namco", ["Hips", "UpperLeg_L", "LowerLeg_L", "Foot_L", "Toes_L"], [-1, 0, 1, 2, 3]],
    ["VRM", ["hips", "leftUpperLeg", "leftLowerLeg", "leftFoot", "leftToes"], [-1, 0, 1, 2, 3]],
    ["100STYLE", ["Hips", "LeftHip", "LeftKnee", "LeftAnkle", "LeftToe"], [-1, 0, 1, 2, 3]],
  ])("maps the legs of %s", (_, names, parents) => {
    const m = chain(names, parents);
    expect([
      m.get("hips"),
      m.get("leftUpperLeg"),
      m.get("leftLowerLeg"),
      m.get("leftFoot"),
      m.get("leftToes"),
    ]).toEqual([0, 1, 2, 3, 4]);
  });
});

describe.skipIf(!hasShared)("real captures", () => {
  it("every file imports, stands on the floor, bends its knees forward, and gives steps", () => {
    let files = 0;
    for (const path of captures()) {
      const { clip, report } = importBvh(readFileSync(path, "utf8"), path);
      files++;
      expect(report.legLength).toBeGreaterThan(0.7);
      expect(report.legLength).toBeLessThan(1.1);
      expect(clip.root.every(Number.isFinite) && clip.rotations.every(Number.isFinite), path).toBe(true);
      // A straight knee shows no plane, and a foot on its toes no heading: neither may spin the leg about.
      const popping = poppingOf(clip.rotations, clip.frames, "all")?.popping ?? 0;
      // The PFNN files end with a pose of their own; the shortest dash bends its knees backwards.
      if (!/LocomotionFlat|dash_normal/.test(path)) expect(popping, path).toBeLessThan(2);
      // A clip of two seconds or more holds a step of each foot at least.
      if (clip.frames > 120)
        expect(prepareClip({ name: "c", clip, tasks: [] }).steps.length, path).toBeGreaterThan(1);
    }
    expect(files).toBeGreaterThan(80);
  });

  it("arms swing as the file's do: whoever runs bends the elbows and swings them past the hips", () => {
    const runs = captures().filter((path) => /dataset-2_run_normal/.test(path));
    expect(runs).toHaveLength(3);
    for (const path of runs) {
      const { clip } = importBvh(readFileSync(path, "utf8"), path);
      const { joints } = motionPoints(
        clip.skeleton,
        [wholeChunk(clip, new Uint8Array(clip.frames))],
        clip.frames,
      );
      const { arm, elbow } = strideSwings(joints, clip.frames, (f) => f >= 8 && f < clip.frames - 8);
      expect(arm[1], path).toBeGreaterThan(30);
      expect(elbow[0], path).toBeGreaterThan(80);
    }
  });
});
