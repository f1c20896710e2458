/** Builds the character's mesh off the page's thread. */
import { createSkeleton, type Proportions } from "../core/skeleton/skeleton.ts";
import { buildCharacterMesh, type CharacterMesh } from "../view/character/build-mesh.ts";

export interface MeshRequest {
  id: number;
  height: number;
  proportions: Proportions;
}
export interface MeshResponse {
  id: number;
  mesh: CharacterMesh;
}

self.onmessage = (event: MessageEvent<MeshRequest>) => {
  const { id, height, proportions } = event.data;
  const mesh = buildCharacterMesh(createSkeleton(height, proportions));
  const answer: MeshResponse = { id, mesh };
  (self as unknown as { postMessage(m: unknown, t: Transferable[]): void }).postMessage(answer, [
    mesh.positions.buffer,
    mesh.normals.buffer,
    mesh.indices.buffer,
    mesh.skinIndices.buffer,
    mesh.skinWeights.buffer,
  ] as Transferable[]);
};
