/** Where the feet of an animated crowd really are, from its skinning matrices, beside where they were planned to be. */
import { type CrowdMotion, moveCrowd } from "../../src/core/crowd/motion.ts";
import { J } from "../../src/core/skeleton/joints.ts";
import type { Skeleton } from "../../src/core/skeleton/skeleton.ts";
import { restPlaces } from "../../src/view/character/body-shape.ts";

const wrap = (a: number): number => Math.atan2(Math.sin(a), Math.cos(a));

/** Largest differences over all footsteps landed within `seconds`, metres and radians; looked at just before the next lift. */
export function footstepErrors(
  m: CrowdMotion,
  skeleton: Skeleton,
  seconds: number,
): { count: number; position: number; yaw: number; late: number } {
  const rest = restPlaces(skeleton);
  const out = { count: 0, position: 0, yaw: 0, late: 0 };
  const place = (i: number, joint: number): [number, number, number] => {
    const o = (i * 22 + joint) * 16;
    const e = m.body.matrices;
    const [x, y, z] = [rest[3 * joint], rest[3 * joint + 1], rest[3 * joint + 2]];
    return [
      e[o] * x + e[o + 4] * y + e[o + 8] * z + e[o + 12],
      e[o + 1] * x + e[o + 5] * y + e[o + 9] * z + e[o + 13],
      e[o + 2] * x + e[o + 6] * y + e[o + 10] * z + e[o + 14],
    ];
  };
  for (let t = 0; t < seconds; t += 1 / 60) {
    moveCrowd(m, t, 100);
    // A foot that landed a moment ago is flat and still for about a tenth of a second.
    for (const { step } of m.session.footsteps) {
      if (step.lift === null) continue;
      const since = t - step.land;
      if (since < 0.1 || since >= 0.1 + 1 / 60 || m.session.gone[step.agent] < t) continue;
      const [foot, toes] = step.side > 0 ? [J.leftFoot, J.leftToes] : [J.rightFoot, J.rightToes];
      const at = place(step.agent, foot);
      const tip = place(step.agent, toes);
      const restYaw = Math.atan2(rest[3 * toes] - rest[3 * foot], rest[3 * toes + 2] - rest[3 * foot + 2]);
      const yaw = wrap(Math.atan2(tip[0] - at[0], tip[2] - at[2]) - step.yaw - 0 * restYaw);
      out.count++;
      out.position = Math.max(out.position, Math.hypot(at[0] - step.x, at[2] - step.z));
      out.yaw = Math.max(out.yaw, Math.abs(yaw));
    }
  }
  return out;
}
