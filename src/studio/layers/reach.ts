/** Hands led to what they hold or write on, and the box that follows the body. */
import type { Clip } from "../../core/capture/clip.ts";
import { bendTrunk } from "../../core/ik/trunk.ts";
import { solveTwoBone } from "../../core/ik/two-bone.ts";
import { wrapAngle } from "../../core/math/angle.ts";
import { gaussian } from "../../core/math/interpolate.ts";
import {
  quatBetween,
  quatInverseMultiply,
  quatMultiply,
  quatNormalize,
  quatRotate,
} from "../../core/math/quaternion.ts";
import { J } from "../../core/skeleton/joints.ts";
import type { Skeleton } from "../../core/skeleton/skeleton.ts";
import type { BodyAngles } from "./body.ts";
import type { TaskLayer } from "./tasks.ts";

/** Hands led from where they hang to their places; the trunk helps, the elbow points down and out. */
export function reach(
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
export function carryBox(clip: Clip, body: BodyAngles, tasks: TaskLayer, skeleton: Skeleton): void {
  const scale = skeleton.height / 1.75;
  const ahead = 0.1 * scale + tasks.boxSize[2] / 2 + 0.035;
  const smooth = new Float64Array(3 * clip.frames);
  for (let f = 0; f < clip.frames; f++) {
    smooth[3 * f] = clip.root[3 * f];
    smooth[3 * f + 1] = clip.root[3 * f + 1];
    smooth[3 * f + 2] = clip.root[3 * f + 2];
  }
  // Arms give a little: the box does not take every rise and fall of the hips.
  gaussian(smooth, 3, 1.2);
  const yaw = Float64Array.from(body.chestYaw);
  gaussian(yaw, 1, 2.5);
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
