/**
 * The planner's part for scenes with paths: styles, the visitor's own among them, their families of loops built ahead, and
 * the walk. One planner keeps one.
 */
import type { Scene } from "../core/scene/types.ts";
import { createSkeleton } from "../core/skeleton/skeleton.ts";
import { buildFamily, MOST_MEMBERS, type StrideFamily } from "../core/styles/family.ts";
import { fitLoop, type LoopSequence } from "../core/styles/loop.ts";
import { type PathPlan, planPaths, stylesOf } from "../core/styles/plan-paths.ts";
import type { PathOptions } from "../core/styles/synthesise-path.ts";
import { type StyleFacts, styleFacts, styleFromBvh } from "../core/styles/user-style.ts";
import { shippedLoop } from "../studio/style-families.ts";
import { STYLES } from "../studio/styles.ts";

/** Members of a family between two reports. */
const REPORT_EVERY = 10;

export class PathPlanner {
  /** Loops on the body they were captured from, by style; `own` are the visitor's. */
  private readonly shipped = new Map<string, LoopSequence>();
  private readonly own = new Map<string, LoopSequence>();
  private families: { key: string; byStyle: Map<string, StrideFamily> } | null = null;

  /**
   * A straight sample becomes a style; one of that name gives way.
   *
   * @throws BvhError, StyleError with one sentence that begins with the file's name.
   */
  addStyle(name: string, file: string, text: string): StyleFacts {
    const loop = styleFromBvh(text, file, name);
    this.own.set(name, loop);
    this.families?.byStyle.delete(name);
    return styleFacts(loop);
  }

  forgetStyle(name: string): void {
    this.own.delete(name);
    this.families?.byStyle.delete(name);
  }

  /** What the styles that ship are, in their own order. */
  shippedFacts(): StyleFacts[] {
    return STYLES.flatMap((name) => {
      const loop = this.shipped.get(name) ?? shippedLoop(name);
      if (!loop) return [];
      this.shipped.set(name, loop);
      return [styleFacts(loop)];
    });
  }

  private loopOf(name: string): LoopSequence | null {
    const known = this.own.get(name) ?? this.shipped.get(name);
    if (known) return known;
    const loop = shippedLoop(name);
    if (loop) this.shipped.set(name, loop);
    return loop;
  }

  /**
   * The walk along a scene's paths. Families that are missing are built first, one style after the other.
   *
   * @param key of the scene's character: families are kept until it changes.
   * @param report told of members built; @param breathe awaited after each style: true to go on, false to give up.
   * @returns null when it was given up.
   * @throws RangeError naming the place of a path or style that cannot be followed.
   */
  async plan(
    scene: Scene,
    key: string,
    options: Partial<PathOptions>,
    report: (style: string, done: number, of: number) => void,
    breathe: () => Promise<boolean>,
  ): Promise<PathPlan | null> {
    const skeleton = createSkeleton(scene.character.height, scene.character.proportions);
    if (this.families?.key !== key) this.families = { key, byStyle: new Map() };
    const { byStyle } = this.families;
    for (const style of stylesOf(scene)) {
      if (byStyle.has(style)) continue;
      const loop = this.loopOf(style);
      // A style that nobody knows is named with its place by planPaths.
      if (!loop) continue;
      const family = buildFamily(fitLoop(loop, skeleton.legLength), skeleton, MOST_MEMBERS, (done, of) => {
        if (done % REPORT_EVERY === 0) report(style, done, of);
      });
      byStyle.set(style, family);
      if (!(await breathe())) return null;
    }
    return planPaths(scene, skeleton, byStyle, options);
  }
}
