/**
 * A scene's stones as footsteps and a motion [Barycentric §6, the stepping-stone problem].
 */
import { CLIP_RATE, type Clip } from "../capture/clip.ts";
import { wrapAngle } from "../math/angle.ts";
import type { GroundPose } from "../math/frame2.ts";
import { groundHeight, groundNormal } from "../scene/terrain.ts";
import type { Scene, SceneStone, Terrain } from "../scene/types.ts";
import { JOINT_COUNT } from "../skeleton/joints.ts";
import { categorise } from "../steps/categories.ts";
import type { Foot, Footstep, Step } from "../steps/types.ts";
import type { Plan } from "../tasks/plan-types.ts";
import { AIR, F_LAND, FOOT, FOOT_STATE, LAST_SIDE, LIFT, PLACE, STATE } from "./batch.ts";
import { type BlendCrowd, createBlendCrowd, type TimedFootstep } from "./crowd.ts";
import { type FootSpace, triangleArea } from "./foot-space.ts";
import type { BlendLibrary } from "./library.ts";
import { feetForStones } from "./stone-feet.ts";
import { timesFor } from "./stone-times.ts";
import type { StepChoice } from "./types.ts";

/** Seconds standing before the first lift and after the last landing. */
const LEAD = 0.7;
const TAIL = 1;
/** A stone this near to the ground lies on it, metres. */
const ON_GROUND = 0.02;
/** Footsteps missed by more than this are told, metres. */
const TOLD = 0.005;

/** A plan whose `blend` says what was chosen for each step, with its motion. */
export interface StonePlan {
  plan: Plan;
  clip: Clip;
  contacts: Uint8Array;
  choices: StepChoice[];
}

/** Where the character is when it comes to the stones. */
export interface Standing {
  feet: [Footstep, Footstep];
  /** The hips' place and local rotations of the last frame before. */
  root: Float64Array | Float32Array;
  rotations: Float64Array | Float32Array;
}

/** The scene's stones in playing order. */
export function orderedStones(scene: Scene): SceneStone[] {
  const byId = new Map(scene.stones.map((s) => [s.id, s]));
  return scene.order.flatMap((id) => byId.get(id) ?? []);
}

/**
 * Plans and synthesises a scene's stones: never fails on stones out of reach, it comes as near as it can and says so.
 *
 * @param standing where the character comes from; null for standing at the scene's start.
 * @param options `lambda4`: 0 lands on the stones, 1 follows the root's velocity alone; beyond beta feet leave the stones.
 */
export function planStones(
  scene: Scene,
  library: BlendLibrary,
  standing: Standing | null = null,
  options: { lambda4?: number } = {},
): StonePlan {
  const stones = orderedStones(scene);
  const warnings: string[] = [];
  const crowd = createBlendCrowd(library, 1, { matrices: false });
  const [x, z] = scene.start.position;
  const i = crowd.add({ x, z, yaw: wrapAngle(scene.start.yaw), y: groundHeight(scene.terrain, x, z) });
  if (standing) crowd.adopt(i, standing.feet, standing.root, standing.rotations);
  else standOnGround(crowd, scene.terrain);
  const lambda4 = Math.max(0, Math.min(1, options.lambda4 ?? 0));
  crowd.steer(i, lambda4, Number.NaN, Number.NaN, Number.NaN);
  const start: [Footstep, Footstep] = [footOf(crowd, 0), footOf(crowd, 1)];
  const feet = feetForStones(
    start,
    stones.map((s) => ({ ...groundOf(s), foot: s.foot })),
  );
  const name = (k: number) => `stones[${scene.stones.indexOf(stones[k])}]`;
  const times = timesFor(
    library,
    start,
    stones.map((s, k) => ({ ...groundOf(s), foot: feet[k], time: s.time })),
    LEAD,
    (k) => warnings.push(`${name(k)}.time: too soon after the step before; it lands as soon as it can.`),
  );
  const steps = stones.map((s, k): TimedFootstep => {
    const [sx, sy, sz] = s.position;
    const rests = Math.abs(sy - groundHeight(scene.terrain, sx, sz)) < ON_GROUND;
    return {
      foot: feet[k],
      x: sx,
      y: sy,
      z: sz,
      yaw: wrapAngle(s.yaw),
      ...times[k],
      normal: rests ? groundNormal(scene.terrain, sx, sz) : [0, 0],
    };
  });
  const last = steps.reduce((t, s) => Math.max(t, s.land), 0);
  const motion = playTrack(crowd, steps, last + TAIL, scene.seed.toString());
  motion.choices.forEach((c, k) => {
    if (lambda4 === 0 && c.missed > TOLD)
      warnings.push(
        `${name(k)}.position: out of reach by ${c.missed.toFixed(2)} m; the foot lands as near as it can.`,
      );
  });
  const plan = planOf(start, steps, motion.clip.frames / CLIP_RATE, warnings, library);
  plan.blend = {
    names: library.names,
    feet: [spaceOf(library.feet[0]), spaceOf(library.feet[1])],
    first: 0,
    choices: motion.choices,
  };
  return { ...motion, plan };
}

const spaceOf = (f: FootSpace) => ({
  points: Array.from(f.points),
  triangles: Array.from(f.triangles),
  hull: Array.from(f.hull),
});

const groundOf = (s: SceneStone): GroundPose => ({
  x: s.position[0],
  z: s.position[2],
  yaw: wrapAngle(s.yaw),
});

