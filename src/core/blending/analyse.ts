/**
 * Motion clip analysis in place [Barycentric §4.1]: one cycle of two steps, its mean root motion, displacement vectors
 * and landing points.
 *
 * The root's frame on the ground moves at the cycle's mean velocity and turn rate (a straight line or a circle); what the
 * hips do beside it stays in the clip, so "forward displacement is ignored, vertical and lateral deviations are kept". It
 * is fitted to the midpoints and mean yaws of consecutive footsteps at their landings, which is how §4.2 makes a root track
 * of footsteps: so the root of a clip and of a track are one thing.
 */
import { wrapAngle } from "../math/angle.ts";
import { type GroundPose, midPose, toLocal } from "../math/frame2.ts";
import { JOINT_COUNT } from "../skeleton/joints.ts";
import type { Step } from "../steps/types.ts";
import type { AnimationStep, ClipAnalysis, CyclicSource, GroundMove } from "./types.ts";

/** A clip that no cycle can be found in. */
export class CycleError extends Error {}

/** The root's frame over a clip's cycle: a uniform motion on the ground. */
export interface RootMotion {
  /** Frame at the cycle's first lift. */
  origin: GroundPose;
  /** Lateral and forward m/s and rad/s, in the root's own frame. */
  velocity: GroundMove;
}

/** Displacement after `time` seconds of a uniform motion, in its frame at time 0. */
export function uniformMove(out: GroundMove, v: GroundMove, time: number): GroundMove {
  const a = v.yaw * time;
  // Integrals of cos and sin over the turn; series where they would divide by nothing.
  const s = Math.abs(a) < 1e-4 ? time * (1 - (a * a) / 6) : Math.sin(a) / v.yaw;
  const c = Math.abs(a) < 1e-4 ? (time * a) / 2 : (1 - Math.cos(a)) / v.yaw;
  out.x = v.x * s + v.z * c;
  out.z = v.z * s - v.x * c;
  out.yaw = a;
  return out;
}

/** The root's frame on the ground `time` seconds after the cycle's first lift. */
export function rootFrame(root: RootMotion, time: number): GroundPose {
  const d = uniformMove({ x: 0, z: 0, yaw: 0 }, root.velocity, time);
  const { origin } = root;
  const c = Math.cos(origin.yaw);
  const s = Math.sin(origin.yaw);
  return {
    x: origin.x + c * d.x + s * d.z,
    z: origin.z - s * d.x + c * d.z,
    yaw: origin.yaw + d.yaw,
  };
}

/** Last frame on which the foot that will take the step still rests; first frame on which it rests again. */
export const liftFrame = (s: Step): number => Math.max(0, s.start - 1);
export const landFrame = (s: Step): number => s.end;

const isStep = (s: Step): boolean => s.category !== "HeelPivot" && s.category !== "ToePivot";

/** Largest difference of local rotations between two frames, plus that of the hips' height: how badly a cycle closes. */
function mismatch(source: CyclicSource, a: number, b: number): number {
  const { rotations, root } = source.clip;
  const q = 4 * JOINT_COUNT;
  let sum = Math.abs(root[3 * a + 1] - root[3 * b + 1]);
  for (let j = 1; j < JOINT_COUNT; j++) {
    let d = 0;
    for (let k = 0; k < 4; k++) d += rotations[q * a + 4 * j + k] * rotations[q * b + 4 * j + k];
    sum += 1 - Math.abs(d);
  }
  return sum;
}

/**
 * Index of the step that the best cycle begins with: three alternating steps, away from start and stop, closing well.
 *
 * @throws CycleError when there is none.
 */
function bestCycle(source: CyclicSource): number {
  const { steps, name } = source;
  const last = steps.length - 1;
  let best = -1;
  let least = Number.POSITIVE_INFINITY;
  for (let k = 1; k + 2 <= last; k++) {
    const alternate = steps[k].foot !== steps[k + 1].foot && steps[k].foot === steps[k + 2].foot;
    if (!alternate || ![k, k + 1, k + 2].every((i) => isStep(steps[i]))) continue;
    // The first step starts from standing, the last ones come to a stop.
    const away = (k < 2 ? 1 : 0) + (k + 3 > last ? 1 : 0);
    const cost = away + mismatch(source, liftFrame(steps[k]), liftFrame(steps[k + 2]));
    if (cost < least) {
      least = cost;
      best = k;
    }
  }
  if (best < 0)
    throw new CycleError(
      `${name}: a cycle needs four steps with alternating feet, found ${steps.length} in all.`,
    );
  return best;
}

