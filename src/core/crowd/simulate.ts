/** A crowd over time: everyone plans as a step ends, so plans are staggered by themselves; places are noted at 20 Hz. */
import { cellOf, clearWay, createGround, type Ground } from "./ground.ts";
import { createStep, createStop, evaluateStep, S, STATE, type Step } from "./locomotion.ts";
import { ahead, createLongWay, extendLongWay, type LongWay } from "./long-way.ts";
import { clearOfWalls, createPlanner, type Planner, planSteps, seeOthers, type Walker } from "./planner.ts";
import { type CrowdWorld, DEFAULT_GAIT, FOOT_RADIUS, type Gait, TICK } from "./types.ts";

/** Radius of the visual field, metres. */
const FIELD = 7;
/** Distance to a goal's point at which it counts as reached, metres. */
const ARRIVED = 0.9;
/** Nodes expanded by a plan: normally, and by one who has not come on for a while. */
const NODES = 70;
const STUCK_NODES = 260;
const STUCK_AFTER = 2.5;

interface Person extends Walker {
  state: Float64Array;
  goal: number;
  way: LongWay | null;
  waySince: number;
  goalSince: number;
  here: boolean;
  /** Best distance so far and when it was made. */
  progress: number;
  progressAt: number;
}

export interface Crowd {
  world: CrowdWorld;
  ground: Ground;
  gait: Gait;
  planner: Planner;
  people: Person[];
  tick: number;
  statistics: CrowdStatistics;
  seen: Int32Array;
  gaps: Float64Array;
  cells: Map<number, number[]>;
  /** Fields of the goals, shared by all who go there. */
  ways: Map<string, LongWay>;
}

export interface CrowdStatistics {
  plans: number;
  expanded: number;
  generated: number;
  worstExpanded: number;
}

export function createCrowd(world: CrowdWorld, gait: Gait = DEFAULT_GAIT): Crowd {
  const ground = createGround(world);
  const ways = new Map<string, LongWay>();
  // First ways are found before anyone walks.
  for (const a of world.agents) if (a.goals.length > 0) wayTo(ground, ways, a.goals[0], a.x, a.z);
  return {
    world,
    ways,
    ground,
    gait,
    planner: createPlanner(gait),
    people: world.agents.map((a, i) => {
      const state = new Float64Array(STATE);
      state[S.x] = a.x;
      state[S.z] = a.z;
      state[S.ux] = a.dirX;
      state[S.uz] = a.dirZ;
      state[S.faceX] = a.dirX;
      state[S.faceZ] = a.dirZ;
      state[S.side] = i & 1 ? -1 : 1;
      state[S.footX] = a.x;
      state[S.footZ] = a.z;
      const step = createStep();
      // Standing at first, some a little longer than others: plans are then spread over the ticks.
      createStop(new Float64Array(STATE), 0, step, state, 0, ((i * 3) % 10) * TICK, gait);
      return {
        state,
        step,
        plan: Array.from({ length: 8 }, createStep),
        planned: 0,
        goal: 0,
        way: null,
        waySince: -1,
        goalSince: 0,
        here: a.goals.length > 0,
        progress: Number.POSITIVE_INFINITY,
        progressAt: 0,
      };
    }),
    tick: 0,
    statistics: { plans: 0, expanded: 0, generated: 0, worstExpanded: 0 },
    seen: new Int32Array(world.agents.length),
    gaps: new Float64Array(world.agents.length),
    cells: new Map(),
  };
}

function wayTo(
  ground: Ground,
  ways: Map<string, LongWay>,
  goal: { x: number; z: number },
  x: number,
  z: number,
): LongWay {
  const name = `${goal.x},${goal.z}`;
  let way = ways.get(name);
  if (!way) {
    way = createLongWay(ground, goal.x, goal.z);
    ways.set(name, way);
  }
  extendLongWay(ground, way, x, z);
  return way;
}

const pose = new Float64Array(4);
const other = new Float64Array(4);

/** One tick of 0.05 s. Returns how many are still on their way. */
export function stepCrowd(crowd: Crowd): number {
  const time = crowd.tick * TICK;
  const { people } = crowd;
  const n = people.length;
  arrive(crowd, time);
  place(crowd, time);
  let left = 0;
  for (let k = 0; k < n; k++) {
    // Who begins changes from tick to tick, so that nobody is always first.
    const i = (k + crowd.tick * 7) % n;
    const person = people[i];
    if (!person.here) continue;
    left++;
    if (person.step.start + person.step.duration > time + 1e-6) continue;
    person.state[S.time] = time;
    plan(crowd, i, time);
  }
  crowd.tick++;
  return left;
}