/** The first stance's soles on the ground. */
function standOnGround(crowd: BlendCrowd, terrain: Terrain): void {
  for (let side = 0; side < 2; side++) {
    const p = FOOT + FOOT_STATE * side + PLACE;
    const s = crowd.state;
    const [nx, nz] = groundNormal(terrain, s[p], s[p + 2]);
    s[p + 1] = groundHeight(terrain, s[p], s[p + 2]);
    s[p + 4] = nx;
    s[p + 5] = nz;
  }
  // Shown so from the first frame on.
  crowd.update(0);
}

function footOf(crowd: BlendCrowd, side: 0 | 1): Footstep {
  const out = { x: 0, y: 0, z: 0, yaw: 0 };
  crowd.footstep(0, side, out);
  const p = FOOT + FOOT_STATE * side + PLACE;
  const normal: [number, number] = [crowd.state[p + 4], crowd.state[p + 5]];
  return { foot: side === 0 ? "left" : "right", ...out, normal };
}

/**
 * Plays a track of footsteps on a crowd of one: frames at 60 a second, contacts, and what was chosen for each step.
 *
 * @param seconds how long; the first frame is the crowd's present one.
 */
export function playTrack(
  crowd: BlendCrowd,
  steps: readonly TimedFootstep[],
  seconds: number,
  name: string,
): { clip: Clip; contacts: Uint8Array; choices: StepChoice[] } {
  const { library } = crowd;
  const frames = Math.max(1, Math.round(seconds * CLIP_RATE));
  const clip: Clip = {
    name,
    skeleton: library.skeleton,
    rate: CLIP_RATE,
    frames,
    root: new Float64Array(3 * frames),
    rotations: new Float64Array(4 * JOINT_COUNT * frames),
  };
  const contacts = new Uint8Array(frames);
  const choices: StepChoice[] = [];
  /** Step of each foot on its way, and the lift last seen. */
  const flying: (StepChoice | null)[] = [null, null];
  let lift = crowd.state[LIFT];
  let next = 0;
  for (let f = 0; f < frames; f++) {
    while (next < steps.length && crowd.push(0, steps[next])) next++;
    if (f > 0) crowd.update(1 / CLIP_RATE);
    clip.root.set(crowd.root, 3 * f);
    clip.rotations.set(crowd.rotations, 4 * JOINT_COUNT * f);
    contacts[f] = crowd.contacts[0];
    for (let side = 0; side < 2; side++) {
      const step = flying[side];
      if (step && crowd.state[FOOT + FOOT_STATE * side + AIR] === 0) {
        step.before = crowd.landingError[0];
        flying[side] = null;
      }
    }
    if (crowd.state[LIFT] !== lift) {
      lift = crowd.state[LIFT];
      const side = crowd.state[LAST_SIDE];
      const choice = choiceOf(crowd, steps[choices.length]);
      flying[side] = choice;
      choices.push(choice);
    }
  }
  return { clip, contacts, choices };
}

function choiceOf(crowd: BlendCrowd, wanted: TimedFootstep): StepChoice {
  const { choice, mix, query } = crowd.scratch;
  const side = query.side as 0 | 1;
  const space = crowd.library.feet[side];
  return {
    foot: side === 0 ? "left" : "right",
    lift: crowd.state[STATE * 0 + LIFT],
    land: crowd.state[FOOT + FOOT_STATE * side + F_LAND],
    query: [query.x, query.z],
    weighed: [choice.located.x, choice.located.z],
    landing: [choice.x, choice.z],
    root: [choice.rx, choice.rz],
    triangle: choice.located.triangle,
    area: triangleArea(space, choice.located.triangle),
    corners: Array.from(choice.corners),
    lambda: Array.from(choice.lambda),
    lambda4: choice.lambda4,
    beta: choice.beta,
    clips: Array.from(mix.clips.subarray(0, mix.count)),
    weights: Array.from(mix.weights.subarray(0, mix.count)),
    before: Number.NaN,
    missed: Math.hypot(query.landing.x - wanted.x, query.landing.z - wanted.z),
  };
}

/** The footsteps as a plan. */
function planOf(
  start: [Footstep, Footstep],
  steps: readonly TimedFootstep[],
  duration: number,
  warnings: string[],
  library: BlendLibrary,
): Plan {
  const last: Record<Foot, Footstep> = { left: start[0], right: start[1] };
  const told = steps.map((s): Step => {
    const to: Footstep = { foot: s.foot, x: s.x, y: s.y, z: s.z, yaw: s.yaw };
    if (s.normal) to.normal = s.normal;
    const step: Step = {
      foot: s.foot,
      category: "Walk",
      phase: "locomotion",
      start: s.lift * CLIP_RATE,
      end: s.land * CLIP_RATE,
      airStart: s.lift * CLIP_RATE,
      airEnd: s.land * CLIP_RATE,
      from: last[s.foot],
      to,
    };
    last[s.foot] = to;
    return step;
  });
  categorise(told, start, [], CLIP_RATE, library.skeleton.legLength);
  return {
    start,
    steps: told.map((s, k) => ({
      ...s.to,
      category: s.category,
      phase: s.phase,
      task: -1,
      template: null,
      clip: -1,
      step: -1,
      lift: steps[k].lift,
      land: steps[k].land,
    })),
    segments: [],
    tasks: [],
    duration,
    candidates: [],
    traces: [],
    warnings,
  };
}
