/**
 * A library for a character of other proportions: "character-specific footstep templates" [TaskLoco §7].
 *
 * Our skeletons scale legs and feet together, so the same rotations with root and footsteps scaled by the ratio of leg
 * lengths keep every plant where it is; rotations are shared, not copied.
 */
import type { Skeleton } from "../skeleton/skeleton.ts";
import type { Footstep } from "../steps/types.ts";
import type { Library, LibraryClip } from "./types.ts";

/** The library with every clip on `skeleton`. */
export function retargetLibrary(library: Library, skeleton: Skeleton): Library {
  const ratios = library.clips.map((c) => skeleton.legLength / c.clip.skeleton.legLength);
  const pair = (p: [number, number], k: number): [number, number] => [p[0] * k, p[1] * k];
  const mean = ratios.length > 0 ? ratios.reduce((a, b) => a + b, 0) / ratios.length : 1;
  return {
    ...library,
    clips: library.clips.map((c, i) => retargetLibraryClip(c, skeleton, ratios[i])),
    templates: library.templates.map((t) => {
      const k = ratios[t.clip];
      const d = t.descriptor;
      return {
        ...t,
        descriptor: {
          ...d,
          nextInCurrent: pair(d.nextInCurrent, k),
          currentInNext: pair(d.currentInNext, k),
          followupInNext: d.followupInNext ? pair(d.followupInNext, k) : null,
        },
      };
    }),
    enterRadius: Object.fromEntries(
      Object.entries(library.enterRadius).map(([c, r]) => [c, r * mean]),
    ) as Library["enterRadius"],
  };
}

function retargetLibraryClip(c: LibraryClip, skeleton: Skeleton, k: number): LibraryClip {
  const scaled = (s: Footstep): Footstep => ({ ...s, x: s.x * k, y: s.y * k, z: s.z * k });
  return {
    ...c,
    clip: { ...c.clip, skeleton, root: c.clip.root.map((v) => v * k) },
    tasks: c.tasks.map((t) => ({
      ...t,
      position: [t.position[0] * k, t.position[1] * k, t.position[2] * k],
    })),
    steps: c.steps.map((s) => ({ ...s, from: scaled(s.from), to: scaled(s.to) })),
    initialStance: [scaled(c.initialStance[0]), scaled(c.initialStance[1])],
  };
}
