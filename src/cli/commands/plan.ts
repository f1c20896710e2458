/** `plan`: scenes into footsteps and whole motions. */
import { existsSync, mkdirSync, readFileSync, writeFileSync } from "node:fs";
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

/** A scene's paths: footsteps and motion, written as a plan's are. */
function planAlongPaths(
  scene: Scene,
  skeleton: Skeleton,
  name: string,
  out: string,
  bvh: string | undefined,
) {
  const { plan, motion } = planPaths(scene, skeleton, styleFamilies(stylesOf(scene), skeleton));
  const clip = { ...motion.clip, name };
  const chunk = {
    first: 0,
    frames: clip.frames,
    root: Float32Array.from(clip.root),
    rotations: Float32Array.from(clip.rotations),
    contacts: motion.contacts,
  };
  const quality = measureMotion(skeleton, [chunk], clip.frames, plan, []);
  writeFileSync(out, `${JSON.stringify(resultDocument(scene, plan, motion.contacts, quality))}\n`);
  if (bvh) writeFileSync(bvh, writeBvh(clip));
  return {
    scene: name,
    footsteps: plan.steps.length,
    seconds: plan.duration,
    warnings: plan.warnings,
    quality,
  };
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
    const base = library ? decodeLibrary(readFileSync(library)) : shippedLibrary();
    const kept = new Map<string, { library: Library; cache: SwingCache }>();
    const rows = files.map((f, i) => {
      const scene = readScene(readText(f), f);
      const { height, proportions } = scene.character;
      const skeleton = createSkeleton(height, proportions);
      const key = JSON.stringify([height, proportions]);
      const character = kept.get(key) ?? { library: retargetLibrary(base, skeleton), cache: new Map() };
      kept.set(key, character);
      const bvh = many ? to[i].replace(/\.json$/, ".bvh") : one(o, "bvh");
      if (scene.paths.length > 0) {
        if (scene.tasks.length > 0 || scene.stones.length > 0)
          throw new Error(`${f}: paths: a scene with paths has no tasks and no stones yet.`);
        return planAlongPaths(scene, skeleton, f, to[i], bvh);
      }
      const goals = goalsOf(scene);
      const plan = planScene(scene, character.library, skeleton);
      const synthesis = beginSynthesis(character.library, skeleton, plan, goals, character.cache);
      const clip = synthesiseClip(synthesis, f);
      const chunk = {
        first: 0,
        frames: clip.frames,
        root: Float32Array.from(clip.root),
        rotations: Float32Array.from(clip.rotations),
        contacts: synthesis.track.contacts,
      };
      const quality = measureMotion(skeleton, [chunk], clip.frames, plan, goals);
      writeFileSync(
        to[i],
        `${JSON.stringify(resultDocument(scene, plan, synthesis.track.contacts, quality))}\n`,
      );
      if (bvh) writeFileSync(bvh, writeBvh(clip));
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
