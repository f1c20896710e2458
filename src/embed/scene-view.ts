/** What player and markers ask of whatever draws the scene: the stage in three dimensions, or the plan seen from above. */
import type { BoxTrack, InkStroke } from "../core/motion/types.ts";
import type { Scene } from "../core/scene/types.ts";
import type { Skeleton } from "../core/skeleton/skeleton.ts";
import type { CharacterMesh } from "../view/character/build-mesh.ts";
import type { Footprint, FootprintMode } from "../view/footprints.ts";

export interface SceneView {
  setScene(scene: Scene, selected: readonly string[]): void;
  /** A frame of the motion: the hips' place at `r`, local rotations from `o`. */
  setPose(root: ArrayLike<number>, r: number, rotations: ArrayLike<number>, o: number): void;
  setFootprints(prints: Footprint[], mode: FootprintMode): void;
  setBoxes(tracks: readonly BoxTrack[], frame: number): void;
  setInk(strokes: readonly InkStroke[], time: number): void;
  /** The character's skin; left out where none is worn. */
  setCharacter?(skeleton: Skeleton, mesh: CharacterMesh): void;
  /** Fits places into the picture. */
  frame(points: readonly (readonly [number, number, number])[]): void;
  setOrbit(enabled: boolean): void;
  /** A place in the picture's pixels. */
  project(x: number, y: number, z: number): { x: number; y: number; visible: boolean };
  /** The place [x, z] at a height under a pixel; null where there is none. */
  levelPoint(x: number, y: number, height: number): [number, number] | null;
  /** The picture as the address of a PNG, for paper; left out where what is drawn prints as it is. */
  still?(): string;
}
