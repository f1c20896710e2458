/** What an import measures in a file: leg length, floor, and how the feet rest. */
import type { JointName } from "../skeleton/joints.ts";
import type { WorldMotion } from "./bvh-world.ts";
import type { Joints } from "./names.ts";

/** World place of one of our joints in a frame; of the nearest that the file has. */
function placeOf(world: WorldMotion, joint: number, frame: number, out: Float64Array, o: number): void {
  const i = 3 * (frame * world.joints + joint);
  for (let k = 0; k < 3; k++) out[o + k] = world.positions[i + k];
}

function distance(world: WorldMotion, a: number, b: number, frame: number): number {
  const i = 3 * (frame * world.joints + a);
  const j = 3 * (frame * world.joints + b);
  return Math.hypot(
    world.positions[i] - world.positions[j],
    world.positions[i + 1] - world.positions[j + 1],
    world.positions[i + 2] - world.positions[j + 2],
  );
}

/** Thigh, shank and ankle height as our leg length counts them. */
export function measureLeg(world: WorldMotion, joints: Joints): number {
  const g = (n: JointName) => joints.get(n) as number;
  const thigh = distance(world, g("leftUpperLeg"), g("leftLowerLeg"), 0);
  const shank = distance(world, g("leftLowerLeg"), g("leftFoot"), 0);
  return (thigh + shank) * (0.93 / 0.84);
}

export interface FeetCalibration {
  floor: number;
  /** Slope of ankle to toe when the foot is flat, left and right, radians (toe up positive); and the ankle's height over the floor. */
  slope: [number, number];
  ankle: [number, number];
}

/** How high and how steep the feet are when they rest: the stillest low frames of each. */
export function calibrateFeet(world: WorldMotion, joints: Joints): FeetCalibration {
  const out: FeetCalibration = { floor: 0, slope: [-0.6, -0.6], ankle: [0.09, 0.09] };
  const floors: number[] = [];
  (["left", "right"] as const).forEach((side, s) => {
    const foot = joints.get(`${side}Foot`) as number;
    const toe = joints.get(`${side}Toes`);
    const rows: { speed: number; y: number; slope: number }[] = [];
    const a = new Float64Array(6);
    for (let f = 1; f < world.frames; f++) {
      placeOf(world, foot, f, a, 0);
      const i = 3 * (f * world.joints + foot);
      const j = 3 * ((f - 1) * world.joints + foot);
      const speed =
        Math.hypot(
          world.positions[i] - world.positions[j],
          world.positions[i + 1] - world.positions[j + 1],
          world.positions[i + 2] - world.positions[j + 2],
        ) * world.rate;
      let slope = -0.6;
      if (toe !== undefined) {
        placeOf(world, toe, f, a, 3);
        slope = Math.atan2(a[4] - a[1], Math.hypot(a[3] - a[0], a[5] - a[2]));
      }
      rows.push({ speed, y: a[1], slope });
    }
    if (rows.length === 0) rows.push({ speed: 0, y: world.positions[3 * foot + 1], slope: -0.6 });
    // The slowest sixth, and of these the middle.
    rows.sort((x, y) => x.speed - y.speed);
    const still = rows.slice(0, Math.max(1, Math.ceil(rows.length / 6)));
    const mid = (values: number[]) => values.sort((x, y) => x - y)[values.length >> 1];
    const y = mid(still.map((r) => r.y));
    out.slope[s] = mid(still.map((r) => r.slope));
    out.ankle[s] = y;
    floors.push(y);
  });
  out.floor = Math.min(...floors) - 0.09 * (measureLeg(world, joints) / 0.93);
  return out;
}
