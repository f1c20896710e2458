import {
  Bone,
  BufferGeometry,
  Euler,
  Group,
  Quaternion,
  SkinnedMesh,
  Skeleton as ThreeSkeleton,
  Vector3,
} from "three";
import { beforeAll, describe, expect, test } from "vitest";
import { defaultScene } from "../../src/core/scene/default-scene.ts";
import { forwardKinematics } from "../../src/core/skeleton/forward-kinematics.ts";
import { JOINT_COUNT, JOINT_NAMES, type JointName, PARENTS } from "../../src/core/skeleton/joints.ts";
import { createSkeleton } from "../../src/core/skeleton/skeleton.ts";
import { type Solved, solveScene } from "../../src/core/solve-scene.ts";
import { buildLibrary } from "../../src/core/templates/build-library.ts";
import type { Library } from "../../src/core/templates/types.ts";
import { renderScore } from "../../src/studio/render.ts";
import { studioSet } from "../../src/studio/set.ts";
import { CharacterController } from "../../src/view/controller.ts";

const TURNS: Partial<Record<JointName, [number, number, number]>> = {
  leftUpperArm: [0, 0, -0.9],
  rightUpperArm: [0, 0, 0.9],
};

/** A rig of another make: Mixamo's names, centimetres under a scaled group, every bone's axes turned, arms lowered. */
function stranger(height: number): { root: Group; bones: Bone[] } {
  const s = createSkeleton(height);
  const names: Record<string, string> = {
    hips: "Hips",
    spine: "Spine",
    chest: "Spine1",
    upperChest: "Spine2",
    neck: "Neck",
    head: "Head",
  };
  const rig = (n: string): string =>
    names[n] ??
    n
      .replace(/^(left|right)/, (w) => w[0].toUpperCase() + w.slice(1))
      .replace("UpperArm", "Arm")
      .replace("LowerArm", "ForeArm")
      .replace("UpperLeg", "UpLeg")
      .replace("LowerLeg", "Leg")
      .replace("Toes", "ToeBase");
  // World rest: our rest with arms lowered; each bone's own axes turned by an odd rotation.
  const odd = JOINT_NAMES.map((_, j) =>
    new Quaternion().setFromEuler(new Euler(0.3 * j, 1 + 0.7 * j, -0.4 * j)),
  );
  const bend = JOINT_NAMES.map(() => new Quaternion());
  const world: Vector3[] = [];
  JOINT_NAMES.forEach((name, j) => {
    const p = PARENTS[j];
    const own = new Quaternion().setFromEuler(new Euler(...(TURNS[name] ?? [0, 0, 0])));
    bend[j] = p < 0 ? own : bend[p].clone().multiply(own);
    const offset = new Vector3().fromArray(s.offsets, 3 * j);
    world[j] = p < 0 ? offset : world[p].clone().add(offset.applyQuaternion(bend[p]));
  });
  const bones = JOINT_NAMES.map((name) => {
    const b = new Bone();
    b.name = `mixamorig:${rig(name)}`;
    return b;
  });
  const rests = JOINT_NAMES.map((_, j) => bend[j].clone().multiply(odd[j]));
  JOINT_NAMES.forEach((_, j) => {
    const p = PARENTS[j];
    if (p < 0) {
      bones[j].position.copy(world[j]).multiplyScalar(100);
      bones[j].quaternion.copy(rests[j]);
      return;
    }
    const back = rests[p].clone().invert();
    bones[j].position.copy(world[j]).sub(world[p]).multiplyScalar(100).applyQuaternion(back);
    bones[j].quaternion.copy(back).multiply(rests[j]);
    bones[p].add(bones[j]);
  });
  const root = new Group();
  root.scale.setScalar(0.01);
  const mesh = new SkinnedMesh(new BufferGeometry());
  mesh.add(bones[0]);
  root.add(mesh);
  root.updateMatrixWorld(true);
  mesh.bind(new ThreeSkeleton(bones));
  return { root, bones };
}

describe("a character of one's own", () => {
  let library: Library;
  let motion: Solved;
  let holder: Group;
  let bones: Bone[];
  let controller: CharacterController;
  beforeAll(() => {
    const some = studioSet().filter((s) => ["write-columns-near", "write-columns-middle"].includes(s.name));
    library = buildLibrary(
      some.map(({ name, score }) => {
        const { clip, sidecar } = renderScore(score);
        return { name, clip, tasks: sidecar.tasks };
      }),
    );
    const made = stranger(1.62);
    bones = made.bones;
    holder = new Group();
    holder.add(made.root);
    controller = new CharacterController(holder);
    motion = solveScene(
      { ...defaultScene(), tasks: defaultScene().tasks.slice(0, 1), order: ["write"] },
      library,
      controller.skeleton,
    );
  });

  test("its legs decide which skeleton is planned for", () => {
    expect(controller.skeleton.legLength).toBeCloseTo(createSkeleton(1.62).legLength, 3);
  });

  test("ankles are where the motion has them, hands within a centimetre of it, at any place of the character", () => {
    holder.position.set(3, 0, -2);
    holder.rotation.y = 0.7;
    controller.play(motion);
    const places = new Float64Array(3 * JOINT_COUNT);
    const world = new Float64Array(4 * JOINT_COUNT);
    const worst = { foot: 0, hand: 0 };
    for (let f = 0; f < motion.frames; f += 7) {
      controller.time = f / 60;
      controller.update(0);
      holder.updateMatrixWorld(true);
      forwardKinematics(
        places,
        world,
        motion.skeleton,
        Float64Array.from(motion.root),
        3 * f,
        Float64Array.from(motion.rotations),
        4 * JOINT_COUNT * f,
      );
      for (const [name, kind] of [
        ["leftFoot", "foot"],
        ["rightFoot", "foot"],
        ["leftHand", "hand"],
        ["rightHand", "hand"],
      ] as const) {
        const j = JOINT_NAMES.indexOf(name);
        const at = holder.worldToLocal(bones[j].getWorldPosition(new Vector3()));
        worst[kind] = Math.max(worst[kind], at.distanceTo(new Vector3().fromArray(places, 3 * j)));
      }
    }
    expect(worst.foot).toBeLessThan(0.0005);
    expect(worst.hand).toBeLessThan(0.01);
  });

  test("update moves time on, stops at the end, and loops when told to", () => {
    controller.play(motion);
    controller.update(0.5);
    expect(controller.time).toBeCloseTo(0.5, 9);
    controller.update(1e6);
    expect(controller.time).toBe(controller.duration);
    controller.loop = true;
    controller.play(motion, controller.duration - 0.1);
    controller.update(0.3);
    expect(controller.time).toBeCloseTo(0.2, 6);
    controller.loop = false;
  });

  test("a bone that is not there is named", () => {
    const { root } = stranger(1.7);
    expect(() => new CharacterController(root, { bones: { hips: "Pelvis" } })).toThrow(
      'bones.hips: no bone is called "Pelvis".',
    );
    expect(() => new CharacterController(new Group())).toThrow("bones.hips: a bone is needed");
  });
});
