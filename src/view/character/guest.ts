/**
 * A character from a file, moved by our motion: every mapped bone takes our joint's world rotation over its own rest pose,
 * and the legs are closed onto our ankles, so that planted feet stay planted [TaskLoco §6].
 *
 * The motion is planned for a skeleton of the guest's own height and legs (`measure`), so what is left for the legs to
 * close is small.
 */
import { Box3, Group, type Object3D, Quaternion, SkinnedMesh, Texture, Vector3 } from "three";
import { forwardKinematics } from "../../core/skeleton/forward-kinematics.ts";
import { J, JOINT_COUNT, JOINT_NAMES, type JointName, PARENTS } from "../../core/skeleton/joints.ts";
import type { Skeleton } from "../../core/skeleton/skeleton.ts";
import type { BoneMap } from "./bone-map.ts";

/** Bones whose rest direction is turned to ours: a guest in A-pose is brought to T-pose. The rest keep their own. */
const TURNED = /Shoulder|UpperArm|LowerArm|UpperLeg|LowerLeg/;

interface Driven {
  bone: Object3D;
  joint: number;
  /** Rest rotation in the world, turned so that the bone points as ours does. */
  rest: Quaternion;
}

const CHILD: Partial<Record<JointName, JointName>> = {
  leftShoulder: "leftUpperArm",
  leftUpperArm: "leftLowerArm",
  leftLowerArm: "leftHand",
  rightShoulder: "rightUpperArm",
  rightUpperArm: "rightLowerArm",
  rightLowerArm: "rightHand",
  leftUpperLeg: "leftLowerLeg",
  leftLowerLeg: "leftFoot",
  rightUpperLeg: "rightLowerLeg",
  rightLowerLeg: "rightFoot",
};

export class Guest {
  readonly group = new Group();
  /** Height and hips' height in the rest pose, metres. */
  readonly measure: { height: number; hips: number };
  private readonly driven: Driven[] = [];
  private readonly positions = new Float64Array(3 * JOINT_COUNT);
  private readonly rotations = new Float64Array(4 * JOINT_COUNT);
  private readonly ankles: [number, number];
  private readonly holder = new Group();

  /**
   * @param model the loaded scene; it is turned to face +Z and put under `group`.
   * @param map needs hips and both legs.
   */
  constructor(
    model: Object3D,
    private readonly map: BoneMap,
    /** The build that the motion is planned for; may be replaced when it changes. */
    public skeleton: Skeleton,
  ) {
    this.group.add(this.holder);
    this.holder.add(model);
    this.group.updateMatrixWorld(true);
    // Left is +X: whatever way the file faces, it faces +Z.
    const across = this.at("leftUpperLeg").sub(this.at("rightUpperLeg"));
    this.holder.rotation.y = Math.atan2(across.z, across.x);
    this.group.updateMatrixWorld(true);
    const floor = new Box3().setFromObject(model, true).min.y;
    model.traverse((o) => {
      o.frustumCulled = false;
      if (o instanceof SkinnedMesh) o.castShadow = o.receiveShadow = true;
    });
    const top = new Box3().setFromObject(model, true).max.y;
    this.measure = { height: top - floor, hips: this.at("hips").y - floor };
    this.ankles = [this.at("leftFoot").y - floor, this.at("rightFoot").y - floor];
    const rest = restOf(skeleton);
    JOINT_NAMES.forEach((name, joint) => {
      const bone = map.get(name);
      if (!bone) return;
      const own = bone.getWorldQuaternion(new Quaternion());
      const child = CHILD[name];
      const end = child ? map.get(child) : undefined;
      if (child && end && TURNED.test(name)) {
        const theirs = end.getWorldPosition(new Vector3()).sub(bone.getWorldPosition(new Vector3()));
        const ours = rest(JOINT_NAMES.indexOf(child)).sub(rest(joint));
        own.premultiply(new Quaternion().setFromUnitVectors(theirs.normalize(), ours.normalize()));
      }
      this.driven.push({ bone, joint, rest: own });
    });
    // Parents before children, as the file has them.
    const depth = (o: Object3D): number => (o.parent ? 1 + depth(o.parent) : 0);
    this.driven.sort((a, b) => depth(a.bone) - depth(b.bone));
  }

  private at(name: JointName): Vector3 {
    const bone = this.map.get(name);
    if (!bone) throw new Error(`${name}: the character has no such bone.`);
    return bone.getWorldPosition(new Vector3());
  }

