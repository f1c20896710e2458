/** Feet of a stretch of a motion laid over each other, translucent: a foot that skates is a smear, a planted one is sharp [Oracle Figure 1]. */
import { BoxGeometry, Group, InstancedMesh, Matrix4, MeshBasicMaterial, Quaternion, Vector3 } from "three";
import { forwardKinematics } from "../core/skeleton/forward-kinematics.ts";
import { J, JOINT_COUNT } from "../core/skeleton/joints.ts";
import { createSkeleton } from "../core/skeleton/skeleton.ts";

/** One frame in this many is drawn. */
const EVERY = 3;
const MOST = 120;
const OPACITY = 0.14;
/** Width of the drawn sole, metres. */
const WIDTH = 0.085;

interface Moving {
  height: number;
  root: Float32Array;
  rotations: Float32Array;
}

export class FootGhosts {
  readonly object = new Group();
  private readonly parts: InstancedMesh[];

  constructor() {
    const colours = ["#3a4fa0", "#3a4fa0", "#a06414", "#a06414"];
    this.parts = colours.map((color) => {
      const mesh = new InstancedMesh(
        new BoxGeometry(1, 1, 1),
        new MeshBasicMaterial({
          color,
          transparent: true,
          opacity: OPACITY,
          depthWrite: false,
          toneMapped: false,
        }),
        MOST,
      );
      mesh.frustumCulled = false;
      mesh.renderOrder = 5;
      mesh.count = 0;
      this.object.add(mesh);
      return mesh;
    });
  }

  /**
   * Lays the feet of frames [first, last) down, or none.
   *
   * @param middle frame of `origin` (frames x 3) that stands at the room's middle; @param scale on every place.
   */
  show(
    motion: Moving | null,
    { first, last }: { first: number; last: number },
    middle: number,
    origin: Float32Array,
    scale: number,
  ): void {
    for (const p of this.parts) p.count = 0;
    if (!motion) return;
    const skeleton = createSkeleton(motion.height);
    const { foot } = skeleton;
    const p = new Float64Array(3 * JOINT_COUNT);
    const w = new Float64Array(4 * JOINT_COUNT);
    const root = new Float64Array(3);
    const m = new Matrix4();
    const at = new Vector3();
    const q = new Quaternion();
    const size = new Vector3();
    const place = (
      mesh: InstancedMesh,
      joint: number,
      offset: [number, number, number],
      box: [number, number, number],
    ) => {
      if (mesh.count >= MOST) return;
      q.set(w[4 * joint], w[4 * joint + 1], w[4 * joint + 2], w[4 * joint + 3]);
      at.set(...offset).applyQuaternion(q);
      at.x += p[3 * joint];
      at.y += p[3 * joint + 1];
      at.z += p[3 * joint + 2];
      m.compose(at.multiplyScalar(scale), q, size.set(...box).multiplyScalar(scale));
      mesh.setMatrixAt(mesh.count++, m);
    };
    for (let f = first; f < last; f += EVERY) {
      for (let k = 0; k < 3; k++) root[k] = motion.root[3 * f + k] - (k === 1 ? 0 : origin[3 * middle + k]);
      forwardKinematics(
        p,
        w,
        skeleton,
        root,
        0,
        Float64Array.from(motion.rotations.subarray(4 * JOINT_COUNT * f, 4 * JOINT_COUNT * (f + 1))),
        0,
      );
      const length = foot.heelBack + foot.ballForward;
      for (const side of [0, 1]) {
        const joint = side === 0 ? J.leftFoot : J.rightFoot;
        const rise = 0.04;
        place(
          this.parts[2 * side],
          joint,
          [0, rise / 2 - foot.ankleHeight, (foot.ballForward - foot.heelBack) / 2],
          [WIDTH, rise, length],
        );
        place(
          this.parts[2 * side + 1],
          joint + 1,
          [0, rise / 2 - foot.ballHeight, foot.tipForward / 2],
          [WIDTH, rise, foot.tipForward],
        );
      }
    }
    for (const part of this.parts) part.instanceMatrix.needsUpdate = true;
  }

  dispose(): void {
    for (const p of this.parts) {
      p.geometry.dispose();
      (p.material as MeshBasicMaterial).dispose();
      p.dispose();
    }
  }
}
