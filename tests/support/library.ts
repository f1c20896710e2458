/** The studio's library, made once a test process. */
import { buildLibrary } from "../../src/core/templates/build-library.ts";
import type { Library } from "../../src/core/templates/types.ts";
import { type Rendered, renderScore } from "../../src/studio/render.ts";
import { studioSet } from "../../src/studio/set.ts";

let made: { rendered: (Rendered & { name: string })[]; library: Library } | null = null;

export function studio(): { rendered: (Rendered & { name: string })[]; library: Library } {
  if (!made) {
    const rendered = studioSet().map(({ name, score }) => ({ name, ...renderScore(score) }));
    made = {
      rendered,
      library: buildLibrary(rendered.map((r) => ({ name: r.name, clip: r.clip, tasks: r.sidecar.tasks }))),
    };
  }
  return made;
}
