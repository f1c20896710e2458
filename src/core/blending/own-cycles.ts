/** A person's own cyclic clips beside or in the place of those that ship [Barycentric §§4.1, 6]. */
import type { Clip } from "../capture/clip.ts";
import type { ContactTrack } from "../steps/types.ts";
import { prepareClip } from "../templates/build-library.ts";
import { analyseClip } from "./analyse.ts";
import type { CyclicSource } from "./types.ts";

/**
 * A capture as a clip to blend steps of.
 *
 * @param name the clip that it replaces where one is called so; else it joins.
 * @param contacts one byte a frame; left out, they are found as in any capture.
 * @throws CycleError when it has no cycle: alternating steps of both feet, six are enough.
 */
export function ownCycle(name: string, clip: Clip, contacts?: ContactTrack): CyclicSource {
  const { steps } = prepareClip({ name, clip, tasks: [], ...(contacts ? { contacts } : {}) });
  const source: CyclicSource = { name, clip, steps };
  analyseClip(source);
  return source;
}

/** Shipped clips with own ones: one of the same name replaces, in its place; the others follow. */
export function withOwnCycles(
  shipped: readonly CyclicSource[],
  own: readonly CyclicSource[],
): CyclicSource[] {
  const byName = new Map(own.map((s) => [s.name, s]));
  const names = new Set(shipped.map((s) => s.name));
  return [...shipped.map((s) => byName.get(s.name) ?? s), ...own.filter((s) => !names.has(s.name))];
}
