/**
 * Drives a character of your own with a solved motion: any SkinnedMesh whose bones can be named, in any rest pose.
 *
 * **Order within a frame.** (1) Your own logic: input, a new motion from the planner. (2) `controller.update(dt)`: writes the local
 * rotation of every mapped bone and the place of the hips, nothing else. (3) What adds to the pose: an AnimationMixer for fingers or
 * the face, look-at, spring bones (`vrm.update(dt)`). A mixer that writes the same bones must run before, and is overwritten. (4)
 * Rendering; three updates world matrices itself.
 *
 * Turning is carried over joint by joint in world space, so rest rotations do not matter; a rest pose with lowered arms is
 * brought to the T-pose first. Legs are then closed so that the ankles are where the motion has them: feet that stand, stand.
 * Take the skeleton that a motion is planned for from `controller.skeleton`: its legs are as long as the character's.
 */
import { type Bone, type Object3D, Quaternion, Vector3 } from "three";
import { forwardKinematics } from "../core/skeleton/forward-kinematics.ts";
import { JOINT_COUNT, JOINT_NAMES, type JointName } from "../core/skeleton/joints.ts";
import { createSkeleton, REFERENCE_HEIGHT, type Skeleton } from "../core/skeleton/skeleton.ts";
import { type BoneMap, mapBones } from "./bone-map.ts";

/** A motion at 60 Hz, as `solveScene` and the planner give it. */
export interface SolvedMotion {
  skeleton: Skeleton;
  frames: number;
  /** The hips' world place, frames x 3. */
  root: ArrayLike<number>;
  /** Local rotations xyzw, frames x JOINT_COUNT x 4. */
  rotations: ArrayLike<number>;
}

export interface ControllerOptions {
  /** Bones by joint, where their names do not tell. */
  bones?: BoneMap;
  /** Plays again from the start at the end; default false. */
  loop?: boolean;
}

interface Driven {
  bone: Bone;
  joint: number;
  /** From our joint's world rotation to the bone's: the bone's rest rotation, brought to the T-pose. */
  rest: Quaternion;
}

const RATE = 60;
const Q = 4 * JOINT_COUNT;
/** Bones whose rest direction is brought to ours, and the joint at their far end. */
const LIMBS: readonly (readonly [JointName, JointName])[] = [
  ["leftUpperArm", "leftLowerArm"],
  ["leftLowerArm", "leftHand"],
  ["rightUpperArm", "rightLowerArm"],
  ["rightLowerArm", "rightHand"],
  ["leftUpperLeg", "leftLowerLeg"],
  ["leftLowerLeg", "leftFoot"],
  ["rightUpperLeg", "rightLowerLeg"],
  ["rightLowerLeg", "rightFoot"],
];
/** These follow the limb that they end. */
const ENDS: Partial<Record<JointName, JointName>> = { leftHand: "leftLowerArm", rightHand: "rightLowerArm" };

export class CharacterController {
  /** For planning: a skeleton with legs as long as the character's. */
  readonly skeleton: Skeleton;
  /** Playing time, seconds. */
  time = 0;
  /** 1 is as captured; 0 stands still. */
  speed = 1;
  loop: boolean;
  private motion: SolvedMotion | null = null;
  private readonly bones: Map<JointName, Bone>;
  private readonly driven: Driven[] = [];
  /** Hips over the ground at rest, metres. */
  private readonly hipsHeight: number;
  /** Ankles over the ground at rest, left and right. */
  private readonly ankles: [number, number];
  private readonly places = new Float64Array(3 * JOINT_COUNT);
  private readonly world = new Float64Array(Q);
  private readonly rootRow = new Float64Array(3);
  private readonly row = new Float64Array(Q);

