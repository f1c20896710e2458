/**
 * A BVH file onto our skeleton: joints mapped, scale and floor found, 60 Hz, feet where the capture has them.
 *
 * Rest poses are not trusted (some are no T-pose at all): limbs are rebuilt from where the joints are in every frame. Bones
 * take the capture's directions, knees and elbows bend in its planes, ankles stand exactly on its ankles.
 */
import { JOINT_NAMES, type JointName } from "../skeleton/joints.ts";
import { createSkeleton } from "../skeleton/skeleton.ts";
import { BvhError, type BvhFile, parseBvh } from "./bvh-parse.ts";
import { worldOf } from "./bvh-world.ts";
import type { Clip } from "./clip.ts";
import { calibrateFeet, measureLeg } from "./import-measure.ts";
import { rebuild } from "./import-rebuild.ts";
import { type Joints, mapJoints } from "./names.ts";

export interface ImportReport {
  /** Our joint: the file's. */
  mapped: Record<string, string>;
  unmapped: string[];
  /** Of our joints, those the file has none for. */
  missing: string[];
  frames: number;
  rate: number;
  seconds: number;
  /** Metres a unit of the file. */
  scale: number;
  up: "y" | "z";
  /** Height of the floor in the file, metres. */
  floor: number;
  height: number;
  legLength: number;
  warnings: string[];
}

export interface ImportResult {
  clip: Clip;
  report: ImportReport;
}

const NEEDED: JointName[] = [
  "hips",
  "leftUpperLeg",
  "leftLowerLeg",
  "leftFoot",
  "rightUpperLeg",
  "rightLowerLeg",
  "rightFoot",
];

/**
 * A BVH text as a clip on a skeleton of the actor's own size.
 *
 * @throws BvhError for broken files and rigs without legs.
 */
export function importBvh(text: string, name: string): ImportResult {
  return importBvhFile(parseBvh(text, name));
}

/**
 * The same of a file read already, e.g. by `readBvhStream`.
 *
 * @param joints which of the file's joints ours are; left out, told by their names.
 * @throws BvhError for rigs without legs.
 */
export function importBvhFile(file: BvhFile, joints: Joints = jointsOf(file)): ImportResult {
  const { name } = file;
  const lacking = NEEDED.filter((j) => !joints.has(j));
  if (lacking.length > 0) throw new BvhError(`${name}: no joint was found for ${lacking.join(", ")}.`);
  const warnings: string[] = [];
  const world = worldOf(file, joints);
  const leg = measureLeg(world, joints);
  const skeleton = createSkeleton(Math.max(1.2, Math.min(2.3, (leg / 0.93) * 1.75)));
  if (!joints.has("leftToes") || !joints.has("rightToes"))
    warnings.push(
      "This skeleton has no toes. Heel contacts are found; toe contacts are guessed from the ankle.",
    );
  const feet = calibrateFeet(world, joints);
  const clip = rebuild(file, world, joints, skeleton, feet);
  const used = new Set(joints.values());
  return {
    clip,
    report: {
      mapped: Object.fromEntries([...joints].map(([ours, i]) => [ours, file.joints[i].name])),
      unmapped: file.joints.filter((_, i) => !used.has(i)).map((j) => j.name),
      missing: JOINT_NAMES.filter((j) => !joints.has(j)),
      frames: file.frames,
      rate: Math.round((1 / file.frameTime) * 100) / 100,
      seconds: file.frames * file.frameTime,
      scale: world.scale,
      up: world.up,
      floor: feet.floor,
      height: skeleton.height,
      legLength: skeleton.legLength,
      warnings,
    },
  };
}

/** Our joints in a file, told by their names. */
export const jointsOf = (file: BvhFile): Joints =>
  mapJoints(
    file.joints.map((j) => j.name),
    file.joints.map((j) => j.parent),
  );
