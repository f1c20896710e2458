// @vitest-environment happy-dom
/** Every file that the editor writes of a motion, read back by somebody else's reader. */
import { type VRMAnimation, VRMAnimationLoaderPlugin } from "@pixiv/three-vrm-animation";
import validator from "gltf-validator";
import { AnimationMixer, Quaternion, SkinnedMesh, Vector3 } from "three";
import { BVHLoader } from "three/addons/loaders/BVHLoader.js";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import { describe, expect, it } from "vitest";
import { writeBvh } from "../../src/core/capture/bvh-write.ts";
import { contactsCsv, parseContactsCsv } from "../../src/core/contacts/csv.ts";
import { EXPORT_RATES, exportClip, footstepsCsv } from "../../src/core/motion/export-clip.ts";
import { beginSynthesis, synthesiseClip } from "../../src/core/motion/synthesise.ts";
import { parseScene } from "../../src/core/scene/schema.ts";
import { forwardKinematics } from "../../src/core/skeleton/forward-kinematics.ts";
import { JOINT_COUNT, JOINT_NAMES } from "../../src/core/skeleton/joints.ts";
import { createSkeleton } from "../../src/core/skeleton/skeleton.ts";
import { goalsOf, planScene } from "../../src/core/tasks/plan-scene.ts";
import { retargetLibrary } from "../../src/core/templates/retarget-library.ts";
import { buildCharacterMesh } from "../../src/view/character/build-mesh.ts";
import { exportGlb, exportVrma } from "../../src/view/export-gltf.ts";
import { studio } from "../support/library.ts";

const skeleton = createSkeleton(1.75);
const scene = parseScene({
  version: 1,
  tasks: [{ id: 'turn, "here"', category: "turn", position: [0.6, 0, 1.4], yaw: 2 }],
});
const library = retargetLibrary(studio().library, skeleton);
const plan = planScene(scene, library, skeleton);
const synthesis = beginSynthesis(library, skeleton, plan, goalsOf(scene), new Map());
const clip = synthesiseClip(synthesis, "Two tables");

/** World places of all joints in a frame, metres. */
function joints(frame: number, of = clip): Float64Array {
  const positions = new Float64Array(3 * JOINT_COUNT);
  forwardKinematics(
    positions,
    new Float64Array(4 * JOINT_COUNT),
    skeleton,
    of.root,
    3 * frame,
    of.rotations,
    4 * JOINT_COUNT * frame,
  );
  return positions;
}

const parse = (data: ArrayBuffer, prepare: (l: GLTFLoader) => void = () => undefined) => {
  const loader = new GLTFLoader();
  prepare(loader);
  return loader.parseAsync(data, "");
};

describe("motion at a chosen rate", () => {
  it.each(EXPORT_RATES)("%i Hz: as long as before, on the same way", (rate) => {
    const out = exportClip(clip, { rate, inPlace: false });
    expect((out.frames - 1) / rate).toBeLessThanOrEqual((clip.frames - 1) / 60 + 1e-9);
    expect((out.frames - 1) / rate).toBeGreaterThan((clip.frames - 1) / 60 - 1 / rate);
    const f = Math.floor(out.frames / 2);
    const at = (f * 60) / rate;
    const near = joints(Math.round(at));
    const got = joints(f, out);
    for (let i = 0; i < near.length; i++) expect(Math.abs(got[i] - near[i])).toBeLessThan(0.03);
  });

  it("in place: hips over the origin at their height, joints as they were about them", () => {
    const out = exportClip(clip, { rate: 60, inPlace: true });
    const here = joints(100);
    const there = joints(100, out);
    for (let j = 0; j < JOINT_COUNT; j++) {
      expect(there[3 * j] - there[0]).toBeCloseTo(here[3 * j] - here[0], 9);
      expect(there[3 * j + 1]).toBeCloseTo(here[3 * j + 1], 9);
    }
    expect(there[0]).toBe(0);
    expect(() => exportClip(clip, { rate: 0, inPlace: false })).toThrow("rate");
  });
});

