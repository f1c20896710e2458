/**
 * Motion-quality figures on a motion with contacts: what the editor shows and the result document carries.
 *
 * Definitions follow docs/quality.md.
 */
import { wrapAngle } from "../math/angle.ts";
import { quatRotate, quatYaw } from "../math/quaternion.ts";
import type { MotionChunk, QualityFigures } from "../motion/types.ts";
import { forwardKinematics } from "../skeleton/forward-kinematics.ts";
import { J, JOINT_COUNT } from "../skeleton/joints.ts";
import type { Skeleton } from "../skeleton/skeleton.ts";
import type { Footstep } from "../steps/types.ts";
import type { Plan } from "../tasks/plan-types.ts";
import type { TaskGoal } from "../tasks/transition.ts";
import { balanceShares } from "./balance.ts";
import { checkClaims } from "./claims.ts";
import { createRangeWorkspace, jointsOutOfRange } from "./joint-ranges.ts";
import { type MotionPace, paceOf, steadyFrames } from "./kind.ts";
import { jerkRatio, poppingOf } from "./smoothness.ts";

/** Sole points a foot: heel, ball, tip. */
const ROW = 9;

export interface MotionPoints {
  frames: number;
  /** frames x JOINT_COUNT x 3. */
  joints: Float64Array;
  /** frames x 2 x 9: heel, ball, tip of left and right. */
  soles: Float64Array;
  /** frames x 2 x 3: palms. */
  palms: Float64Array;
  /** Pelvis up axis, frames x 3. */
  up: Float64Array;
  contacts: Uint8Array;
  /** Local rotations xyzw, frames x JOINT_COUNT x 4. */
  rotations: Float64Array;
  /** The hips' place, frames x 3, and where they face. */
  root: Float64Array;
  yaw: Float64Array;
  /** Frames with a joint outside of its anatomical range. */
  outOfRange: number;
}

/** Places of joints and soles over a motion. */
export function motionPoints(
  skeleton: Skeleton,
  chunks: readonly MotionChunk[],
  frames: number,
): MotionPoints {
  const out: MotionPoints = {
    frames,
    joints: new Float64Array(3 * JOINT_COUNT * frames),
    soles: new Float64Array(2 * ROW * frames),
    palms: new Float64Array(6 * frames),
    up: new Float64Array(3 * frames),
    contacts: new Uint8Array(frames),
    rotations: new Float64Array(4 * JOINT_COUNT * frames),
    root: new Float64Array(3 * frames),
    yaw: new Float64Array(frames),
    outOfRange: 0,
  };
  const ranges = createRangeWorkspace();
  const p = new Float64Array(3 * JOINT_COUNT);
  const w = new Float64Array(4 * JOINT_COUNT);
  const v = new Float64Array(3);
  const shape = skeleton.foot;
  for (const chunk of chunks) {
    for (let k = 0; k < chunk.frames; k++) {
      const f = chunk.first + k;
      if (f >= frames) break;
      forwardKinematics(p, w, skeleton, chunk.root, 3 * k, chunk.rotations, 4 * JOINT_COUNT * k);
      out.joints.set(p, 3 * JOINT_COUNT * f);
      out.contacts[f] = chunk.contacts[k];
      out.rotations.set(
        chunk.rotations.subarray(4 * JOINT_COUNT * k, 4 * JOINT_COUNT * (k + 1)),
        4 * JOINT_COUNT * f,
      );
      for (let i = 0; i < 3; i++) out.root[3 * f + i] = p[i];
      out.yaw[f] = quatYaw(w, 0);
      if (jointsOutOfRange(p, 0, w, 0, ranges).length > 0) out.outOfRange++;
      quatRotate(v, 0, w, 0, 0, 1, 0);
      out.up.set(v, 3 * f);
      for (let side = 0; side < 2; side++) {
        const foot = side === 0 ? J.leftFoot : J.rightFoot;
        const hand = side === 0 ? J.leftHand : J.rightHand;
        const o = (2 * f + side) * ROW;
        quatRotate(v, 0, w, 4 * foot, 0, -shape.ankleHeight, -shape.heelBack);
        for (let i = 0; i < 3; i++) out.soles[o + i] = p[3 * foot + i] + v[i];
        quatRotate(v, 0, w, 4 * (foot + 1), 0, -shape.ballHeight, 0);
        for (let i = 0; i < 3; i++) out.soles[o + 3 + i] = p[3 * (foot + 1) + i] + v[i];
        quatRotate(v, 0, w, 4 * (foot + 1), 0, -shape.ballHeight, shape.tipForward);
        for (let i = 0; i < 3; i++) out.soles[o + 6 + i] = p[3 * (foot + 1) + i] + v[i];
        quatRotate(v, 0, w, 4 * hand, side === 0 ? skeleton.palm : -skeleton.palm, 0, 0);
        for (let i = 0; i < 3; i++) out.palms[6 * f + 3 * side + i] = p[3 * hand + i] + v[i];
      }
    }
  }
  return out;
}

