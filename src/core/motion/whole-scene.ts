/**
 * A whole scene in its order: tasks, paths and stones, each run of one kind planned from where the one before has left the
 * character, and walked to where it has to begin.
 */
import { joinMotions, type PlannedMotion, standingAfter } from "../blending/join.ts";
import type { BlendLibrary } from "../blending/library.ts";
import { orderedStones, planStones, type Standing } from "../blending/plan-stones.ts";
import { bearing, groundDistance, midPose } from "../math/frame2.ts";
import type { Scene, SceneStone, SceneTask } from "../scene/types.ts";
import type { Skeleton } from "../skeleton/skeleton.ts";
import type { Footstep } from "../steps/types.ts";
import type { StrideFamily } from "../styles/family.ts";
import { type PathPlan, planPaths, stylesOf } from "../styles/plan-paths.ts";
import type { PathOptions } from "../styles/synthesise-path.ts";
import { goalsOf, planScene } from "../tasks/plan-scene.ts";
import { standingFeet } from "../tasks/standing-feet.ts";
import type { Library } from "../templates/types.ts";
import { blendIn } from "./blend-in.ts";
import { beginSynthesis, handResults, type SwingCache, synthesiseClip } from "./synthesise.ts";
import type { BoxTrack, InkStroke } from "./types.ts";

/** What each kind of run is made of; asked for only where a scene has it. */
export interface WholeSources {
  /** Templates fitted to the skeleton. */
  library(): Library;
  /** Strides of the styles named, fitted to the skeleton. */
  families(styles: string[]): ReadonlyMap<string, StrideFamily>;
  blends(): BlendLibrary;
  cache: SwingCache;
}

export interface WholeOptions {
  /** Steps on stones: 0 on them, 1 by the root's velocity [Barycentric §5]. */
  lambda4?: number;
  /** How paths are walked: refinements left out, and so on. */
  paths?: Partial<PathOptions>;
  /** Whether to record the optimiser's terms. */
  trace?: boolean;
}

export interface WholeMotion extends PlannedMotion {
  boxes: BoxTrack[];
  ink: InkStroke[];
  /** Its walks along paths, with the frame at which each begins. */
  walks: { first: number; walk: PathPlan }[];
}

type Kind = "tasks" | "paths" | "stones";

/** A scene's order cut where the kind changes. */
export function runsOf(scene: Scene): { kind: Kind; ids: string[] }[] {
  const kinds = new Map<string, Kind>();
  for (const kind of ["tasks", "paths", "stones"] as const)
    for (const thing of scene[kind]) kinds.set(thing.id, kind);
  const out: { kind: Kind; ids: string[] }[] = [];
  for (const id of scene.order) {
    const kind = kinds.get(id);
    if (!kind) continue;
    const last = out[out.length - 1];
    if (last?.kind === kind) last.ids.push(id);
    else out.push({ kind, ids: [id] });
  }
  return out;
}

/** The part of a scene that a run is. */
function partOf(scene: Scene, ids: readonly string[]): Scene {
  const has = (t: { id: string }) => ids.includes(t.id);
  return {
    ...scene,
    tasks: scene.tasks.filter(has),
    paths: scene.paths.filter(has),
    stones: scene.stones.filter(has),
    order: [...ids],
  };
}

/**
 * Plans and synthesises a scene's tasks, paths and stones in their order.
 *
 * A first run of paths begins where its path does. Who sits rises before what is not a task.
 *
 * @throws RangeError as the planner of a run does, naming the place.
 */
