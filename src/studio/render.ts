/**
 * A score rendered into a capture: layers from the ground up, closed by inverse kinematics, corrected so that the whole
 * body's zero-moment point follows the planned pressure. See docs/studio.md.
 */
import { CLIP_RATE, type Clip } from "../core/capture/clip.ts";
import type { Sidecar } from "../core/capture/sidecar.ts";
import { solveLeg } from "../core/ik/leg.ts";
import { bendTrunk } from "../core/ik/trunk.ts";
import { solveTwoBone } from "../core/ik/two-bone.ts";
import { wrapAngle } from "../core/math/angle.ts";
import { gaussian, softEnvelope } from "../core/math/interpolate.ts";
import {
  quatBetween,
  quatFromAxisAngle,
  quatFromYawPitchRoll,
  quatInverseMultiply,
  quatMultiply,
  quatNormalize,
  quatRotate,
  quatSlerp,
} from "../core/math/quaternion.ts";
import { forwardKinematics } from "../core/skeleton/forward-kinematics.ts";
import { J, JOINT_COUNT } from "../core/skeleton/joints.ts";
import { createSkeleton, type Skeleton } from "../core/skeleton/skeleton.ts";
import type { ContactTrack } from "../core/steps/types.ts";
import { type BodyAngles, renderBody } from "./layers/body.ts";
import { pendulum, zeroMomentPoint } from "./layers/centre-of-mass.ts";
import { type FootTrack, renderFoot } from "./layers/feet.ts";
import { ballisticHeight, flightFrames, loadFactor } from "./layers/flight.ts";
import { renderGait } from "./layers/gait.ts";
import { calmKnees, type Legs } from "./layers/knees.ts";
import { planPressure } from "./layers/pressure.ts";
import { createTaskLayer, handsOnBox, renderTasks, SEAT_UNDER_HIPS, type TaskLayer } from "./layers/tasks.ts";
import type { Score } from "./score.ts";

export interface Rendered {
  clip: Clip;
  contacts: ContactTrack;
  sidecar: Sidecar;
}

/** Largest error of the zero-moment point that a round answers, metres. */
const MOST_CORRECTION = 0.09;
/** Rounds of correcting the pelvis by the whole body's zero-moment point. */
const ROUNDS = 4;
/** Under this share of the weight on the feet there is no zero-moment point to speak of. */
const LIGHT = 0.3;
const LEAST_KNEE = (3.5 * Math.PI) / 180;
const Q = 4 * JOINT_COUNT;

