/**
 * Cyclic clips for footstep-parameterised blending [Barycentric §5]: one gait each, kept up for some steps. Dense in side
 * and back steps, where the paper found its own too sparse.
 */
import { wrapAngle } from "../core/math/angle.ts";
import { toWorld } from "../core/math/frame2.ts";
import { DEFAULT_PROPORTIONS, REFERENCE_HEIGHT } from "../core/skeleton/skeleton.ts";
import { straightScore } from "./choreography/straight.ts";
import { createWalker, finish, middle, other, sideOf, standingPair, step } from "./choreography/walker.ts";
import { paceAt } from "./pace.ts";
import type { Actor, Pace, Score } from "./score.ts";

const DEG = Math.PI / 180;
const ADULT: Actor = { height: REFERENCE_HEIGHT, proportions: DEFAULT_PROPORTIONS };
/** A cycle repeats: its steps vary less than a walker's do. */
const EVEN = 0.15;
/** Steps of each clip between its first and its last. */
const STEPS = 8;

/** Runs come up to speed gently: what accelerates hard belongs to no cycle. */
const RUN_UP = [0.56, 0.66, 0.77, 0.88, 0.96];

const JOG: Partial<Pace> = { length: 0.8, time: 0.385, stance: 0.46, width: 0.08 };

const RUN: Partial<Pace> = { length: 0.97, time: 0.378, stance: 0.4, width: 0.07 };
/** Between walking and jogging: blends of the two alone would shuffle. */
const SLOW_JOG: Partial<Pace> = { length: 0.64, time: 0.39, stance: 0.48, width: 0.08 };

function straight(name: string, seed: number, pace: Partial<Pace>): Score {
  const actor = { ...ADULT, pace: { ...pace, noise: EVEN } };
  return straightScore({ name, seed, actor, steps: STEPS, runUp: RUN_UP });
}

/** Walks round a circle: `radius` metres to the left positive. */
function curve(name: string, seed: number, radius: number): Score {
  const w = createWalker(name, seed, { x: 0, z: 0, yaw: 0 }, ADULT);
  let foot = radius > 0 ? ("left" as const) : ("right" as const);
  let turned = 0;
  for (let k = 0; k < STEPS + 2; k++) {
    const length = (k === 0 ? 0.45 : 0.58) * w.scale;
    turned += length / radius;
    const centre = {
      x: radius * (1 - Math.cos(turned)),
      z: radius * Math.sin(turned),
      yaw: wrapAngle(turned),
    };
    step(
      w,
      foot,
      "walk",
      toWorld(centre, { x: sideOf(foot) * 0.07 * w.scale, z: 0, yaw: sideOf(foot) * 0.1 }),
    );
    foot = other(foot);
  }
  closeFeet(w, foot);
  return finish(w);
}

/** Turns on the spot by `each` radians a step. */
function spot(name: string, seed: number, each: number): Score {
  const w = createWalker(name, seed, { x: 0, z: 0, yaw: 0 }, ADULT);
  let foot = each > 0 ? ("left" as const) : ("right" as const);
  let yaw = 0;
  for (let k = 0; k < STEPS; k++) {
    yaw += each;
    step(w, foot, "turnStep", standingPair({ x: 0, z: 0, yaw: wrapAngle(yaw) }, w.scale)[foot]);
    foot = other(foot);
  }
  step(w, foot, "turnStep", standingPair({ x: 0, z: 0, yaw: wrapAngle(yaw) }, w.scale)[foot]);
  return finish(w);
}

/**
 * Walks ahead by `length` a step with the feet `half` off the line, drifting sideways by `drift` a step, to the left positive,
 * without turning.
 */
function drifting(
  name: string,
  seed: number,
  length: number,
  half: number,
  drift: number,
  pace: Partial<Pace> | null = null,
): Score {
  const w = createWalker(
    name,
    seed,
    { x: 0, z: 0, yaw: 0 },
    pace ? { ...ADULT, pace: { ...pace, noise: EVEN } } : ADULT,
  );
  // The foot on the side it drifts to opens; the other one follows.
  let foot = drift >= 0 ? ("left" as const) : ("right" as "left" | "right");
  const at = { x: 0, z: 0 };
  for (let k = 0; k < STEPS + 2; k++) {
    // A runner takes some steps to come up to speed, and to slow down.
    const share = k === 0 ? 0.6 : pace ? Math.min(1, 0.5 + 0.2 * k, 0.5 + 0.2 * (STEPS + 1 - k)) : 1;
    at.x += drift * share * w.scale;
    at.z += length * share * w.scale;
    step(w, foot, pace ? "run" : "walk", {
      x: at.x + sideOf(foot) * half * w.scale,
      z: at.z,
      yaw: sideOf(foot) * 0.1,
    });
    foot = other(foot);
  }
  closeFeet(w, foot);
  return finish(w);
}

