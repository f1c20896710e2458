/**
 * A crowd over time, tick by tick at 20 Hz: everyone plans as a step ends, so plans are staggered by themselves. One who planned lately
 * and sees nothing new goes on with the plan. What a tick may search is limited by nodes, never by a clock, so that it
 * neither stalls nor depends on the machine: beyond the limit plans are kept, or walkers stop in place.
 */
import { clearOfWalls } from "./bodies.ts";
import { createWish, giveWay, goesFirst, STUCK_AFTER, type Wish } from "./give-way.ts";
import { createGround, type Ground } from "./ground.ts";
import { costOfStep, seeOthers, startJudging } from "./judge.ts";
import { createStop } from "./locomotion.ts";
import { ahead, covers, createLongWay, extendLongWay, type LongWay } from "./long-way.ts";
import { createNeighbours, look, type Neighbours, placeAll } from "./neighbours.ts";
import { createPlanner, energyPerMetre, type Planner, planSteps, type Search } from "./planner.ts";
import { boundAt, createSight, noteSteps, PLAN, type Sight } from "./sight.ts";
import { KIND, P, POSE, S, STATE, STEP } from "./state.ts";
import { type CrowdWorld, DEFAULT_GAIT, type Gait, TICK } from "./types.ts";
import { chooseYaw } from "./yaw-interval.ts";

/** Distance to a goal's point at which it counts as reached, and from a goal's box, metres. */
const ARRIVED = 0.9;
const ARRIVED_BOX = 0.15;
/** Nodes expanded by a plan: normally, and by one who has not come on for a while. */
const NODES = 50;
const STUCK_NODES = 80;
/** Steps taken from one plan before the next search, and how much dearer the rest may have become, J/kg. */
const KEPT = 1;
const DEARER = 0.1;
/** Nodes that a tick may expand: at least, and for each agent. */
const TICK_NODES = 800;
const TICK_NODES_EACH = 7;
/** What nearness counts to one who goes first on the same way, and to one who comes after. */
const AHEAD = 3;
const BEHIND = 0.5;
/** Time lost until a walker is under way, seconds; and what standing costs one who is stuck over what it takes. */
const UNDER_WAY = 0.3;
const IMPATIENCE = 2;
/** Cells of long ways that a tick may look at. */
const TICK_CELLS = 1500;

export interface Person {
  gait: Gait;
  goal: number;
  way: LongWay | null;
  waySince: number;
  goalSince: number;
  here: boolean;
  /** Best distance so far and when it was made. */
  progress: number;
  progressAt: number;
  /** Steps planned after the one under way, and how many were taken without a search. */
  planned: number;
  kept: number;
  /** Energy of a metre of normal steps at `perMetreSpeed`. */
  perMetre: number;
  perMetreSpeed: number;
}

export interface CrowdOptions {
  /** Looks one step ahead only, to compare with [Footsteps §4]. */
  greedy?: boolean;
}

export interface Crowd {
  world: CrowdWorld;
  ground: Ground;
  options: CrowdOptions;
  planner: Planner;
  people: Person[];
  wishes: Wish[];
  /** STATE numbers each: where the step under way leads. */
  states: Float64Array;
  /** 1 + PLAN steps each: under way, then planned; and the states after the planned ones. */
  steps: Float64Array;
  planStates: Float64Array;
  sight: Sight;
  neighbours: Neighbours;
  tick: number;
  /** Nodes and cells left in this tick. */
  nodesLeft: number;
  cellsLeft: number;
  search: Search | null;
  statistics: CrowdStatistics;
  /** Fields of the goals, shared by all who go there. */
  ways: Map<string, LongWay>;
  /** Called with each agent that takes a step. */
  onStep: ((agent: number) => void) | null;
}

export interface CrowdStatistics {
  /** Searches; steps taken from an earlier plan; stops because a tick's nodes were used up. */
  plans: number;
  kept: number;
  putOff: number;
  expanded: number;
  judgements: number;
  generated: number;
  worstExpanded: number;
  worstGenerated: number;
  /** Energy of all steps taken, J/kg [Footsteps eqs. 14-16]. */
  fixedEnergy: number;
  speedEnergy: number;
  bendEnergy: number;
}