/** Renders a score; the same score gives the same capture. */
export function renderScore(score: Score): Rendered {
  const skeleton = createSkeleton(score.actor.height, score.actor.proportions);
  const frames = Math.max(2, Math.ceil(score.duration * CLIP_RATE) + 1);
  const feet: [FootTrack, FootTrack] = [
    renderFoot(score, "left", skeleton, frames),
    renderFoot(score, "right", skeleton, frames),
  ];
  const gait = renderGait(score, skeleton.legLength, frames);
  const body = renderBody(score, feet, gait, skeleton, frames);
  const tasks = createTaskLayer(frames);
  renderTasks(score, body, tasks, skeleton, frames);
  const pressure = planPressure(score, feet, skeleton, frames);
  pinSeats(score, body, tasks, skeleton, frames);

  const clip: Clip = {
    name: score.name,
    skeleton,
    rate: CLIP_RATE,
    frames,
    root: new Float64Array(3 * frames),
    rotations: new Float64Array(Q * frames),
  };
  const positions = new Float64Array(3 * JOINT_COUNT * frames);
  const centre = new Float64Array(3 * frames);
  const height = new Float64Array(frames);
  for (let f = 0; f < frames; f++) height[f] = body.hipHeight[f] + 0.05 * skeleton.height;
  const flight = flightFrames(feet, frames);
  let weight = flight ? loadFactor(ballisticHeight(height, flight)) : null;
  const way = pendulum(pressure.point, height, tasks.pins, weight);
  const wished = Float64Array.from(body.hipHeight);
  smoothJoins(way, tasks.pins.pinned);
  trunkRotations(clip, body, skeleton);
  const planned = feet.map((t) => ({ ankle: t.ankle.slice(), toeBend: t.toeBend.slice() }));
  for (let round = 0; ; round++) {
    placeHips(clip, way, body, feet, skeleton);
    feet.forEach((t, side) => {
      t.ankle.set(planned[side].ankle);
      t.toeBend.set(planned[side].toeBend);
    });
    const raise = calmKnees(feet, legsOf(clip, skeleton, flight));
    for (let f = 0; f < frames; f++) clip.root[3 * f + 1] += raise[f];
    closeBody(clip, feet, body, tasks, skeleton, positions, round === ROUNDS);
    if (round === ROUNDS) break;
    const load = tasks.load.share.some((s) => s > 0) ? tasks.load : null;
    const q = zeroMomentPoint(positions, JOINT_COUNT, frames, centre, load);
    if (flight) {
      // The whole body falls freely in flight, not the pelvis alone.
      const wish = Float64Array.from(
        { length: frames },
        (_, f) => centre[3 * f + 1] + wished[f] + hipsOver(body, skeleton, f) - clip.root[3 * f + 1],
      );
      const fallen = ballisticHeight(wish, flight);
      for (let f = 0; f < frames; f++) body.hipHeight[f] = wished[f] + fallen[f] - wish[f];
      weight = loadFactor(fallen);
      for (let f = 0; f < frames; f++) {
        if (weight[f] >= LIGHT) continue;
        q[2 * f] = pressure.point[2 * f];
        q[2 * f + 1] = pressure.point[2 * f + 1];
      }
    }
    // A leg out of reach throws its zero-moment point far off: one round believes a hand's breadth at most.
    for (let k = 0; k < q.length; k++)
      q[k] = Math.max(-MOST_CORRECTION, Math.min(MOST_CORRECTION, pressure.point[k] - q[k]));
    for (let f = 0; f < frames; f++) if (tasks.pins.pinned[f]) q[2 * f] = q[2 * f + 1] = 0;
    gaussian(q, 2, 2);
    const correction = pendulum(
      q,
      height,
      { pinned: tasks.pins.pinned, place: new Float64Array(2 * frames) },
      weight,
    );
    smoothJoins(correction, tasks.pins.pinned);
    for (let k = 0; k < way.length; k++) way[k] += correction[k];
  }
  hemisphere(clip);
  const contacts = new Uint8Array(frames);
  for (let f = 0; f < frames; f++) contacts[f] = feet[0].contacts[f] | (feet[1].contacts[f] << 2);
  return { clip, contacts, sidecar: sidecarOf(score, contacts) };
}

/** Seated frames: the hips over the seat, tipping about the point that the seat carries. */
function pinSeats(
  score: Score,
  body: BodyAngles,
  tasks: TaskLayer,
  skeleton: Skeleton,
  frames: number,
): void {
  const over = SEAT_UNDER_HIPS * (skeleton.height / 1.75);
  const drop = -skeleton.offsets[3 * J.leftUpperLeg + 1];
  const up = new Float64Array(4);
  const v = new Float64Array(3);
  for (const event of score.events) {
    if (event.type !== "sit") continue;
    const { task } = event;
    for (let f = 0; f < frames; f++) {
      if (
        !tasks.pins.pinned[f] ||
        Math.abs(tasks.pins.place[2 * f] - task.position[0]) +
          Math.abs(tasks.pins.place[2 * f + 1] - task.position[2]) >
          1e-9
      )
        continue;
      quatFromYawPitchRoll(up, 0, body.pelvisYaw[f], body.pelvisPitch[f], body.pelvisRoll[f]);
      quatRotate(v, 0, up, 0, 0, 1, 0);
      tasks.pins.place[2 * f] = task.position[0] + v[0] * (over + drop);
      tasks.pins.place[2 * f + 1] = task.position[2] + v[2] * (over + drop);
      body.hipHeight[f] = task.position[1] + v[1] * over;
    }
  }
  gaussianWhere(body.hipHeight, tasks.pins.pinned);
}

