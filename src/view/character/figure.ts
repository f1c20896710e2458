/** The character in the scene: the mesh skinned to the skeleton's joints, posed from flat arrays. */
import { Bone, Group, MeshPhysicalMaterial, SkinnedMesh, Skeleton as ThreeSkeleton } from "three";
import { JOINT_COUNT, JOINT_NAMES, PARENTS } from "../../core/skeleton/joints.ts";
import type { Skeleton } from "../../core/skeleton/skeleton.ts";
import { blob, disposeProp } from "../props.ts";
import { ROOMS, SHOES, type Theme } from "../tokens.ts";
import { PARTS } from "./body-shape.ts";
import type { CharacterMesh } from "./build-mesh.ts";
import { characterGeometry } from "./geometry.ts";

export class Figure {
  readonly group = new Group();
  private readonly bones: Bone[];
  private readonly materials: MeshPhysicalMaterial[];
  private readonly mesh: SkinnedMesh;
  private readonly blobs = [blob(0.3, 0.48, 0.5), blob(0.3, 0.48, 0.5), blob(0.85, 0.85, 0.2)];

  constructor(skeleton: Skeleton, data: CharacterMesh) {
    const geometry = characterGeometry(data);
    this.materials = PARTS.map(
      (part) =>
        new MeshPhysicalMaterial({
          roughness: part === "body" ? 0.62 : 0.55,
          sheen: part === "body" ? 0.5 : 0,
          sheenRoughness: 0.6,
        }),
    );
    this.mesh = new SkinnedMesh(geometry, this.materials);
    this.mesh.castShadow = true;
    this.mesh.receiveShadow = true;
    this.mesh.frustumCulled = false;
    this.bones = JOINT_NAMES.map((name) => {
      const b = new Bone();
      b.name = name;
      return b;
    });
    for (let j = 0; j < JOINT_COUNT; j++) {
      this.bones[j].position.set(
        skeleton.offsets[3 * j],
        skeleton.offsets[3 * j + 1],
        skeleton.offsets[3 * j + 2],
      );
      if (PARENTS[j] >= 0) this.bones[PARENTS[j]].add(this.bones[j]);
    }
    this.mesh.add(this.bones[0]);
    this.mesh.updateMatrixWorld(true);
    this.mesh.bind(new ThreeSkeleton(this.bones));
    this.group.add(this.mesh, ...this.blobs);
  }

  setTheme(theme: Theme): void {
    const colours = { body: ROOMS[theme].body, ivory: ROOMS[theme].ivory, ...SHOES };
    PARTS.forEach((part, i) => {
      this.materials[i].color.set(colours[part]);
      this.materials[i].sheenColor.set(ROOMS[theme].ivory);
    });
  }

  /** Seen through and in one colour: a second figure beside the scene's own. */
  makeGhost(colour: string, opacity: number): void {
    this.mesh.castShadow = false;
    for (const b of this.blobs) b.visible = false;
    for (const m of this.materials) {
      m.color.set(colour);
      m.transparent = true;
      m.opacity = opacity;
    }
  }

  /** Poses from a row of root (3) and rotations (JOINT_COUNT x 4). */
  setPose(root: ArrayLike<number>, r: number, rotations: ArrayLike<number>, o: number): void {
    this.bones[0].position.set(root[r], root[r + 1], root[r + 2]);
    for (let j = 0; j < JOINT_COUNT; j++) {
      const k = o + 4 * j;
      this.bones[j].quaternion.set(rotations[k], rotations[k + 1], rotations[k + 2], rotations[k + 3]);
    }
    this.mesh.updateMatrixWorld(true);
    [16, 20].forEach((foot, i) => {
      const e = this.bones[foot].matrixWorld.elements;
      this.blobs[i].position.set(e[12] + 0.06 * e[8], 0.002, e[14] + 0.06 * e[10]);
      this.blobs[i].rotation.y = Math.atan2(e[8], e[10]);
      (this.blobs[i].material as { opacity?: number }).opacity =
        0.5 * Math.max(0, 1 - Math.max(0, e[13] - 0.1) / 0.14);
    });
    this.blobs[2].position.set(root[r], 0.0015, root[r + 2]);
  }

  /** World place of a joint as it is posed. */
  joint(j: number): [number, number, number] {
    const e = this.bones[j].matrixWorld.elements;
    return [e[12], e[13], e[14]];
  }

  dispose(): void {
    this.mesh.geometry.dispose();
    this.mesh.skeleton.dispose();
    for (const b of this.blobs) disposeProp(b);
    for (const m of this.materials) m.dispose();
  }
}
