/**
 * Full-body motion from a plan [TaskLoco §6]: warped feet and root first, then the body closed onto feet, hands and seat.
 *
 * The first pass runs over the whole plan (it is cheap and forward in time); the second makes chunks of frames in any
 * order, so that what is shown can come first.
 */
import { CLIP_RATE, type Clip } from "../capture/clip.ts";
import { JOINT_COUNT } from "../skeleton/joints.ts";
import type { Skeleton } from "../skeleton/skeleton.ts";
import type { Step } from "../steps/types.ts";
import type { Plan } from "../tasks/plan-types.ts";
import type { TaskGoal } from "../tasks/transition.ts";
import type { Library } from "../templates/types.ts";
import { balanceBody, type KeptBalance } from "./balance-pass.ts";
import { type BodyTrack, createBodyState, createBodyTrack, runBodyPass } from "./body-pass.ts";
import { boxTracks, createHandState, type HandState, handTargets, inkOf } from "./hand-pass.ts";
import { raiseHeels } from "./heel-pass.ts";
import { leadToSeats, reachWithLegs, softenSwings } from "./hips-pass.ts";
import {
  closeArms,
  closeLegs,
  createLimbWorkspace,
  type HandTargets,
  type LimbWorkspace,
} from "./limb-pass.ts";
import { type SegmentSetup, setUpSegments } from "./segment-setup.ts";
import { taskWindows } from "./task-windows.ts";
import type { BoxTrack, InkStroke, MotionChunk } from "./types.ts";

const Q = JOINT_COUNT * 4;

export interface Synthesis {
  frames: number;
  skeleton: Skeleton;
  track: BodyTrack;
  setups: SegmentSetup[];
  hands: HandState;
  limbs: LimbWorkspace;
  targets: HandTargets;
}

/** Swing paths of captures' steps, kept over plans. */
export type SwingCache = Map<Step, { travel: Float64Array; yaw: Float64Array }>;

/**
 * First pass: where root and feet are in every frame of the plan.
 *
 * @param kept the balance of the motion that is playing, so that a re-plan goes on from it without a seam.
 */
export function beginSynthesis(
  library: Library,
  skeleton: Skeleton,
  plan: Plan,
  goals: readonly TaskGoal[],
  cache: SwingCache,
  kept: KeptBalance | null = null,
): Synthesis {
  const frames = Math.max(1, Math.round(plan.duration * CLIP_RATE));
  const setups = setUpSegments(library, plan, cache);
  const track = createBodyTrack(frames);
  runBodyPass(track, setups, skeleton, createBodyState());
  const windows = taskWindows(library, plan, new Map(goals.map((g) => [g.id, g])));
  leadToSeats(track, setups, windows, skeleton);
  const limbs = createLimbWorkspace();
  balanceBody(track, windows, skeleton, limbs, kept);
  raiseHeels(track, setups, skeleton, kept);
  softenSwings(track, skeleton);
  reachWithLegs(track, skeleton, kept);
  return {
    frames,
    skeleton,
    track,
    setups,
    hands: createHandState(windows, frames),
    limbs,
    targets: { weight: [0, 0], place: new Float64Array(6) },
  };
}

/** Second pass over frames first..first+frames-1, which must be asked for in order of time. */
export function synthesiseChunk(s: Synthesis, first: number, frames: number): MotionChunk {
  const count = Math.max(0, Math.min(frames, s.frames - first));
  const root = new Float32Array(3 * count);
  const rotations = new Float32Array(Q * count);
  for (let k = 0; k < count; k++) {
    poseFrame(s, first + k);
    for (let i = 0; i < 3; i++) root[3 * k + i] = s.limbs.root[i];
    for (let i = 0; i < Q; i++) rotations[Q * k + i] = s.limbs.pose[i];
  }
  return { first, frames: count, root, rotations, contacts: s.track.contacts.slice(first, first + count) };
}

function poseFrame(s: Synthesis, frame: number): void {
  closeLegs(s.limbs, s.track, frame, s.skeleton);
  handTargets(s.targets, s.hands, s.limbs, s.track, s.setups, frame, s.skeleton);
  closeArms(s.limbs, s.targets, s.skeleton);
}

/** What the hands left: boxes' ways and ink; complete once every frame has been made. */
export function handResults(s: Synthesis): { boxes: BoxTrack[]; ink: InkStroke[] } {
  return { boxes: boxTracks(s.hands, s.frames), ink: inkOf(s.hands) };
}

/** The whole motion as a clip, for export and measuring. */
export function synthesiseClip(s: Synthesis, name: string): Clip {
  const root = new Float64Array(3 * s.frames);
  const rotations = new Float64Array(Q * s.frames);
  for (let f = 0; f < s.frames; f++) {
    poseFrame(s, f);
    root.set(s.limbs.root, 3 * f);
    rotations.set(s.limbs.pose, Q * f);
  }
  return { name, skeleton: s.skeleton, rate: CLIP_RATE, frames: s.frames, root, rotations };
}