/** Softens a track for some frames around where pinning begins and ends. */
function gaussianWhere(track: Float64Array, pinned: Uint8Array): void {
  const n = pinned.length;
  const copy = Float64Array.from(track);
  gaussian(copy, track.length / n, 3);
  const stride = track.length / n;
  for (let f = 0; f < n; f++) {
    let near = 99;
    for (let k = -10; k <= 10; k++) {
      const a = f + k;
      if (a > 0 && a < n && pinned[a] !== pinned[a - 1]) near = Math.min(near, Math.abs(k));
    }
    if (near > 10) continue;
    const w = near <= 5 ? 1 : (10 - near) / 5;
    for (let c = 0; c < stride; c++)
      track[stride * f + c] += w * (copy[stride * f + c] - track[stride * f + c]);
  }
}

function smoothJoins(way: Float64Array, pinned: Uint8Array): void {
  gaussianWhere(way, pinned);
}

/** Pelvis, spine, head and arms as local rotations. */
function trunkRotations(clip: Clip, body: BodyAngles, _skeleton: Skeleton): void {
  const q = new Float64Array(48);
  for (let f = 0; f < clip.frames; f++) {
    const o = Q * f;
    const r = clip.rotations;
    quatFromYawPitchRoll(q, 0, body.pelvisYaw[f], body.pelvisPitch[f], body.pelvisRoll[f]);
    quatFromYawPitchRoll(q, 4, body.chestYaw[f], body.chestPitch[f], body.chestRoll[f]);
    quatFromYawPitchRoll(
      q,
      8,
      body.headYaw[f],
      body.headPitch[f] * 0.4 + body.chestPitch[f] * 0.35,
      body.headRoll[f],
    );
    quatSlerp(q, 12, q, 0, q, 4, 0.3);
    quatSlerp(q, 16, q, 0, q, 4, 0.65);
    quatSlerp(q, 20, q, 4, q, 8, 0.45);
    for (let k = 0; k < 4; k++) r[o + k] = q[k];
    quatInverseMultiply(r, o + 4 * J.spine, q, 0, q, 12);
    quatInverseMultiply(r, o + 4 * J.chest, q, 12, q, 16);
    quatInverseMultiply(r, o + 4 * J.upperChest, q, 16, q, 4);
    quatInverseMultiply(r, o + 4 * J.neck, q, 4, q, 20);
    quatInverseMultiply(r, o + 4 * J.head, q, 20, q, 8);
    // Arms hang: they follow the chest's turn and a quarter of its lean.
    quatFromYawPitchRoll(q, 24, body.chestYaw[f], 0.25 * body.chestPitch[f], 0.5 * body.chestRoll[f]);
    for (let side = 0; side < 2; side++) {
      const arm = body.arms[side];
      const sign = side === 0 ? 1 : -1;
      const shoulder = side === 0 ? J.leftShoulder : J.rightShoulder;
      quatFromAxisAngle(q, 28, 1, 0, 0, -arm.swing[f]);
      quatFromAxisAngle(q, 32, 0, 0, 1, -sign * (Math.PI / 2 - arm.out[f]));
      quatFromAxisAngle(q, 36, 1, 0, 0, arm.turn[f]);
      quatMultiply(q, 40, q, 24, q, 28);
      quatMultiply(q, 40, q, 40, q, 32);
      quatMultiply(q, 40, q, 40, q, 36);
      for (let k = 0; k < 4; k++) r[o + 4 * shoulder + k] = k === 3 ? 1 : 0;
      quatInverseMultiply(r, o + 4 * (shoulder + 1), q, 4, q, 40);
      quatFromAxisAngle(r, o + 4 * (shoulder + 2), 0, 1, 0, -sign * arm.elbow[f]);
      quatFromAxisAngle(r, o + 4 * (shoulder + 3), 0, 1, 0, -sign * 0.12);
    }
  }
}

/** The hips joint over the middle of the hip joints, metres. */
function hipsOver(body: BodyAngles, skeleton: Skeleton, f: number): number {
  return -skeleton.offsets[3 * J.leftUpperLeg + 1] * Math.cos(body.pelvisPitch[f]);
}