describe("files read back by others", () => {
  it("BVH: three's loader puts every joint within 0.1 mm", () => {
    const out = exportClip(clip, { rate: 30, inPlace: false });
    const { skeleton: read, clip: motion } = new BVHLoader().parse(writeBvh(out, { rootOffset: false }));
    const mixer = new AnimationMixer(read.bones[0]);
    mixer.clipAction(motion).play();
    mixer.setTime(40 / 30);
    read.bones[0].updateMatrixWorld(true);
    const wanted = joints(40, out);
    for (const bone of read.bones) {
      const j = JOINT_NAMES.indexOf(bone.name as (typeof JOINT_NAMES)[number]);
      if (j < 0) continue;
      const at = bone.getWorldPosition(new Vector3());
      expect(
        Math.hypot(at.x - wanted[3 * j], at.y - wanted[3 * j + 1], at.z - wanted[3 * j + 2]),
      ).toBeLessThan(1e-4);
    }
  });

  it("GLB: no error by the validator; the loader's skin moves as ours", async () => {
    const out = exportClip(clip, { rate: 30, inPlace: false });
    const data = await exportGlb(skeleton, buildCharacterMesh(skeleton), out);
    const report = await validator.validateBytes(new Uint8Array(data));
    expect(report.issues.messages.filter((m) => m.severity === 0)).toEqual([]);
    expect(report.issues.numErrors).toBe(0);
    const gltf = await parse(data);
    const mixer = new AnimationMixer(gltf.scene);
    mixer.clipAction(gltf.animations[0]).play();
    mixer.setTime(40 / 30);
    gltf.scene.updateMatrixWorld(true);
    const wanted = joints(40, out);
    JOINT_NAMES.forEach((name, j) => {
      const at = gltf.scene.getObjectByName(name)!.getWorldPosition(new Vector3());
      expect(
        Math.hypot(at.x - wanted[3 * j], at.y - wanted[3 * j + 1], at.z - wanted[3 * j + 2]),
      ).toBeLessThan(1e-4);
    });
    let skins = 0;
    gltf.scene.traverse((o) => {
      if (o instanceof SkinnedMesh) skins++;
    });
    expect(skins).toBeGreaterThan(0);
  });

  it("VRMA: three-vrm's loader finds every bone and the same rotations", async () => {
    const out = exportClip(clip, { rate: 30, inPlace: false });
    const data = await exportVrma(skeleton, out);
    const report = await validator.validateBytes(new Uint8Array(data));
    expect(report.issues.numErrors).toBe(0);
    const gltf = await parse(data, (l) => l.register((parser) => new VRMAnimationLoaderPlugin(parser)));
    const animations = gltf.userData.vrmAnimations as VRMAnimation[];
    expect(animations).toHaveLength(1);
    expect(animations[0].duration).toBeCloseTo((out.frames - 1) / 30, 3);
    const bones = animations[0].humanoidTracks.rotation;
    for (const name of JOINT_NAMES) expect(bones.has(name)).toBe(true);
    const track = bones.get("leftUpperLeg")!;
    const j = JOINT_NAMES.indexOf("leftUpperLeg");
    const got = new Quaternion().fromArray(track.values, 4 * 40);
    const wanted = new Quaternion().fromArray(out.rotations, 4 * (40 * JOINT_COUNT + j));
    expect(got.angleTo(wanted)).toBeLessThan(1e-3);
  });

  it("footsteps and contacts as CSV", () => {
    const rows = footstepsCsv(plan).trim().split("\n");
    expect(rows[0]).toBe("foot,x,y,z,yaw,category,phase,task,lift,land");
    expect(rows).toHaveLength(plan.steps.length + 3);
    expect(rows[3]).toContain('"turn, ""here"""');
    expect(Number(rows[3].split(",")[1])).toBeCloseTo(plan.steps[0].x, 3);
    const back = parseContactsCsv(contactsCsv(synthesis.track.contacts, 60, 60, clip.frames), "c.csv");
    expect([...back]).toEqual([...synthesis.track.contacts]);
  });
});
