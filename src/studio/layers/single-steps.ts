/**
 * Steps outside a rhythm: to the side, closing, forward and back at a task.
 *
 * A step to the side opens with the hip hitched over the leg that is carried out and the trunk leaned over the one that
 * stands; the knee yields as the weight is taken; then the trunk has gone over, and the hip of the foot that follows hangs.
 * Trunk after pelvis, shoulders after trunk, elbows last: each a little later than what carries it.
 */
import { CLIP_RATE } from "../../core/capture/clip.ts";
import { gaussian, unit } from "../../core/math/interpolate.ts";
import type { Skeleton } from "../../core/skeleton/skeleton.ts";
import type { Score, ScoreStance } from "../score.ts";
import { type BodyAngles, pulse } from "./body.ts";
import type { Gait } from "./gait.ts";

const DEG = Math.PI / 180;
/** Metres that a full step to the side is long, at 1.75 m. */
const FULL = 0.42;
/** Frames by which trunk, upper arms and elbows follow the pelvis. */
const LAG = { chest: 3, arm: 7, elbow: 11 } as const;
/** Standard deviation of the arms' slowness, frames. */
const SLOW_ARMS = 7;

/** How much of each kind of step there is, a frame each; left and right foot. */
interface Parts {
  /** In the air, any step. */
  air: [Float64Array, Float64Array];
  /** In the air, carried away from the other foot / brought to it. */
  lead: [Float64Array, Float64Array];
  trail: [Float64Array, Float64Array];
  /** Weight being taken after a step to the side. */
  taken: [Float64Array, Float64Array];
  /** To the side on the whole, left positive. */
  course: Float64Array;
}

function partsOf(score: Score, facing: Float64Array, gait: Gait, skeleton: Skeleton, frames: number): Parts {
  const make = (): [Float64Array, Float64Array] => [new Float64Array(frames), new Float64Array(frames)];
  const p: Parts = {
    air: make(),
    lead: make(),
    trail: make(),
    taken: make(),
    course: new Float64Array(frames),
  };
  const place: Record<"left" | "right", ScoreStance> = { left: score.start.left, right: score.start.right };
  for (const s of score.steps) {
    const from = place[s.foot];
    place[s.foot] = s;
    if (s.kind === "heelPivot" || s.kind === "toePivot" || s.kind === "slide") continue;
    const side = s.foot === "left" ? 0 : 1;
    const yaw = facing[Math.max(0, Math.min(frames - 1, Math.round(s.lift * CLIP_RATE)))];
    const dx = s.x - from.x;
    const dz = s.z - from.z;
    const across = dx * Math.cos(yaw) - dz * Math.sin(yaw);
    const along = dx * Math.sin(yaw) + dz * Math.cos(yaw);
    const square = across * across + along * along;
    const share = square > 1e-6 ? across ** 4 / (across ** 4 + along ** 4) : 0;
    const size = share * Math.min(1.15, Math.abs(across) / ((FULL * skeleton.height) / 1.75));
    const leads = across > 0 === (side === 0);
    const last = Math.min(frames - 1, Math.ceil((s.land + 0.7) * CLIP_RATE));
    for (let f = Math.max(0, Math.floor((s.lift - 0.3) * CLIP_RATE)); f <= last; f++) {
      const t = f / CLIP_RATE;
      const calm = 1 - Math.min(1, gait.amount[f] * 1.4);
      const u = unit((t - s.lift) / (s.land - s.lift));
      const bump = calm * Math.sin(Math.PI * u) ** 2;
      p.air[side][f] += bump;
      (leads ? p.lead : p.trail)[side][f] += size * bump;
      p.taken[side][f] += calm * size * pulse(t, s.land - 0.1, s.land + 0.13, s.land + 0.15, s.land + 0.55);
      const going = calm * size * pulse(t, s.lift - 0.3, s.lift + 0.05, s.land, s.land + 0.5);
      if (going > Math.abs(p.course[f])) p.course[f] = Math.sign(across) * going;
    }
  }
  for (const pair of [p.air, p.lead, p.trail, p.taken]) for (const track of pair) gaussian(track, 1, 3.5);
  gaussian(p.course, 1, 7);
  return p;
}