/** The hips' place: over the way of the mass, at the walk's height, lowered softly where a leg would not reach. */
function placeHips(
  clip: Clip,
  way: Float64Array,
  body: BodyAngles,
  feet: readonly [FootTrack, FootTrack],
  skeleton: Skeleton,
): void {
  const o = skeleton.offsets;
  const thigh = -o[3 * J.leftLowerLeg + 1];
  const shank = -o[3 * J.leftFoot + 1];
  const longest = Math.sqrt(thigh * thigh + shank * shank + 2 * thigh * shank * Math.cos(LEAST_KNEE));
  const need = new Float64Array(clip.frames);
  const v = new Float64Array(3);
  for (let f = 0; f < clip.frames; f++) {
    clip.root[3 * f] = way[2 * f];
    clip.root[3 * f + 1] = body.hipHeight[f] + hipsOver(body, skeleton, f);
    clip.root[3 * f + 2] = way[2 * f + 1];
    for (let side = 0; side < 2; side++) {
      // An airborne foot gives way itself.
      if (feet[side].swing[f] > 0 && !feet[side].turning[f]) continue;
      const hip = side === 0 ? J.leftUpperLeg : J.rightUpperLeg;
      quatRotate(v, 0, clip.rotations, Q * f, o[3 * hip], o[3 * hip + 1], o[3 * hip + 2]);
      const dx = clip.root[3 * f] + v[0] - feet[side].ankle[3 * f];
      const dy = clip.root[3 * f + 1] + v[1] - feet[side].ankle[3 * f + 1];
      const dz = clip.root[3 * f + 2] + v[2] - feet[side].ankle[3 * f + 2];
      need[f] = Math.max(need[f], dy - Math.sqrt(Math.max(0.01, longest * longest - dx * dx - dz * dz)));
    }
  }
  const lower = softEnvelope(need, 5);
  for (let f = 0; f < clip.frames; f++) clip.root[3 * f + 1] -= lower[f];
}

/** Both hip joints over the frames, for the knees' layer. */
function legsOf(clip: Clip, skeleton: Skeleton, flight: Uint8Array | null): Legs {
  const o = skeleton.offsets;
  const v = new Float64Array(3);
  const hips: [Float64Array, Float64Array] = [
    new Float64Array(3 * clip.frames),
    new Float64Array(3 * clip.frames),
  ];
  for (let f = 0; f < clip.frames; f++)
    for (let side = 0; side < 2; side++) {
      const hip = side === 0 ? J.leftUpperLeg : J.rightUpperLeg;
      quatRotate(v, 0, clip.rotations, Q * f, o[3 * hip], o[3 * hip + 1], o[3 * hip + 2]);
      for (let k = 0; k < 3; k++) hips[side][3 * f + k] = clip.root[3 * f + k] + v[k];
    }
  return {
    hips,
    thigh: -o[3 * J.leftLowerLeg + 1],
    shank: -o[3 * J.leftFoot + 1],
    shape: skeleton.foot,
    flight,
  };
}

