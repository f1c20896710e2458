/** World places of a BVH file's joints in metres, Y up, left = +X when facing +Z. */
import type { JointName } from "../skeleton/joints.ts";
import type { BvhFile } from "./bvh-parse.ts";

export interface WorldMotion {
  frames: number;
  joints: number;
  rate: number;
  /** frames x joints x 3, metres. */
  positions: Float64Array;
  /** Metres a unit of the file. */
  scale: number;
  up: "y" | "z";
}

/** Units that files come in, metres each: metres, centimetres, inches, and the CMU and PFNN files' 5.6444 cm. */
const UNITS = [1, 0.01, 0.0254, 0.056444, 0.001];
/** Thigh and shank of adults, metres. */
const LEG = 0.8;

/** Forward kinematics over a whole file. */
export function worldOf(file: BvhFile, joints: Map<JointName, number>): WorldMotion {
  const n = file.joints.length;
  const positions = new Float64Array(file.frames * n * 3);
  const m = new Float64Array(n * 9);
  const r = new Float64Array(9);
  for (let f = 0; f < file.frames; f++) {
    const row = f * file.columns;
    for (let j = 0; j < n; j++) {
      const joint = file.joints[j];
      let [ox, oy, oz] = joint.offset;
      identity(r);
      for (let c = 0; c < joint.channels.length; c++) {
        const value = file.values[row + joint.column + c];
        switch (joint.channels[c]) {
          // A position channel replaces the offset.
          case "Xposition":
            ox = value;
            break;
          case "Yposition":
            oy = value;
            break;
          case "Zposition":
            oz = value;
            break;
          case "Xrotation":
            turn(r, 0, value);
            break;
          case "Yrotation":
            turn(r, 1, value);
            break;
          default:
            turn(r, 2, value);
        }
      }
      const o = 3 * (f * n + j);
      if (joint.parent < 0) {
        positions[o] = ox;
        positions[o + 1] = oy;
        positions[o + 2] = oz;
        m.set(r, 9 * j);
        continue;
      }
      const p = 9 * joint.parent;
      const po = 3 * (f * n + joint.parent);
      for (let k = 0; k < 3; k++)
        positions[o + k] =
          positions[po + k] + m[p + 3 * k] * ox + m[p + 3 * k + 1] * oy + m[p + 3 * k + 2] * oz;
      for (let i = 0; i < 3; i++) {
        for (let k = 0; k < 3; k++)
          m[9 * j + 3 * i + k] =
            m[p + 3 * i] * r[k] + m[p + 3 * i + 1] * r[3 + k] + m[p + 3 * i + 2] * r[6 + k];
      }
    }
  }
  const up = upAxis(positions, n, file.frames, joints);
  if (up === "z") {
    for (let i = 0; i < positions.length; i += 3) {
      const y = positions[i + 1];
      positions[i + 1] = positions[i + 2];
      positions[i + 2] = -y;
    }
  }
  const scale = unitOf(positions, joints);
  for (let i = 0; i < positions.length; i++) positions[i] *= scale;
  return { frames: file.frames, joints: n, rate: 1 / file.frameTime, positions, scale, up };
}

function identity(r: Float64Array): void {
  r.fill(0);
  r[0] = r[4] = r[8] = 1;
}

/** r = r R(axis, degrees). */
function turn(r: Float64Array, axis: 0 | 1 | 2, degrees: number): void {
  const a = (degrees * Math.PI) / 180;
  const c = Math.cos(a);
  const s = Math.sin(a);
  const i = (axis + 1) % 3;
  const j = (axis + 2) % 3;
  for (let row = 0; row < 9; row += 3) {
    const x = r[row + i];
    const y = r[row + j];
    r[row + i] = c * x + s * y;
    r[row + j] = c * y - s * x;
  }
}

/** The axis along which the head (or the hips) is over the feet on average. */
function upAxis(
  positions: Float64Array,
  n: number,
  frames: number,
  joints: Map<JointName, number>,
): "y" | "z" {
  const top = joints.get("head") ?? joints.get("neck") ?? joints.get("hips") ?? 0;
  const foot = joints.get("leftFoot") ?? 0;
  let y = 0;
  let z = 0;
  const every = Math.max(1, Math.floor(frames / 200));
  for (let f = 0; f < frames; f += every) {
    y += positions[3 * (f * n + top) + 1] - positions[3 * (f * n + foot) + 1];
    z += positions[3 * (f * n + top) + 2] - positions[3 * (f * n + foot) + 2];
  }
  return Math.abs(z) > 1.5 * Math.abs(y) ? "z" : "y";
}

/** The unit that makes the leg most like a person's. */
function unitOf(positions: Float64Array, joints: Map<JointName, number>): number {
  const at = (name: JointName) => 3 * (joints.get(name) ?? 0);
  const length = (a: number, b: number) =>
    Math.hypot(
      positions[a] - positions[b],
      positions[a + 1] - positions[b + 1],
      positions[a + 2] - positions[b + 2],
    );
  const leg = length(at("leftUpperLeg"), at("leftLowerLeg")) + length(at("leftLowerLeg"), at("leftFoot"));
  if (!(leg > 0)) return 1;
  let best = 1;
  let miss = Number.POSITIVE_INFINITY;
  for (const u of UNITS) {
    const d = Math.abs(Math.log((leg * u) / LEG));
    if (d < miss) {
      miss = d;
      best = u;
    }
  }
  // Nothing fits: whatever makes it a person's.
  return miss < 0.5 ? best : LEG / leg;
}