/** 95th percentile; null of nothing. */
function p95(values: number[]): number | null {
  if (values.length === 0) return null;
  values.sort((a, b) => a - b);
  return values[Math.min(values.length - 1, Math.floor(0.95 * values.length))];
}

/** The figures of a motion that answers a plan. Millimetres, degrees, shares. */
export function measureMotion(
  skeleton: Skeleton,
  chunks: readonly MotionChunk[],
  frames: number,
  plan: Plan,
  goals: readonly TaskGoal[],
): QualityFigures {
  const points = motionPoints(skeleton, chunks, frames);
  const ground = groundUnder(plan, frames);
  levelSoles(points, plan);
  const slides: number[] = [];
  const flats: number[] = [];
  let deepest = 0;
  const floats: number[] = [];
  for (let side = 0; side < 2; side++) {
    const at = (f: number, k: number) => points.soles[(2 * f + side) * ROW + k];
    const bits = (f: number) => (points.contacts[f] >> (2 * side)) & 3;
    // Heel plants by the heel point; toe plants by whichever of ball and tip moves less from frame to frame.
    for (const bit of [1, 2]) {
      for (const [a, b] of runs(frames, (f) => (bits(f) & bit) !== 0)) {
        let x = 0;
        let z = 0;
        let far = 0;
        for (let f = a + 1; f < b; f++) {
          let dx = Number.POSITIVE_INFINITY;
          let dz = 0;
          for (const k of bit === 1 ? [0] : [3, 6]) {
            const ex = at(f, k) - at(f - 1, k);
            const ez = at(f, k + 2) - at(f - 1, k + 2);
            if (ex * ex + ez * ez < dx * dx + dz * dz || dx === Number.POSITIVE_INFINITY) {
              dx = ex;
              dz = ez;
            }
          }
          x += dx;
          z += dz;
          far = Math.max(far, Math.hypot(x, z));
        }
        slides.push(1000 * far);
        for (let f = a; f < b; f++) {
          const y = (bit === 1 ? at(f, 1) : Math.min(at(f, 4), at(f, 7))) - ground[side][f];
          deepest = Math.max(deepest, -1000 * y);
          floats.push(Math.max(0, 1000 * y));
        }
      }
    }
    for (const [a, b] of runs(frames, (f) => bits(f) === 3)) {
      let far = 0;
      for (let f = a; f < b; f++) far = Math.max(far, Math.hypot(at(f, 3) - at(a, 3), at(f, 5) - at(a, 5)));
      flats.push(1000 * far);
    }
  }
  const pace = paceOf(points.root, points.yaw, frames, 60);
  // What stands for most of the time but steps is no standing: real ones that stand never lift a foot.
  const kind = pace.kind === "stand" && plan.steps.length > 0 ? "all" : pace.kind;
  const popping = poppingOf(points.rotations, frames, kind);
  const leg = skeleton.legLength - skeleton.foot.ankleHeight;
  const balance = balanceShares(points, skeleton, plan, goals, ground);
  return {
    skate: p95(slides),
    skateFlat: p95(flats),
    penetration: deepest,
    float: p95(floats),
    reach: reachOf(points, plan, goals, skeleton),
    footstepError: footstepErrorOf(points, plan, ground, skeleton.foot.ankleHeight),
    limitViolations: points.outOfRange,
    popping: popping?.popping ?? null,
    poppingOwn: popping?.own ?? null,
    jerk: steadyJerk(points, pace, leg),
    balance: balance.near,
    balanceWithin50mm: balance.wide,
    missedPlants: checkClaims(points.soles, points.contacts, ground, frames, 60, leg).missed,
  };
}

