/** Clips as plain BVH: metres, the clip's own rate, VRM bone names, rest pose standing on y = 0. */
import { J, JOINT_COUNT, JOINT_NAMES, PARENTS } from "../skeleton/joints.ts";
import type { Clip } from "./clip.ts";

const DEG = 180 / Math.PI;

/** Bones that end in an End Site: where their tips are, in their own frame. */
function endSite(clip: Clip, joint: number): [number, number, number] | null {
  const { foot, palm, headTop } = clip.skeleton;
  switch (joint) {
    case J.head:
      return [0, headTop, 0];
    case J.leftHand:
      return [palm, 0, 0];
    case J.rightHand:
      return [-palm, 0, 0];
    case J.leftToes:
    case J.rightToes:
      return [0, -foot.ballHeight, foot.tipForward];
    default:
      return null;
  }
}

const number = (v: number): string => {
  const s = v.toFixed(6);
  return s === "-0.000000" ? "0.000000" : s;
};

/**
 * The clip as BVH text. Root channels: position, then Z X Y rotation (degrees); other joints Z X Y rotation.
 * Reading it back gives every joint within 1e-5 m.
 *
 * @param options.rootOffset false writes the hips' OFFSET as zero: some readers add it to the position's channels.
 */
export function writeBvh(clip: Clip, options: { rootOffset?: boolean } = {}): string {
  const rootOffset = options.rootOffset ?? true;
  const out: string[] = ["HIERARCHY"];
  const order: number[] = [];
  const children = (joint: number) => [...PARENTS.keys()].filter((j) => PARENTS[j] === joint);
  const visit = (joint: number, depth: number) => {
    const pad = "  ".repeat(depth);
    const o = clip.skeleton.offsets;
    out.push(`${pad}${joint === 0 ? "ROOT" : "JOINT"} ${JOINT_NAMES[joint]}`, `${pad}{`);
    // The hips' own offset is their rest place: the rest pose stands on the ground.
    const at = joint === 0 && !rootOffset ? [0, 0, 0] : [o[3 * joint], o[3 * joint + 1], o[3 * joint + 2]];
    out.push(`${pad}  OFFSET ${at.map(number).join(" ")}`);
    out.push(
      joint === 0
        ? `${pad}  CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation`
        : `${pad}  CHANNELS 3 Zrotation Xrotation Yrotation`,
    );
    order.push(joint);
    for (const c of children(joint)) visit(c, depth + 1);
    const end = endSite(clip, joint);
    if (end)
      out.push(`${pad}  End Site`, `${pad}  {`, `${pad}    OFFSET ${end.map(number).join(" ")}`, `${pad}  }`);
    out.push(`${pad}}`);
  };
  visit(0, 0);
  out.push("MOTION", `Frames: ${clip.frames}`, `Frame Time: ${(1 / clip.rate).toFixed(8)}`);
  const euler = [0, 0, 0];
  for (let f = 0; f < clip.frames; f++) {
    const row: string[] = [
      number(clip.root[3 * f]),
      number(clip.root[3 * f + 1]),
      number(clip.root[3 * f + 2]),
    ];
    for (const joint of order) {
      eulerZxy(euler, clip.rotations, (f * JOINT_COUNT + joint) * 4);
      row.push(number(euler[0]), number(euler[1]), number(euler[2]));
    }
    out.push(row.join(" "));
  }
  return `${out.join("\n")}\n`;
}

/** Angles of R = Rz Rx Ry in degrees, from a unit quaternion. */
function eulerZxy(out: number[], q: Float64Array, i: number): void {
  const x = q[i];
  const y = q[i + 1];
  const z = q[i + 2];
  const w = q[i + 3];
  const sx = Math.max(-1, Math.min(1, 2 * (y * z + w * x)));
  out[1] = Math.asin(sx) * DEG;
  if (Math.abs(sx) < 0.9999999) {
    out[0] = Math.atan2(-2 * (x * y - w * z), 1 - 2 * (x * x + z * z)) * DEG;
    out[2] = Math.atan2(-2 * (x * z - w * y), 1 - 2 * (x * x + y * y)) * DEG;
  } else {
    out[0] = Math.atan2(2 * (x * y + w * z), 1 - 2 * (y * y + z * z)) * DEG;
    out[2] = 0;
  }
}