/** Legs onto the feet, hands to their places; joints' places for the zero-moment point. */
function closeBody(
  clip: Clip,
  feet: readonly [FootTrack, FootTrack],
  body: BodyAngles,
  tasks: TaskLayer,
  skeleton: Skeleton,
  all: Float64Array,
  last: boolean,
): void {
  carryBox(clip, body, tasks, skeleton);
  handsOnBox(tasks, clip.frames);
  const positions = new Float64Array(3 * JOINT_COUNT);
  const world = new Float64Array(Q);
  const pose = new Float64Array(Q);
  const root = new Float64Array(3);
  const v = new Float64Array(12);
  const q = new Float64Array(12);
  const place = new Float64Array(6);
  for (let f = 0; f < clip.frames; f++) {
    for (let k = 0; k < Q; k++) pose[k] = clip.rotations[Q * f + k];
    for (let k = 0; k < 3; k++) root[k] = clip.root[3 * f + k];
    forwardKinematics(positions, world, skeleton, root, 0, pose, 0);
    for (let side = 0; side < 2; side++) {
      const t = feet[side];
      const upper = side === 0 ? J.leftUpperLeg : J.rightUpperLeg;
      const foot = upper + 2;
      // The knee points with the foot, half with the pelvis; a little outwards.
      const out = (side === 0 ? 1 : -1) * 0.05;
      const yaw = t.yaw[f] + out + wrapAngle(body.pelvisYaw[f] - t.yaw[f]) * 0.4;
      solveLeg(
        pose,
        positions,
        world,
        J.hips,
        upper,
        skeleton.offsets,
        t.ankle[3 * f],
        t.ankle[3 * f + 1],
        t.ankle[3 * f + 2],
        Math.sin(yaw),
        0.15,
        Math.cos(yaw),
      );
      quatFromYawPitchRoll(world, 4 * foot, t.yaw[f], -t.pitch[f], 0);
      quatInverseMultiply(pose, 4 * foot, world, 4 * (upper + 1), world, 4 * foot);
      quatFromAxisAngle(pose, 4 * (foot + 1), 1, 0, 0, -t.toeBend[f]);
      quatMultiply(world, 4 * (foot + 1), world, 4 * foot, pose, 4 * (foot + 1));
      quatRotate(
        v,
        0,
        world,
        4 * foot,
        skeleton.offsets[3 * (foot + 1)],
        skeleton.offsets[3 * (foot + 1) + 1],
        skeleton.offsets[3 * (foot + 1) + 2],
      );
      for (let k = 0; k < 3; k++) positions[3 * (foot + 1) + k] = positions[3 * foot + k] + v[k];
    }
    reach(f, pose, positions, world, root, tasks, skeleton, v, q, place);
    all.set(positions, 3 * JOINT_COUNT * f);
    if (last) for (let k = 0; k < Q; k++) clip.rotations[Q * f + k] = pose[k];
  }
}

/** Hands led from where they hang to their places; the trunk helps, the elbow points down and out. */
function reach(
  f: number,
  pose: Float64Array,
  positions: Float64Array,
  world: Float64Array,
  root: Float64Array,
  tasks: TaskLayer,
  skeleton: Skeleton,
  v: Float64Array,
  q: Float64Array,
  place: Float64Array,
): void {
  const weights: [number, number] = [tasks.hands.weight[0][f], tasks.hands.weight[1][f]];
  if (weights[0] <= 0 && weights[1] <= 0) return;
  const points = [0, 0, 0, 0, 0, 0];
  for (let side = 0; side < 2; side++) {
    const w = weights[side];
    if (w <= 0) continue;
    const hand = side === 0 ? J.leftHand : J.rightHand;
    const sign = side === 0 ? 1 : -1;
    // Way the hand points: from its own to the wanted one.
    quatRotate(v, 0, world, 4 * hand, sign, 0, 0);
    const p = tasks.hands.point[side];
    let n = 0;
    for (let k = 0; k < 3; k++) {
      points[3 * side + k] = v[k] + w * (p[3 * f + k] - v[k]);
      n += points[3 * side + k] ** 2;
    }
    n = Math.sqrt(n) || 1;
    for (let k = 0; k < 3; k++) points[3 * side + k] /= n;
    for (let k = 0; k < 3; k++) {
      const free = positions[3 * hand + k];
      const wrist = tasks.hands.place[side][3 * f + k] - points[3 * side + k] * skeleton.palm;
      place[3 * side + k] = free + w * (wrist - free);
    }
  }
  bendTrunk(pose, positions, world, root, skeleton, weights, place);
  for (let side = 0; side < 2; side++) {
    if (weights[side] <= 0) continue;
    const sign = side === 0 ? 1 : -1;
    const upper = side === 0 ? J.leftUpperArm : J.rightUpperArm;
    const hand = upper + 2;
    quatRotate(v, 3, world, 4 * J.upperChest, sign * 0.55, -1, -0.25);
    solveTwoBone(
      pose,
      0,
      positions,
      world,
      upper - 1,
      upper,
      upper + 1,
      hand,
      skeleton.offsets,
      place[3 * side],
      place[3 * side + 1],
      place[3 * side + 2],
      v,
      3,
    );
    // The hand points as wanted.
    quatMultiply(q, 0, world, 4 * (upper + 1), pose, 4 * hand);
    quatRotate(v, 0, q, 0, sign, 0, 0);
    quatBetween(q, 4, v[0], v[1], v[2], points[3 * side], points[3 * side + 1], points[3 * side + 2]);
    quatMultiply(world, 4 * hand, q, 4, q, 0);
    quatInverseMultiply(pose, 4 * hand, world, 4 * (upper + 1), world, 4 * hand);
    quatNormalize(pose, 4 * hand);
  }
}

