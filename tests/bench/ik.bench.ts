/**
 * Full-body IK beside three.js CCDIKSolver on the same targets: the effectors of a capture's next frames, from the pose of the
 * frame before, until all five are within 1 mm.
 *
 * The root is given to both. CCDIKSolver gets no joint limits (which favours it) and is asked again, up to 40 times,
 * until it is there.
 */
import { Bone, BufferGeometry, Quaternion, SkinnedMesh, Skeleton as ThreeSkeleton, Vector3 } from "three";
import { CCDIKSolver } from "three/examples/jsm/animation/CCDIKSolver.js";
import { createFabrik, EFFECTORS, solveFabrik } from "../../src/core/ik/fabrik.ts";
import { forwardKinematics } from "../../src/core/skeleton/forward-kinematics.ts";
import { J, JOINT_COUNT, PARENTS } from "../../src/core/skeleton/joints.ts";
import { studio } from "../support/library.ts";
import { figure, median } from "./measure.ts";
import type { BenchModule } from "./types.ts";

const Q = 4 * JOINT_COUNT;
/** Links of the peer's chains, from the effector's parent to the trunk. */
const CHAINS: readonly (readonly number[])[] = [
  [J.leftLowerArm, J.leftUpperArm, J.leftShoulder, J.upperChest, J.chest, J.spine],
  [J.rightLowerArm, J.rightUpperArm, J.rightShoulder, J.upperChest, J.chest, J.spine],
  [J.leftLowerLeg, J.leftUpperLeg],
  [J.rightLowerLeg, J.rightUpperLeg],
  [J.neck, J.upperChest, J.chest, J.spine],
];

const bench: BenchModule = {
  name: "ik",
  async run() {
    const { clip } = studio().library.clips[0];
    const { skeleton } = clip;
    const frames = Math.min(clip.frames - 3, 600);
    const positions = new Float64Array(3 * JOINT_COUNT);
    const world = new Float64Array(Q);
    const at = (f: number): Float64Array => {
      forwardKinematics(positions, world, skeleton, clip.root, 3 * f, clip.rotations, Q * f);
      return Float64Array.from(EFFECTORS.flatMap((j) => [...positions.subarray(3 * j, 3 * j + 3)]));
    };
    const bones = Array.from({ length: JOINT_COUNT + EFFECTORS.length }, () => new Bone());
    for (let j = 0; j < JOINT_COUNT; j++) {
      if (PARENTS[j] >= 0) bones[PARENTS[j]].add(bones[j]);
      bones[j].position.fromArray(skeleton.offsets, 3 * j);
    }
    const mesh = new SkinnedMesh(new BufferGeometry());
    mesh.add(bones[0]);
    for (let e = 0; e < EFFECTORS.length; e++) mesh.add(bones[JOINT_COUNT + e]);
    mesh.bind(new ThreeSkeleton(bones));
    const solver = new CCDIKSolver(
      mesh,
      // Legs first, then the head, then the hands.
      [2, 3, 4, 0, 1].map((e) => ({
        target: JOINT_COUNT + e,
        effector: EFFECTORS[e],
        links: CHAINS[e].map((index) => ({ index })),
        iteration: 1,
      })),
    );
    const pose = new Float64Array(Q);
    const root = new Float64Array(3);
    const workspace = createFabrik(skeleton);
    const own: number[] = [];
    const peer: number[] = [];
    let reached = 0;
    let peerReached = 0;
    const place = new Vector3();
    const goal = new Vector3();
    const q = new Quaternion();
    for (let round = 0; round < 3; round++) {
      for (let f = 0; f < frames; f += 2) {
        const targets = at(f + 2);
        pose.set(clip.rotations.subarray(Q * f, Q * f + Q));
        root.set(clip.root.subarray(3 * f + 6, 3 * f + 9));
        let t = performance.now();
        const left = solveFabrik(workspace, root, pose, targets, [1, 1, 1, 1, 1], {
          tolerance: 1e-3,
          rounds: 60,
          freeHips: true,
        });
        const ownMs = performance.now() - t;
        for (let j = 0; j < JOINT_COUNT; j++)
          bones[j].quaternion.copy(q.fromArray(clip.rotations, Q * f + 4 * j));
        bones[0].position.fromArray(clip.root, 3 * f + 6);
        for (let e = 0; e < EFFECTORS.length; e++) bones[JOINT_COUNT + e].position.fromArray(targets, 3 * e);
        mesh.updateMatrixWorld(true);
        t = performance.now();
        let there = false;
        for (let k = 0; k < 40 && !there; k++) {
          solver.update();
          there = EFFECTORS.every((j, e) => {
            place.setFromMatrixPosition(bones[j].matrixWorld);
            return place.distanceTo(goal.fromArray(targets, 3 * e)) <= 1e-3;
          });
        }
        const peerMs = performance.now() - t;
        if (round < 2) continue;
        own.push(1000 * ownMs);
        peer.push(1000 * peerMs);
        if (left <= 1e-3) reached++;
        if (there) peerReached++;
      }
    }
    const time = figure("full-body IK, warm, 5 effectors to 1 mm", "us", own, "ratio <= 0.2", () => true);
    time.peer = "three.js CCDIKSolver";
    time.peerMedian = median(peer);
    time.ratio = time.median / time.peerMedian;
    time.ok = time.ratio <= 0.2;
    const share = figure(
      "full-body IK, reached",
      "%",
      [(100 * reached) / own.length],
      "100 %",
      (v) => v === 100,
    );
    share.peer = "three.js CCDIKSolver";
    share.peerMedian = (100 * peerReached) / own.length;
    return [time, share];
  },
};

export default bench;