const pose = new Float64Array(POSE);
const local = new Float64Array(3);

/** Steps of agent `i` from here on in `crowd.steps`. */
export const stepsOf = (i: number): number => i * (1 + PLAN) * STEP;

/** A crowd at rest at its start. First ways are found before anyone walks. */
export function createCrowd(world: CrowdWorld, options: CrowdOptions = {}): Crowd {
  const n = world.agents.length;
  const crowd: Crowd = {
    world,
    ground: createGround(world),
    options,
    planner: createPlanner(),
    people: [],
    wishes: world.agents.map(createWish),
    states: new Float64Array(n * STATE),
    steps: new Float64Array(n * (1 + PLAN) * STEP),
    planStates: new Float64Array(n * PLAN * STATE),
    sight: createSight(n),
    neighbours: createNeighbours(n),
    tick: 0,
    nodesLeft: 0,
    cellsLeft: 0,
    search: null,
    statistics: {
      plans: 0,
      kept: 0,
      putOff: 0,
      expanded: 0,
      judgements: 0,
      generated: 0,
      worstExpanded: 0,
      worstGenerated: 0,
      fixedEnergy: 0,
      speedEnergy: 0,
      bendEnergy: 0,
    },
    ways: new Map(),
    onStep: null,
  };
  world.agents.forEach((a, i) => {
    const gait: Gait = { ...DEFAULT_GAIT, ...a.gait };
    const o = i * STATE;
    crowd.states[o + S.x] = a.x;
    crowd.states[o + S.z] = a.z;
    crowd.states[o + S.ux] = crowd.states[o + S.faceX] = crowd.states[o + S.headX] = a.dirX;
    crowd.states[o + S.uz] = crowd.states[o + S.faceZ] = crowd.states[o + S.headZ] = a.dirZ;
    crowd.states[o + S.side] = i & 1 ? -1 : 1;
    // Standing at first, some a little longer than others: plans are then spread over the ticks.
    createStop(crowd.states, o, crowd.steps, stepsOf(i), crowd.states, o, ((i * 3) % 10) * TICK, gait);
    noteSteps(crowd.sight, i, crowd.steps, stepsOf(i), 0, 0, gait.footAside);
    crowd.people.push({
      gait,
      goal: 0,
      way: a.goals.length > 0 ? wayTo(crowd, a.goals[0], a.x, a.z, Number.POSITIVE_INFINITY) : null,
      waySince: 0,
      goalSince: 0,
      here: a.goals.length > 0,
      progress: Number.POSITIVE_INFINITY,
      progressAt: 0,
      planned: 0,
      kept: 0,
      perMetre: 0,
      perMetreSpeed: -1,
    });
  });
  return crowd;
}

/** Other walls, surfaces and goals for the same agents, who find their ways anew from where they are. */
export function changeGround(crowd: Crowd, world: CrowdWorld): void {
  crowd.world = world;
  crowd.ground = createGround(world);
  crowd.ways.clear();
  for (const person of crowd.people) {
    person.way = null;
    person.planned = 0;
    person.progress = Number.POSITIVE_INFINITY;
    person.progressAt = crowd.tick * TICK;
  }
}

/** The field of a goal, carried on to a start as far as `cells` go. */
function wayTo(crowd: Crowd, goal: { x: number; z: number }, x: number, z: number, cells: number): LongWay {
  const name = `${goal.x},${goal.z}`;
  let way = crowd.ways.get(name);
  if (!way) {
    way = createLongWay(crowd.ground, goal.x, goal.z);
    crowd.ways.set(name, way);
  }
  if (cells === Number.POSITIVE_INFINITY) extendLongWay(crowd.ground, way, x, z);
  else if (cells > 0) extendLongWay(crowd.ground, way, x, z, cells);
  return way;
}

