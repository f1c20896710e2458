/** A character from a glTF, GLB or VRM file: its scene, bones and which joint each is. */
import { type Bone, Box3 } from "three";
import { type GLTF, GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import { type BoneMap, bonesIn, mapBones } from "./bone-map.ts";
import { checkGltf } from "./gltf-check.ts";

export interface CharacterFile {
  scene: GLTF["scene"];
  bones: Bone[];
  map: BoneMap;
  /** Whether the file itself says which bone is which. */
  sure: boolean;
  /** Metres, or whatever the file's unit is. */
  height: number;
}

/**
 * Reads a character.
 *
 * @throws Error "NAME: ..." for what is no glTF, is damaged, or holds nothing that is skinned to bones.
 */
export async function readCharacter(bytes: ArrayBuffer, name: string): Promise<CharacterFile> {
  checkGltf(bytes, name);
  const { gltf, bones, map, sure } = await load(bytes, name);
  if (bones.length === 0) throw new Error(`${name}: nothing in it is skinned to bones.`);
  const box = new Box3().setFromObject(gltf.scene, true);
  const height = box.max.y - box.min.y;
  if (
    !(height > 0 && Number.isFinite(height) && Number.isFinite(box.max.x - box.min.x + box.max.z - box.min.z))
  )
    throw new Error(`${name}: its places are no finite numbers, or it has no height.`);
  return { scene: gltf.scene, bones, map, sure, height };
}

async function load(
  bytes: ArrayBuffer,
  name: string,
): Promise<{ gltf: GLTF; bones: Bone[]; map: BoneMap; sure: boolean }> {
  try {
    // The loader keeps what it is given.
    const gltf = await new GLTFLoader().parseAsync(bytes.slice(0), "");
    return { gltf, bones: bonesIn(gltf.scene), ...(await mapBones(gltf)) };
  } catch (error) {
    const [why] = (error instanceof Error ? error.message : String(error)).split(/[\r\n]/);
    throw new Error(`${name}: no glTF character can be read. (${why.slice(0, 200)})`);
  }
}
