/**
 * Joint names of common rigs, to VRM humanoid names: CMU, Mixamo, LaFAN1, Bandai-Namco, Xsens, 100STYLE, Ready Player Me,
 * VRM and what resembles them.
 */
import type { JointName } from "../skeleton/joints.ts";

/** Which joint of a file each of ours is. */
export type Joints = Map<JointName, number>;

const SIDED: [RegExp, string][] = [
  [/^(clavicle|collar|shoulder)$/, "Shoulder"],
  [/^(upperarm|arm|uparm|shoulderjoint)$/, "UpperArm"],
  [/^(lowerarm|forearm|elbow|lowarm)$/, "LowerArm"],
  [/^(hand|wrist)$/, "Hand"],
  [/^(upperleg|upleg|thigh|hip|upperlegjoint)$/, "UpperLeg"],
  [/^(lowerleg|leg|shin|knee|calf|lowleg)$/, "LowerLeg"],
  [/^(foot|ankle)$/, "Foot"],
  [/^(toes|toe|toebase|ball)$/, "Toes"],
];

/** Which of our joints a name says; side and part, or null. */
function partOf(name: string): JointName | null {
  let n = name
    .replace(/^.*[:|]/, "")
    .replace(/^(mixamorig|bip0?1|valvebiped|skeleton|character1|j_bip)\d*/i, "")
    .replace(/[_\s.-]+/g, " ")
    .replace(/([a-z])([A-Z])/g, "$1 $2")
    .toLowerCase()
    .trim();
  let side = "";
  const sides: [RegExp, string][] = [
    [/(^| )(left|l)( |$)/, "left"],
    [/(^| )(right|r)( |$)/, "right"],
  ];
  for (const [pattern, s] of sides) {
    if (pattern.test(n)) {
      side = s;
      n = n.replace(pattern, " ").trim();
      break;
    }
  }
  const flat = n.replace(/ /g, "");
  if (side) {
    for (const [pattern, part] of SIDED) if (pattern.test(flat)) return `${side}${part}` as JointName;
    return null;
  }
  if (/^(hips?|pelvis|jointroot|rootjoint)$/.test(flat)) return "hips";
  if (/^(spine|lowerback|torso|abdomen|spine0|chest0|lowback)$/.test(flat)) return "spine";
  if (/^(chest|spine1|thorax|ribs|chest1)$/.test(flat)) return "chest";
  if (/^(upperchest|spine2|spine3|chest2|chest3|chest4)$/.test(flat)) return "upperChest";
  if (/^(neck|neck0|neck1)$/.test(flat)) return "neck";
  if (/^(head)$/.test(flat)) return "head";
  return null;
}

/**
 * Indices of our joints in a list of names (parents before children); -1 where there is none.
 *
 * A rig's first spine bone is `spine`, the last under the neck `upperChest`. Rigs that call the upper arm "shoulder" are told
 * by having no other bone for it.
 */
export function mapJoints(names: readonly string[], parents: readonly number[]): Joints {
  const out = new Map<JointName, number>();
  names.forEach((name, i) => {
    const part = partOf(name);
    if (part && !out.has(part)) out.set(part, i);
  });
  for (const side of ["left", "right"] as const) {
    const arm = (p: string) => `${side}${p}` as JointName;
    // LaFAN, 100STYLE and Xsens: Shoulder > Arm > ForeArm; some have Collar > Shoulder > Elbow > Wrist.
    if (!out.has(arm("UpperArm")) && out.has(arm("Shoulder")) && out.has(arm("LowerArm"))) {
      const shoulder = out.get(arm("Shoulder")) as number;
      const collar = parents[shoulder];
      out.set(arm("UpperArm"), shoulder);
      if (/(collar|clavicle)/i.test(names[collar] ?? "")) out.set(arm("Shoulder"), collar);
      else out.delete(arm("Shoulder"));
    }
    const collar = names.findIndex((n) => /(collar|clavicle)/i.test(n) && partOf(n) === arm("Shoulder"));
    const shoulder = names.findIndex((n) => /shoulder/i.test(n) && partOf(n) === arm("Shoulder"));
    if (collar >= 0 && shoulder >= 0 && parents[shoulder] === collar) {
      out.set(arm("Shoulder"), collar);
      out.set(arm("UpperArm"), shoulder);
    }
    // CMU: LHipJoint > LeftUpLeg; "hip" may be either.
    const upper = out.get(arm("UpperLeg"));
    const lower = out.get(arm("LowerLeg"));
    if (upper !== undefined && lower !== undefined && parents[lower] !== upper)
      out.set(arm("UpperLeg"), parents[lower]);
  }
  if (!out.has("hips")) out.set("hips", 0);
  // A root over the hips that only carries travel is not the hips.
  return out;
}