  /**
   * Binds to the character in its rest pose, standing on the ground of `object`'s own space and facing +Z.
   *
   * @param object what holds the bones: a SkinnedMesh, or the scene of a glTF file. Its own place and turn are kept and
   *   carry the motion; its scale must be even.
   * @throws Error when a bone that is needed is not found.
   */
  constructor(
    private readonly object: Object3D,
    options: ControllerOptions = {},
  ) {
    this.loop = options.loop ?? false;
    this.bones = mapBones(object, options.bones);
    object.updateWorldMatrix(true, true);
    const turnBack = object.getWorldQuaternion(new Quaternion()).invert();
    const place = (joint: JointName): Vector3 =>
      object.worldToLocal((this.bones.get(joint) as Bone).getWorldPosition(new Vector3()));
    this.hipsHeight = place("hips").y;
    this.ankles = [place("leftFoot").y, place("rightFoot").y];
    const leg =
      place("leftUpperLeg").distanceTo(place("leftLowerLeg")) +
      place("leftLowerLeg").distanceTo(place("leftFoot")) +
      this.ankles[0];
    this.skeleton = skeletonFor(leg);
    const correction = this.restCorrections(place);
    for (const [joint, bone] of this.bones) {
      const rest = turnBack.clone().multiply(bone.getWorldQuaternion(new Quaternion()));
      rest.premultiply(correction.get(joint) ?? new Quaternion());
      this.driven.push({ bone, joint: JOINT_NAMES.indexOf(joint), rest });
    }
    // Parents are written before their children.
    this.driven.sort((a, b) => depthOf(a.bone) - depthOf(b.bone));
  }

  /** Turns that bring each limb from the rest pose to the one in which all our rotations are nothing. */
  private restCorrections(place: (joint: JointName) => Vector3): Map<JointName, Quaternion> {
    const out = new Map<JointName, Quaternion>();
    const ours = new Vector3();
    for (const [from, to] of LIMBS) {
      if (!this.bones.has(from) || !this.bones.has(to)) continue;
      const theirs = place(to).sub(place(from)).normalize();
      ours.fromArray(this.skeleton.offsets, 3 * JOINT_NAMES.indexOf(to)).normalize();
      out.set(from, new Quaternion().setFromUnitVectors(theirs, ours));
    }
    for (const [end, limb] of Object.entries(ENDS) as [JointName, JointName][]) {
      const turn = out.get(limb);
      if (turn) out.set(end, turn);
    }
    return out;
  }

  get duration(): number {
    return this.motion ? (this.motion.frames - 1) / RATE : 0;
  }

  /** Plays another motion from a time on; the one before is let go of. */
  play(motion: SolvedMotion, time = 0): void {
    this.motion = motion;
    this.time = time;
  }

  /** Moves on by `dt` seconds and poses the character. Does nothing before a motion is given. */
  update(dt: number): void {
    const { motion } = this;
    if (!motion) return;
    const { duration } = this;
    this.time += dt * this.speed;
    if (this.loop && duration > 0) this.time -= Math.floor(this.time / duration) * duration;
    this.time = Math.max(0, Math.min(duration, this.time));
    this.pose(motion, this.time * RATE);
  }

  private pose(motion: SolvedMotion, frame: number): void {
    const i = Math.min(motion.frames - 1, Math.floor(frame));
    const next = Math.min(motion.frames - 1, i + 1);
    const u = frame - i;
    for (let k = 0; k < 3; k++)
      this.rootRow[k] = motion.root[3 * i + k] * (1 - u) + motion.root[3 * next + k] * u;
    for (let j = 0; j < JOINT_COUNT; j++) {
      quat.fromArray(motion.rotations, Q * i + 4 * j);
      quat2.fromArray(motion.rotations, Q * next + 4 * j);
      quat.slerp(quat2, u).toArray(this.row, 4 * j);
    }
    forwardKinematics(this.places, this.world, motion.skeleton, this.rootRow, 0, this.row, 0);
    this.object.updateWorldMatrix(true, false);
    this.object.getWorldQuaternion(carrier);
    for (const { bone, joint, rest } of this.driven) {
      quat
        .fromArray(this.world, 4 * joint)
        .multiply(rest)
        .premultiply(carrier);
      setWorldRotation(bone, quat);
      // The hips stand as much over the ground as their legs are longer.
      if (joint === 0) {
        const rise = this.hipsHeight / motion.skeleton.offsets[1];
        setPlace(bone, this.object, this.places[0], this.places[1] * rise, this.places[2]);
      }
    }
    this.closeLeg(motion, "left", 0);
    this.closeLeg(motion, "right", 1);
  }

