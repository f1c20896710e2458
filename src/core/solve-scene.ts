/** A scene solved in one call: footsteps and whole-body motion. What the worker does in slices, for programs that can wait. */
import { beginSynthesis, handResults, synthesiseChunk } from "./motion/synthesise.ts";
import type { BoxTrack, InkStroke, QualityFigures } from "./motion/types.ts";
import { measureMotion } from "./quality/measure.ts";
import type { Scene } from "./scene/types.ts";
import { createSkeleton, type Skeleton } from "./skeleton/skeleton.ts";
import type { ContactTrack } from "./steps/types.ts";
import { goalsOf, planScene } from "./tasks/plan-scene.ts";
import type { Plan } from "./tasks/plan-types.ts";
import { retargetLibrary } from "./templates/retarget-library.ts";
import type { Library } from "./templates/types.ts";

export interface Solved {
  plan: Plan;
  skeleton: Skeleton;
  /** At 60 Hz. */
  frames: number;
  /** The hips' world place, frames x 3, metres. */
  root: Float32Array;
  /** Local rotations xyzw, frames x JOINT_COUNT x 4. */
  rotations: Float32Array;
  contacts: ContactTrack;
  boxes: BoxTrack[];
  ink: InkStroke[];
  quality: QualityFigures;
}

/**
 * Plans a scene's tasks and makes the motion.
 *
 * @param library templates, as `decodeLibrary` reads them; fitted to the scene's character here.
 * @param skeleton whose body moves; left out: that of the scene's `character`.
 * @returns everything; what could not be met is said in `plan.warnings`.
 */
export function solveScene(
  scene: Scene,
  library: Library,
  skeleton: Skeleton = createSkeleton(scene.character.height, scene.character.proportions),
): Solved {
  const fitted = retargetLibrary(library, skeleton);
  const goals = goalsOf(scene);
  const plan = planScene(scene, fitted, skeleton);
  const synthesis = beginSynthesis(fitted, skeleton, plan, goals, new Map());
  const chunk = synthesiseChunk(synthesis, 0, synthesis.frames);
  const { boxes, ink } = handResults(synthesis);
  return {
    plan,
    skeleton,
    frames: synthesis.frames,
    root: chunk.root,
    rotations: chunk.rotations,
    contacts: chunk.contacts,
    boxes,
    ink,
    quality: measureMotion(skeleton, [chunk], synthesis.frames, plan, goals),
  };
}
