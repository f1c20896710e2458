/** SteerSuite test cases (XML) as crowd worlds. */

import { createRandom } from "../math/random.ts";
import { cosine, sine } from "./elementary.ts";
import { wallObstacles, wallsOfPolygon } from "./polygon-walls.ts";
import { repairWorld } from "./repairs.ts";
import type { CrowdAgent, CrowdGoal, CrowdWorld, Obstacle } from "./types.ts";
import { CaseError, parseXml, type XmlNode } from "./xml.ts";

const MOST_AGENTS = 5000;
const MOST_OBSTACLES = 10_000;
/** Places further than this from the middle are a mistake, metres. */
const FARTHEST = 10_000;

/**
 * A SteerSuite test case as a world. Random places are drawn from `seed`.
 *
 * @throws CaseError naming file and line.
 */
export function readSteerCase(text: string, file: string, seed = 1): CrowdWorld {
  const start = text.indexOf("<SteerBenchTestCase");
  if (start < 0) throw new CaseError(`${file}: no <SteerBenchTestCase> was found.`);
  // Comments before the root stay counted in the lines.
  const before = text.slice(0, start).split("\n").length - 1;
  const root = parseXml("\n".repeat(before) + text.slice(start), file);
  const r = createRandom(seed);
  const world: CrowdWorld = { name: file, obstacles: [], agents: [], repairs: [] };
  const fail = (node: XmlNode, what: string): never => {
    throw new CaseError(`${file}, line ${node.line}: ${what}`);
  };
  const child = (node: XmlNode, name: string): XmlNode =>
    node.children.find((c) => c.name === name) ?? fail(node, `<${node.name}> needs <${name}>.`);
  const maybe = (node: XmlNode, name: string): XmlNode | undefined =>
    node.children.find((c) => c.name === name);
  const number = (node: XmlNode, name: string): number => {
    const c = child(node, name);
    const v = Number(c.text.trim());
    if (c.text.trim() === "" || !Number.isFinite(v))
      fail(c, `<${name}>: a number is needed, found ${JSON.stringify(c.text.trim().slice(0, 30))}.`);
    return v;
  };
  const metres = (node: XmlNode, name: string): number => {
    const value = number(node, name);
    if (Math.abs(value) > FARTHEST)
      fail(child(node, name), `<${name}>: at most ${FARTHEST} m are possible, found ${value}.`);
    return value;
  };
  const size = (node: XmlNode, name: string): number => {
    const value = metres(node, name);
    if (value < 0) fail(child(node, name), `<${name}>: a size of 0 or more is needed, found ${value}.`);
    return value;
  };
  const bounds = (node: XmlNode): [number, number, number, number] => {
    const x = [metres(node, "xmin"), metres(node, "xmax")];
    const z = [metres(node, "zmin"), metres(node, "zmax")];
    return [Math.min(...x), Math.max(...x), Math.min(...z), Math.max(...z)];
  };
  const isRandom = (node: XmlNode): boolean => maybe(node, "random")?.text.trim() === "true";
  const box = (x0: number, x1: number, z0: number, z1: number): Obstacle => ({
    x: (x0 + x1) / 2,
    z: (z0 + z1) / 2,
    halfX: (x1 - x0) / 2,
    halfZ: (z1 - z0) / 2,
    cos: 1,
    sin: 0,
    round: false,
  });
  const header = maybe(root, "header");
  const named = header && maybe(header, "name");
  if (named) world.name = named.text.trim() || file;
  const edges = header && maybe(header, "worldBounds");
  const whole = edges ? bounds(edges) : ([-50, 50, -50, 50] as [number, number, number, number]);
  /** Regions in which no room was found: asked again, they get few trials, so that crowded cases stay quick to read. */
  const full = new Set<string>();
  const somewhere = ([x0, x1, z0, z1]: [number, number, number, number]): [number, number] => {
    const key = `${x0} ${x1} ${z0} ${z1}`;
    const trials = full.has(key) ? 5 : 2000;
    for (let i = 0; i < trials; i++) {
      const x = r.between(x0, x1);
      const z = r.between(z0, z1);
      const clear =
        world.agents.every((a) => (a.x - x) ** 2 + (a.z - z) ** 2 > 0.5) &&
        world.obstacles.every((o) => !covers(o, x, z, 0.35));
      if (clear) return [x, z];
    }
    full.add(key);
    return [r.between(x0, x1), r.between(z0, z1)];
  };
  const goalsOf = (node: XmlNode): CrowdGoal[] =>
    child(node, "goalSequence").children.flatMap((g): CrowdGoal[] => {
      const speed = maybe(g, "desiredSpeed") ? number(g, "desiredSpeed") : 1.3;
      const lasts = maybe(g, "timeDuration") ? number(g, "timeDuration") : 1e9;
      const base = {
        speed: speed > 0 ? Math.min(2, speed) : 1.3,
        patience: lasts > 0 ? lasts : 1e9,
        box: null,
      };
      if (g.name === "seekStaticTarget") {
        const t = child(g, "targetLocation");
        const [x, z] = isRandom(t) ? somewhere(whole) : [metres(t, "x"), metres(t, "z")];
        return [{ ...base, x, z }];
      }
      if (g.name === "seekAxisAlignedBoxRegion") {
        const b = bounds(child(g, "goalRegionBounds"));
        return [{ ...base, x: (b[0] + b[1]) / 2, z: (b[2] + b[3]) / 2, box: b }];
      }
      world.repairs.push(`${file}, line ${g.line}: <${g.name}> is not followed.`);
      return [];
    });
  const agent = (node: XmlNode, region: [number, number, number, number] | null): CrowdAgent => {
    const initial = child(node, "initialConditions");
    const at = maybe(initial, "position");
    const [x, z] =
      region || !at || isRandom(at) ? somewhere(region ?? whole) : [metres(at, "x"), metres(at, "z")];
    const goals = goalsOf(node);
    const d = maybe(initial, "direction");
    let dx = goals.length > 0 ? goals[0].x - x : 0;
    let dz = goals.length > 0 ? goals[0].z - z : 1;
    if (d && isRandom(d)) {
      const a = r.between(0, 6.283185307179586);
      dx = cosine(a);
      dz = sine(a);
    } else if (d && (metres(d, "x") !== 0 || metres(d, "z") !== 0)) {
      dx = metres(d, "x");
      dz = metres(d, "z");
    }
    const n = Math.sqrt(dx * dx + dz * dz) || 1;
    return { x, z, dirX: dx / n, dirZ: dz / n, goals };
  };
  const addObstacles = (node: XmlNode, more: readonly Obstacle[]): void => {
    if (world.obstacles.length + more.length > MOST_OBSTACLES)
      fail(node, `${more.length} obstacles more, at most ${MOST_OBSTACLES} are possible.`);
    world.obstacles.push(...more);
  };
  for (const node of root.children) {
    switch (node.name) {
      case "obstacle":
        addObstacles(node, [box(...bounds(node))]);
        break;
      case "circleObstacle": {
        const p = child(node, "position");
        const radius = size(node, "radius");
        world.obstacles.push({
          x: metres(p, "x"),
          z: metres(p, "z"),
          halfX: radius,
          halfZ: radius,
          cos: 1,
          sin: 0,
          round: true,
        });
        break;
      }
      case "orientedBoxObstacle":
      case "orientedWallObstacle": {
        const p = child(node, "position");
        const s = child(node, "size");
        const a = (number(node, "thetaY") * Math.PI) / 180;
        const body: Obstacle = {
          x: metres(p, "x"),
          z: metres(p, "z"),
          halfX: size(s, "x") / 2,
          halfZ: size(s, "z") / 2,
          cos: cosine(a),
          sin: sine(a),
          round: false,
        };
        const door = maybe(node, "doorway");
        if (door) addObstacles(node, wallObstacles(body, number(door, "value"), size(door, "doorRadius")));
        else addObstacles(node, [body]);
        break;
      }
      case "polygonObstacle": {
        const corners = node.children
          .filter((v) => v.name === "vertex")
          .map((v): [number, number] => [metres(v, "x"), metres(v, "z")]);
        if (corners.length < 2)
          fail(node, `<polygonObstacle> needs two <vertex> or more, found ${corners.length}.`);
        addObstacles(node, wallsOfPolygon(corners));
        break;
      }
      case "obstacleRegion": {
        const region = bounds(child(node, "regionBounds"));
        const half = size(node, "obstacleSize") / 2;
        const count = size(node, "numObstacles");
        if (world.obstacles.length + count > MOST_OBSTACLES)
          fail(node, `${count} obstacles more, at most ${MOST_OBSTACLES} are possible.`);
        for (let i = 0; i < count; i++) {
          const [x, z] = somewhere(region);
          world.obstacles.push(box(x - half, x + half, z - half, z + half));
        }
        break;
      }
      case "agent":
        world.agents.push(agent(node, null));
        break;
      case "agentRegion": {
        const region = bounds(child(node, "regionBounds"));
        const count = size(node, "numAgents");
        if (world.agents.length + count > MOST_AGENTS)
          fail(node, `${count} agents more, at most ${MOST_AGENTS} are simulated.`);
        for (let i = 0; i < count; i++) world.agents.push(agent(node, region));
        break;
      }
      case "header":
      case "suggestedCameraView":
        break;
      default:
        world.repairs.push(`${file}, line ${node.line}: <${node.name}> is passed over.`);
    }
  }
  if (world.agents.length > MOST_AGENTS)
    throw new CaseError(`${file}: ${world.agents.length} agents, at most ${MOST_AGENTS} are simulated.`);
  repairWorld(world, file);
  return world;
}

function covers(o: Obstacle, x: number, z: number, margin: number): boolean {
  const dx = x - o.x;
  const dz = z - o.z;
  if (o.round) return dx * dx + dz * dz < (o.halfX + margin) ** 2;
  return (
    Math.abs(dx * o.cos - dz * o.sin) < o.halfX + margin &&
    Math.abs(dx * o.sin + dz * o.cos) < o.halfZ + margin
  );
}
