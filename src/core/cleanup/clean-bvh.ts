/**
 * Footskate removal on a BVH as it is: its own skeleton, rate and channels [Kovar, Schreiner and Gleicher 2002, as Oracle §7 uses it].
 *
 * Every plant gets one place over which the foot rolls; the root follows softly by half of what both feet need, the legs close
 * analytically, and corrections blend into the frames around.
 */
import type { BvhFile } from "../capture/bvh-parse.ts";
import { worldOf } from "../capture/bvh-world.ts";
import type { Clip } from "../capture/clip.ts";
import { mapJoints } from "../capture/names.ts";
import { LEG_ROW, POINT, trackOf } from "../contacts/motion-track.ts";
import type { ContactTrack } from "../steps/types.ts";
import { fileMotion, writeRoot } from "./file-motion.ts";
import { closeLeg, hingeOf, type Leg, lowerRoot, settleKnee } from "./legs.ts";
import { correctFoot } from "./roll.ts";
import { kneesOf, rootShift } from "./root.ts";
import { type FootJoints, padsOf } from "./soles.ts";

export interface CleanReport {
  plants: number;
  /** Largest move of a foot and of the root, metres. */
  largestMove: number;
  largestRoot: number;
}

/** Seconds in which a correction blends in and out: 30 frames at 60 Hz [Oracle §7]. */
const BLEND = 0.5;

/**
 * A cleaned copy of `file`.
 *
 * @param clip the same motion on the project's skeleton at 60 Hz (what importBvh gives).
 * @param contacts its contacts, one byte a clip frame.
 * @throws Error when thigh, shank and foot do not follow one another in the file's skeleton.
 */
export function cleanBvh(
  file: BvhFile,
  clip: Clip,
  contacts: ContactTrack,
): { file: BvhFile; report: CleanReport } {
  const joints = mapJoints(
    file.joints.map((j) => j.name),
    file.joints.map((j) => j.parent),
  );
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
  const legLength = clip.skeleton.legLength;
  const pads = padsOf(motion, legs, bitsOf, legLength, (f, side) => {
    const o = (2 * clipFrame(f) + side) * LEG_ROW;
    const x = track.points[o + POINT.tip] - track.points[o + POINT.ankle];
    const z = track.points[o + POINT.tip + 2] - track.points[o + POINT.ankle + 2];
    // The clip's ground is x, z; the file's first ground axis is z under Y up, and x, then -z, under Z up.
    return up === "y" ? [z, x] : [x, -z];
  });
  const corrections = pads.map((p, side) =>
    correctFoot(
      p,
      Uint8Array.from({ length: n }, (_, f) => bitsOf(f, side)),
      kneesOf(motion, legs[side]).gain,
      {
        rate,
        leg: legLength,
        blend: BLEND,
      },
    ),
  );
  // The root follows; then it goes down where a leg would still be too straight.
  const shift = rootShift(
    motion,
    legs,
    corrections.map((c) => c.move),
  );
  lowerRoot(shift, legs, corrections, motion);
  legs.forEach((leg, side) => {
    settleKnee(leg, corrections[side], shift, motion);
  });
  const out: BvhFile = { ...file, values: file.values.slice() };
  writeRoot(out, joints.get("hips") ?? 0, shift, motion.q, motion.joints, scale);
  const hinges = legs.map((leg) => hingeOf(leg, motion));
  let largestMove = 0;
  let largestRoot = 0;
  for (let f = 0; f < n; f++) {
    largestRoot = Math.max(largestRoot, Math.hypot(shift[3 * f], shift[3 * f + 1], shift[3 * f + 2]));
    corrections.forEach((correction, side) => {
      const { move } = correction;
      largestMove = Math.max(largestMove, Math.hypot(move[3 * f], move[3 * f + 1], move[3 * f + 2]));
      closeLeg(out, legs[side], f, motion, shift, correction, hinges[side]);
    });
  }
  return {
    file: out,
    report: { plants: corrections.reduce((sum, c) => sum + c.plants.length, 0), largestMove, largestRoot },
  };
}

/** Length of a joint's end site, else of its first child's offset, in the file's units. */
function toeEnd(file: BvhFile, joint: number): number {
  const length = (v: readonly number[]): number => Math.hypot(v[0], v[1], v[2]);
  const ends = file.joints[joint].endSites.map(length);
  const children = file.joints.filter((j) => j.parent === joint).map((j) => length(j.offset));
  return Math.max(0, ...ends, ...children);
}