/**
 * The root's uniform motion over the cycle that begins with step k: a fit to the midpoints and mean yaws of consecutive
 * footsteps at their landings.
 */
function rootMotion(source: CyclicSource, k: number): RootMotion {
  const { clip, steps } = source;
  const begin = liftFrame(steps[k]) / clip.rate;
  const middle = (i: number) => midPose(steps[i - 1].to, steps[i].to);
  const landing = (i: number) => landFrame(steps[i]) / clip.rate;
  const time = landing(k + 2) - landing(k);
  const turn = wrapAngle(steps[k + 2].to.yaw - steps[k].to.yaw);
  const rate = turn / time;
  // Yaw at the first lift, from both landings.
  let sx = 0;
  let sz = 0;
  for (const i of [k, k + 1]) {
    const yaw = middle(i).yaw - rate * (landing(i) - begin);
    sx += Math.sin(yaw);
    sz += Math.cos(yaw);
  }
  const yaw = Math.atan2(sx, sz);
  const d = toLocal({ ...middle(k), yaw: yaw + rate * (landing(k) - begin) }, middle(k + 2));
  // Solve uniformMove(v, time) = d for v.
  const s = Math.abs(turn) < 1e-4 ? time : Math.sin(turn) / rate;
  const c = Math.abs(turn) < 1e-4 ? (time * turn) / 2 : (1 - Math.cos(turn)) / rate;
  const n = s * s + c * c;
  const velocity = { x: (d.x * s - d.z * c) / n, z: (d.z * s + d.x * c) / n, yaw: rate };
  // The place at the first lift that puts it on both midpoints as nearly as can be.
  let x = 0;
  let z = 0;
  for (const i of [k, k + 1]) {
    const from = rootFrame({ origin: { x: 0, z: 0, yaw }, velocity }, landing(i) - begin);
    const m = middle(i);
    x += (m.x - from.x) / 2;
    z += (m.z - from.z) / 2;
  }
  return { origin: { x, z, yaw }, velocity };
}

/** A clip's cycle: what the tables of the library are baked from. */
export interface Cycle {
  analysis: ClipAnalysis;
  root: RootMotion;
  /** Index of the step it begins with. */
  first: number;
}

/**
 * Finds a clip's cycle and measures its steps.
 *
 * @throws CycleError naming the clip when it has no three alternating steps after its first footsteps.
 */
export function analyseClip(source: CyclicSource): Cycle {
  const k = bestCycle(source);
  const { steps, clip } = source;
  const root = rootMotion(source, k);
  const rate = clip.rate;
  const begin = liftFrame(steps[k]);
  const one = (i: number): AnimationStep => {
    const step = steps[i];
    const lift = liftFrame(step);
    const frame = rootFrame(root, (lift - begin) / rate);
    const swing = (landFrame(step) - lift) / rate;
    const duration = (liftFrame(steps[i + 1]) - lift) / rate;
    const same = steps.findIndex((s, n) => n > i && s.foot === step.foot);
    const before = steps.findLastIndex((s, n) => n < i && s.foot === step.foot);
    const stance =
      same >= 0
        ? (liftFrame(steps[same]) - landFrame(step)) / rate
        : before >= 0
          ? (lift - landFrame(steps[before])) / rate
          : duration;
    return {
      foot: step.foot,
      swing,
      duration,
      stance,
      landing: toLocal(frame, step.to),
      support: toLocal(frame, steps[i - 1].to),
      displacement: uniformMove({ x: 0, z: 0, yaw: 0 }, root.velocity, swing),
      whole: uniformMove({ x: 0, z: 0, yaw: 0 }, root.velocity, duration),
    };
  };
  const pair = [one(k), one(k + 1)];
  if (pair[0].foot === "right") pair.reverse();
  return {
    analysis: {
      name: source.name,
      velocity: root.velocity,
      steps: [pair[0], pair[1]],
      frames: { first: begin, second: liftFrame(steps[k + 1]), end: liftFrame(steps[k + 2]) },
    },
    root,
    first: k,
  };
}
