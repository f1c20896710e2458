/** The styles that ship, as families of loops fitted to a character. */

import type { Skeleton } from "../core/skeleton/skeleton.ts";
import { buildFamily, MOST_MEMBERS, type StrideFamily } from "../core/styles/family.ts";
import { cutLoop, fitLoop } from "../core/styles/loop.ts";
import { renderScore } from "./render.ts";
import { STYLES, styleScore } from "./styles.ts";

/** Renders each style asked for, cuts its loop and builds its family; a name that is not a style's is left out. */
export function styleFamilies(names: readonly string[], skeleton: Skeleton): Map<string, StrideFamily> {
  const out = new Map<string, StrideFamily>();
  for (const style of STYLES) {
    if (!names.includes(style)) continue;
    const { clip } = renderScore(styleScore(style));
    out.set(style, buildFamily(fitLoop(cutLoop(clip, style), skeleton.legLength), skeleton, MOST_MEMBERS));
  }
  return out;
}
