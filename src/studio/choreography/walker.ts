/**
 * A walker that writes scores: it knows where its feet are and lays footsteps as a person would.
 *
 * Lengths are for a leg of 0.93 m and scale with the actor; times are those of comfortable walking (about 1.15 m/s, 0.54 s
 * a step, a quarter of it in double support [Perry, Gait Analysis]), varied a little by a seed as people vary.
 */
import { wrapAngle } from "../../core/math/angle.ts";
import {
  bearing,
  type GroundPose,
  groundDistance,
  midPose,
  toLocal,
  toWorld,
} from "../../core/math/frame2.ts";
import { createRandom, type Random } from "../../core/math/random.ts";
import { pivotPlace } from "../../core/motion/sole.ts";
import { createSkeleton, type Skeleton } from "../../core/skeleton/skeleton.ts";
import { CATEGORY_DEFAULTS } from "../../core/steps/categories.ts";
import type { Foot } from "../../core/steps/types.ts";
import { shortStep } from "../pace.ts";
import {
  type Actor,
  type Pace,
  paceOf,
  type Score,
  type ScoreEvent,
  type ScoreStep,
  type StepKind,
} from "../score.ts";

const DEG = Math.PI / 180;

export const other = (f: Foot): Foot => (f === "left" ? "right" : "left");
export const sideOf = (f: Foot): 1 | -1 => (f === "left" ? 1 : -1);

/** Half the distance across standing ankles, toe-out, half the distance across walking ones. */
export const STANCE = { half: 0.095, toeOut: 7 * DEG, walkingHalf: 0.07 } as const;

/** Seconds in the air, and of double support before it. */
const TIMES: Record<StepKind, [number, number]> = {
  walk: [0.405, 0.135],
  run: [0.48, -0.1],
  turnStep: [0.46, 0.15],
  side: [0.42, 0.2],
  close: [0.42, 0.17],
  forward: [0.4, 0.22],
  backward: [0.42, 0.22],
  heelPivot: [0.4, 0.16],
  toePivot: [0.4, 0.1],
  slide: [0.4, 0.15],
};

export interface Walker {
  name: string;
  actor: Actor;
  skeleton: Skeleton;
  scale: number;
  /** Null: the times of each kind of step are the walker's own. */
  pace: Pace | null;
  random: Random;
  seed: number;
  time: number;
  feet: Record<Foot, GroundPose>;
  start: Record<Foot, GroundPose>;
  steps: ScoreStep[];
  events: ScoreEvent[];
  gaze: Score["gaze"];
  lastFoot: Foot | null;
  /** Slower and shorter with a box in the hands. */
  carrying: boolean;
}

/** A walker standing at a place. */
export function createWalker(name: string, seed: number, at: GroundPose, actor: Actor): Walker {
  const skeleton = createSkeleton(actor.height, actor.proportions);
  const scale = skeleton.legLength / 0.93;
  const feet = standingPair(at, scale);
  return {
    name,
    actor,
    skeleton,
    scale,
    pace: actor.pace ? paceOf(actor) : null,
    random: createRandom(seed),
    seed,
    time: 0.9,
    feet,
    start: { left: feet.left, right: feet.right },
    steps: [],
    events: [],
    gaze: [],
    lastFoot: null,
    carrying: false,
  };
}

/** Footsteps of a stance about a middle. */
export function standingPair(at: GroundPose, scale: number): Record<Foot, GroundPose> {
  const pair = (f: Foot) =>
    toWorld(at, { x: sideOf(f) * STANCE.half * scale, z: 0, yaw: sideOf(f) * STANCE.toeOut });
  return { left: pair("left"), right: pair("right") };
}

export const middle = (w: Walker): GroundPose => midPose(w.feet.left, w.feet.right);

/** Seconds in the air and of double support before it (negative: of flight), of a kind of step at the walker's pace. */
function timesOf(w: Walker, kind: StepKind, foot: Foot, to: GroundPose): readonly [number, number] {
  if (w.pace && (kind === "walk" || kind === "run")) {
    const air = 2 * w.pace.time * (1 - w.pace.stance);
    return [air, w.pace.time - air];
  }
  if (kind !== "walk") return TIMES[kind];
  const { time, stance } = shortStep(toLocal(w.feet[other(foot)], to).z / w.scale);
  const air = 2 * time * (1 - stance);
  return [air, time - air];
}

