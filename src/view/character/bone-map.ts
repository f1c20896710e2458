/** Which bones of a loaded character are our joints: by the file's own word (VRM), else by their names. */
import { type Bone, type Object3D, SkinnedMesh } from "three";
import type { GLTF } from "three/addons/loaders/GLTFLoader.js";
import { mapJoints } from "../../core/capture/names.ts";
import { JOINT_NAMES, type JointName } from "../../core/skeleton/joints.ts";

export type BoneMap = Map<JointName, Object3D>;

/** Joints that a character cannot do without. */
export const NEEDED_JOINTS: readonly JointName[] = [
  "hips",
  "leftUpperLeg",
  "leftLowerLeg",
  "leftFoot",
  "rightUpperLeg",
  "rightLowerLeg",
  "rightFoot",
];

/** Bones of every skinned mesh, parents before children. */
export function bonesIn(root: Object3D): Bone[] {
  const used = new Set<Object3D>();
  root.traverse((o) => {
    if (o instanceof SkinnedMesh) for (const b of o.skeleton.bones) used.add(b);
  });
  const out: Bone[] = [];
  root.traverse((o) => {
    if (used.has(o)) out.push(o as Bone);
  });
  return out;
}

interface HumanBones {
  VRMC_vrm?: { humanoid?: { humanBones?: Record<string, { node: number }> } };
  VRM?: { humanoid?: { humanBones?: { bone: string; node: number }[] } };
}

/** The map that a VRM file (0.x or 1.0) carries; null for other files. */
async function vrmMap(gltf: GLTF): Promise<BoneMap | null> {
  const { VRMC_vrm, VRM } = (gltf.parser.json.extensions ?? {}) as HumanBones;
  const listed: [string, number][] = VRMC_vrm?.humanoid?.humanBones
    ? Object.entries(VRMC_vrm.humanoid.humanBones).map(([name, b]) => [name, b.node])
    : (VRM?.humanoid?.humanBones ?? []).map((b) => [b.bone, b.node]);
  if (listed.length === 0) return null;
  const map: BoneMap = new Map();
  for (const [name, node] of listed)
    if ((JOINT_NAMES as readonly string[]).includes(name))
      map.set(name as JointName, (await gltf.parser.getDependency("node", node)) as Object3D);
  return map;
}

/** Maps a loaded character's bones. @returns the map, and whether the file itself said so. */
export async function mapBones(gltf: GLTF): Promise<{ map: BoneMap; sure: boolean }> {
  const own = await vrmMap(gltf);
  if (own) return { map: own, sure: true };
  const bones = bonesIn(gltf.scene);
  const parents = bones.map((b) => bones.indexOf(b.parent as Bone));
  const found = mapJoints(
    bones.map((b) => b.name),
    parents,
  );
  const map: BoneMap = new Map();
  for (const [joint, i] of found) if (bones[i]) map.set(joint, bones[i]);
  return { map, sure: false };
}

/** Needed joints that a map leaves out. */
export function missingJoints(map: BoneMap): JointName[] {
  return NEEDED_JOINTS.filter((j) => !map.has(j));
}
