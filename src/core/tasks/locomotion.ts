/**
 * The locomotion phase [TaskLoco Algorithm 1, PlanLocomotionPhase; §5.5 Enter Task Preparation]: steps of category
 * Walk along the route, one by one, then the last ones fitted to the stance that the entry begins from.
 */
import { toLocal, toWorld } from "../math/frame2.ts";
import type { Foot } from "../steps/types.ts";
import type { Library } from "../templates/types.ts";
import { type DraftStep, footPose, otherFoot, stanceBefore } from "./draft.ts";

/** A walking segment with its displacement, for choosing. */
export interface Walk {
  clip: number;
  step: number;
  foot: Foot;
  /** Seen from the stance foot: lateral, forward, yaw. */
  desired: [number, number, number];
  /** A box is carried in it. */
  carrying: boolean;
}

export interface Walks {
  list: Walk[];
  /** Median forward displacement, metres. */
  length: number;
  /** Half the median distance across the feet. */
  halfWidth: number;
}

/** The library's walking segments with their displacements. */
export function walksOf(library: Library): Walks {
  const list: Walk[] = library.walks.map(([clip, step]) => {
    const source = library.clips[clip];
    const s = source.steps[step];
    const d = toLocal(footPose(stanceBefore(source, step)[otherFoot(s.foot)]), footPose(s.to));
    return {
      clip,
      step,
      foot: s.foot,
      desired: [d.x, d.z, d.yaw],
      carrying: carriedAt(library, clip, s.start),
    };
  });
  const median = (values: number[]) => values.sort((a, b) => a - b)[values.length >> 1] ?? 0;
  return {
    list,
    length: median(list.map((w) => w.desired[1])) || 0.6,
    halfWidth: median(list.map((w) => Math.abs(w.desired[0]))) / 2 || 0.07,
  };
}

/** Whether a box is held in a clip at a frame: after a lift's contact and before the place's. */
export function carriedAt(library: Library, clip: number, frame: number): boolean {
  const time = frame / 60;
  let held = false;
  for (const t of library.clips[clip].tasks) {
    if (t.contact > time) break;
    if (t.category === "lift") held = true;
    if (t.category === "place") held = false;
  }
  return held;
}

/** What the next walking step should be like. */
export interface WalkWish {
  foot: Foot;
  forward: number;
  yaw: number;
  carrying: boolean;
  /** Segment planned before, to be continued in the same capture where that is as good. */
  after: { clip: number; step: number } | null;
}

/** The walking segment nearest to a wish; a continuation of the same capture is worth 6 cm. Null when there is none of that foot. */
export function chooseWalk(walks: Walks, wish: WalkWish): Walk | null {
  let best: Walk | null = null;
  let bestCost = Number.POSITIVE_INFINITY;
  for (const w of walks.list) {
    if (w.foot !== wish.foot) continue;
    let cost = Math.abs(w.desired[1] - wish.forward) + 0.4 * Math.abs(w.desired[2] - wish.yaw);
    if (w.carrying !== wish.carrying) cost += 0.5;
    if (wish.after && w.clip === wish.after.clip && w.step === wish.after.step + 1) cost -= 0.06;
    if (cost < bestCost) {
      bestCost = cost;
      best = w;
    }
  }
  return best;
}

/** A walking segment laid from the stance foot. */
export function layWalk(walk: Walk, stance: { x: number; z: number; yaw: number }): DraftStep {
  const p = toWorld(stance, { x: walk.desired[0], z: walk.desired[1], yaw: walk.desired[2] });
  return {
    foot: walk.foot,
    x: p.x,
    y: 0,
    z: p.z,
    yaw: p.yaw,
    category: "Walk",
    phase: "locomotion",
    template: null,
    clip: walk.clip,
    step: walk.step,
    desired: [...walk.desired],
  };
}