/** Lays a step after the last one. */
export function step(w: Walker, foot: Foot, kind: StepKind, to: GroundPose, slow = 1): ScoreStep {
  const [air, support] = timesOf(w, kind, foot, to);
  const vary = 1 + 0.025 * (w.pace?.noise ?? 1) * w.random.normal();
  const pace = Math.sqrt(w.scale) * slow * (w.carrying ? 1.06 : 1) * vary;
  const pivot = kind === "heelPivot" || kind === "toePivot";
  const place = pivot
    ? pivotPlace(w.skeleton.foot, w.feet[foot], to.yaw, kind === "heelPivot" ? "heel" : "ball")
    : { ...to };
  if (!pivot) keepApart(w, foot, place);
  const lift = Math.round((w.time + support * pace) * 60) / 60;
  const land = Math.round((lift + air * pace) * 60) / 60;
  // A walking step is named by how far its foot turns, whatever rhythm it goes in.
  const turns = Math.abs(wrapAngle(to.yaw - w.feet[foot].yaw)) >= CATEGORY_DEFAULTS.turn;
  const named = kind === "walk" || kind === "turnStep" ? (turns ? "turnStep" : "walk") : kind;
  const s: ScoreStep = { foot, kind: named, lift, land, x: place.x, z: place.z, yaw: wrapAngle(to.yaw) };
  w.steps.push(s);
  w.feet[foot] = { x: s.x, z: s.z, yaw: s.yaw };
  w.time = land;
  w.lastFoot = foot;
  return s;
}

/** A landing foot keeps its ankle a foot's breadth from the other, towards its own side. */
function keepApart(w: Walker, foot: Foot, place: { x: number; z: number }): void {
  const stance = w.feet[other(foot)];
  const least = 0.165 * w.scale;
  const d = groundDistance(stance, place);
  if (d >= least) return;
  const own = toWorld({ ...stance, x: 0, z: 0 }, { x: sideOf(foot), z: 0, yaw: 0 });
  const dx = d > 1e-6 ? (place.x - stance.x) / d + own.x : own.x;
  const dz = d > 1e-6 ? (place.z - stance.z) / d + own.z : own.z;
  const n = Math.hypot(dx, dz) || 1;
  place.x = stance.x + (dx / n) * least;
  place.z = stance.z + (dz / n) * least;
}

/** Turns a foot about its heel or its ball to a yaw. */
export function pivot(w: Walker, foot: Foot, end: "heel" | "ball", yaw: number): void {
  step(w, foot, end === "heel" ? "heelPivot" : "toePivot", { ...w.feet[foot], yaw });
}

/** Time passes. */
export function wait(w: Walker, seconds: number): void {
  w.time = Math.round((w.time + seconds) * 60) / 60;
  if (seconds > 0.3) w.lastFoot = null;
}

export function look(w: Walker, target: [number, number, number] | null, delay = 0): void {
  w.gaze.push({ time: w.time + delay, target });
}

/** A foot's place beside a line of walking. */
function beside(
  w: Walker,
  centre: GroundPose,
  foot: Foot,
  half: number = STANCE.walkingHalf,
  toeOut: number = 0.1,
): GroundPose {
  const noise = 0.006 * w.random.normal();
  return toWorld(centre, {
    x: sideOf(foot) * half * w.scale + noise,
    z: 0,
    yaw: sideOf(foot) * toeOut + 0.012 * w.random.normal(),
  });
}

/**
 * Opens towards a course and begins to walk: `pivots` as after writing or sitting (heel pivot, turn and step), else
 * turning steps alone, as with a box. Ends with the body turned within 25 degrees of the course.
 */
export function openTowards(w: Walker, course: number, pivots: boolean, carefully = 1): void {
  const turn = wrapAngle(course - middle(w).yaw);
  if (Math.abs(turn) < 24 * DEG) return;
  const inner: Foot = turn > 0 ? "left" : "right";
  const outer = other(inner);
  let first = inner;
  let yaw = middle(w).yaw;
  const sign = Math.sign(turn);
  const ahead = (angle: number, length: number, foot: Foot, half: number): GroundPose => {
    const m = middle(w);
    const centre = toWorld({ x: m.x, z: m.z, yaw: angle }, { x: 0, z: length * w.scale, yaw: 0 });
    return toWorld(centre, { x: sideOf(foot) * half * w.scale, z: 0, yaw: sideOf(foot) * 0.08 });
  };
  if (pivots && Math.abs(turn) > 32 * DEG) {
    const open = Math.min(Math.abs(turn) * 0.6, 52 * DEG) * (0.92 + 0.08 * w.random.next());
    pivot(w, inner, "heel", w.feet[inner].yaw + sign * open);
    yaw += sign * open;
    first = outer;
  }
  for (let guard = 0; guard < 5; guard++) {
    const left = wrapAngle(course - yaw);
    if (Math.abs(left) < 20 * DEG) break;
    const opening = first === inner;
    const take = Math.min(Math.abs(left), (opening ? 62 : 66) * DEG);
    yaw += Math.sign(left) * take;
    // The outer foot travels round; the inner one opens nearly on the spot.
    const length = opening ? 0.1 : Math.abs(wrapAngle(course - yaw)) < 15 * DEG ? 0.3 : 0.14;
    step(w, first, "turnStep", ahead(yaw, length, first, opening ? 0.11 : 0.095), carefully);
    first = other(first);
  }
}