/**
 * Jerk over the motion's steady part, beside real people's at its speed: where the hips keep going, else, in a motion that stands,
 * all of it. Standing between walks would halve the mean speed that real jerk is looked up at, and starts and stops are not steady.
 *
 * @param pace of the same motion, at 60 frames a second as `points` are.
 * @param leg hip to ankle, metres.
 * @returns null of less than a third of a second.
 */
export function steadyJerk(points: MotionPoints, pace: MotionPace, leg: number): number | null {
  const { frames, joints } = points;
  const going = steadyFrames(pace, 60);
  const count = going.reduce((a, b) => a + b, 0);
  if (count < 60 && pace.kind === "stand") return jerkRatio(joints, frames, 60, leg, "stand", 0);
  const kind = pace.kind === "stand" || pace.kind === "all" ? "walk" : pace.kind;
  // A few steps, or steps that each come to rest, are never steady: from the first to the last of them.
  if (count < 60)
    return jerkRatio(joints, frames, 60, leg, kind, pace.speeds, (f) => f >= pace.first && f <= pace.last);
  return jerkRatio(joints, frames, 60, leg, kind, pace.alongWay, (f) => going[f] === 1);
}

/** Height of the ground under left and right foot: of the footstep it stands on or, past the middle of a swing, goes to. */
function groundUnder(plan: Plan, frames: number): [Float64Array, Float64Array] {
  const out: [Float64Array, Float64Array] = [new Float64Array(frames), new Float64Array(frames)];
  plan.start.forEach((s, side) => {
    out[side].fill(s.y);
  });
  for (const s of [...plan.steps].sort((a, b) => a.land - b.land))
    out[s.foot === "left" ? 0 : 1].fill(s.y, Math.max(0, Math.round(30 * (s.lift + s.land))));
  return out;
}

/**
 * Heights of the soles as they would be were the ground of each footstep level: on a slope what counts is how far a point is over
 * or under the slope through its footstep.
 */
function levelSoles(points: MotionPoints, plan: Plan): void {
  const { soles, frames } = points;
  const level = (s: Footstep, from: number, to: number): void => {
    const [nx, nz] = s.normal ?? [0, 0];
    if (nx === 0 && nz === 0) return;
    const up = Math.sqrt(1 - nx * nx - nz * nz);
    const side = s.foot === "left" ? 0 : 1;
    for (let f = from; f < to; f++) {
      for (let o = (2 * f + side) * ROW; o < (2 * f + side + 1) * ROW; o += 3)
        soles[o + 1] += (nx * (soles[o] - s.x) + nz * (soles[o + 2] - s.z)) / up;
    }
  };
  for (const foot of ["left", "right"] as const) {
    let ground: Footstep = plan.start[foot === "left" ? 0 : 1];
    let from = 0;
    const own = plan.steps.filter((s) => s.foot === foot).sort((a, b) => a.land - b.land);
    for (const s of own) {
      const middle = Math.max(from, Math.min(frames, Math.round(30 * (s.lift + s.land))));
      level(ground, from, middle);
      ground = s;
      from = middle;
    }
    level(ground, from, frames);
  }
}

function runs(frames: number, on: (f: number) => boolean): [number, number][] {
  const out: [number, number][] = [];
  let from = -1;
  for (let f = 0; f <= frames; f++) {
    const is = f < frames && on(f);
    if (is && from < 0) from = f;
    if (!is && from >= 0) {
      if (f - from > 2) out.push([from, f]);
      from = -1;
    }
  }
  return out;
}