/** One tick of 0.05 s. Returns how many are still on their way. */
export function stepCrowd(crowd: Crowd): number {
  const { people, tick, steps, sight } = crowd;
  const n = people.length;
  const time = tick * TICK;
  crowd.nodesLeft = Math.max(TICK_NODES, TICK_NODES_EACH * n);
  crowd.cellsLeft = TICK_CELLS;
  arrive(crowd, time);
  placeAll(crowd.neighbours, sight, people, tick);
  let left = 0;
  // Who begins changes from tick to tick, so that nobody is always first.
  let i = n === 0 ? 0 : (tick * 7) % n;
  for (let k = 0; k < n; k++, i = i + 1 === n ? 0 : i + 1) {
    if (!people[i].here) continue;
    left++;
    const p = stepsOf(i);
    if (steps[p + P.start] + steps[p + P.duration] > time + 1e-6) continue;
    crowd.states[i * STATE + S.time] = time;
    takeStep(crowd, i, time);
    crowd.onStep?.(i);
  }
  crowd.tick++;
  return left;
}

function arrive(crowd: Crowd, time: number): void {
  const { people, sight, world } = crowd;
  for (let i = 0; i < people.length; i++) {
    const person = people[i];
    if (!person.here) continue;
    const goal = world.agents[i].goals[person.goal];
    const o = boundAt(sight, i, crowd.tick);
    const x = sight.bound[o];
    const z = sight.bound[o + 1];
    let reached: boolean;
    if (goal.box) {
      const [x0, x1, z0, z1] = goal.box;
      const dx = Math.max(x0 - x, 0, x - x1);
      const dz = Math.max(z0 - z, 0, z - z1);
      reached = dx * dx + dz * dz < ARRIVED_BOX * ARRIVED_BOX;
    } else {
      const dx = x - goal.x;
      const dz = z - goal.z;
      reached = dx * dx + dz * dz < ARRIVED * ARRIVED;
    }
    if (!reached && time - person.goalSince < goal.patience) continue;
    person.goal++;
    person.goalSince = time;
    person.way = null;
    person.planned = 0;
    person.progress = Number.POSITIVE_INFINITY;
    person.progressAt = time;
    if (person.goal >= world.agents[i].goals.length) person.here = false;
  }
}

/** The search of a walker, with the numbers of its gait and goal. */
function searchOf(crowd: Crowd, i: number, way: LongWay, stuck: boolean, time: number): Search {
  const { ground, states } = crowd;
  const person = crowd.people[i];
  const goal = crowd.world.agents[i].goals[person.goal];
  if (person.perMetreSpeed !== goal.speed) {
    person.perMetre = energyPerMetre(person.gait, goal.speed);
    person.perMetreSpeed = goal.speed;
  }
  const s = i * STATE;
  pose[0] = states[s + S.x];
  pose[1] = states[s + S.z];
  pose[2] = states[s + S.faceX];
  pose[3] = states[s + S.faceZ];
  pose[4] = pose[0];
  pose[5] = pose[1];
  crowd.search ??= {
    ground,
    way,
    gait: person.gait,
    speed: 0,
    tolerance: 0,
    most: 0,
    inWall: false,
    perMetre: 0,
    underWay: 0,
    impatience: 1,
    time: 0,
  };
  const { search } = crowd;
  search.ground = ground;
  search.way = way;
  search.gait = person.gait;
  search.speed = goal.speed;
  search.tolerance = goal.box ? 0.1 : ARRIVED * 0.8;
  search.most = crowd.options.greedy ? 1 : Math.min(crowd.nodesLeft, stuck ? STUCK_NODES : NODES);
  search.inWall = !clearOfWalls(ground, pose, 0);
  search.perMetre = person.perMetre;
  search.underWay = 0.5 * goal.speed * goal.speed + person.gait.power * UNDER_WAY;
  search.impatience = stuck ? IMPATIENCE : 1;
  search.time = time;
  return search;
}

