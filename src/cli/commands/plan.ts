/** `plan`: scenes into footsteps and whole motions; a result is planned anew and laid beside the new plan. */
import { existsSync, mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { type BlendLibrary, bakeLibrary } from "../../core/blending/library.ts";
import { ownCycle, withOwnCycles } from "../../core/blending/own-cycles.ts";
import type { CyclicSource } from "../../core/blending/types.ts";
import { writeBvh } from "../../core/capture/bvh-write.ts";
import type { SwingCache } from "../../core/motion/synthesise.ts";
import { planWhole } from "../../core/motion/whole-scene.ts";
import { type Beside, besidePerformance } from "../../core/quality/footstep-distance.ts";
import { measureMotion } from "../../core/quality/measure.ts";
import { footstepsOf, type ResultDocument, resultDocument } from "../../core/scene/result.ts";
import { readSceneOrResult } from "../../core/scene/result-schema.ts";
import { createSkeleton, type Skeleton } from "../../core/skeleton/skeleton.ts";
import { goalsOf } from "../../core/tasks/plan-scene.ts";
import type { Plan } from "../../core/tasks/plan-types.ts";
import { buildLibrary } from "../../core/templates/build-library.ts";
import { decodeLibrary, encodeLibrary } from "../../core/templates/library-file.ts";
import { retargetLibrary } from "../../core/templates/retarget-library.ts";
import type { Library } from "../../core/templates/types.ts";
import { cyclicSources } from "../../studio/blend-library.ts";
import { styleFamilies } from "../../studio/style-families.ts";
import { baseName, needed, one, outputs, readOptions } from "../args.ts";
import { readCapture, readText } from "../read.ts";
import { studioCaptures } from "./library.ts";

/** Where the shipped library is kept once it has been made. */
const SHIPPED = "public/generated/library.bin";

function shippedLibrary(): Library {
  if (!existsSync(SHIPPED)) {
    console.error("making the library ...");
    mkdirSync("public/generated", { recursive: true });
    writeFileSync(SHIPPED, encodeLibrary(buildLibrary(studioCaptures(() => undefined))));
  }
  return decodeLibrary(readFileSync(SHIPPED));
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
    const many = files.length > 1 || out.endsWith("/");
    const to = outputs(files, out, "json");
    const library = one(o, "library");
    const base = once(() => (library ? decodeLibrary(readFileSync(library)) : shippedLibrary()));
    const sources = once(() => withOwnClips(o.values.get("cycles") ?? []));
    const kept = new Map<string, Character>();
    const rows = files.map((f, i) => {
      const { scene, result } = readSceneOrResult(readText(f), f);
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
      const { plan, clip, contacts } = planWhole(scene, skeleton, {
        library: character.library,
        families: (styles) => styleFamilies(styles, skeleton),
        blends: character.blends,
        cache: character.cache,
      });
      const chunk = {
        first: 0,
        frames: clip.frames,
        root: Float32Array.from(clip.root),
        rotations: Float32Array.from(clip.rotations),
        contacts,
      };
      const quality = measureMotion(skeleton, [chunk], clip.frames, plan, goalsOf(scene));
      writeFileSync(to[i], `${JSON.stringify(resultDocument(scene, plan, contacts, quality))}\n`);
      const bvh = many ? to[i].replace(/\.json$/, ".bvh") : one(o, "bvh");
      if (bvh) writeFileSync(bvh, writeBvh({ ...clip, name: f }));
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