/** Largest distance of hand, box or seat from its target at contact, mm. */
function reachOf(
  points: MotionPoints,
  plan: Plan,
  goals: readonly TaskGoal[],
  skeleton: Skeleton,
): number | null {
  let worst: number | null = null;
  for (const t of plan.tasks) {
    const goal = goals.find((g) => g.id === t.id);
    if (!goal || t.clip < 0 || goal.category === "turn" || goal.category === "stand") continue;
    const f = Math.max(0, Math.min(points.frames - 1, Math.round(t.contact * 60)));
    const target = [goal.frame.x, goal.height, goal.frame.z];
    const d = (x: number, y: number, z: number) =>
      1000 * Math.hypot(x - target[0], y - target[1], z - target[2]);
    const palm = (side: number, k: number) => points.palms[6 * f + 3 * side + k];
    let distance: number;
    if (goal.category === "write") {
      const side = goal.hand === "left" ? 0 : 1;
      distance = d(palm(side, 0), palm(side, 1), palm(side, 2));
    } else if (goal.category === "sit") {
      const hip = (k: number) =>
        (points.joints[3 * (JOINT_COUNT * f + J.leftUpperLeg) + k] +
          points.joints[3 * (JOINT_COUNT * f + J.rightUpperLeg) + k]) /
        2;
      distance = Number.POSITIVE_INFINITY;
      // The seat is met by a point 60 to 120 mm under the hip joints.
      for (let under = 0.06; under <= 0.1201; under += 0.01) {
        const u = under * (skeleton.height / 1.75);
        distance = Math.min(
          distance,
          d(
            hip(0) - u * points.up[3 * f],
            hip(1) - u * points.up[3 * f + 1],
            hip(2) - u * points.up[3 * f + 2],
          ),
        );
      }
    } else
      distance = d(
        (palm(0, 0) + palm(1, 0)) / 2,
        (palm(0, 1) + palm(1, 1)) / 2,
        (palm(0, 2) + palm(1, 2)) / 2,
      );
    worst = Math.max(worst ?? 0, distance);
  }
  return worst;
}

/** Planned against executed footsteps: place (mm) of the ankle over flat soles, and nothing is taken off. */
function footstepErrorOf(
  points: MotionPoints,
  plan: Plan,
  ground: readonly [Float64Array, Float64Array],
  ankleHeight: number,
): QualityFigures["footstepError"] {
  let place = 0;
  let yaw = 0;
  let judged = 0;
  plan.steps.forEach((s, i) => {
    const side = s.foot === "left" ? 0 : 1;
    const joint = side === 0 ? J.leftFoot : J.rightFoot;
    const next = plan.steps.findIndex((n, k) => k > i && n.foot === s.foot);
    const until = Math.min(
      points.frames - 1,
      Math.round((next >= 0 ? plan.steps[next].lift : plan.duration) * 60),
    );
    // Where both ends are claimed and the foot lies flattest: heel point and ball at one height.
    let best = -1;
    let least = 2e-4;
    for (let f = Math.round(s.land * 60); f < until; f++) {
      if (((points.contacts[f] >> (2 * side)) & 3) !== 3) continue;
      const heel = Math.abs(points.soles[(2 * f + side) * ROW + 1] - ground[side][f]);
      if (heel < least) {
        least = heel;
        best = f;
      }
    }
    if (best < 0) return;
    const o = 3 * (JOINT_COUNT * best + joint);
    // Over flat soles the ankle is off by its height along the ground's normal.
    const [nx, nz] = s.normal ?? [0, 0];
    const dx = points.joints[o] - s.x - ankleHeight * nx;
    const dz = points.joints[o + 2] - s.z - ankleHeight * nz;
    place = Math.max(place, 1000 * Math.hypot(dx, dz));
    const heading = Math.atan2(
      points.joints[o + 3] - points.joints[o],
      points.joints[o + 5] - points.joints[o + 2],
    );
    yaw = Math.max(yaw, Math.abs(wrapAngle(heading - s.yaw)) * (180 / Math.PI));
    judged++;
  });
  return judged > 0 ? { position: place, yaw } : null;
}