/** Sees to the way: found, carried on where a walker has strayed from it, given up for a while by who is stuck. */
function wayOf(crowd: Crowd, i: number, time: number): LongWay {
  const { ground, states } = crowd;
  const person = crowd.people[i];
  const goal = crowd.world.agents[i].goals[person.goal];
  const x = states[i * STATE + S.x];
  const z = states[i * STATE + S.z];
  const strayed =
    person.way !== null &&
    time - person.waySince > 2 &&
    !(person.way.bent && covers(ground, person.way, x, z));
  if (!person.way || strayed) {
    const before = person.way?.bent ?? false;
    person.way = wayTo(crowd, goal, x, z, crowd.cellsLeft);
    if (person.way.bent || before) crowd.cellsLeft -= TICK_CELLS / 3;
    person.waySince = time;
  }
  ahead(local, ground, person.way, states, i * STATE);
  if (local[2] < person.progress - 0.3) {
    person.progress = local[2];
    person.progressAt = time;
  }
  const dx = local[0] - x;
  const dz = local[1] - z;
  const d = Math.sqrt(dx * dx + dz * dz);
  if (d > 1e-6) {
    crowd.wishes[i].aimX = dx / d;
    crowd.wishes[i].aimZ = dz / d;
  }
  return person.way;
}

/** What a walker sees and wants as its step ends: the search to be made, and whether it has waited long or makes room. */
function prepare(crowd: Crowd, i: number, time: number): { search: Search; stuck: boolean } {
  const { planner, states, neighbours, wishes } = crowd;
  const { others } = planner;
  const person = crowd.people[i];
  const tick = Math.round(time / TICK);
  const way = wayOf(crowd, i, time);
  const s = i * STATE;
  const x = states[s + S.x];
  const z = states[s + S.z];
  const count = look(neighbours, i, states, s, person.gait);
  seeOthers(others, crowd.sight, neighbours.seen, count, tick);
  for (let k = 0; k < others.count; k++) {
    const other = neighbours.seen[k];
    const dx = neighbours.places[2 * other] - x;
    const dz = neighbours.places[2 * other + 1] - z;
    others.weight[k] = goesFirst(wishes, i, other, dx, dz)
      ? AHEAD
      : goesFirst(wishes, other, i, -dx, -dz)
        ? BEHIND
        : 1;
  }
  const waited = time - person.progressAt;
  const aside = giveWay(crowd.ground, wishes, neighbours, count, i, time, waited, x, z);
  // Who made room begins to wait anew.
  if (aside !== null) person.progress = Number.POSITIVE_INFINITY;
  const stuck = waited > STUCK_AFTER || aside !== null;
  return { search: searchOf(crowd, i, aside ?? way, stuck, time), stuck };
}

/**
 * Searches for an agent as it will when its step ends, but takes no step: what the planner holds then can be looked at.
 *
 * @returns whether anything is free.
 */
export function searchAgain(crowd: Crowd, i: number): boolean {
  const { states, people, wishes } = crowd;
  const person = { ...people[i] };
  const wish = { ...wishes[i] };
  crowd.nodesLeft = STUCK_NODES;
  crowd.cellsLeft = 0;
  placeAll(crowd.neighbours, crowd.sight, people, crowd.tick);
  const { search } = prepare(crowd, i, states[i * STATE + S.time]);
  const found = planSteps(crowd.planner, states, i * STATE, search);
  Object.assign(people[i], person);
  Object.assign(wishes[i], wish);
  return found;
}

/** The next step of a walker whose step has ended: from the plan where it still holds, else searched for. */
function takeStep(crowd: Crowd, i: number, time: number): void {
  const { planner, statistics, states } = crowd;
  const person = crowd.people[i];
  const { search, stuck } = prepare(crowd, i, time);
  const spent = search.most <= 0;
  if (
    (spent || (person.kept < KEPT && !stuck && !crowd.options.greedy)) &&
    keepPlan(crowd, i, search, spent)
  ) {
    statistics.kept++;
    return;
  }
  if (spent || !planSteps(planner, states, i * STATE, search)) {
    if (spent) statistics.putOff++;
    // Resting is what all others have left room for.
    const p = stepsOf(i);
    const s = i * STATE;
    createStop(states, s, crowd.steps, p, states.slice(s, s + STATE), 0, 0.4, person.gait);
    person.planned = 0;
  } else commit(crowd, i);
  person.kept = 0;
  taken(crowd, i);
  if (spent) return;
  statistics.plans++;
  statistics.expanded += planner.expanded;
  statistics.judgements += planner.judgements;
  statistics.generated += planner.generated;
  statistics.worstExpanded = Math.max(statistics.worstExpanded, planner.expanded);
  statistics.worstGenerated = Math.max(statistics.worstGenerated, planner.generated);
  crowd.nodesLeft -= planner.expanded;
}

