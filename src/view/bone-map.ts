/** Which bone of a character is which of our joints. */
import type { Bone, Object3D } from "three";
import { mapJoints } from "../core/capture/names.ts";
import { JOINT_NAMES, type JointName } from "../core/skeleton/joints.ts";

/** Names of bones, by joint. Joints left out are guessed from common naming habits. */
export type BoneMap = Partial<Record<JointName, string>>;

/** Joints that a character cannot do without. */
const NEEDED: readonly JointName[] = [
  "hips",
  "leftUpperLeg",
  "leftLowerLeg",
  "leftFoot",
  "rightUpperLeg",
  "rightLowerLeg",
  "rightFoot",
];

/**
 * The bones of our joints under `root`.
 *
 * @param names bones that the guess would miss.
 * @throws Error naming the bone that is not there, or the joint that none was found for.
 */
export function mapBones(root: Object3D, names: BoneMap = {}): Map<JointName, Bone> {
  const bones: Bone[] = [];
  root.traverse((o) => {
    if ((o as Bone).isBone) bones.push(o as Bone);
  });
  const parents = bones.map((b) => bones.indexOf(b.parent as Bone));
  const guessed = mapJoints(
    bones.map((b) => b.name),
    parents,
  );
  const out = new Map<JointName, Bone>();
  for (const joint of JOINT_NAMES) {
    const name = names[joint];
    if (name !== undefined) {
      const bone = bones.find((b) => b.name === name);
      if (!bone) throw new Error(`bones.${joint}: no bone is called ${JSON.stringify(name)}.`);
      out.set(joint, bone);
    } else {
      const i = guessed.get(joint) ?? -1;
      if (bones[i]) out.set(joint, bones[i]);
    }
  }
  for (const joint of NEEDED)
    if (!out.has(joint))
      throw new Error(`bones.${joint}: a bone is needed, and none was recognised by its name.`);
  return out;
}
