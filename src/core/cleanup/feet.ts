/** Both feet of a file as clean-up sees them: joints, kinematics, pads and contact bits at the file's own rate. */
import type { BvhFile } from "../capture/bvh-parse.ts";
import { worldOf } from "../capture/bvh-world.ts";
import type { Clip } from "../capture/clip.ts";
import { LEG_ROW, POINT, trackOf } from "../contacts/motion-track.ts";
import type { JointName } from "../skeleton/joints.ts";
import type { ContactTrack } from "../steps/types.ts";
import { fileMotion } from "./file-motion.ts";
import type { Leg } from "./legs.ts";
import { type FileMotion, type FootJoints, type PadTrack, padsOf, solesOf } from "./soles.ts";

export interface FileFeet {
  legs: (Leg & FootJoints)[];
  motion: FileMotion;
  /** Metres a unit of the file. */
  scale: number;
  pads: PadTrack[];
  /** Contact bits of each foot, one byte a frame of the file: 1 heel, 2 toe. */
  bits: Uint8Array[];
}

/**
 * @param rested the same motion with its feet on the ground, once it is known: there soles show where they are. A capture that floats
 * up and down tells them a centimetre too high or too low, and a foot that rolls then slides by millimetres.
 * @throws Error when thigh, shank and foot do not follow one another in the file's skeleton.
 */
export function feetOf(
  file: BvhFile,
  clip: Clip,
  contacts: ContactTrack,
  joints: Map<JointName, number>,
  rested: BvhFile = file,
): FileFeet {
  const legs = (["left", "right"] as const).map((side): Leg & FootJoints => {
    const index = (name: "UpperLeg" | "LowerLeg" | "Foot" | "Toes") => joints.get(`${side}${name}`) ?? -1;
    const leg = { thigh: index("UpperLeg"), shank: index("LowerLeg"), foot: index("Foot") };
    if (file.joints[leg.shank]?.parent !== leg.thigh || file.joints[leg.foot]?.parent !== leg.shank)
      throw new Error(`${file.name}: thigh, shank and foot of the ${side} leg do not follow one another.`);
    return { ...leg, toes: index("Toes"), toeEnd: 0 };
  });
  const { scale, up } = worldOf(file, joints);
  for (const leg of legs) leg.toeEnd = leg.toes < 0 ? 0 : scale * toeEnd(file, leg.toes);
  const motion = fileMotion(file, scale, up);
  const { frames: n, rate } = motion;
  const track = trackOf(clip);
  const clipFrame = (f: number): number =>
    Math.max(0, Math.min(clip.frames - 1, Math.round((f * clip.rate) / rate)));
  const bitsOf = (f: number, side: number): number => (contacts[clipFrame(f)] >> (2 * side)) & 3;
  const onGround = rested === file ? motion : fileMotion(rested, scale, up);
  const soles = solesOf(onGround, legs, bitsOf, clip.skeleton.legLength, (f, side) => {
    const o = (2 * clipFrame(f) + side) * LEG_ROW;
    const x = track.points[o + POINT.tip] - track.points[o + POINT.ankle];
    const z = track.points[o + POINT.tip + 2] - track.points[o + POINT.ankle + 2];
    // The clip's ground is x, z; the file's first ground axis is z under Y up, and x, then -z, under Z up.
    return up === "y" ? [z, x] : [x, -z];
  });
  const pads = legs.map((leg, side) => padsOf(motion, leg, soles[side]));
  const bits = [0, 1].map((side) => Uint8Array.from({ length: n }, (_, f) => bitsOf(f, side)));
  return { legs, motion, scale, pads, bits };
}

/** Length of a joint's end site, else of its first child's offset, in the file's units. */
function toeEnd(file: BvhFile, joint: number): number {
  const length = (v: readonly number[]): number => Math.hypot(v[0], v[1], v[2]);
  const ends = file.joints[joint].endSites.map(length);
  const children = file.joints.filter((j) => j.parent === joint).map((j) => length(j.offset));
  return Math.max(0, ...ends, ...children);
}
