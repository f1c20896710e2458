/**
 * The last steps of a walk, from where it is near to the stance that an entry begins from [TaskLoco §5.5, Enter Task
 * Preparation: "additional locomotion footsteps may be introduced"].
 *
 * A stance is a place and a way to face, and which foot stands; straight walking does not lead into any stance but one ahead.
 * So the captures' own walking and turning steps are tried one after the other, a beam of the best sequences kept: each
 * continues where the one before has left both feet, and is charged for what it would have to be warped. What is left at the
 * end is for the optimiser.
 */
import { wrapAngle } from "../math/angle.ts";
import { type GroundPose, toLocal, toWorld } from "../math/frame2.ts";
import { ledBetween } from "../motion/task-windows.ts";
import type { Skeleton } from "../skeleton/skeleton.ts";
import type { Foot } from "../steps/types.ts";
import type { Library } from "../templates/types.ts";
import { type DraftStep, type Feet, footPose, otherFoot, stanceBefore } from "./draft.ts";
import { carriedAt } from "./locomotion.ts";
import { pivotEnd } from "./pivots.ts";
import { type Obstacle, obstacleDistance } from "./route.ts";
import { footInside } from "./tidy.ts";

/** A capture's step seen from the standing foot: where its foot comes from and goes to. */
interface Move {
  clip: number;
  step: number;
  from: GroundPose;
  to: GroundPose;
  turns: boolean;
}

/** Moves of one foot with free hands or with a box. */
type Moves = Record<Foot, Move[]>;

/** Most moves of a foot that are tried: spread over what the captures have. */
const MOST_MOVES = 36;
/** Sequences kept, and their greatest length. */
const BEAM = 20;
const DEPTH = 9;
/** Costs: a step; warping by half a metre, twice that; a place in furniture. */
const STEP = 0.2;
const WARP = 0.7;
const BLOCKED = 1.5;
/** Furniture farther than this from both ends is not looked at, metres. */
const NEAR = 2.5;
/** A step that turns, beside one that walks. */
const TURNS = 0.07;
/** What is left at the end, a metre and a radian: the standing foot, and the other. */
const LEFT = 2.4;
const LEFT_TURN = 0.9;
const OTHER = 1.0;
/** What is thought to be left, a metre. */
const WAY = 0.42;
/** Moves that would be warped more are not tried, metres. */
const MOST_WARP = 0.55;
/** A radian counts as so many metres. */
const TURN = 0.3;

const cache = new WeakMap<Library, { free: Moves; carrying: Moves }>();

function movesOf(library: Library): { free: Moves; carrying: Moves } {
  let found = cache.get(library);
  if (!found) {
    const all: { free: Moves; carrying: Moves } = {
      free: { left: [], right: [] },
      carrying: { left: [], right: [] },
    };
    library.clips.forEach((source, clip) => {
      source.steps.forEach((s, step) => {
        if (s.category !== "Walk" && s.category !== "TurnAndStep") return;
        // A step is played from the landing before it; arms on their way from a board or to a box belong to that task.
        if (ledBetween(source.tasks, source.steps[step - 1]?.end ?? s.start, s.end)) return;
        const feet = stanceBefore(source, step);
        const stance = footPose(feet[otherFoot(s.foot)]);
        const list = carriedAt(library, clip, s.start) ? all.carrying : all.free;
        list[s.foot].push({
          clip,
          step,
          from: toLocal(stance, footPose(feet[s.foot])),
          to: toLocal(stance, footPose(s.to)),
          turns: s.category === "TurnAndStep",
        });
      });
    });
    for (const moves of [all.free, all.carrying])
      for (const foot of ["left", "right"] as const) moves[foot] = spread(moves[foot]);
    found = all;
    cache.set(library, found);
  }
  return found;
}

const apart = (a: GroundPose, b: GroundPose): number =>
  Math.hypot(a.x - b.x, a.z - b.z) + TURN * Math.abs(wrapAngle(a.yaw - b.yaw));

/** The moves farthest from each other, one after the other. */
function spread(moves: Move[]): Move[] {
  const out: Move[] = [];
  const nearest = moves.map(() => Number.POSITIVE_INFINITY);
  let next = 0;
  while (out.length < Math.min(MOST_MOVES, moves.length)) {
    const chosen = moves[next];
    out.push(chosen);
    let best = -1;
    moves.forEach((m, i) => {
      nearest[i] = Math.min(nearest[i], apart(m.to, chosen.to) + 0.5 * apart(m.from, chosen.from));
      if (best < 0 || nearest[i] > nearest[best]) best = i;
    });
    next = best;
  }
  return out;
}