/** Adds what single steps do to pelvis, trunk, head and arms. `facing`: the body's yaw, a frame each. Mutates the angles. */
export function addSingleSteps(
  b: BodyAngles,
  score: Score,
  facing: Float64Array,
  gait: Gait,
  skeleton: Skeleton,
  looks: Float64Array,
  frames: number,
): void {
  const p = partsOf(score, facing, gait, skeleton, frames);
  const at = (track: Float64Array, f: number, lag: number) => track[Math.max(0, f - lag)];
  /** Left less right. */
  const tilt = (pair: [Float64Array, Float64Array], f: number, lag = 0) =>
    at(pair[0], f, lag) - at(pair[1], f, lag);
  const both = (pair: [Float64Array, Float64Array], f: number, lag = 0) =>
    at(pair[0], f, lag) + at(pair[1], f, lag);
  // Hanging arms are slow: of a small step they keep little, of one to the side, which throws the trunk about, all.
  const arms = p.air.map((air, side) => {
    const wide = Float64Array.from(p.lead[side], (x, f) => x + p.trail[side][f]);
    const small = Float64Array.from(air, (x, f) => x - wide[f]);
    gaussian(small, 1, SLOW_ARMS);
    return small.map((x, f) => x + wide[f]);
  }) as [Float64Array, Float64Array];
  for (let f = 0; f < frames; f++) {
    const course = p.course[f];
    const small = tilt(p.air, f) - tilt(p.lead, f) - tilt(p.trail, f);
    // Positive roll: left side up. The hip is hitched over a foot that goes out, and hangs over one that follows.
    b.pelvisRoll[f] += DEG * (-2.4 * small + 3.2 * tilt(p.lead, f) - 4.2 * tilt(p.trail, f));
    b.chestRoll[f] +=
      DEG *
      (1.2 * (tilt(p.air, f, LAG.chest) - tilt(p.lead, f, LAG.chest) - tilt(p.trail, f, LAG.chest)) +
        5.5 * tilt(p.lead, f, LAG.chest) +
        2.6 * tilt(p.trail, f, LAG.chest) -
        4 * tilt(p.taken, f, LAG.chest) -
        2.4 * at(p.course, f, LAG.chest));
    b.headRoll[f] -= DEG * 1.2 * (tilt(p.lead, f, LAG.arm) - tilt(p.taken, f, LAG.arm));
    // The leading hip opens ahead of the trunk; the eyes look where it goes.
    b.pelvisYaw[f] += DEG * (2 * course + 3.2 * Math.abs(course) * (tilt(p.lead, f) + tilt(p.trail, f)));
    b.chestYaw[f] += DEG * (5 * at(p.course, f, LAG.chest) - 1.6 * tilt(p.lead, f, LAG.chest));
    b.headYaw[f] += DEG * (1 - looks[f]) * 22 * course;
    b.pelvisPitch[f] += DEG * 1.8 * Math.abs(course);
    b.chestPitch[f] +=
      DEG * (1.5 * both(p.air, f) + 2.2 * Math.abs(course) + 1.4 * both(p.taken, f, LAG.chest));
    b.headPitch[f] += DEG * (5 * both(p.air, f) + 2 * Math.abs(course));
    for (let side = 0; side < 2; side++) {
      const arm = b.arms[side];
      const sign = side === 0 ? 1 : -1;
      const air = both(arms, f, LAG.arm);
      arm.out[f] += DEG * (3 * air + 3 * Math.abs(at(p.course, f, LAG.arm)));
      arm.elbow[f] += DEG * (5 * both(arms, f, LAG.elbow) + 9 * Math.abs(at(p.course, f, LAG.elbow)));
      // Opposite arm and leg, and the shoulders' turn.
      arm.swing[f] += DEG * (-3.5 * sign * tilt(arms, f, LAG.arm) + 3 * Math.abs(at(p.course, f, LAG.arm)));
      arm.turn[f] += DEG * 6 * Math.abs(at(p.course, f, LAG.arm));
    }
    // Knees stay soft and yield as they take the weight.
    b.hipHeight[f] -=
      skeleton.legLength * (0.008 * both(p.air, f) + 0.009 * Math.abs(course) + 0.014 * both(p.taken, f));
  }
}
