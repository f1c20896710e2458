/** `plan`: scenes into footsteps and whole motions. */
import { existsSync, mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { joinMotions, type PlannedMotion, risen, standingAfter } from "../../core/blending/join.ts";
import { type BlendLibrary, bakeLibrary } from "../../core/blending/library.ts";
import { planStones } from "../../core/blending/plan-stones.ts";
import { writeBvh } from "../../core/capture/bvh-write.ts";
import { beginSynthesis, type SwingCache, synthesiseClip } from "../../core/motion/synthesise.ts";
import { measureMotion } from "../../core/quality/measure.ts";
import { resultDocument } from "../../core/scene/result.ts";
import { readScene } from "../../core/scene/schema.ts";
import type { Scene } from "../../core/scene/types.ts";
import { createSkeleton, type Skeleton } from "../../core/skeleton/skeleton.ts";
import { planPaths, stylesOf } from "../../core/styles/plan-paths.ts";
import { goalsOf, planScene } from "../../core/tasks/plan-scene.ts";
import { buildLibrary } from "../../core/templates/build-library.ts";
import { decodeLibrary, encodeLibrary } from "../../core/templates/library-file.ts";
import { retargetLibrary } from "../../core/templates/retarget-library.ts";
import type { Library } from "../../core/templates/types.ts";
import { cyclicSources } from "../../studio/blend-library.ts";
import { styleFamilies } from "../../studio/style-families.ts";
import { needed, one, outputs, readOptions } from "../args.ts";
import { readText } from "../read.ts";
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

/** A scene's tasks or paths, then its stones; null when there is nothing before the stones. */
function motionBefore(scene: Scene, character: Character, name: string): PlannedMotion | null {
  const { skeleton } = character;
  if (scene.paths.length > 0) {
    const { plan, motion } = planPaths(scene, skeleton, styleFamilies(stylesOf(scene), skeleton));
    return { plan, clip: { ...motion.clip, name }, contacts: motion.contacts };
  }
  if (scene.stones.length > 0 && scene.tasks.length === 0) return null;
  const library = character.library();
  const plan = planScene(scene, library, skeleton);
  const synthesis = beginSynthesis(library, skeleton, plan, goalsOf(scene), character.cache);
  const clip = synthesiseClip(synthesis, name);
  return { plan, clip, contacts: synthesis.track.contacts };
}

function motionOf(scene: Scene, character: Character, name: string): PlannedMotion {
  const before = motionBefore(scene, character, name);
  if (before && scene.stones.length === 0) return before;
  const stones = planStones(scene, character.blends(), before ? standingAfter(before) : null);
  return before ? joinMotions(before, stones) : stones;
}

export const planCommand = {
  usage: "plan --scene F... --out F.json | DIR/ [--bvh F.bvh] [--library F]",
  run(args: string[]) {
    const o = readOptions(args, { scene: "many", out: "one", bvh: "one", library: "one" });
    needed(o, "scene");
    const files = o.values.get("scene") ?? [];
    const out = needed(o, "out");
    const many = files.length > 1 || out.endsWith("/");
    if (many) mkdirSync(out, { recursive: true });
    const to = outputs(files, out, "json");
    const library = one(o, "library");
    const base = once(() => (library ? decodeLibrary(readFileSync(library)) : shippedLibrary()));
    const sources = once(cyclicSources);
    const kept = new Map<string, Character>();
    const rows = files.map((f, i) => {
      const scene = risen(readScene(readText(f), f));
      if (scene.paths.length > 0 && scene.tasks.length > 0)
        throw new Error(`${f}: paths: a scene with paths has no tasks yet.`);
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
      const { plan, clip, contacts } = motionOf(scene, character, f);
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
      };
    });
    return rows.length === 1 ? rows[0] : rows;
  },
};
