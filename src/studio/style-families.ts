/** The styles that ship, as loops cut from the studio's samples and families fitted to a character. */

import type { Skeleton } from "../core/skeleton/skeleton.ts";
import { buildFamily, MOST_MEMBERS, type StrideFamily } from "../core/styles/family.ts";
import { cutLoop, fitLoop, type LoopSequence } from "../core/styles/loop.ts";
import { renderScore } from "./render.ts";
import { STYLES, type Style, styleScore } from "./styles.ts";

/** Renders a style's sample and cuts its loop; null for a name that is not a style's. */
export function shippedLoop(name: string): LoopSequence | null {
  if (!STYLES.includes(name as Style)) return null;
  return cutLoop(renderScore(styleScore(name as Style)).clip, name);
}

/** Renders each style asked for, cuts its loop and builds its family; a name that is not a style's is left out. */
export function styleFamilies(names: readonly string[], skeleton: Skeleton): Map<string, StrideFamily> {
  const out = new Map<string, StrideFamily>();
  for (const style of STYLES) {
    const loop = names.includes(style) ? shippedLoop(style) : null;
    if (loop) out.set(style, buildFamily(fitLoop(loop, skeleton.legLength), skeleton, MOST_MEMBERS));
  }
  return out;
}
