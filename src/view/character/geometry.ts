/** A character's mesh as three.js geometry, a group a part in the order of PARTS. */
import { BufferAttribute, BufferGeometry } from "three";
import type { CharacterMesh } from "./build-mesh.ts";

export function characterGeometry(data: CharacterMesh): BufferGeometry {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(data.positions, 3));
  geometry.setAttribute("normal", new BufferAttribute(data.normals, 3));
  geometry.setAttribute("skinIndex", new BufferAttribute(data.skinIndices, 4));
  geometry.setAttribute("skinWeight", new BufferAttribute(data.skinWeights, 4));
  geometry.setIndex(new BufferAttribute(data.indices, 1));
  data.groups.forEach(([start, count], i) => {
    geometry.addGroup(start, count, i);
  });
  return geometry;
}
