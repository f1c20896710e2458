/** What an editor does to a scene's crowd: pure functions, a new scene each. */
import { freeId } from "./commands.ts";
import type { CrowdSpec, Scene, SceneProp, SceneRegion, SceneWalker } from "./types.ts";

type Point = readonly [number, number];

const crowdOf = (scene: Scene): CrowdSpec => scene.crowd ?? { agents: [], regions: [], surfaces: [] };
const withCrowd = (scene: Scene, change: Partial<CrowdSpec>): Scene => {
  const crowd = { ...crowdOf(scene), ...change };
  const empty = crowd.agents.length + crowd.regions.length + crowd.surfaces.length === 0;
  return { ...scene, crowd: empty ? null : crowd };
};

/** Square metres that one walker of a new area has. */
const ROOM = 1.6;

/** A new area in which walkers begin; they go as far as it is long, on its other side. */
export function addRegion(scene: Scene, a: Point, b: Point): { scene: Scene; index: number } {
  const crowd = crowdOf(scene);
  const bounds: SceneRegion["bounds"] = [
    Math.min(a[0], b[0]),
    Math.max(a[0], b[0]),
    Math.min(a[1], b[1]),
    Math.max(a[1], b[1]),
  ];
  const area = (bounds[1] - bounds[0]) * (bounds[3] - bounds[2]);
  const middle: Point = [(bounds[0] + bounds[1]) / 2, (bounds[2] + bounds[3]) / 2];
  const region: SceneRegion = {
    bounds,
    count: Math.max(1, Math.min(500, Math.floor(area / ROOM))),
    goals: [[middle[0], middle[1] > 0 ? middle[1] - 8 : middle[1] + 8]],
    speed: 1.3,
    gait: "usual",
  };
  return { scene: withCrowd(scene, { regions: [...crowd.regions, region] }), index: crowd.regions.length };
}

/** A new walker, facing and going to a goal. */
export function addWalker(scene: Scene, at: Point, goal: Point): { scene: Scene; index: number } {
  const crowd = crowdOf(scene);
  const walker: SceneWalker = {
    position: [at[0], at[1]],
    yaw: Math.atan2(goal[0] - at[0], goal[1] - at[1]),
    goals: [[goal[0], goal[1]]],
    speed: 1.3,
    gait: "usual",
  };
  return { scene: withCrowd(scene, { agents: [...crowd.agents, walker] }), index: crowd.agents.length };
}

export function changeWalker(scene: Scene, index: number, change: Partial<SceneWalker>): Scene {
  return withCrowd(scene, {
    agents: crowdOf(scene).agents.map((a, i) => (i === index ? { ...a, ...change } : a)),
  });
}

export function changeRegion(scene: Scene, index: number, change: Partial<SceneRegion>): Scene {
  return withCrowd(scene, {
    regions: crowdOf(scene).regions.map((r, i) => (i === index ? { ...r, ...change } : r)),
  });
}

/** An area with its middle at a place. */
export function placeRegion(scene: Scene, index: number, at: Point): Scene {
  const r = crowdOf(scene).regions[index];
  if (!r) return scene;
  const [w, d] = [(r.bounds[1] - r.bounds[0]) / 2, (r.bounds[3] - r.bounds[2]) / 2];
  return changeRegion(scene, index, { bounds: [at[0] - w, at[0] + w, at[1] - d, at[1] + d] });
}

/** A goal at a place: of a walker ("a") or an area ("r"). */
export function placeGoal(scene: Scene, of: "a" | "r", index: number, goal: number, at: Point): Scene {
  const crowd = crowdOf(scene);
  const move = (goals: [number, number][]): [number, number][] =>
    goals.map((g, i) => (i === goal ? [at[0], at[1]] : g));
  if (of === "a")
    return withCrowd(scene, {
      agents: crowd.agents.map((a, i) => (i === index ? { ...a, goals: move(a.goals) } : a)),
    });
  return withCrowd(scene, {
    regions: crowd.regions.map((r, i) => (i === index ? { ...r, goals: move(r.goals) } : r)),
  });
}

export function removeWalkers(scene: Scene, indices: readonly number[]): Scene {
  return withCrowd(scene, { agents: crowdOf(scene).agents.filter((_, i) => !indices.includes(i)) });
}

export function removeRegions(scene: Scene, indices: readonly number[]): Scene {
  return withCrowd(scene, { regions: crowdOf(scene).regions.filter((_, i) => !indices.includes(i)) });
}

const WALL_HEIGHT = 1.1;
const WALL_THICK = 0.16;

/** A wall between two points; walls of crowds are low, so that one can see over them. */
export function addWall(scene: Scene, a: Point, b: Point): { scene: Scene; id: string } {
  const id = freeId(scene, "wall");
  const wall: SceneProp = {
    id,
    kind: "wall",
    position: [(a[0] + b[0]) / 2, 0, (a[1] + b[1]) / 2],
    yaw: Math.atan2(-(b[1] - a[1]), b[0] - a[0]),
    size: [Math.max(0.2, Math.hypot(b[0] - a[0], b[1] - a[1])), WALL_HEIGHT, WALL_THICK],
  };
  return { scene: { ...scene, props: [...scene.props, wall] }, id };
}

export function addPillar(scene: Scene, at: Point): { scene: Scene; id: string } {
  const id = freeId(scene, "pillar");
  const pillar: SceneProp = {
    id,
    kind: "pillar",
    position: [at[0], 0, at[1]],
    yaw: 0,
    size: [0.5, WALL_HEIGHT, 0.5],
  };
  return { scene: { ...scene, props: [...scene.props, pillar] }, id };
}

/** Cuts a door into the wall nearest to a point. The scene itself comes back when no wall is within half a metre. */
export function addDoor(scene: Scene, at: Point, width = 0.95): Scene {
  let best: { prop: SceneProp; along: number } | null = null;
  let least = 0.5;
  for (const p of scene.props) {
    if (p.kind !== "wall") continue;
    const [dx, dz] = [at[0] - p.position[0], at[1] - p.position[2]];
    const along = dx * Math.cos(p.yaw) - dz * Math.sin(p.yaw);
    const off = Math.abs(dx * Math.sin(p.yaw) + dz * Math.cos(p.yaw));
    if (off > least || Math.abs(along) > p.size[0] / 2) continue;
    least = off;
    best = { prop: p, along };
  }
  if (!best) return scene;
  const { prop, along } = best;
  const half = prop.size[0] / 2;
  const piece = (from: number, to: number, id: string): SceneProp => ({
    ...prop,
    id,
    position: [
      prop.position[0] + ((from + to) / 2) * Math.cos(prop.yaw),
      prop.position[1],
      prop.position[2] - ((from + to) / 2) * Math.sin(prop.yaw),
    ],
    size: [to - from, prop.size[1], prop.size[2]],
  });
  const pieces: SceneProp[] = [];
  const [low, high] = [along - width / 2, along + width / 2];
  if (low > -half + 0.05) pieces.push(piece(-half, low, prop.id));
  if (high < half - 0.05) pieces.push(piece(high, half, pieces.length > 0 ? freeId(scene, "wall") : prop.id));
  return { ...scene, props: scene.props.flatMap((p) => (p.id === prop.id ? pieces : [p])) };
}
