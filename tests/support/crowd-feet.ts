/** Where the feet of an animated crowd really are, from its skinning matrices, beside where they were planned to be. */
import type { CrowdFootstep } from "../../src/core/crowd/footfalls.ts";
import { type CrowdMotion, moveCrowd } from "../../src/core/crowd/motion.ts";
import { J } from "../../src/core/skeleton/joints.ts";
import type { Skeleton } from "../../src/core/skeleton/skeleton.ts";
import { restPlaces } from "../../src/view/character/body-shape.ts";

const wrap = (a: number): number => Math.atan2(Math.sin(a), Math.cos(a));
/** A foot that has landed rests flat within this time, unless it leaves at once, seconds. */
const SETTLES = 0.12;

/**
 * Differences between planned and executed footsteps, metres and radians: for each, the least from its landing to 0.12 s after (a
 * foot that leaves at once rolls on), and of these the largest and the share within 1 mm and half a degree.
 */
export function footstepErrors(
  m: CrowdMotion,
  skeleton: Skeleton,
  seconds: number,
): { count: number; position: number; yaw: number; exact: number } {
  const rest = restPlaces(skeleton);
  const place = (i: number, joint: number): [number, number] => {
    const o = (i * 22 + joint) * 16;
    const e = m.body.matrices;
    const [x, y, z] = [rest[3 * joint], rest[3 * joint + 1], rest[3 * joint + 2]];
    return [
      e[o] * x + e[o + 4] * y + e[o + 8] * z + e[o + 12],
      e[o + 2] * x + e[o + 6] * y + e[o + 10] * z + e[o + 14],
    ];
  };
  const best = new Map<CrowdFootstep, { position: number; yaw: number }>();
  for (let f = 0; f < seconds * 60; f++) {
    const t = f / 60;
    moveCrowd(m, t, 200);
    for (const { step } of m.session.footsteps) {
      if (step.lift === null || t < step.land || t > step.land + SETTLES || m.session.gone[step.agent] < t)
        continue;
      const [foot, toes] = step.side > 0 ? [J.leftFoot, J.leftToes] : [J.rightFoot, J.rightToes];
      const at = place(step.agent, foot);
      const tip = place(step.agent, toes);
      const position = Math.hypot(at[0] - step.x, at[1] - step.z);
      const yaw = Math.abs(wrap(Math.atan2(tip[0] - at[0], tip[1] - at[1]) - step.yaw));
      const known = best.get(step);
      if (!known || position < known.position) best.set(step, { position, yaw });
    }
  }
  const all = [...best.values()];
  return {
    count: all.length,
    position: Math.max(0, ...all.map((e) => e.position)),
    yaw: Math.max(0, ...all.map((e) => e.yaw)),
    exact:
      all.filter((e) => e.position <= 0.001 && e.yaw <= (0.5 * Math.PI) / 180).length /
      Math.max(1, all.length),
  };
}
