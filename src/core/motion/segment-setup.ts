/**
 * What is constant over one segment of a plan: its capture, the feet before and after on both grounds, and the
 * swing foot's progress.
 */
import type { Clip } from "../capture/clip.ts";
import { wrapAngle } from "../math/angle.ts";
import type { GroundPose } from "../math/frame2.ts";
import { forwardKinematics } from "../skeleton/forward-kinematics.ts";
import { J, JOINT_COUNT } from "../skeleton/joints.ts";
import type { Step } from "../steps/types.ts";
import { type Feet, footPose, stanceBefore } from "../tasks/draft.ts";
import { pivotEnd } from "../tasks/pivots.ts";
import type { Plan, PlannedSegment, PlannedStep } from "../tasks/plan-types.ts";
import type { Library, LibraryClip } from "../templates/types.ts";
import { createGroundMap, type GroundMap } from "./ground-map.ts";
import { sampleClip } from "./sample.ts";

export interface SegmentSetup {
  segment: PlannedSegment;
  source: LibraryClip;
  map: GroundMap;
  /** 0 left, 1 right, -1 none swings. */
  swing: -1 | 0 | 1;
  step: Step | null;
  pivot: "heel" | "ball" | null;
  /** Fraction of the way travelled by the swing foot at each source frame from step.start to step.end. */
  travel: Float64Array;
  /** Foot yaw in the capture at those frames, unwrapped. */
  yaw: Float64Array;
  /** Left and right footsteps, before and after, in the plan and in the capture. */
  planBefore: [GroundPose, GroundPose];
  planAfter: [GroundPose, GroundPose];
  sourceBefore: [GroundPose, GroundPose];
  sourceAfter: [GroundPose, GroundPose];
  /** Height of the ground under each foot, plan: before and after. */
  heightBefore: [number, number];
  heightAfter: [number, number];
  /** What the user asks of the plants before and after; undefined: as the capture has them. */
  plantBefore: [PlannedStep["plant"], PlannedStep["plant"]];
  plantAfter: [PlannedStep["plant"], PlannedStep["plant"]];
  /** Whether its first frame goes on in the same capture where the segment before ended. */
  continues: boolean;
}

const root = new Float64Array(3);
const rotations = new Float64Array(JOINT_COUNT * 4);
const positions = new Float64Array(JOINT_COUNT * 3);
const world = new Float64Array(JOINT_COUNT * 4);

/** All segments of a plan, ready to be played. Caches the capture's swing paths in `cache`. */
export function setUpSegments(
  library: Library,
  plan: Plan,
  cache: Map<Step, { travel: Float64Array; yaw: Float64Array }>,
): SegmentSetup[] {
  const feet: Feet = { left: plan.start[0], right: plan.start[1] };
  const plants: SegmentSetup["plantBefore"] = [undefined, undefined];
  return plan.segments.map((segment, i) => {
    const source = library.clips[segment.clip];
    const planned = segment.step >= 0 ? plan.steps[segment.step] : null;
    const step = planned ? source.steps[planned.step] : null;
    const index = planned ? planned.step : firstStepAfter(source, segment.from);
    const stance = stanceBefore(source, index);
    const planBefore: [GroundPose, GroundPose] = [footPose(feet.left), footPose(feet.right)];
    const heightBefore: [number, number] = [feet.left.y, feet.right.y];
    const sourceBefore: [GroundPose, GroundPose] = [footPose(stance.left), footPose(stance.right)];
    const planAfter: [GroundPose, GroundPose] = [...planBefore];
    const heightAfter: [number, number] = [...heightBefore];
    const sourceAfter: [GroundPose, GroundPose] = [...sourceBefore];
    const plantBefore: SegmentSetup["plantBefore"] = [...plants];
    const swing: -1 | 0 | 1 = planned ? (planned.foot === "left" ? 0 : 1) : -1;
    if (planned && step && swing !== -1) {
      planAfter[swing] = { x: planned.x, z: planned.z, yaw: planned.yaw };
      heightAfter[swing] = planned.y;
      plants[swing] = planned.plant;
      sourceAfter[swing] = footPose(step.to);
      feet[planned.foot] = { foot: planned.foot, x: planned.x, y: planned.y, z: planned.z, yaw: planned.yaw };
    }
    let path = step ? cache.get(step) : undefined;
    if (step && !path) {
      path = swingPath(source.clip, step);
      cache.set(step, path);
    }
    const before = plan.segments[i - 1];
    return {
      segment,
      source,
      map: createGroundMap(sourceBefore, sourceAfter, planBefore, planAfter),
      swing,
      step,
      pivot: planned ? pivotEnd(planned.category) : null,
      travel: path?.travel ?? new Float64Array(0),
      yaw: path?.yaw ?? new Float64Array(0),
      planBefore,
      planAfter,
      sourceBefore,
      sourceAfter,
      heightBefore,
      heightAfter,
      plantBefore,
      plantAfter: [...plants],
      continues: before !== undefined && before.clip === segment.clip && before.to === segment.from,
    };
  });
}

/** Index of the first step that has not ended by a frame: the stance of a hold is what earlier steps left. */
function firstStepAfter(source: LibraryClip, frame: number): number {
  let i = 0;
  while (i < source.steps.length && source.steps[i].end <= frame + 1) i++;
  return i;
}

/** Fraction of the way and yaw of the swing foot over a step of a capture. */
function swingPath(clip: Clip, step: Step): { travel: Float64Array; yaw: Float64Array } {
  const n = step.end - step.start + 1;
  const travel = new Float64Array(n);
  const yaw = new Float64Array(n);
  const foot = step.foot === "left" ? J.leftFoot : J.rightFoot;
  let px = 0;
  let pz = 0;
  for (let k = 0; k < n; k++) {
    sampleClip(root, rotations, clip, step.start + k);
    forwardKinematics(positions, world, clip.skeleton, root, 0, rotations, 0);
    const x = positions[3 * foot];
    const z = positions[3 * foot + 2];
    const fx = 2 * (world[4 * foot] * world[4 * foot + 2] + world[4 * foot + 3] * world[4 * foot + 1]);
    const fz = 1 - 2 * (world[4 * foot] ** 2 + world[4 * foot + 1] ** 2);
    const y = Math.atan2(fx, fz);
    if (k > 0) {
      // Turning counts like travel at the ball's distance, so that a turn on the spot progresses too.
      const turn = wrapAngle(y - yaw[k - 1]);
      travel[k] = travel[k - 1] + Math.hypot(x - px, z - pz) + 0.1 * Math.abs(turn);
      yaw[k] = yaw[k - 1] + turn;
    } else yaw[0] = y;
    px = x;
    pz = z;
  }
  const total = travel[n - 1];
  for (let k = 0; k < n; k++) {
    const u = n > 1 ? k / (n - 1) : 1;
    travel[k] = total > 0.02 ? travel[k] / total : u * u * (3 - 2 * u);
  }
  return { travel, yaw };
}

/** Linear reading of a per-frame table at a fractional frame. */
export function readTable(table: Float64Array, frame: number): number {
  const n = table.length;
  if (n === 0) return 0;
  const f = Math.max(0, Math.min(n - 1, frame));
  const i = Math.min(n - 2, Math.floor(f));
  if (i < 0) return table[0];
  return table[i] + (f - i) * (table[i + 1] - table[i]);
}