/** Steps straight (or gently curved) to a place for the body's middle, ending on a foot of the caller's choice. */
export function walkTo(w: Walker, target: { x: number; z: number }, last: Foot | null, curve = 0): void {
  const from = middle(w);
  const distance = groundDistance(from, target);
  if (distance < 0.12 * w.scale) return;
  const length = (w.carrying ? 0.56 : 0.625) * w.scale;
  const course = bearing(from, target);
  const firstFoot: Foot = w.lastFoot
    ? other(w.lastFoot)
    : wrapAngle(course - from.yaw) > 0.08
      ? "left"
      : "right";
  // Nobody lunges through a room: a step more rather than one that the hips have to sink for.
  const longest = 0.69 * w.scale;
  let n = Math.max(1, Math.round(distance / length + 0.25), Math.ceil(distance / longest));
  if (last) {
    const ends = (k: number) => (k % 2 === 1 ? firstFoot : other(firstFoot));
    if (ends(n) !== last) {
      const more = distance / (n + 1);
      const less = n > 1 ? distance / (n - 1) : Number.POSITIVE_INFINITY;
      n = less < longest && Math.abs(less - length) < Math.abs(more - length) ? n - 1 : n + 1;
    }
  }
  // A first step from standing is shorter, and so is the last.
  const shares = Array.from(
    { length: n },
    (_, i) =>
      (i === 0 && w.lastFoot === null ? 0.85 : 1) *
      (i === n - 1 && n > 2 ? 0.92 : 1) *
      (1 + 0.012 * w.random.normal()),
  );
  const total = shares.reduce((a, b) => a + b, 0);
  let done = 0;
  let foot = firstFoot;
  for (let i = 0; i < n; i++) {
    done += shares[i] / total;
    const bow = curve * Math.sin(Math.PI * done) * distance;
    const slope = curve * Math.PI * Math.cos(Math.PI * done);
    const heading = wrapAngle(course + Math.atan(slope));
    const centre: GroundPose = {
      x: from.x + done * (target.x - from.x) + bow * Math.cos(course),
      z: from.z + done * (target.z - from.z) - bow * Math.sin(course),
      yaw: heading,
    };
    const turn = Math.abs(wrapAngle(heading - w.feet[foot].yaw));
    step(
      w,
      foot,
      turn > 30 * DEG ? "turnStep" : "walk",
      beside(w, centre, foot),
      i === 0 && w.lastFoot === null ? 1.08 : 1,
    );
    foot = other(foot);
  }
}

export interface TurnInOptions {
  /** The last foot lands short of its yaw and turns on its ball. */
  pivots: boolean;
  /** Both feet do. */
  both?: boolean;
}

/**
 * From walking to standing at a place: walks there, turns in by as many turning steps as the angle wants, inner foot
 * first, and closes.
 */