/** Steps sideways by `width` metres each pair, to the left positive, drifting ahead by `ahead`. */
function sideways(name: string, seed: number, width: number, ahead: number): Score {
  const w = createWalker(name, seed, { x: 0, z: 0, yaw: 0 }, ADULT);
  const lead = width > 0 ? ("left" as const) : ("right" as const);
  for (let k = 1; k <= STEPS / 2; k++) {
    const pair = standingPair({ x: k * width * w.scale, z: k * ahead * w.scale, yaw: 0 }, w.scale);
    step(w, lead, "side", pair[lead]);
    step(w, other(lead), k === STEPS / 2 ? "close" : "side", pair[other(lead)]);
  }
  return finish(w);
}

/** Steps backwards by `length` metres each, turning by `turn` radians a step. */
function backwards(name: string, seed: number, length: number, turn: number): Score {
  const w = createWalker(name, seed, { x: 0, z: 0, yaw: 0 }, ADULT);
  let foot = "left" as "left" | "right";
  const at = { x: 0, z: 0, yaw: 0 };
  for (let k = 0; k < STEPS; k++) {
    at.yaw = wrapAngle(at.yaw + turn);
    at.x -= Math.sin(at.yaw) * length * w.scale;
    at.z -= Math.cos(at.yaw) * length * w.scale;
    step(
      w,
      foot,
      "backward",
      toWorld(at, { x: sideOf(foot) * 0.085 * w.scale, z: 0, yaw: sideOf(foot) * 0.1 }),
    );
    foot = other(foot);
  }
  closeFeet(w, foot);
  return finish(w);
}

function closeFeet(w: ReturnType<typeof createWalker>, foot: "left" | "right"): void {
  const stance = w.feet[other(foot)];
  const at = toWorld(stance, { x: sideOf(foot) * 0.19 * w.scale, z: 0, yaw: sideOf(foot) * 2 * 7 * DEG });
  step(w, foot, "close", { ...at, yaw: wrapAngle(middle(w).yaw + sideOf(foot) * 7 * DEG) });
}

/** The clips, in a fixed order. */
export function cyclicScores(): Score[] {
  return [
    ...[0.7, 0.9, 1.15, 1.4, 1.6].map((v, i) => straight(`cycle-walk-${i + 1}`, 201 + i, paceAt(v))),
    ...[0.26, 0.4].map((d, i) => drifting(`cycle-short-${i + 1}`, 241 + i, d, 0.07, 0)),
    ...[0.3, 0.55].map((d, i) => drifting(`cycle-wide-${i + 1}`, 243 + i, d, 0.15, 0)),
    ...[0.16, -0.16].map((d, i) => drifting(`cycle-drift-${i + 1}`, 245 + i, 0.42, 0.08, d)),
    ...[0.28, -0.28].map((d, i) => drifting(`cycle-drift-${i + 3}`, 247 + i, 0.52, 0.09, d)),
    straight("cycle-jog", 206, JOG),
    ...[0.16, -0.16].map((d, i) => drifting(`cycle-jog-${i + 2}`, 261 + i, 0.8, 0.05, d, JOG)),
    straight("cycle-jog-4", 209, SLOW_JOG),
    ...[0.16, -0.16].map((d, i) => drifting(`cycle-jog-${i + 5}`, 251 + i, 0.64, 0.05, d, SLOW_JOG)),
    straight("cycle-run", 207, { length: 1.15, time: 0.375, stance: 0.37, width: 0.06 }),
    straight("cycle-run-2", 208, RUN),
    straight("cycle-run-3", 210, { length: 0.88, time: 0.38, stance: 0.43, width: 0.07 }),
    straight("cycle-run-4", 256, { length: 1.06, time: 0.376, stance: 0.375, width: 0.06 }),
    ...[1.1, -1.1, 2.2, -2.2].map((r, i) => curve(`cycle-curve-${i + 1}`, 211 + i, r)),
    ...[28, -28, 50, -50].map((a, i) => spot(`cycle-spot-${i + 1}`, 215 + i, a * DEG)),
    ...[0.22, -0.22, 0.4, -0.4].map((d, i) => sideways(`cycle-side-${i + 1}`, 221 + i, d, 0)),
    ...[0.3, -0.3].map((d, i) => sideways(`cycle-side-ahead-${i + 1}`, 225 + i, d, 0.15)),
    ...[0.3, -0.3].map((d, i) => sideways(`cycle-side-back-${i + 1}`, 227 + i, d, -0.15)),
    ...[0.2, 0.32, 0.44].map((d, i) => backwards(`cycle-back-${i + 1}`, 231 + i, d, 0)),
    ...[8, -8].map((a, i) => backwards(`cycle-back-turn-${i + 1}`, 234 + i, 0.28, a * DEG)),
  ];
}
