// @vitest-environment happy-dom
/** Characters from files: bones found, and our motion on them with the feet where they were planned. */

import { type VRM, VRMLoaderPlugin } from "@pixiv/three-vrm";
import {
  Bone,
  BoxGeometry,
  Float32BufferAttribute,
  Group,
  MeshBasicMaterial,
  MeshStandardMaterial,
  type Object3D,
  SkinnedMesh,
  Skeleton as ThreeSkeleton,
  Uint16BufferAttribute,
  Vector3,
} from "three";
import { GLTFExporter } from "three/addons/exporters/GLTFExporter.js";
import { type GLTF, GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import { describe, expect, it } from "vitest";
import type { Clip } from "../../src/core/capture/clip.ts";
import { createRandom } from "../../src/core/math/random.ts";
import { forwardKinematics } from "../../src/core/skeleton/forward-kinematics.ts";
import { J, JOINT_COUNT, JOINT_NAMES, type JointName, PARENTS } from "../../src/core/skeleton/joints.ts";
import { createSkeleton } from "../../src/core/skeleton/skeleton.ts";
import { mapBones, missingJoints } from "../../src/view/character/bone-map.ts";
import { buildCharacterMesh } from "../../src/view/character/build-mesh.ts";
import { Guest } from "../../src/view/character/guest.ts";
import { exportGlb, exportVrma } from "../../src/view/export-gltf.ts";

const skeleton = createSkeleton(1.75);

/** A pose that bends everything a little, with the legs well short of straight. */
function pose(seed: number): { root: Float64Array; rotations: Float64Array } {
  const r = createRandom(seed);
  const rotations = new Float64Array(4 * JOINT_COUNT);
  for (let j = 0; j < JOINT_COUNT; j++) {
    const name = JOINT_NAMES[j];
    const bend = /LowerLeg/.test(name) ? 0.8 : /UpperLeg/.test(name) ? -0.45 : r.between(-0.25, 0.25);
    rotations.set([Math.sin(bend / 2), 0, 0, Math.cos(bend / 2)], 4 * j);
  }
  return { root: Float64Array.of(0.7, 0.86, -1.1), rotations };
}

function joints(p: ReturnType<typeof pose>): Float64Array {
  const positions = new Float64Array(3 * JOINT_COUNT);
  forwardKinematics(positions, new Float64Array(4 * JOINT_COUNT), skeleton, p.root, 0, p.rotations, 0);
  return positions;
}

const place = (o: Object3D): Vector3 => o.getWorldPosition(new Vector3());

const MIXAMO: Partial<Record<JointName, string>> = {
  hips: "Hips",
  spine: "Spine",
  chest: "Spine1",
  upperChest: "Spine2",
  neck: "Neck",
  head: "Head",
};
for (const [side, word] of [
  ["left", "Left"],
  ["right", "Right"],
] as const)
  for (const [part, name] of [
    ["Shoulder", "Shoulder"],
    ["UpperArm", "Arm"],
    ["LowerArm", "ForeArm"],
    ["Hand", "Hand"],
    ["UpperLeg", "UpLeg"],
    ["LowerLeg", "Leg"],
    ["Foot", "Foot"],
    ["Toes", "ToeBase"],
  ] as const)
    MIXAMO[`${side}${part}`] = word + name;

/** A rig as Mixamo's: other names, centimetres under a scaled node, turned about, arms hanging at 45 degrees. */
function mixamoRig(): GLTF {
  const bones = JOINT_NAMES.map((name, j) => {
    const b = new Bone();
    b.name = `mixamorig:${MIXAMO[name]}`;
    b.position
      .set(skeleton.offsets[3 * j], skeleton.offsets[3 * j + 1], skeleton.offsets[3 * j + 2])
      .multiplyScalar(100);
    return b;
  });
  for (let j = 1; j < JOINT_COUNT; j++) bones[PARENTS[j]].add(bones[j]);
  bones[J.leftUpperArm].rotation.z = -Math.PI / 4;
  bones[J.rightUpperArm].rotation.z = Math.PI / 4;
  const scene = new Group();
  const armature = new Group();
  armature.scale.setScalar(0.01);
  armature.rotation.y = Math.PI;
  const geometry = new BoxGeometry(40, 175, 20).translate(0, 87.5, 0);
  const n = geometry.getAttribute("position").count;
  geometry.setAttribute("skinIndex", new Uint16BufferAttribute(new Uint16Array(4 * n), 4));
  geometry.setAttribute(
    "skinWeight",
    new Float32BufferAttribute(
      Float32Array.from({ length: 4 * n }, (_, i) => (i % 4 === 0 ? 1 : 0)),
      4,
    ),
  );
  const mesh = new SkinnedMesh(geometry, new MeshBasicMaterial());
  armature.add(bones[0], mesh);
  scene.add(armature);
  scene.updateMatrixWorld(true);
  mesh.bind(new ThreeSkeleton(bones));
  return { scene, parser: { json: {} } } as unknown as GLTF;
}

interface GltfJson {
  nodes?: { name?: string }[];
  extensions?: Record<string, unknown>;
  extensionsUsed?: string[];
}

/** Names that say nothing, as in files where only the extension tells which bone is which. */
const dumb = (joint: number): string => `node_${(joint * 7) % JOINT_COUNT}`;

/**
 * A character as a VRM file of either version, written by three's exporter: feet, knees and hands at places of their own, the arms a
 * little down, and facing -Z in version 0.x, as its specification wants.
 */
async function vrmFile(version: "0.x" | "1.0"): Promise<ArrayBuffer> {
  const bones = JOINT_NAMES.map((_, j) => {
    const b = new Bone();
    b.name = dumb(j);
    const [x, y, z] = skeleton.offsets.subarray(3 * j, 3 * j + 3);
    // Shorter shins, longer thighs: another person's legs.
    const stretch = /LowerLeg/.test(JOINT_NAMES[j]) ? 1.06 : /Foot/.test(JOINT_NAMES[j]) ? 0.94 : 1;
    b.position.set(x, y * stretch, z);
    return b;
  });
  for (let j = 1; j < JOINT_COUNT; j++) bones[PARENTS[j]].add(bones[j]);
  bones[J.leftUpperArm].rotation.z = -0.2;
  bones[J.rightUpperArm].rotation.z = 0.2;
  const scene = new Group();
  if (version === "0.x") scene.rotation.y = Math.PI;
  const geometry = new BoxGeometry(0.4, 1.75, 0.2).translate(0, 0.875, 0);
  const n = geometry.getAttribute("position").count;
  geometry.setAttribute("skinIndex", new Uint16BufferAttribute(new Uint16Array(4 * n), 4));
  const first = Float32Array.from({ length: 4 * n }, (_, i) => (i % 4 === 0 ? 1 : 0));
  geometry.setAttribute("skinWeight", new Float32BufferAttribute(first, 4));
  const mesh = new SkinnedMesh(geometry, new MeshStandardMaterial());
  scene.add(bones[0], mesh);
  scene.updateMatrixWorld(true);
  mesh.bind(new ThreeSkeleton(bones));
  const exporter = new GLTFExporter().register((writer) => ({
    afterParse() {
      const { json } = writer as unknown as { json: GltfJson };
      const nodes = json.nodes ?? [];
      const node = (joint: JointName): number => nodes.findIndex((x) => x.name === dumb(J[joint]));
      const extension =
        version === "1.0"
          ? {
              VRMC_vrm: {
                specVersion: "1.0",
                meta: { name: "Somebody", authors: ["Nobody"], licenseUrl: "https://vrm.dev/licenses/1.0/" },
                humanoid: { humanBones: Object.fromEntries(JOINT_NAMES.map((j) => [j, { node: node(j) }])) },
              },
            }
          : {
              VRM: {
                specVersion: "0.0",
                meta: { title: "Somebody", author: "Nobody" },
                humanoid: {
                  humanBones: JOINT_NAMES.map((j) => ({ bone: j, node: node(j), useDefaultValues: true })),
                },
                blendShapeMaster: { blendShapeGroups: [] },
                secondaryAnimation: { boneGroups: [], colliderGroups: [] },
                materialProperties: [],
              },
            };
      json.extensions = { ...json.extensions, ...extension };
      json.extensionsUsed = [...(json.extensionsUsed ?? []), ...Object.keys(extension)];
    },
  }));
  return (await exporter.parseAsync(scene, { binary: true })) as ArrayBuffer;
}

describe("characters from files", () => {
  for (const version of ["0.x", "1.0"] as const)
    it(`VRM ${version}: every bone as three-vrm finds it, feet where they were planned`, async () => {
      const bytes = await vrmFile(version);
      const judge = new GLTFLoader().register((parser) => new VRMLoaderPlugin(parser));
      const vrm = (await judge.parseAsync(bytes.slice(0), "")).userData.vrm as VRM;
      expect(vrm.meta.metaVersion).toBe(version === "1.0" ? "1" : "0");
      const gltf = await new GLTFLoader().parseAsync(bytes.slice(0), "");
      const { map, sure } = await mapBones(gltf);
      expect(sure).toBe(true);
      expect(missingJoints(map)).toEqual([]);
      for (const joint of JOINT_NAMES)
        expect(map.get(joint)?.name, joint).toBe(vrm.humanoid.getRawBoneNode(joint)?.name);
      const guest = new Guest(gltf.scene, map, skeleton);
      for (let seed = 1; seed < 6; seed++) {
        const p = pose(seed);
        guest.setPose(p.root, 0, p.rotations, 0);
        const wanted = joints(p);
        for (const side of ["left", "right"] as const) {
          const at = place(map.get(`${side}Foot`)!);
          const j = J[`${side}Foot`];
          expect(Math.hypot(at.x - wanted[3 * j], at.z - wanted[3 * j + 2])).toBeLessThan(0.001);
          // Left is left, whatever way the file faces.
          const knee = place(map.get(`${side}LowerLeg`)!);
          const k = J[`${side}LowerLeg`];
          expect(Math.hypot(knee.x - wanted[3 * k], knee.z - wanted[3 * k + 2])).toBeLessThan(0.06);
        }
      }
    });

  it("our own GLB comes back: every bone by name, feet within 1 mm and the rest within 2 cm in any pose", async () => {
    const clip: Clip = {
      name: "x",
      skeleton,
      rate: 60,
      frames: 1,
      root: pose(1).root,
      rotations: pose(1).rotations,
    };
    const gltf = await new GLTFLoader().parseAsync(
      await exportGlb(skeleton, buildCharacterMesh(skeleton), clip),
      "",
    );
    const { map, sure } = await mapBones(gltf);
    expect(sure).toBe(false);
    expect([...map.keys()].sort()).toEqual([...JOINT_NAMES].sort());
    const guest = new Guest(gltf.scene, map, skeleton);
    expect(guest.measure.hips).toBeCloseTo(skeleton.offsets[1], 1);
    for (let seed = 1; seed < 6; seed++) {
      const p = pose(seed);
      guest.setPose(p.root, 0, p.rotations, 0);
      const wanted = joints(p);
      for (const name of ["hips", "leftLowerLeg", "leftFoot", "rightFoot", "head", "rightHand"] as const) {
        const j = J[name];
        const at = place(map.get(name)!);
        // The sole's thickness is the file's own: heights may differ by it.
        expect(Math.hypot(at.x - wanted[3 * j], at.z - wanted[3 * j + 2])).toBeLessThan(
          name.includes("Foot") ? 0.001 : 0.02,
        );
        expect(Math.abs(at.y - wanted[3 * j + 1])).toBeLessThan(0.02);
      }
    }
  });

  it("a Mixamo rig in centimetres, turned about, in A-pose: feet as planned, arms as ours", async () => {
    const gltf = mixamoRig();
    const { map } = await mapBones(gltf);
    expect(missingJoints(map)).toEqual([]);
    const guest = new Guest(gltf.scene, map, skeleton);
    expect(guest.measure.height).toBeCloseTo(1.75, 2);
    for (let seed = 1; seed < 6; seed++) {
      const p = pose(seed);
      guest.setPose(p.root, 0, p.rotations, 0);
      const wanted = joints(p);
      for (const name of ["leftFoot", "rightFoot"] as const) {
        const at = place(map.get(name)!);
        const j = J[name];
        expect(at.distanceTo(new Vector3(wanted[3 * j], wanted[3 * j + 1], wanted[3 * j + 2]))).toBeLessThan(
          0.001,
        );
      }
      for (const side of ["left", "right"] as const) {
        const arm = place(map.get(`${side}LowerArm`)!)
          .sub(place(map.get(`${side}UpperArm`)!))
          .normalize();
        const [a, b] = [J[`${side}UpperArm`], J[`${side}LowerArm`]];
        const ours = new Vector3(
          wanted[3 * b] - wanted[3 * a],
          wanted[3 * b + 1] - wanted[3 * a + 1],
          wanted[3 * b + 2] - wanted[3 * a + 2],
        ).normalize();
        expect(arm.dot(ours)).toBeGreaterThan(0.9999);
      }
    }
  });

  it("files without legs say which bones are missing", async () => {
    const gltf = mixamoRig();
    gltf.scene.traverse((o) => {
      if (o.name.endsWith("Leg")) o.name = "stick";
    });
    expect(missingJoints((await mapBones(gltf)).map).length).toBeGreaterThan(0);
    const clip: Clip = {
      name: "x",
      skeleton,
      rate: 60,
      frames: 1,
      root: pose(1).root,
      rotations: pose(1).rotations,
    };
    const bare = await new GLTFLoader().parseAsync(await exportVrma(skeleton, clip), "");
    expect((await mapBones(bare)).map.size).toBeLessThan(2);
  });
});
