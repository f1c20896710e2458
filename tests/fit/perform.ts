/** The straight performance that a shape is judged by, beside the walkers that its recipe names. */
import { CLIP_RATE } from "../../src/core/capture/clip.ts";
import { JOINT_COUNT } from "../../src/core/skeleton/joints.ts";
import { DEFAULT_PROPORTIONS, REFERENCE_HEIGHT } from "../../src/core/skeleton/skeleton.ts";
import { straightScore } from "../../src/studio/choreography/straight.ts";
import type { GaitShape } from "../../src/studio/gait-shape.ts";
import { type Rendered, renderWorkings } from "../../src/studio/render.ts";
import type { Recipe } from "./recipes.ts";

/**
 * Steps at the recipe's pace, or, where its runners gain speed, the steps in which ours does so too: up to where it slows down.
 *
 * @returns the capture, and by how much its knees raised the hips, metres a frame.
 */
export function perform(recipe: Recipe, shape: GaitShape, steps: number): Rendered & { raise: Float64Array } {
  const score = straightScore({
    name: "fit",
    seed: 1,
    actor: {
      height: REFERENCE_HEIGHT,
      proportions: DEFAULT_PROPORTIONS,
      pace: { ...recipe.pace, noise: 0.3 },
      shape,
    },
    steps: recipe.gains ? 1 : steps,
    ...(recipe.gains ? { runUp: recipe.gains } : {}),
  });
  const { clip, contacts, sidecar, raise } = renderWorkings(score);
  if (!recipe.gains) return { clip, contacts, sidecar, raise };
  const frames = Math.round(score.steps[recipe.gains.length].land * CLIP_RATE);
  return {
    clip: {
      ...clip,
      frames,
      root: clip.root.subarray(0, 3 * frames),
      rotations: clip.rotations.subarray(0, 4 * JOINT_COUNT * frames),
    },
    contacts: contacts.subarray(0, frames),
    sidecar,
    raise: raise.subarray(0, frames),
  };
}

/** The frames in which chest and arms are judged: the middle of a performance, where its rhythm is whole. */
export const middleOf = (frames: number) => (frame: number) => frame >= 0.3 * frames && frame < 0.7 * frames;
