/** The body as point masses, for centre of mass and zero-moment point. */
import { J } from "./joints.ts";

/** Point masses: share of body mass, from joint, to joint, how far along [Winter, table 4.1, after Dempster]. */
export const MASSES: readonly (readonly [number, number, number, number])[] = [
  [0.142, J.hips, J.spine, 0.3],
  [0.139, J.spine, J.chest, 0.8],
  [0.216, J.upperChest, J.neck, 0.35],
  [0.081, J.neck, J.head, 1.3],
  [0.028, J.leftUpperArm, J.leftLowerArm, 0.436],
  [0.028, J.rightUpperArm, J.rightLowerArm, 0.436],
  [0.022, J.leftLowerArm, J.leftHand, 0.6],
  [0.022, J.rightLowerArm, J.rightHand, 0.6],
  [0.1, J.leftUpperLeg, J.leftLowerLeg, 0.433],
  [0.1, J.rightUpperLeg, J.rightLowerLeg, 0.433],
  [0.0465, J.leftLowerLeg, J.leftFoot, 0.433],
  [0.0465, J.rightLowerLeg, J.rightFoot, 0.433],
  [0.0145, J.leftFoot, J.leftToes, 0.5],
  [0.0145, J.rightFoot, J.rightToes, 0.5],
];