export function planWhole(
  scene: Scene,
  skeleton: Skeleton,
  sources: WholeSources,
  options: WholeOptions = {},
): WholeMotion {
  const runs = runsOf(scene);
  if (runs.length === 0) runs.push({ kind: "tasks", ids: [] });
  let whole: WholeMotion | null = null;
  const add = (run: WholeMotion): void => {
    whole = whole ? after(whole, run) : run;
  };
  runs.forEach((run, i) => {
    const part = partOf(scene, run.ids);
    const standing = whole ? standingAfter(whole) : null;
    if (run.kind === "stones") {
      const near = standing ? beforeStones(standing, orderedStones(part), skeleton) : null;
      if (near) add(doTasks(partOf(scene, []), skeleton, sources, standing, near, options));
      const from = near && whole ? standingAfter(whole) : standing;
      const stones = planStones(part, sources.blends(), from, { lambda4: options.lambda4 ?? 0 });
      add({ ...stones, boxes: [], ink: [], walks: [] });
      return;
    }
    if (run.kind === "tasks") {
      const next = runs[i + 1];
      const risen = next ? rise(part) : part;
      add(doTasks(risen, skeleton, sources, standing, null, options));
      return;
    }
    const along = planPaths(part, skeleton, sources.families(stylesOf(part)), options.paths ?? {});
    const { plan, motion } = along;
    if (standing) add(doTasks(partOf(scene, []), skeleton, sources, standing, plan.start, options));
    const walk = {
      plan,
      clip: motion.clip,
      contacts: motion.contacts,
      boxes: [],
      ink: [],
      walks: [{ first: 0, walk: along }],
    };
    const there = whole ? standingAfter(whole) : null;
    if (there) blendIn(walk.clip, there.root, there.rotations);
    add(walk);
  });
  return whole as unknown as WholeMotion;
}

/** From farther than a step the first stone is walked to; so far before it one stands, metres at a leg of 0.93 m. */
const STEP_OFF = 0.9;
const BEFORE = 0.45;

/** Where to stand before the first of some stones that is too far to step on; null where it is not. */
function beforeStones(
  standing: Standing,
  stones: readonly SceneStone[],
  skeleton: Skeleton,
): [Footstep, Footstep] | null {
  const scale = skeleton.legLength / 0.93;
  const at = (s: SceneStone) => ({ x: s.position[0], z: s.position[2] });
  const here = midPose(standing.feet[0], standing.feet[1]);
  const first = stones[0] && at(stones[0]);
  if (!first || groundDistance(here, first) < STEP_OFF * scale) return null;
  const yaw = stones[1] ? bearing(first, at(stones[1])) : bearing(here, first);
  const d = BEFORE * scale;
  const feet = standingFeet(
    { x: first.x - d * Math.sin(yaw), z: first.z - d * Math.cos(yaw), yaw },
    skeleton,
  );
  return [feet.left, feet.right];
}

/** Tasks from a stance, and at last a walk to another. */
function doTasks(
  part: Scene,
  skeleton: Skeleton,
  sources: WholeSources,
  standing: Standing | null,
  then: readonly [Footstep, Footstep] | null,
  options: WholeOptions,
): WholeMotion {
  const library = sources.library();
  const here = standing ? midPose(standing.feet[0], standing.feet[1]) : null;
  const scene: Scene = here ? { ...part, start: { position: [here.x, here.z], yaw: here.yaw } } : part;
  const plan = planScene(scene, library, skeleton, {
    feet: standing?.feet ?? null,
    then,
    trace: options.trace ?? false,
  });
  const synthesis = beginSynthesis(library, skeleton, plan, goalsOf(scene), sources.cache);
  const clip = synthesiseClip(synthesis, "scene");
  if (standing) blendIn(clip, standing.root, standing.rotations);
  plan.tasks = plan.tasks.filter((t) => t.id !== "");
  return { plan, clip, contacts: synthesis.track.contacts, walks: [], ...handResults(synthesis) };
}

/** Nobody walks on from a seat without rising: a run of tasks that ends in one gets a rise. */
function rise(part: Scene): Scene {
  const last = part.tasks.find((t) => t.id === part.order.at(-1));
  if (last?.category !== "sit") return part;
  const up: SceneTask = { ...last, id: `${last.id}/rise`, category: "stand", duration: null };
  return { ...part, tasks: [...part.tasks, up], order: [...part.order, up.id] };
}

/** The second motion after the first, with what hands have left in either. */
function after(a: WholeMotion, b: WholeMotion): WholeMotion {
  const frames = a.clip.frames;
  return {
    ...joinMotions(a, b),
    boxes: [...a.boxes, ...b.boxes.map((t) => ({ ...t, first: t.first + frames }))],
    walks: [...a.walks, ...b.walks.map((w) => ({ ...w, first: w.first + frames }))],
    ink: [...a.ink, ...b.ink.map((s) => ({ ...s, times: s.times.map((t) => t + frames / 60) }))],
  };
}