interface Node {
  feet: Record<Foot, GroundPose>;
  last: Foot | null;
  cost: number;
  before: Node | null;
  move: Move | null;
}

/** A step more, not yet chosen; `score` is what the whole way is thought to cost. */
interface Child {
  parent: Node;
  move: Move;
  foot: Foot;
  to: GroundPose;
  cost: number;
  score: number;
}

/** Keeps the list in order and no longer than the beam. */
function insert(list: Child[], child: Child): void {
  let i = list.length;
  while (i > 0 && list[i - 1].score > child.score) i--;
  list.splice(i, 0, child);
  if (list.length > BEAM) list.pop();
}

/** Where an approach ends: the foot that stands and the other, and the body's way. */
export interface ApproachGoal {
  stanceFoot: Foot;
  stance: Feet;
}

/**
 * Walking and turning steps from the present feet to a stance; none where it is best taken as it is.
 *
 * @param last the foot that landed last; null when both have stood for a while.
 * @param wished the foot that the user asks for as step `k` of the approach, where there is one.
 */
export function approach(
  library: Library,
  feet: Feet,
  last: Foot | null,
  goal: ApproachGoal,
  carrying: boolean,
  obstacles: readonly Obstacle[],
  skeleton: Skeleton,
  wished: (k: number) => Foot | undefined = () => undefined,
): DraftStep[] {
  const all = movesOf(library);
  const moves = carrying && all.carrying.left.length > 4 ? all.carrying : all.free;
  const aim = footPose(goal.stance[goal.stanceFoot]);
  const swing = otherFoot(goal.stanceFoot);
  const there = footPose(goal.stance[swing]);
  const near = obstacles.filter(
    (o) => obstacleDistance(o, aim.x, aim.z) < NEAR || obstacleDistance(o, feet.left.x, feet.left.z) < NEAR,
  );
  const start: Node = {
    feet: { left: footPose(feet.left), right: footPose(feet.right) },
    last,
    cost: 0,
    before: null,
    move: null,
  };
  const wrong = last === swing ? 0.35 : 0;
  // A foot asked for on the way is not got round by ending before it.
  let least = 0;
  for (let k = 0; k < DEPTH - 1; k++) if (wished(k) !== undefined) least = k + 1;
  let best = start;
  let bestTotal =
    least > 0 ? Number.POSITIVE_INFINITY : wrong + remaining(start.feet, goal.stanceFoot, aim, there);
  let beam = [start];
  for (let depth = 1; depth <= DEPTH && beam.length > 0; depth++) {
    const children: Child[] = [];
    let worst = bestTotal;
    for (const parent of beam) {
      for (const foot of ["left", "right"] as const) {
        const asked = wished(depth - 1);
        if (asked === undefined ? parent.last === foot : foot !== asked) continue;
        const stance = parent.feet[otherFoot(foot)];
        const own = toLocal(stance, parent.feet[foot]);
        const target = foot === goal.stanceFoot ? aim : there;
        const c = Math.cos(stance.yaw);
        const s = Math.sin(stance.yaw);
        for (const move of moves[foot]) {
          const warp = apart(own, move.from);
          if (warp > MOST_WARP) continue;
          let cost = parent.cost + STEP + 2 * WARP * warp * warp + (move.turns ? TURNS : 0);
          if (cost >= worst) continue;
          const x = stance.x + c * move.to.x + s * move.to.z;
          const z = stance.z - s * move.to.x + c * move.to.z;
          const d = Math.hypot(x - target.x, z - target.z);
          if (cost + WAY * d >= worst) continue;
          const to = { x, z, yaw: wrapAngle(stance.yaw + move.to.yaw) };
          if (near.length > 0 && footInside(near, to, skeleton)) cost += BLOCKED;
          const score = cost + WAY * d + 0.12 * facing(to, target, d);
          if (score >= worst) continue;
          insert(children, { parent, move, foot, to, cost, score });
          if (children.length === BEAM) worst = children[BEAM - 1].score;
        }
      }
    }
    beam = children.map(({ parent, move, foot, to, cost }) => ({
      feet: foot === "left" ? { left: to, right: parent.feet.right } : { left: parent.feet.left, right: to },
      last: foot,
      cost,
      before: parent,
      move,
    }));
    for (const node of beam) {
      if (node.last !== goal.stanceFoot || depth < least) continue;
      const total = node.cost + remaining(node.feet, goal.stanceFoot, aim, there);
      if (total < bestTotal) {
        bestTotal = total;
        best = node;
      }
    }
  }
  return stepsOf(library, best);
}

