/** Random footstep tracks within the hulls of the landing points: a gait each, taken up from standing. */

import type { TimedFootstep } from "../../src/core/blending/crowd.ts";
import type { BlendLibrary } from "../../src/core/blending/library.ts";
import { MOVE_ROW } from "../../src/core/blending/library.ts";
import { createMix } from "../../src/core/blending/mix.ts";
import { DURATION, mixMoves, SWING } from "../../src/core/blending/step-query.ts";
import { lerpAngle } from "../../src/core/math/angle.ts";
import type { Random } from "../../src/core/math/random.ts";
import type { Footstep } from "../../src/core/steps/types.ts";

/** Steps that take the gait up, and steps in all. */
export const RAMP = 4;
export const STEPS = 10;

/** A triangle of a hull by its area, and weights evenly spread over it. */
function randomMix(library: BlendLibrary, side: number, r: Random): { clips: number[]; weights: number[] } {
  const { triangles, points } = library.feet[side];
  const areas: number[] = [];
  for (let t = 0; t < triangles.length; t += 3) {
    const [a, b, c] = [0, 1, 2].map((k) => 2 * triangles[t + k]);
    areas.push(
      Math.abs(
        (points[b] - points[a]) * (points[c + 1] - points[a + 1]) -
          (points[b + 1] - points[a + 1]) * (points[c] - points[a]),
      ),
    );
  }
  let pick = r.next() * areas.reduce((s, v) => s + v, 0);
  let t = 0;
  while (t < areas.length - 1 && pick > areas[t]) pick -= areas[t++];
  let u = r.next();
  let v = r.next();
  if (u + v > 1) {
    u = 1 - u;
    v = 1 - v;
  }
  return { clips: [0, 1, 2].map((k) => triangles[3 * t + k]), weights: [u, v, 1 - u - v] };
}

/**
 * A track of STEPS footsteps in the gait of a random mix, with the clips' times stretched by `pace` (0.8 to 1.2).
 *
 * @param start where left and right foot stand. @param first seconds of the first lift.
 */
export function randomTrack(
  library: BlendLibrary,
  start: readonly [Footstep, Footstep],
  first: number,
  pace: number,
  r: Random,
  chosen: number,
): TimedFootstep[] {
  const mix = createMix();
  const { clips, weights } = randomMix(library, chosen, r);
  const out: TimedFootstep[] = [];
  const feet = [{ ...start[0] }, { ...start[1] }];
  const lands = [Number.NEGATIVE_INFINITY, Number.NEGATIVE_INFINITY];
  const slow = library.names.indexOf("cycle-short-1");
  let side = r.next() < 0.5 ? 0 : 1;
  for (let k = 0; k < STEPS; k++) {
    // From short steps on the spot to the gait, over the first steps.
    const share = Math.min(1, (k + 1) / RAMP);
    mix.count = 4;
    clips.forEach((c, n) => {
      mix.clips[n] = c;
      mix.weights[n] = weights[n] * share;
    });
    mix.clips[3] = slow;
    mix.weights[3] = 1 - share;
    const column = (c: number) => mixMoves(library, mix, side, c);
    const swing = column(SWING) * pace;
    const duration = column(DURATION) * pace;
    const before = Math.max(lands[0], lands[1]);
    // At whole frames, so that what is read at a landing is read in its instant.
    const land = Math.round(60 * (k === 0 ? first + swing : before + duration)) / 60;
    const lift = Math.round(60 * Math.max(land - swing, lands[side] + 0.1)) / 60;
    const past = k === 0 ? 0.15 / (swing + 0.15) : Math.max(-1, (land - before - swing) / (land - before));
    const [own, other] = [feet[side], feet[1 - side]];
    const yawBefore = lerpAngle(own.yaw, other.yaw, 0.5);
    let turn = 0;
    for (let n = 0; n < mix.count; n++)
      turn += mix.weights[n] * library.moves[MOVE_ROW * (2 * mix.clips[n] + side) + 8] * pace;
    const yaw0 = yawBefore + past * turn;
    const c = Math.cos(yaw0);
    const s = Math.sin(yaw0);
    const px = column(0);
    const pz = column(1);
    // The root's track at the lift leans on the footstep itself: solved for it.
    const solve = (m: number, support: number, p: number) =>
      (m * (1 - past) + (past * support) / 2 + p) / (1 - past / 2);
    const x = solve((own.x + other.x) / 2, other.x, c * px + s * pz);
    const z = solve((own.z + other.z) / 2, other.z, c * pz - s * px);
    // The root's yaw at the landing is the mean of both footsteps'.
    const yaw = 2 * (yawBefore + turn) - other.yaw;
    const step: TimedFootstep = { foot: side === 0 ? "left" : "right", x, y: 0, z, yaw, lift, land };
    out.push(step);
    feet[side] = { ...step };
    lands[side] = land;
    side = 1 - side;
  }
  return out;
}