/** What every step taken leaves behind: energy, and poses for the others to see. */
function taken(crowd: Crowd, i: number): void {
  const { steps, statistics } = crowd;
  const p = stepsOf(i);
  statistics.fixedEnergy += steps[p + P.fixedEnergy];
  statistics.speedEnergy += steps[p + P.speedEnergy];
  statistics.bendEnergy += steps[p + P.bendEnergy];
  noteSteps(crowd.sight, i, steps, p, crowd.people[i].planned, crowd.tick, crowd.people[i].gait.footAside);
}

/** Takes the next step of the plan when it is free and what follows has not become dearer; `any`: when it is free. */
function keepPlan(crowd: Crowd, i: number, search: Search, any: boolean): boolean {
  const person = crowd.people[i];
  if (person.planned < (any ? 1 : 3)) return false;
  const { planner, states, steps, planStates } = crowd;
  const p = stepsOf(i);
  startJudging(planner.others, states, i * STATE);
  let before = 0;
  let now = 0;
  for (let k = 1; k <= (any ? 1 : person.planned); k++) {
    const extra = costOfStep(planner.others, steps, p + k * STEP, k === 1, search);
    if (extra < 0) return false;
    before += steps[p + k * STEP + P.nearness];
    now += extra;
    if (!any && now > before + DEARER) return false;
  }
  steps.copyWithin(p, p + STEP, p + (1 + person.planned) * STEP);
  const q = i * PLAN * STATE;
  states.set(planStates.subarray(q, q + STATE), i * STATE);
  planStates.copyWithin(q, q + STATE, q + person.planned * STATE);
  person.planned--;
  person.kept++;
  fixYaw(crowd, i);
  taken(crowd, i);
  return true;
}

/** Takes the first step of the planner's path, and keeps the rest as the plan. */
function commit(crowd: Crowd, i: number): void {
  const { planner, states, steps, planStates } = crowd;
  const person = crowd.people[i];
  const p = stepsOf(i);
  const count = Math.min(PLAN + 1, planner.pathLength);
  for (let k = 0; k < count; k++) {
    const node = planner.path[k];
    for (let m = 0; m < STEP; m++) steps[p + k * STEP + m] = planner.steps[node * STEP + m];
    const to = k === 0 ? states : planStates;
    const o = k === 0 ? i * STATE : (i * PLAN + k - 1) * STATE;
    for (let m = 0; m < STATE; m++) to[o + m] = planner.states[node * STATE + m];
  }
  person.planned = count - 1;
  fixYaw(crowd, i);
}

/** The planted foot's exact yaw, now that the step after it is planned [Footsteps §4.1]. From then on it is fixed. */
function fixYaw(crowd: Crowd, i: number): void {
  const { steps, states } = crowd;
  const person = crowd.people[i];
  const p = stepsOf(i);
  if (steps[p + P.kind] !== KIND.walk) return;
  const n = p + STEP;
  const next =
    person.planned > 0 && steps[n + P.kind] === KIND.walk
      ? { inner: steps[n + P.inner], outer: steps[n + P.outer], theta: steps[n + P.theta] }
      : null;
  const yaw = chooseYaw(
    steps[p + P.inner],
    steps[p + P.outer],
    steps[p + P.theta],
    next,
    person.gait.yawRange,
  );
  steps[p + P.yaw] = yaw;
  states[i * STATE + S.inner] = yaw;
  states[i * STATE + S.outer] = yaw;
}