function arrive(crowd: Crowd, time: number): void {
  crowd.people.forEach((person, i) => {
    if (!person.here) return;
    const goal = crowd.world.agents[i].goals[person.goal];
    evaluateStep(pose, 0, person.step, time);
    let reached: boolean;
    if (goal.box) {
      const [x0, x1, z0, z1] = goal.box;
      const dx = Math.max(x0 - pose[0], 0, pose[0] - x1);
      const dz = Math.max(z0 - pose[1], 0, pose[1] - z1);
      reached = dx * dx + dz * dz < 0.0225;
    } else {
      const dx = pose[0] - goal.x;
      const dz = pose[1] - goal.z;
      reached = dx * dx + dz * dz < ARRIVED * ARRIVED;
    }
    if (!reached && time - person.goalSince < goal.patience) return;
    person.goal++;
    person.goalSince = time;
    person.way = null;
    person.progress = Number.POSITIVE_INFINITY;
    if (person.goal >= crowd.world.agents[i].goals.length) person.here = false;
  });
}

const LOOKUP = 3.5;
const key = (x: number, z: number): number =>
  (Math.floor(x / LOOKUP) + 5000) * 16384 + Math.floor(z / LOOKUP) + 5000;

/** Everyone into cells, where they are now. */
function place(crowd: Crowd, time: number): void {
  crowd.cells.clear();
  crowd.people.forEach((person, i) => {
    if (!person.here) return;
    evaluateStep(pose, 0, person.step, time);
    const k = key(pose[0], pose[1]);
    const list = crowd.cells.get(k);
    if (list) list.push(i);
    else crowd.cells.set(k, [i]);
  });
}

/** Fills crowd.seen with the others in sight, nearest first; those behind a walker's back and far off are not seen. */
function look(crowd: Crowd, i: number, time: number): number {
  const person = crowd.people[i];
  const { seen, gaps } = crowd;
  const x = person.state[S.x];
  const z = person.state[S.z];
  const cx = Math.floor(x / LOOKUP);
  const cz = Math.floor(z / LOOKUP);
  let count = 0;
  for (let a = cx - 2; a <= cx + 2; a++)
    for (let b = cz - 2; b <= cz + 2; b++) {
      const list = crowd.cells.get((a + 5000) * 16384 + b + 5000);
      if (!list) continue;
      for (const k of list) {
        if (k === i) continue;
        evaluateStep(other, 0, crowd.people[k].step, time);
        const dx = other[0] - x;
        const dz = other[1] - z;
        let d = Math.sqrt(dx * dx + dz * dz);
        const front = dx * person.state[S.faceX] + dz * person.state[S.faceZ];
        if (d > FIELD || (front < -0.5 && d > 2)) continue;
        // Who is in front counts as nearer.
        if (front < 0) d += 0.6;
        let at = count++;
        while (at > 0 && gaps[at - 1] > d) {
          gaps[at] = gaps[at - 1];
          seen[at] = seen[at - 1];
          at--;
        }
        gaps[at] = d;
        seen[at] = k;
      }
    }
  return count;
}

function plan(crowd: Crowd, i: number, time: number): void {
  const { planner, ground, statistics } = crowd;
  const person = crowd.people[i];
  const goal = crowd.world.agents[i].goals[person.goal];
  const { state } = person;
  if (!person.way || (time - person.waySince > 2 && strayed(ground, person.way, state))) {
    person.way = wayTo(ground, crowd.ways, goal, state[S.x], state[S.z]);
    person.waySince = time;
  }
  const { x: aimX, z: aimZ, distance } = ahead(ground, person.way, state[S.x], state[S.z]);
  if (distance < person.progress - 0.3) {
    person.progress = distance;
    person.progressAt = time;
  }
  const stuck = time - person.progressAt > STUCK_AFTER;
  const count = look(crowd, i, time);
  const way = stuck ? (giveWay(i, time - person.progressAt, state, aimX, aimZ) ?? person.way) : person.way;
  seeOthers(planner, crowd.people, crowd.seen, count, time);
  pose[0] = state[S.x];
  pose[1] = state[S.z];
  pose[2] = state[S.faceX];
  pose[3] = state[S.faceZ];
  const found = planSteps(planner, state, 0, {
    ground,
    way,
    speed: goal.speed,
    tolerance: ARRIVED * 0.8,
    most: stuck ? STUCK_NODES : NODES,
    inWall: !clearOfWalls(ground, pose, 0),
  });
  statistics.plans++;
  statistics.expanded += planner.expanded;
  statistics.generated += planner.generated;
  statistics.worstExpanded = Math.max(statistics.worstExpanded, planner.expanded);
  if (!found) {
    // Resting is what all others have left room for.
    createStop(state, 0, person.step, state.slice(), 0, 0.4, crowd.gait);
    person.planned = 0;
    return;
  }
  const first = planner.path[0];
  Object.assign(person.step, planner.steps[first]);
  for (let k = 0; k < STATE; k++) state[k] = planner.states[first * STATE + k];
  person.planned = Math.min(person.plan.length, planner.pathLength - 1);
  for (let k = 0; k < person.planned; k++) Object.assign(person.plan[k], planner.steps[planner.path[k + 1]]);
}

