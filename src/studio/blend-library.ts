/** The cyclic clips that ship, baked for a character [Barycentric §6]. */
import { type BlendLibrary, bakeLibrary } from "../core/blending/library.ts";
import type { CyclicSource } from "../core/blending/types.ts";
import type { Skeleton } from "../core/skeleton/skeleton.ts";
import { prepareClip } from "../core/templates/build-library.ts";
import { cyclicScores } from "./cycles.ts";
import { renderScore } from "./render.ts";

/** The studio's cyclic clips, their steps found as in any capture. About a second of work. */
export function cyclicSources(): CyclicSource[] {
  return cyclicScores().map((score) => {
    const { clip } = renderScore(score);
    return { name: score.name, clip, steps: prepareClip({ name: score.name, clip, tasks: [] }).steps };
  });
}

/** The library of the clips that ship. */
export function studioBlendLibrary(skeleton: Skeleton): BlendLibrary {
  return bakeLibrary(cyclicSources(), skeleton);
}
