/**
 * The planner's part for scenes with paths: styles, the visitor's own among them, and their families of loops, built ahead. One
 * planner keeps one.
 */
import type { Scene } from "../core/scene/types.ts";
import type { Skeleton } from "../core/skeleton/skeleton.ts";
import { buildFamily, MOST_MEMBERS, type StrideFamily } from "../core/styles/family.ts";
import { fitLoop, type LoopSequence } from "../core/styles/loop.ts";
import { stylesOf } from "../core/styles/plan-paths.ts";
import { type StyleFacts, styleFacts, styleFromBvh } from "../core/styles/user-style.ts";
import { shippedLoop } from "../studio/style-families.ts";
import { STYLES } from "../studio/styles.ts";

/** Members of a family between two reports. */
const REPORT_EVERY = 10;

export class PathPlanner {
  /** Loops on the body they were captured from, by style; `own` are the visitor's. */
  private readonly shipped = new Map<string, LoopSequence>();
  private readonly own = new Map<string, LoopSequence>();
  private kept: { key: string; byStyle: Map<string, StrideFamily> } | null = null;

  /**
   * A straight sample becomes a style; one of that name gives way.
   *
   * @throws BvhError, StyleError with one sentence that begins with the file's name.
   */
  addStyle(name: string, file: string, text: string): StyleFacts {
    const loop = styleFromBvh(text, file, name);
    this.own.set(name, loop);
    this.kept?.byStyle.delete(name);
    return styleFacts(loop);
  }

  forgetStyle(name: string): void {
    this.own.delete(name);
    this.kept?.byStyle.delete(name);
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
   * The strides of a scene's styles. What is missing is built first, one style after the other.
   *
   * @param key of the scene's character: families are kept until it changes.
   * @param report told of members built; @param breathe awaited after each style: true to go on, false to give up.
   * @returns null when it was given up. A style that nobody knows is left out: the walk names it with its place.
   */
  async families(
    scene: Scene,
    skeleton: Skeleton,
    key: string,
    report: (style: string, done: number, of: number) => void,
    breathe: () => Promise<boolean>,
  ): Promise<ReadonlyMap<string, StrideFamily> | null> {
    if (this.kept?.key !== key) this.kept = { key, byStyle: new Map() };
    const { byStyle } = this.kept;
    for (const style of scene.paths.length > 0 ? stylesOf(scene) : []) {
      if (byStyle.has(style)) continue;
      const loop = this.loopOf(style);
      if (!loop) continue;
      const family = buildFamily(fitLoop(loop, skeleton.legLength), skeleton, MOST_MEMBERS, (done, of) => {
        if (done % REPORT_EVERY === 0) report(style, done, of);
      });
      byStyle.set(style, family);
      if (!(await breathe())) return null;
    }
    return byStyle;
  }
}