/** A carried box follows the pelvis: its place between the table's and the body's. */
function carryBox(clip: Clip, body: BodyAngles, tasks: TaskLayer, skeleton: Skeleton): void {
  const scale = skeleton.height / 1.75;
  const ahead = 0.1 * scale + tasks.boxSize[2] / 2 + 0.05;
  const smooth = new Float64Array(3 * clip.frames);
  for (let f = 0; f < clip.frames; f++) {
    smooth[3 * f] = clip.root[3 * f];
    smooth[3 * f + 1] = clip.root[3 * f + 1];
    smooth[3 * f + 2] = clip.root[3 * f + 2];
  }
  const yaw = Float64Array.from(body.chestYaw);
  gaussian(yaw, 1, 4);
  if (!tasks.original) {
    tasks.original = { box: Float64Array.from(tasks.box), yaw: Float64Array.from(tasks.boxYaw) };
  }
  for (let f = 0; f < clip.frames; f++) {
    const w = tasks.carry[f];
    if (tasks.held[f] === 0 && tasks.hands.weight[0][f] === 0) continue;
    const own = yaw[f];
    const x = smooth[3 * f] + Math.sin(own) * ahead;
    const z = smooth[3 * f + 2] + Math.cos(own) * ahead;
    const y = smooth[3 * f + 1] + 0.13 * scale;
    const at = tasks.original;
    const u = tasks.held[f] ? w : 0;
    tasks.box[3 * f] = at.box[3 * f] + u * (x - at.box[3 * f]);
    // Up before back: the box clears the table's edge.
    tasks.box[3 * f + 1] = at.box[3 * f + 1] + Math.min(1, u * 1.25) * (y - at.box[3 * f + 1]);
    tasks.box[3 * f + 2] = at.box[3 * f + 2] + u * (z - at.box[3 * f + 2]);
    tasks.boxYaw[f] = at.yaw[f] + u * wrapAngle(own - at.yaw[f]);
    tasks.load.place.set(tasks.box.subarray(3 * f, 3 * f + 3), 3 * f);
  }
}

/** Consecutive rotations in one hemisphere. */
function hemisphere(clip: Clip): void {
  const r = clip.rotations;
  for (let f = 1; f < clip.frames; f++) {
    for (let j = 0; j < JOINT_COUNT; j++) {
      const a = Q * f + 4 * j;
      const b = a - Q;
      if (r[a] * r[b] + r[a + 1] * r[b + 1] + r[a + 2] * r[b + 2] + r[a + 3] * r[b + 3] < 0)
        for (let k = 0; k < 4; k++) r[a + k] = -r[a + k];
    }
  }
}

function sidecarOf(score: Score, contacts: ContactTrack): Sidecar {
  const runs = (bit: number): [number, number][] => {
    const out: [number, number][] = [];
    let from = -1;
    for (let f = 0; f <= contacts.length; f++) {
      const on = f < contacts.length && (contacts[f] & bit) !== 0;
      if (on && from < 0) from = f;
      if (!on && from >= 0) {
        out.push([from, f]);
        from = -1;
      }
    }
    return out;
  };
  const lift = score.events.find((e) => e.type === "lift");
  return {
    version: 1,
    name: score.name,
    licence: "CC0-1.0",
    height: score.actor.height,
    rate: CLIP_RATE,
    tasks: score.events.map((e) => e.task),
    contacts: { leftHeel: runs(1), leftToe: runs(2), rightHeel: runs(4), rightToe: runs(8) },
    steps: score.steps.map((s) => ({
      foot: s.foot,
      category: s.kind,
      lift: s.lift,
      land: s.land,
      x: s.x,
      z: s.z,
      yaw: s.yaw,
    })),
    ...(lift && lift.type === "lift" ? { load: lift.mass } : {}),
  };
}
