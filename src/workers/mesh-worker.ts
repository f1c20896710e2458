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

/** Cells of the skin that is sent first, in those of the last one: an eighth of the work. */
const FIRST = 2.2;

self.onmessage = (event: MessageEvent<MeshRequest>) => {
  const { id, height, proportions } = event.data;
  const skeleton = createSkeleton(height, proportions);
  // A coarse skin at once, so that the character stands there; then the one that is looked at.
  for (const fineness of [FIRST, 1]) {
    const mesh = buildCharacterMesh(skeleton, fineness);
    const answer: MeshResponse = { id, mesh };
    (self as unknown as { postMessage(m: unknown, t: Transferable[]): void }).postMessage(answer, [
      mesh.positions.buffer,
      mesh.normals.buffer,
      mesh.indices.buffer,
      mesh.skinIndices.buffer,
      mesh.skinWeights.buffer,
    ] as Transferable[]);
  }
};
