/**
 * A scene's paths as one walk: the character goes along each in turn, in the styles painted on it, from standing to
 * standing [Express §§4-7]; the plants are its footsteps.
 */
import { wrapAngle } from "../math/angle.ts";
import type { Scene, ScenePath } from "../scene/types.ts";
import type { Skeleton } from "../skeleton/skeleton.ts";
import { categorise } from "../steps/categories.ts";
import type { Foot, Footstep, Step } from "../steps/types.ts";
import type { Plan } from "../tasks/plan-types.ts";
import type { StrideFamily } from "./family.ts";
import type { StylePlant } from "./feet.ts";
import { createPath, type MotionPath, type PathPoint } from "./path.ts";
import { type PathMotion, type PathOptions, synthesisePath } from "./synthesise-path.ts";
import type { StyleChange } from "./timeline.ts";

const RATE = 60;
/** Style of a path that has none painted. */
const PLAIN = "walking";

export interface PathPlan {
  plan: Plan;
  motion: PathMotion;
  path: MotionPath;
  /** Names of the styles used, in the order of `motion.timeline`'s indices. */
  styles: string[];
  /** Where each of the scene's paths lies on the joined way, metres. */
  spans: { id: string; from: number; to: number }[];
}

/** The scene's paths in playing order. */
export function orderedPaths(scene: Scene): ScenePath[] {
  const byId = new Map(scene.paths.map((p) => [p.id, p]));
  return scene.order.flatMap((id) => byId.get(id) ?? []);
}

/** Names of the styles that a scene's paths ask for, each once, in the order met. */
export function stylesOf(scene: Scene): string[] {
  const names = orderedPaths(scene).flatMap((p) => [PLAIN, ...p.styles.map((s) => s.style)]);
  return [...new Set(names)];
}

/**
 * Plans and synthesises a scene's paths.
 *
 * Paths are joined end to start in their order; a path's styles reach from their place to the next one's. The walk
 * begins at the first point of the first path.
 *
 * @param families one a style name, fitted to the skeleton.
 * @throws RangeError naming the place for a path of fewer than two points or a style that is not known.
 */
export function planPaths(
  scene: Scene,
  skeleton: Skeleton,
  families: ReadonlyMap<string, StrideFamily>,
  options: Partial<PathOptions> = {},
): PathPlan {
  const paths = orderedPaths(scene);
  if (paths.length === 0) throw new RangeError("paths: there is none to follow.");
  const styles = stylesOf(scene);
  for (const p of scene.paths)
    p.styles.forEach((s, k) => {
      if (!families.has(s.style))
        throw new RangeError(
          `paths[${scene.paths.indexOf(p)}].styles[${k}].style: ${JSON.stringify(s.style)} is not known; there are ${[...families.keys()].join(", ")}.`,
        );
    });
  const points: PathPoint[] = [];
  const lengths: number[] = [];
  paths.forEach((p) => {
    if (p.points.length < 2)
      throw new RangeError(`paths[${scene.paths.indexOf(p)}].points: two at least are needed.`);
    for (const q of p.points) points.push([q[0], q[1]]);
    lengths.push(lengthOf(points));
  });
  if (!points.some((q) => q[0] !== points[0][0] || q[1] !== points[0][1]))
    throw new RangeError(
      `paths[${scene.paths.indexOf(paths[0])}].points: two different points are needed, found 1.`,
    );
  const path = createPath(
    points,
    paths.every((p) => p.smooth),
  );
  // Corners are rounded: places along the drawn line become places along the path by their share.
  const drawn = lengths[lengths.length - 1] || 1;
  const changes: StyleChange[] = [{ at: 0, style: styles.indexOf(PLAIN) }];
  paths.forEach((p, i) => {
    const from = i === 0 ? 0 : lengths[i - 1];
    const painted = [...p.styles].sort((a, b) => a.at - b.at);
    if (painted.length === 0 || painted[0].at > 0) painted.unshift({ at: 0, style: PLAIN });
    for (const s of painted) {
      const at = ((from + s.at * (lengths[i] - from)) / drawn) * path.length;
      const style = styles.indexOf(s.style);
      const last = changes[changes.length - 1];
      if (at - last.at < 1e-6) last.style = style;
      else if (last.style !== style) changes.push({ at, style });
    }
  });
  const wanted = styles.map((name) => {
    const family = families.get(name);
    if (!family) throw new RangeError(`styles: ${JSON.stringify(name)} is not known.`);
    return family;
  });
  const motion = synthesisePath(path, wanted, changes, skeleton, options);
  const spans = paths.map((p, i) => ({
    id: p.id,
    from: ((i === 0 ? 0 : lengths[i - 1]) / drawn) * path.length,
    to: (lengths[i] / drawn) * path.length,
  }));
  return { plan: planOf(motion, skeleton), motion, path, styles, spans };
}

function lengthOf(points: readonly PathPoint[]): number {
  let sum = 0;
  for (let i = 1; i < points.length; i++)
    sum += Math.hypot(points[i][0] - points[i - 1][0], points[i][1] - points[i - 1][1]);
  return sum;
}

/** The plants as a plan's footsteps: the first of each foot is where it starts. */
function planOf(motion: PathMotion, skeleton: Skeleton): Plan {
  const steps: Step[] = [];
  const last = new Map<Foot, StylePlant>();
  const start = new Map<Foot, Footstep>();
  const place = (p: StylePlant): Footstep => ({ foot: p.foot, x: p.x, y: 0, z: p.z, yaw: wrapAngle(p.yaw) });
  for (const p of motion.plants) {
    const before = last.get(p.foot);
    last.set(p.foot, p);
    if (!before) start.set(p.foot, place(p));
    else
      steps.push({
        foot: p.foot,
        category: "Walk",
        phase: "locomotion",
        start: before.to,
        end: p.from,
        from: place(before),
        to: place(p),
        airStart: before.to,
        airEnd: p.from,
      });
  }
  const left = start.get("left");
  const right = start.get("right");
  if (!left || !right) throw new RangeError("paths: too short to take a step.");
  steps.sort((a, b) => a.start - b.start);
  categorise(steps, [left, right], [], RATE, skeleton.legLength);
  return {
    start: [left, right],
    steps: steps.map((s) => ({
      ...s.to,
      category: s.category,
      phase: s.phase,
      task: -1,
      template: null,
      clip: -1,
      step: -1,
      lift: s.start / RATE,
      land: s.end / RATE,
    })),
    segments: [],
    tasks: [],
    duration: motion.clip.frames / RATE,
    candidates: [],
    traces: [],
    warnings: motion.timeline.warnings,
  };
}
