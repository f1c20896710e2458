/** `plan`: scenes into footsteps and whole motions; a result is planned anew and laid beside the new plan. */

import { fileURLToPath } from "node:url";
import { type BlendLibrary, bakeLibrary } from "../../core/blending/library.ts";
import { ownCycle, withOwnCycles } from "../../core/blending/own-cycles.ts";
import type { CyclicSource } from "../../core/blending/types.ts";
import { writeBvh } from "../../core/capture/bvh-write.ts";
import { wholeChunk } from "../../core/motion/chunk.ts";
import type { SwingCache } from "../../core/motion/synthesise.ts";
import { planWhole } from "../../core/motion/whole-scene.ts";
import { type Beside, besidePerformance } from "../../core/quality/footstep-distance.ts";
import { measureMotion } from "../../core/quality/measure.ts";
import { footstepsOf, type ResultDocument, resultDocument } from "../../core/scene/result.ts";
import { readSceneOrResult } from "../../core/scene/result-schema.ts";
import type { Scene } from "../../core/scene/types.ts";
import { createSkeleton, type Skeleton } from "../../core/skeleton/skeleton.ts";
import { goalsOf } from "../../core/tasks/plan-scene.ts";
import type { Plan } from "../../core/tasks/plan-types.ts";
import { buildLibrary } from "../../core/templates/build-library.ts";
import { decodeLibrary, encodeLibrary } from "../../core/templates/library-file.ts";
import { retargetLibrary } from "../../core/templates/retarget-library.ts";
import type { Library } from "../../core/templates/types.ts";
import { cyclicSources } from "../../studio/blend-library.ts";
import { styleFamilies } from "../../studio/style-families.ts";
import { STYLES } from "../../studio/styles.ts";
import { baseName, needed, one, outputs, readOptions } from "../args.ts";
import { readCapture, readText } from "../read.ts";
import { keptBeside, writeOutput } from "../write.ts";
import { readLibrary, studioCaptures } from "./library.ts";

/** The studio's library, as the site has it. */
function shippedLibrary(): Library {
  return decodeLibrary(
    keptBeside(fileURLToPath(import.meta.url), "library.bin", () => {
      console.error("making the library from the studio's captures ...");
      return encodeLibrary(buildLibrary(studioCaptures(() => undefined)));
    }),
  );
}

/** Styles that none of ours has, told before the work. @throws Error with the place. */
function checkStyles(scene: Scene, file: string): void {
  scene.paths.forEach((p, i) => {
    p.styles.forEach(({ style }, k) => {
      if (!(STYLES as readonly string[]).includes(style))
        throw new Error(
          `${file}: paths[${i}].styles[${k}].style: one of ${STYLES.join(", ")} is needed, found ${JSON.stringify(style)}.`,
        );
    });
  });
}

/** Does something for a scene, its failures told with the file. */
function naming<T>(file: string, act: () => T): T {
  try {
    return act();
  } catch (error) {
    throw new Error(`${file}: ${error instanceof Error ? error.message : String(error)}`);
  }
}

/** What is kept from scene to scene for one character. */
interface Character {
  skeleton: Skeleton;
  library: () => Library;
  blends: () => BlendLibrary;
  cache: SwingCache;
}

/** A value made when it is first asked for. */
function once<T>(make: () => T): () => T {
  let value: T | undefined;
  return () => {
    value ??= make();
    return value;
  };
}

/** The clips that ship with a user's own: one of the same name replaces ours. */
function withOwnClips(files: readonly string[]): CyclicSource[] {
  const own = files.map((f): CyclicSource => {
    const { clip } = readCapture(f);
    return ownCycle(baseName(f), clip);
  });
  return withOwnCycles(cyclicSources(), own);
}

/** How far the new plan is from the one that a result holds. */
const besideResult = (r: ResultDocument, plan: Plan): Beside | null =>
  besidePerformance(
    { steps: footstepsOf(r).steps, contacts: r.timing.tasks.map((t) => t.contact) },
    { steps: plan.steps, contacts: plan.tasks.map((t) => t.contact) },
  );

export const planCommand = {
  usage: "plan --scene F... --out F.json | DIR/ [--bvh F.bvh] [--library F] [--cycles F.bvh...]",
  run(args: string[]) {
    const o = readOptions(args, { scene: "many", out: "one", bvh: "one", library: "one", cycles: "many" });
    needed(o, "scene");
    const files = o.values.get("scene") ?? [];
    const out = needed(o, "out");
    const to = outputs(files, out, "json");
    const many = files.length > 1 || to[0] !== out;
    const library = one(o, "library");
    const base = once(() => (library ? readLibrary(library) : shippedLibrary()));
    const cycles = o.values.get("cycles") ?? [];
    const sources = once(() => withOwnClips(cycles));
    // What is given and broken is told even where the scene has no use for it.
    if (library) base();
    if (cycles.length > 0) sources();
    const kept = new Map<string, Character>();
    const rows = files.map((f, i) => {
      const { scene, result } = readSceneOrResult(readText(f), f);
      checkStyles(scene, f);
      const { height, proportions } = scene.character;
      const key = JSON.stringify([height, proportions]);
      const skeleton = createSkeleton(height, proportions);
      const character = kept.get(key) ?? {
        skeleton,
        library: once(() => retargetLibrary(base(), skeleton)),
        blends: once(() => bakeLibrary(sources(), skeleton)),
        cache: new Map(),
      };
      kept.set(key, character);
      const { plan, clip, contacts } = naming(f, () =>
        planWhole(scene, skeleton, {
          library: character.library,
          families: (styles) => styleFamilies(styles, skeleton),
          blends: character.blends,
          cache: character.cache,
        }),
      );
      const chunk = wholeChunk(clip, contacts);
      const quality = measureMotion(skeleton, [chunk], clip.frames, plan, goalsOf(scene));
      writeOutput(to[i], `${JSON.stringify(resultDocument(scene, plan, contacts, quality))}\n`);
      const bvh = many ? to[i].replace(/\.json$/, ".bvh") : one(o, "bvh");
      if (bvh) writeOutput(bvh, writeBvh({ ...clip, name: f }));
      return {
        scene: f,
        footsteps: plan.steps.length,
        seconds: plan.duration,
        warnings: plan.warnings,
        quality,
        ...(result ? { beside: besideResult(result, plan) } : {}),
      };
    });
    return rows.length === 1 ? rows[0] : rows;
  },
};
