/** Characters and motions as binary glTF: with the skinned body, or the bones alone as a VRM animation. Loaded when used. */
import {
  Bone,
  Group,
  MeshStandardMaterial,
  type Object3D,
  SkinnedMesh,
  Skeleton as ThreeSkeleton,
} from "three";
import { GLTFExporter } from "three/addons/exporters/GLTFExporter.js";
import type { Clip } from "../core/capture/clip.ts";
import { JOINT_NAMES, PARENTS } from "../core/skeleton/joints.ts";
import type { Skeleton } from "../core/skeleton/skeleton.ts";
import { animationOf } from "./animation.ts";
import { PARTS } from "./character/body-shape.ts";
import type { CharacterMesh } from "./character/build-mesh.ts";
import { characterGeometry } from "./character/geometry.ts";
import { ROOMS, SHOES } from "./tokens.ts";

/** What a plugin needs of the exporter's writer; its own types leave these out. */
interface Writer {
  nodeMap: Map<Object3D, number>;
  json: { extensions?: Record<string, unknown> };
  extensionsUsed: Record<string, boolean>;
}

/** Bones in the rest pose, hips first. */
function bonesOf(skeleton: Skeleton): Bone[] {
  const bones = JOINT_NAMES.map((name) => {
    const b = new Bone();
    b.name = name;
    return b;
  });
  bones.forEach((b, j) => {
    b.position.set(skeleton.offsets[3 * j], skeleton.offsets[3 * j + 1], skeleton.offsets[3 * j + 2]);
    if (PARENTS[j] >= 0) bones[PARENTS[j]].add(b);
  });
  return bones;
}

async function write(
  input: Object3D,
  clip: Clip,
  plugin?: (writer: Writer) => { afterParse(): void },
): Promise<ArrayBuffer> {
  const exporter = new GLTFExporter();
  if (plugin) exporter.register((writer) => plugin(writer as unknown as Writer));
  const data = await exporter.parseAsync(input, { binary: true, animations: [animationOf(clip)] });
  if (!(data instanceof ArrayBuffer)) throw new Error("the exporter gave no binary file.");
  return data;
}

/** The character skinned and animated. @param mesh as the stage draws it. */
export function exportGlb(skeleton: Skeleton, mesh: CharacterMesh, clip: Clip): Promise<ArrayBuffer> {
  const colours = { body: ROOMS.light.body, ivory: ROOMS.light.ivory, ...SHOES };
  const materials = PARTS.map((part) => {
    const m = new MeshStandardMaterial({ color: colours[part], roughness: part === "body" ? 0.62 : 0.55 });
    m.name = part;
    return m;
  });
  const bones = bonesOf(skeleton);
  const body = new SkinnedMesh(characterGeometry(mesh), materials);
  body.name = "body";
  // The bones stand beside the mesh, not under it: a skinned mesh's own place counts for nothing in glTF.
  const character = new Group();
  character.name = "character";
  character.add(bones[0], body);
  character.updateMatrixWorld(true);
  body.bind(new ThreeSkeleton(bones));
  return write(character, clip);
}

/** The motion alone as a VRM animation (VRMC_vrm_animation 1.0): any VRM 1.0 character plays it. */
export function exportVrma(skeleton: Skeleton, clip: Clip): Promise<ArrayBuffer> {
  const bones = bonesOf(skeleton);
  const root = new Group();
  root.name = "humanoid";
  root.add(bones[0]);
  return write(root, clip, (writer) => ({
    afterParse() {
      const humanBones: Record<string, { node: number }> = {};
      for (const b of bones) {
        const node = writer.nodeMap.get(b);
        if (node !== undefined) humanBones[b.name] = { node };
      }
      writer.extensionsUsed.VRMC_vrm_animation = true;
      writer.json.extensions = {
        ...writer.json.extensions,
        VRMC_vrm_animation: { specVersion: "1.0", humanoid: { humanBones } },
      };
    },
  }));
}
