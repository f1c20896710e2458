/** The whole set that ships, rendered twice: every file the same to the byte. */
import { createHash } from "node:crypto";
import { expect, it } from "vitest";
import { writeBvh } from "../../src/core/capture/bvh-write.ts";
import { renderScore } from "../../src/studio/render.ts";
import { everyScore } from "../../src/studio/set.ts";

const hashes = (): Map<string, string> =>
  new Map(
    everyScore().map(({ name, score }) => {
      const { clip, sidecar } = renderScore(score);
      return [
        name,
        createHash("sha256").update(writeBvh(clip)).update(JSON.stringify(sidecar)).digest("hex"),
      ];
    }),
  );

it("the whole set is the same twice, to the byte", () => {
  const first = hashes();
  expect(first.size).toBeGreaterThan(60);
  expect(hashes()).toEqual(first);
});