/**
 * The step that turns most nearly by `turn` from the present feet, laid; null when the captures have none.
 *
 * @param turn from where the standing foot faces, radians.
 */
export function turningStep(
  library: Library,
  feet: Feet,
  foot: Foot,
  turn: number,
  carrying: boolean,
): DraftStep | null {
  const all = movesOf(library);
  const moves = (carrying && all.carrying.left.length > 4 ? all.carrying : all.free)[foot];
  const stance = footPose(feet[otherFoot(foot)]);
  const own = toLocal(stance, footPose(feet[foot]));
  let best: Move | null = null;
  let bestCost = Number.POSITIVE_INFINITY;
  for (const move of moves) {
    const warp = apart(own, move.from);
    const cost = 2 * WARP * warp * warp + 0.4 * Math.abs(wrapAngle(turn - move.to.yaw));
    if (cost < bestCost) {
      bestCost = cost;
      best = move;
    }
  }
  return best ? draft(library, best, foot, toWorld(stance, best.to)) : null;
}

/**
 * The capture's step that most nearly takes a foot from where it is to a footstep, of any kind but a pivot; null when there is
 * none.
 */
export function closingStep(library: Library, feet: Feet, foot: Foot, at: GroundPose): DraftStep | null {
  const stance = footPose(feet[otherFoot(foot)]);
  const from = toLocal(stance, footPose(feet[foot]));
  const to = toLocal(stance, at);
  let best: Move | null = null;
  let bestCost = Number.POSITIVE_INFINITY;
  library.clips.forEach((source, clip) => {
    source.steps.forEach((s, step) => {
      if (s.foot !== foot || pivotEnd(s.category)) return;
      const before = stanceBefore(source, step);
      const there = footPose(before[otherFoot(foot)]);
      const move: Move = {
        clip,
        step,
        from: toLocal(there, footPose(before[foot])),
        to: toLocal(there, footPose(s.to)),
        turns: false,
      };
      const cost = apart(move.from, from) + 1.5 * apart(move.to, to);
      if (cost < bestCost) {
        bestCost = cost;
        best = move;
      }
    });
  });
  return best ? draft(library, best, foot, at) : null;
}

/** How differently two poses face: with distance, facing the way there counts as well. */
function facing(at: GroundPose, target: GroundPose, d: number): number {
  const own = Math.abs(wrapAngle(target.yaw - at.yaw));
  if (d < 0.7) return own;
  const there = Math.abs(wrapAngle(Math.atan2(target.x - at.x, target.z - at.z) - at.yaw));
  return Math.min(own, there);
}

function remaining(
  feet: Record<Foot, GroundPose>,
  stanceFoot: Foot,
  aim: GroundPose,
  there: GroundPose,
): number {
  const s = feet[stanceFoot];
  const o = feet[otherFoot(stanceFoot)];
  return (
    LEFT * Math.hypot(s.x - aim.x, s.z - aim.z) +
    LEFT_TURN * Math.abs(wrapAngle(s.yaw - aim.yaw)) +
    OTHER * Math.hypot(o.x - there.x, o.z - there.z) +
    0.3 * Math.abs(wrapAngle(o.yaw - there.yaw))
  );
}

function stepsOf(library: Library, end: Node): DraftStep[] {
  const out: DraftStep[] = [];
  for (let node: Node | null = end; node?.move && node.last; node = node.before)
    out.unshift(draft(library, node.move, node.last, node.feet[node.last]));
  return out;
}

function draft(library: Library, move: Move, foot: Foot, place: GroundPose): DraftStep {
  return {
    foot,
    x: place.x,
    y: 0,
    z: place.z,
    yaw: place.yaw,
    category: library.clips[move.clip].steps[move.step].category,
    phase: "locomotion",
    template: null,
    clip: move.clip,
    step: move.step,
    desired: [move.to.x, move.to.z, move.to.yaw],
  };
}