  /** Poses from a row of root (3) and rotations (JOINT_COUNT x 4). */
  setPose(root: ArrayLike<number>, r: number, rotations: ArrayLike<number>, o: number): void {
    const { positions, skeleton } = this;
    forwardKinematics(
      positions,
      this.rotations,
      skeleton,
      Float64Array.of(root[r], root[r + 1], root[r + 2]),
      0,
      Float64Array.from({ length: 4 * JOINT_COUNT }, (_, k) => rotations[o + k]),
      0,
    );
    const rise = this.measure.hips / skeleton.offsets[1];
    for (const d of this.driven) {
      setWorldRotation(d.bone, this.ours(d.joint).multiply(d.rest));
      if (d.joint === 0)
        setWorldPosition(d.bone, new Vector3(positions[0], positions[1] * rise, positions[2]));
      d.bone.updateWorldMatrix(false, false);
    }
    this.closeLeg("left", this.ankles[0]);
    this.closeLeg("right", this.ankles[1]);
    this.group.updateMatrixWorld(true);
  }

  private ours(joint: number): Quaternion {
    return new Quaternion().fromArray(this.rotations, 4 * joint);
  }

  /** Hip and knee turned so that the ankle is over ours, as high over the ground as the guest's own foot asks. */
  private closeLeg(side: "left" | "right", ankle: number): void {
    const names = [`${side}UpperLeg`, `${side}LowerLeg`, `${side}Foot`] as const;
    const [upper, lower, foot] = names.map((n) => this.map.get(n));
    if (!upper || !lower || !foot) return;
    const j = J[`${side}Foot`];
    const target = new Vector3(
      this.positions[3 * j],
      this.positions[3 * j + 1] - restOf(this.skeleton)(j).y + ankle,
      this.positions[3 * j + 2],
    );
    upper.updateWorldMatrix(true, true);
    const hip = upper.getWorldPosition(new Vector3());
    const knee = lower.getWorldPosition(new Vector3());
    const end = foot.getWorldPosition(new Vector3());
    const facing = foot.getWorldQuaternion(new Quaternion());
    const thigh = knee.distanceTo(hip);
    const shin = end.distanceTo(knee);
    const way = target.clone().sub(hip);
    const d = Math.max(Math.abs(thigh - shin) + 1e-4, Math.min(thigh + shin - 1e-4, way.length()));
    way.normalize();
    const bend = knee.clone().sub(hip);
    bend.addScaledVector(way, -bend.dot(way));
    // A straight leg bends forward.
    if (bend.lengthSq() < 1e-10) bend.copy(new Vector3(0, 0, 1).applyQuaternion(this.ours(0)));
    bend.normalize();
    const cos = (thigh * thigh + d * d - shin * shin) / (2 * thigh * d);
    const to = hip
      .clone()
      .addScaledVector(way, thigh * cos)
      .addScaledVector(bend, thigh * Math.sqrt(Math.max(0, 1 - cos * cos)));
    turn(upper, knee.sub(hip), to.clone().sub(hip));
    const shinNow = foot.getWorldPosition(new Vector3()).sub(lower.getWorldPosition(new Vector3()));
    turn(lower, shinNow, hip.addScaledVector(way, d).sub(to));
    setWorldRotation(foot, facing);
    foot.updateWorldMatrix(false, true);
  }

  dispose(): void {
    this.group.traverse((o) => {
      if (o instanceof SkinnedMesh) {
        o.geometry.dispose();
        o.skeleton.dispose();
        for (const m of Array.isArray(o.material) ? o.material : [o.material]) {
          for (const v of Object.values(m)) if (v instanceof Texture) v.dispose();
          m.dispose();
        }
      }
    });
  }
}

/** World places of our joints in the rest pose, standing on the ground. */
function restOf(skeleton: Skeleton): (joint: number) => Vector3 {
  return (joint) => {
    const out = new Vector3();
    for (let j = joint; j >= 0; j = PARENTS[j])
      out.add(new Vector3(skeleton.offsets[3 * j], skeleton.offsets[3 * j + 1], skeleton.offsets[3 * j + 2]));
    return out;
  };
}

function setWorldRotation(o: Object3D, world: Quaternion): void {
  const parent = o.parent ? o.parent.getWorldQuaternion(new Quaternion()) : new Quaternion();
  o.quaternion.copy(parent.invert().multiply(world));
}

function setWorldPosition(o: Object3D, world: Vector3): void {
  o.parent?.updateWorldMatrix(true, false);
  o.position.copy(o.parent ? o.parent.worldToLocal(world) : world);
}

/** Turns a bone in the world by what takes one direction to another. */
function turn(bone: Object3D, from: Vector3, to: Vector3): void {
  const by = new Quaternion().setFromUnitVectors(from.normalize(), to.clone().normalize());
  setWorldRotation(bone, by.multiply(bone.getWorldQuaternion(new Quaternion())));
  bone.updateWorldMatrix(false, true);
}