export function turnIn(w: Walker, place: GroundPose, options: TurnInOptions): void {
  const stance = standingPair(place, w.scale);
  const from = middle(w);
  const way = groundDistance(from, place);
  const course = way > 0.2 * w.scale ? bearing(from, place) : from.yaw;
  const turn = wrapAngle(place.yaw - course);
  const size = Math.abs(turn);
  const inner: Foot = turn > 0 ? "left" : "right";
  const outer = other(inner);
  if (size < 22 * DEG) {
    // Straight in: the last walking foot already stands in its place, the other closes.
    const lastFoot: Foot = w.random.next() < 0.5 ? "left" : "right";
    const back = toWorld(place, { x: 0, z: -0.3 * w.scale, yaw: 0 });
    if (way > 0.55 * w.scale) walkTo(w, back, other(lastFoot));
    const foot = w.lastFoot ? other(w.lastFoot) : lastFoot;
    step(w, foot, way > 0.35 * w.scale ? "walk" : "forward", stance[foot], 1.04);
    step(w, other(foot), "close", stance[other(foot)]);
    return;
  }
  // The turn begins some way before the place: the body still moves on while it turns.
  const turns = size < 75 * DEG ? 1 : size < 140 * DEG ? 2 : 3;
  const lead = (0.16 + 0.12 * turns) * w.scale;
  if (way > lead + 0.25 * w.scale) {
    const before = { x: place.x - Math.sin(course) * lead, z: place.z - Math.cos(course) * lead };
    walkTo(w, before, outer);
  }
  let foot = w.lastFoot ? other(w.lastFoot) : inner;
  if (foot !== inner && size > 60 * DEG) {
    // The wrong foot is free: it takes a small step that turns what it can.
    const yaw = course + 0.2 * turn;
    const m = middle(w);
    const centre = { x: m.x + 0.35 * (place.x - m.x), z: m.z + 0.35 * (place.z - m.z), yaw };
    step(w, foot, "walk", beside(w, centre, foot, 0.085));
    foot = inner;
  }
  let yaw = course;
  for (let k = turns; k >= 2; k--) {
    // A share of the turn and of the way.
    yaw += wrapAngle(place.yaw - yaw) / (k + (options.pivots ? 0.35 : 0));
    const m = middle(w);
    const f = 1 / (k + 0.4);
    const centre = { x: m.x + f * (place.x - m.x), z: m.z + f * (place.z - m.z), yaw };
    step(
      w,
      foot,
      "turnStep",
      toWorld(centre, { x: sideOf(foot) * 0.105 * w.scale, z: 0, yaw: sideOf(foot) * 0.1 }),
    );
    foot = other(foot);
  }
  const late = options.pivots
    ? Math.min(34 * DEG, Math.max(16 * DEG, 0.34 * Math.abs(wrapAngle(place.yaw - yaw))))
    : 0;
  const sign = Math.sign(wrapAngle(place.yaw - yaw)) || Math.sign(turn);
  land(w, foot, stance[foot], options.both ? sign * late * 0.8 : 0, turns > 0 ? "turnStep" : "walk");
  land(w, other(foot), stance[other(foot)], options.pivots ? sign * late : 0, "turnStep");
  if (options.pivots) {
    if (options.both) pivot(w, foot, "ball", stance[foot].yaw);
    pivot(w, other(foot), "ball", stance[other(foot)].yaw);
  }
}

/** Lands a foot so that turning on its ball by `late` brings it to its place. */
function land(w: Walker, foot: Foot, place: GroundPose, late: number, kind: StepKind): void {
  if (late === 0) {
    step(w, foot, kind, place);
    return;
  }
  const before = pivotPlace(w.skeleton.foot, place, wrapAngle(place.yaw - late), "ball");
  step(w, foot, kind, before);
}

/** Side steps to a stance beside: lead and close, as many as the distance wants; facing kept. */
export function sideStepTo(w: Walker, place: GroundPose, most = 0.44): void {
  const from = middle(w);
  const local = toLocal({ ...place }, { ...from });
  const distance = -local.x;
  const lead: Foot = distance > 0 ? "left" : "right";
  const n = Math.max(1, Math.ceil(Math.abs(distance) / (most * w.scale) - 0.1));
  for (let k = 1; k <= n; k++) {
    const f = k / n;
    const at: GroundPose = {
      x: from.x + f * (place.x - from.x),
      z: from.z + f * (place.z - from.z),
      yaw: wrapAngle(from.yaw + f * wrapAngle(place.yaw - from.yaw)),
    };
    const pair = standingPair(at, w.scale);
    step(w, lead, "side", pair[lead]);
    step(w, other(lead), k === n ? "close" : "side", pair[other(lead)]);
  }
}

/** Both feet a little forward or back to a stance: small steps during a task. */
export function shuffleTo(w: Walker, place: GroundPose, first: Foot): void {
  const pair = standingPair(place, w.scale);
  for (const foot of [first, other(first)]) {
    const turn = Math.abs(wrapAngle(pair[foot].yaw - w.feet[foot].yaw));
    if (groundDistance(w.feet[foot], pair[foot]) < 0.02 && turn < 4 * DEG) continue;
    const way = toLocal({ ...w.feet[foot], yaw: place.yaw }, pair[foot]);
    const across = Math.abs(way.x) > CATEGORY_DEFAULTS.side * Math.abs(way.z) && Math.abs(way.x) > 0.05;
    step(w, foot, across ? "side" : way.z > 0 ? "forward" : "backward", pair[foot]);
  }
}

/** The finished score. */
export function finish(w: Walker): Score {
  return {
    name: w.name,
    actor: w.actor,
    seed: w.seed,
    duration: w.time + 1.1,
    start: w.start,
    steps: w.steps,
    events: w.events,
    gaze: [...w.gaze].sort((a, b) => a.time - b.time),
  };
}
