import { expect, it } from "vitest";
import { createSkeleton } from "../../src/core/skeleton/skeleton.ts";
import { buildCharacterMesh } from "../../src/view/character/build-mesh.ts";
import { COARSE } from "../../src/view/character/fineness.ts";

// Near by, shown first, and the two of crowds.
it.each([1, COARSE, 20 / 9, 40 / 9])("the skin has no hole, with cells %f times as large", (fineness) => {
  for (const height of [1.5, 1.75, 1.95]) {
    const { indices } = buildCharacterMesh(createSkeleton(height), fineness);
    const open = new Set<string>();
    for (let t = 0; t < indices.length; t += 3)
      for (let k = 0; k < 3; k++) {
        const [a, b] = [indices[t + k], indices[t + ((k + 1) % 3)]];
        const edge = a < b ? `${a} ${b}` : `${b} ${a}`;
        if (!open.delete(edge)) open.add(edge);
      }
    expect(open.size, `edges of one triangle alone at ${height} m`).toBe(0);
    // The finest takes a while: once is enough.
    if (fineness === 1) break;
  }
});
