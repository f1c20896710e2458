/** Footsteps of pivots follow from the end they turn about: the optimiser proposes their yaw alone. */
import { pivotPlace } from "../motion/sole.ts";
import type { FootShape } from "../skeleton/skeleton.ts";
import type { Footstep } from "../steps/types.ts";
import type { DraftStep, Feet } from "./draft.ts";

/** Which end of the foot stays while a step of this category turns; null when the foot leaves the ground. */
export function pivotEnd(category: DraftStep["category"]): "heel" | "ball" | null {
  return category === "HeelPivot" ? "heel" : category === "ToePivot" ? "ball" : null;
}

/**
 * Moves every pivot's footstep to where its yaw brings it. Marks them in `pinned`.
 *
 * @returns whether there was one.
 */
export function placePivots(shape: FootShape, feet: Feet, steps: DraftStep[], pinned: Uint8Array): boolean {
  let any = false;
  const now: Feet = { left: feet.left, right: feet.right };
  steps.forEach((s, i) => {
    const end = pivotEnd(s.category);
    if (end) {
      const from: Footstep = now[s.foot];
      const place = pivotPlace(shape, from, s.yaw, end);
      s.x = place.x;
      s.z = place.z;
      pinned[i] = 1;
      any = true;
    }
    now[s.foot] = s;
  });
  return any;
}