  /** Two bones from the hip so that the ankle is where the motion has it; the knee keeps its side, the foot its turn. */
  private closeLeg(motion: SolvedMotion, side: "left" | "right", k: 0 | 1): void {
    const upper = this.bones.get(`${side}UpperLeg`) as Bone;
    const lower = this.bones.get(`${side}LowerLeg`) as Bone;
    const foot = this.bones.get(`${side}Foot`) as Bone;
    const j = 3 * JOINT_NAMES.indexOf(`${side}Foot`);
    // Ankles that are higher or lower on the foot stay so.
    const lift = this.ankles[k] - motion.skeleton.foot.ankleHeight;
    target.set(this.places[j], this.places[j + 1] + lift, this.places[j + 2]);
    this.object.localToWorld(target);
    foot.getWorldQuaternion(keptFoot);
    upper.getWorldPosition(hip);
    lower.getWorldPosition(knee);
    foot.getWorldPosition(ankle);
    const a = hip.distanceTo(knee);
    const b = knee.distanceTo(ankle);
    const d = Math.max(Math.abs(a - b) + 1e-6, Math.min(a + b - 1e-6, hip.distanceTo(target)));
    // Bend: turn the shank about the knee's axis until hip and ankle are d apart.
    const now = Math.acos(clamp((a * a + b * b - hip.distanceToSquared(ankle)) / (2 * a * b)));
    const wanted = Math.acos(clamp((a * a + b * b - d * d) / (2 * a * b)));
    thigh.subVectors(knee, hip);
    shank.subVectors(ankle, knee);
    axis.crossVectors(thigh, shank);
    // A straight leg bends about the character's own side.
    if (axis.lengthSq() < 1e-10) axis.set(1, 0, 0).applyQuaternion(carrier);
    axis.normalize();
    turnWorld(lower, quat.setFromAxisAngle(axis, now - wanted));
    // Swing: the whole leg points at the target.
    foot.getWorldPosition(ankle);
    thigh.subVectors(ankle, hip).normalize();
    shank.subVectors(target, hip).normalize();
    turnWorld(upper, quat.setFromUnitVectors(thigh, shank));
    setWorldRotation(foot, keptFoot);
  }
}

const quat = new Quaternion();
const quat2 = new Quaternion();
const carrier = new Quaternion();
const parent = new Quaternion();
const keptFoot = new Quaternion();
const turned = new Quaternion();
const target = new Vector3();
const hip = new Vector3();
const knee = new Vector3();
const ankle = new Vector3();
const thigh = new Vector3();
const shank = new Vector3();
const axis = new Vector3();
const spot = new Vector3();

const clamp = (v: number): number => Math.max(-1, Math.min(1, v));

/** A skeleton whose legs have the length given, metres; its height is held to what skeletons may have. */
function skeletonFor(leg: number): Skeleton {
  const reference = createSkeleton().legLength;
  return createSkeleton(Math.max(1.2, Math.min(2.3, (REFERENCE_HEIGHT * leg) / reference)));
}

function depthOf(o: Object3D): number {
  let depth = 0;
  for (let p = o.parent; p; p = p.parent) depth++;
  return depth;
}

function setWorldRotation(o: Object3D, world: Quaternion): void {
  if (o.parent) {
    o.parent.getWorldQuaternion(parent).invert();
    o.quaternion.copy(parent).multiply(world);
  } else o.quaternion.copy(world);
  o.updateMatrixWorld(true);
}

function turnWorld(o: Object3D, turn: Quaternion): void {
  turned.copy(turn).multiply(o.getWorldQuaternion(quat2));
  setWorldRotation(o, turned);
}

/** Puts a bone to a place given in `space`'s own metres. */
function setPlace(o: Object3D, space: Object3D, x: number, y: number, z: number): void {
  space.localToWorld(spot.set(x, y, z));
  if (o.parent) o.parent.worldToLocal(spot);
  o.position.copy(spot);
  o.updateMatrixWorld(true);
}
