/** What the oracle looks at: knees, ankles, toes and the points of both soles over a motion, with the root's way. */
import type { Clip } from "../capture/clip.ts";
import { quatRotate, quatYaw } from "../math/quaternion.ts";
import { forwardKinematics } from "../skeleton/forward-kinematics.ts";
import { J, JOINT_COUNT } from "../skeleton/joints.ts";

/** Points of one leg in a row: knee, ankle, toe joint, heel point, ball's sole, tip; x, y, z each. */
export const LEG_ROW = 18;
export const POINT = { knee: 0, ankle: 3, toe: 6, heel: 9, ball: 12, tip: 15 } as const;

export interface MotionTrack {
  name: string;
  frames: number;
  /** Leg length, metres: every length is taken in this unit. */
  leg: number;
  /** frames x 2 x LEG_ROW: left, right. */
  points: Float64Array;
  /** frames x 4: the hips' x, y, z and heading. */
  root: Float64Array;
}

/** The track of a clip at 60 Hz. */
export function trackOf(clip: Clip): MotionTrack {
  const { skeleton, frames } = clip;
  const shape = skeleton.foot;
  const out: MotionTrack = {
    name: clip.name,
    frames,
    leg: skeleton.legLength,
    points: new Float64Array(2 * LEG_ROW * frames),
    root: new Float64Array(4 * frames),
  };
  const p = new Float64Array(3 * JOINT_COUNT);
  const w = new Float64Array(4 * JOINT_COUNT);
  const v = new Float64Array(3);
  for (let f = 0; f < frames; f++) {
    forwardKinematics(p, w, skeleton, clip.root, 3 * f, clip.rotations, 4 * JOINT_COUNT * f);
    for (let k = 0; k < 3; k++) out.root[4 * f + k] = p[k];
    out.root[4 * f + 3] = quatYaw(w, 0);
    for (let side = 0; side < 2; side++) {
      const knee = side === 0 ? J.leftLowerLeg : J.rightLowerLeg;
      const o = (2 * f + side) * LEG_ROW;
      for (let k = 0; k < 9; k++) out.points[o + k] = p[3 * knee + k];
      const sole = (to: number, joint: number, y: number, z: number): void => {
        quatRotate(v, 0, w, 4 * joint, 0, y, z);
        for (let k = 0; k < 3; k++) out.points[o + to + k] = p[3 * joint + k] + v[k];
      };
      sole(POINT.heel, knee + 1, -shape.ankleHeight, -shape.heelBack);
      sole(POINT.ball, knee + 2, -shape.ballHeight, 0);
      sole(POINT.tip, knee + 2, -shape.ballHeight, shape.tipForward);
    }
  }
  return out;
}

/** The track's mirror image: left and right exchanged, x turned about. */
export function mirrorTrack(track: MotionTrack): MotionTrack {
  const points = new Float64Array(track.points.length);
  const root = track.root.slice();
  for (let f = 0; f < track.frames; f++) {
    root[4 * f] *= -1;
    root[4 * f + 3] *= -1;
    for (let side = 0; side < 2; side++)
      for (let k = 0; k < LEG_ROW; k++)
        points[(2 * f + side) * LEG_ROW + k] =
          track.points[(2 * f + 1 - side) * LEG_ROW + k] * (k % 3 === 0 ? -1 : 1);
  }
  return { ...track, name: `${track.name}~`, points, root };
}