const aside: LongWay = createAside();

function createAside(): LongWay {
  return {
    goalX: 0,
    goalZ: 0,
    cornerOf: new Map(),
    corners: [],
    cost: new Map(),
    parent: new Map(),
    cornerIndex: new Map(),
    open: new Set(),
    from: -1,
    exhausted: true,
  };
}

/** Time in which one who is stuck keeps to a choice, seconds. */
const CHOICE = 1.6;

/**
 * Two who wait for each other would wait for ever: one who has not come on takes turns, by its number and the time, to make
 * room: back, or to a side. Null while it goes on trying.
 */
function giveWay(i: number, since: number, state: Float64Array, aimX: number, aimZ: number): LongWay | null {
  const turn = Math.floor((since - STUCK_AFTER) / CHOICE);
  // A small integer hash: the same everywhere.
  const hash = ((i * 73 + turn * 151 + 7) * 2654435761) >>> 16;
  if (hash % 3 !== 0) return null;
  const dx = aimX - state[S.x];
  const dz = aimZ - state[S.z];
  const n = Math.sqrt(dx * dx + dz * dz) || 1;
  const [back, side] = [
    [-1, 0],
    [-0.5, 0.8],
    [-0.5, -0.8],
    [0, 1],
  ][(hash >> 2) % 4];
  aside.goalX = state[S.x] + (2 * (back * dx + side * dz)) / n;
  aside.goalZ = state[S.z] + (2 * (back * dz - side * dx)) / n;
  return aside;
}

/** Whether a walker has come where its way's field does not reach. */
function strayed(ground: Ground, way: LongWay, state: Float64Array): boolean {
  if (way.cornerOf.size > 0) return !way.cornerOf.has(cellOf(ground, state[S.x], state[S.z]));
  return !clearWay(ground, state[S.x], state[S.z], way.goalX, way.goalZ, 1);
}

export interface CrowdFootstep {
  agent: number;
  side: number;
  x: number;
  z: number;
  /** Direction of the parabola, unit. */
  dirX: number;
  dirZ: number;
  start: number;
  land: number;
}

export interface CrowdTrack {
  dt: number;
  /** frames x agents: [x, z] or null. */
  positions: ([number, number] | null)[][];
  /** Facing, unit vectors: angles are made for files alone. */
  facing: ([number, number] | null)[][];
  feet: ([number, number, number][] | null)[][];
  footsteps: CrowdFootstep[];
  statistics: CrowdStatistics;
  arrived: number;
}

/** Runs a crowd until all have arrived or `seconds` are over. */
export function simulateCrowd(
  world: CrowdWorld,
  seconds: number,
  hooks: { tick?: (tick: number, left: number) => boolean } = {},
): CrowdTrack {
  const crowd = createCrowd(world);
  const track: CrowdTrack = {
    dt: TICK,
    positions: [],
    facing: [],
    feet: [],
    footsteps: [],
    statistics: crowd.statistics,
    arrived: 0,
  };
  const noted: (Step | null)[] = world.agents.map(() => null);
  const starts = new Float64Array(world.agents.length).fill(-1);
  const round = (v: number): number => Math.round(v * 1e5) / 1e5;
  for (let t = 0; t <= seconds / TICK; t++) {
    const left = stepCrowd(crowd);
    const time = t * TICK;
    const positions: ([number, number] | null)[] = [];
    const facing: ([number, number] | null)[] = [];
    const feet: ([number, number, number][] | null)[] = [];
    crowd.people.forEach((person, i) => {
      if (!person.here) {
        positions.push(null);
        facing.push(null);
        feet.push(null);
        return;
      }
      evaluateStep(pose, 0, person.step, time);
      positions.push([round(pose[0]), round(pose[1])]);
      facing.push([pose[2], pose[3]]);
      const { step } = person;
      feet.push(step.kind === 1 ? [[round(step.footX), round(step.footZ), FOOT_RADIUS]] : []);
      if (step.kind === 1 && starts[i] !== step.start) {
        starts[i] = step.start;
        noted[i] = step;
        track.footsteps.push({
          agent: i,
          side: step.side,
          x: round(step.footX),
          z: round(step.footZ),
          dirX: step.px,
          dirZ: step.pz,
          start: round(step.start),
          land: round(step.start + step.duration),
        });
      }
    });
    track.positions.push(positions);
    track.facing.push(facing);
    track.feet.push(feet);
    if (left === 0 || hooks.tick?.(t, left) === false) break;
  }
  track.arrived = crowd.people.filter((q) => !q.here).length;
  return track;
}
