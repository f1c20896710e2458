/**
 * Footskate removal on a BVH as it is: its own skeleton, rate and channels [Kovar, Schreiner and Gleicher 2002, as Oracle §7 uses it].
 *
 * Every plant gets one place over which the foot rolls; the root follows softly by half of what both feet need, the legs close
 * analytically, and corrections blend into the frames around.
 */
import type { BvhFile } from "../capture/bvh-parse.ts";
import type { Clip } from "../capture/clip.ts";
import { jointsOf } from "../capture/import.ts";
import type { JointName } from "../skeleton/joints.ts";
import type { ContactTrack } from "../steps/types.ts";
import { type FileFeet, feetOf } from "./feet.ts";
import { writeRoot } from "./file-motion.ts";
import { closeLeg, hingeOf, lowerRoot, settleKnee } from "./legs.ts";
import { correctFoot } from "./roll.ts";
import { kneesOf, rootShift } from "./root.ts";

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
 * @param joints which of the file's joints ours are; left out, told by their names.
 * @throws Error when thigh, shank and foot do not follow one another in the file's skeleton.
 */
export function cleanBvh(
  file: BvhFile,
  clip: Clip,
  contacts: ContactTrack,
  joints: Map<JointName, number> = jointsOf(file),
): { file: BvhFile; report: CleanReport } {
  // Once to put the feet on the ground, and again with the soles that show there.
  const first = cleanWith(feetOf(file, clip, contacts, joints), file, clip, joints);
  return cleanWith(feetOf(file, clip, contacts, joints, first.file), file, clip, joints);
}

function cleanWith(
  { legs, motion, scale, pads, bits }: FileFeet,
  file: BvhFile,
  clip: Clip,
  joints: Map<JointName, number>,
): { file: BvhFile; report: CleanReport } {
  const { frames: n, rate } = motion;
  const corrections = pads.map((p, side) =>
    correctFoot(p, bits[side], kneesOf(motion, legs[side]).gain, {
      rate,
      leg: clip.skeleton.legLength,
      blend: BLEND,
    }),
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
