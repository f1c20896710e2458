/** Builds the character's mesh off the page's thread. */
import { createSkeleton, type Proportions } from "../core/skeleton/skeleton.ts";
import { buildCharacterMesh, type CharacterMesh } from "../view/character/build-mesh.ts";

export interface MeshRequest {
  id: number;
  height: number;
  proportions: Proportions;
  /** Size of the cells: 1 for one character near by, more for less work. */
  fineness: number;
}
export interface MeshResponse {
  id: number;
  fineness: number;
  mesh: CharacterMesh;
}

self.onmessage = (event: MessageEvent<MeshRequest>) => {
  const { id, height, proportions, fineness } = event.data;
  const mesh = buildCharacterMesh(createSkeleton(height, proportions), fineness);
  const answer: MeshResponse = { id, fineness, mesh };
  (self as unknown as { postMessage(m: unknown, t: Transferable[]): void }).postMessage(answer, [
    mesh.positions.buffer,
    mesh.normals.buffer,
    mesh.indices.buffer,
    mesh.skinIndices.buffer,
    mesh.skinWeights.buffer,
  ] as Transferable[]);
};
