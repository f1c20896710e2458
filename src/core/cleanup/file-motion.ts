/** A BVH file's joints in the world, and the way back: rotations and the root's place written into its own channels. */
import type { BvhChannel, BvhFile } from "../capture/bvh-parse.ts";
import {
  quatConjugate,
  quatFromAxisAngle,
  quatMultiply,
  quatNormalize,
  quatRotate,
} from "../math/quaternion.ts";
import { eulerNear } from "./euler.ts";
import type { FileMotion } from "./soles.ts";

const AXIS: Record<string, number> = { X: 0, Y: 1, Z: 2 };
const isRotation = (c: BvhChannel): boolean => c.endsWith("rotation");

/** The same in the file's units. */
function kinematics(file: BvhFile, q: Float64Array, p: Float64Array): void {
  const n = file.joints.length;
  const r = new Float64Array(8);
  const v = new Float64Array(6);
  for (let f = 0; f < file.frames; f++) {
    for (let j = 0; j < n; j++) {
      const joint = file.joints[j];
      v.set(joint.offset, 0);
      r.set([0, 0, 0, 1], 0);
      joint.channels.forEach((channel, c) => {
        const value = file.values[f * file.columns + joint.column + c];
        const axis = AXIS[channel[0]];
        if (!isRotation(channel)) {
          v[axis] = value;
          return;
        }
        quatFromAxisAngle(
          r,
          4,
          axis === 0 ? 1 : 0,
          axis === 1 ? 1 : 0,
          axis === 2 ? 1 : 0,
          (value * Math.PI) / 180,
        );
        quatMultiply(r, 0, r, 0, r, 4);
      });
      const o = f * n + j;
      if (joint.parent < 0) {
        for (let k = 0; k < 4; k++) q[4 * o + k] = r[k];
        for (let k = 0; k < 3; k++) p[3 * o + k] = v[k];
        continue;
      }
      const parent = f * n + joint.parent;
      quatRotate(v, 3, q, 4 * parent, v[0], v[1], v[2]);
      for (let k = 0; k < 3; k++) p[3 * o + k] = p[3 * parent + k] + v[3 + k];
      quatMultiply(q, 4 * o, q, 4 * parent, r, 0);
      quatNormalize(q, 4 * o);
    }
  }
}

/** World rotations and places in metres of all joints in all frames. */
export function fileMotion(file: BvhFile, scale: number, up: "y" | "z"): FileMotion {
  const joints = file.joints.length;
  const out: FileMotion = {
    frames: file.frames,
    joints,
    rate: 1 / file.frameTime,
    q: new Float64Array(4 * joints * file.frames),
    p: new Float64Array(3 * joints * file.frames),
    axes: up === "y" ? [2, 0, 1] : [0, 1, 2],
  };
  kinematics(file, out.q, out.p);
  for (let i = 0; i < out.p.length; i++) out.p[i] *= scale;
  return out;
}

/** Adds the shift to the hips' position channels (the root's where the hips have none). */
export function writeRoot(
  file: BvhFile,
  hips: number,
  shift: Float64Array,
  q: Float64Array,
  count: number,
  scale: number,
): void {
  let joint = hips;
  const hasPosition = (j: number): boolean => file.joints[j].channels.some((c) => !isRotation(c));
  while (joint > 0 && !hasPosition(joint)) joint = file.joints[joint].parent;
  const { parent, column, channels } = file.joints[joint];
  const inverse = new Float64Array(4);
  const v = new Float64Array(3);
  for (let f = 0; f < file.frames; f++) {
    for (let k = 0; k < 3; k++) v[k] = shift[3 * f + k] / scale;
    if (parent >= 0) {
      quatConjugate(inverse, 0, q, 4 * (f * count + parent));
      quatRotate(v, 0, inverse, 0, v[0], v[1], v[2]);
    }
    channels.forEach((channel, c) => {
      if (!isRotation(channel)) file.values[f * file.columns + column + c] += v[AXIS[channel[0]]];
    });
  }
}

const angles = new Float64Array(3);

/** A local rotation into a joint's rotation channels. */
export function writeRotation(file: BvhFile, joint: number, f: number, q: Float64Array, o: number): void {
  quatNormalize(q, o);
  const { channels, column } = file.joints[joint];
  const at = f * file.columns + column;
  const rotations = channels.flatMap((c, i) => (isRotation(c) ? [i] : []));
  if (rotations.length !== 3) return;
  const axes = rotations.map((i) => AXIS[channels[i][0]]) as [number, number, number];
  eulerNear(
    angles,
    q,
    o,
    axes,
    rotations.map((i) => file.values[at + i]),
  );
  rotations.forEach((i, k) => {
    file.values[at + i] = angles[k];
  });
}

/** The text of a BVH with other values: everything up to the frame time stays as it was written. */
export function rewriteBvh(text: string, file: BvhFile): string {
  const head = /^[\s\S]*?Frame\s+Time\s*:[^\r\n]*/i.exec(text);
  const rows: string[] = [head ? head[0] : ""];
  for (let f = 0; f < file.frames; f++) {
    const row: string[] = [];
    for (let c = 0; c < file.columns; c++)
      row.push(String(Math.round(file.values[f * file.columns + c] * 1e6) / 1e6));
    rows.push(row.join(" "));
  }
  return `${rows.join("\n")}\n`;
}
