/**
 * Where the pressure under the feet is to be: the planned zero-moment point, and each foot's share of the weight.
 *
 * Under a walking foot it runs from the heel to the ball; between the feet the weight passes over in double support;
 * before a first step from standing it goes a little towards the foot that will swing (anticipatory adjustment
 * [Breniere and Do 1986]).
 */
import { CLIP_RATE } from "../../core/capture/clip.ts";
import { gaussian, readMonotone } from "../../core/math/interpolate.ts";
import type { Skeleton } from "../../core/skeleton/skeleton.ts";
import { type GaitShape, shapeOf } from "../gait-shape.ts";
import type { Score, ScoreStep } from "../score.ts";
import { pulse } from "./body.ts";
import type { FootTrack } from "./feet.ts";

export interface Pressure {
  /** x, z a frame. */
  point: Float64Array;
  /** The left foot's share. */
  left: Float64Array;
}

/** Metres ahead of the ankle at a foot of 0.125 m from ankle to ball. */
const STANDING = 0.04;
/** Share on the standing foot while the other pivots. */
const PIVOT_SHARE = 0.8;

const isWalk = (s: ScoreStep): boolean => s.kind === "walk" || s.kind === "turnStep" || s.kind === "run";

/** The plan of pressure over the frames of a score. */
export function planPressure(
  score: Score,
  feet: readonly [FootTrack, FootTrack],
  skeleton: Skeleton,
  frames: number,
): Pressure {
  const gait = shapeOf(score.actor);
  const left = shares(score, frames, gait);
  restOneLeg(left, score);
  const point = new Float64Array(2 * frames);
  const scale = skeleton.foot.ballForward / 0.125;
  const along = [0, 1].map((side) => footProgress(score, side === 0 ? "left" : "right", frames, gait));
  for (let f = 0; f < frames; f++) {
    for (let side = 0; side < 2; side++) {
      const w = side === 0 ? left[f] : 1 - left[f];
      if (w === 0) continue;
      const t = feet[side];
      const yaw = t.turning[f] ? t.yaw[f] : t.rest[3 * f + 2];
      const x = t.turning[f] ? t.ankle[3 * f] : t.rest[3 * f];
      const z = t.turning[f] ? t.ankle[3 * f + 2] : t.rest[3 * f + 1];
      const ahead = along[side][f] * scale;
      const out = (side === 0 ? gait.outward : -gait.outward) * scale;
      point[2 * f] += w * (x + Math.sin(yaw) * ahead + Math.cos(yaw) * out);
      point[2 * f + 1] += w * (z + Math.cos(yaw) * ahead - Math.sin(yaw) * out);
    }
  }
  gaussian(point, 2, 2.2);
  return { point, left };
}

/** Share by which a writer stands on the leg of the writing side more than on the other, and seconds to go over to it. */
const RESTING = 0.17;
const TO_REST = 0.8;

/** At a board the weight goes over one leg and comes back before the next step. */
function restOneLeg(left: Float64Array, score: Score): void {
  for (const event of score.events) {
    if (event.type !== "write") continue;
    const { task } = event;
    const landed = score.steps.reduce((t, s) => (s.lift < task.contact ? Math.max(t, s.land) : t), 0);
    const next = score.steps.reduce(
      (t, s) => (s.lift >= task.contact ? Math.min(t, s.lift) : t),
      Number.POSITIVE_INFINITY,
    );
    const from = landed + 0.3;
    const to = Math.min(task.end + 0.4, next - 0.5);
    // A tap in passing has no time to rest.
    if (to - from < 2 * TO_REST) continue;
    const sign = task.hand === "left" ? 1 : -1;
    for (let f = Math.ceil(from * CLIP_RATE); f < Math.min(left.length, to * CLIP_RATE); f++)
      left[f] += sign * RESTING * pulse(f / CLIP_RATE, from, from + TO_REST, to - TO_REST, to);
  }
}

/** How far ahead of the ankle the pressure is under a foot, metres. */
function footProgress(score: Score, foot: "left" | "right", frames: number, gait: GaitShape): Float64Array {
  const [strike, flat, middle, heelOff, toeOff] = gait.pressure;
  const out = new Float64Array(frames).fill(STANDING);
  const steps = score.steps.filter((s) => s.foot === foot);
  for (let k = 0; k <= steps.length; k++) {
    const before = steps[k - 1];
    const after = steps[k];
    const from = before ? before.land : 0;
    const to = after ? after.lift : frames / CLIP_RATE;
    const times = [from];
    const values = [before && isWalk(before) ? strike : STANDING];
    const push = after && isWalk(after);
    const room = to - from;
    if (room > 0.25) {
      times.push(from + 0.07);
      values.push(before ? flat : STANDING);
      if (room < 1.1) {
        times.push(from + 0.45 * room);
        values.push(push ? middle : STANDING);
      } else {
        times.push(from + 0.45, to - 0.45);
        values.push(STANDING, STANDING);
      }
      times.push(Math.max(from + 0.5 * room, to - 0.17));
      values.push(push ? heelOff : STANDING);
    }
    times.push(to);
    values.push(push ? toeOff : STANDING);
    for (let f = Math.max(0, Math.ceil(from * CLIP_RATE)); f < Math.min(frames, to * CLIP_RATE); f++)
      out[f] = readMonotone(times, values, f / CLIP_RATE);
  }
  return out;
}

/** The left foot's share of the weight. */
function shares(score: Score, frames: number, gait: GaitShape): Float64Array {
  const times: number[] = [];
  const values: number[] = [];
  const add = (t: number, v: number) => {
    const last = times[times.length - 1] ?? -1;
    if (t <= last + 1e-4) return;
    times.push(t);
    values.push(v);
  };
  add(0, 0.5);
  let landed = Number.NEGATIVE_INFINITY;
  const steps = [...score.steps].sort((a, b) => a.lift - b.lift);
  steps.forEach((s, i) => {
    const pivot = s.kind === "heelPivot" || s.kind === "toePivot" || s.kind === "slide";
    const stands = s.foot === "left" ? 0 : 1;
    const share = pivot ? (stands === 1 ? PIVOT_SHARE : 1 - PIVOT_SHARE) : stands;
    const gap = s.lift - Math.max(0, landed);
    if (gap > 0.9) {
      if (landed > 0) add(landed + 0.45, 0.5);
      const ahead = Math.min(0.46, gap / 2);
      add(s.lift - ahead, 0.5);
      // Towards the foot that will swing first.
      if (!pivot) add(s.lift - ahead + 0.14, 0.5 - (stands - 0.5) * 0.3);
      add(s.lift - 0.03, share);
    } else if (gap < 0) {
      // In flight the weight is on neither: it is handed over between the lift and the landing.
      const before = values.pop() ?? share;
      times.pop();
      add(s.lift, before);
      add(landed, share);
    } else if (landed > Number.NEGATIVE_INFINITY) {
      const before = values[values.length - 1];
      if (before === share && gap > 0.1) add(landed + gap / 2, share + (0.5 - share) * 0.35);
      // Over to the front foot between its landing and just before the other leaves.
      add(Math.max(landed + gait.passOver * gap, s.lift - 0.03), share);
    } else add(s.lift - 0.03, share);
    add(s.land, share);
    landed = Math.max(landed, s.land);
    if (i === steps.length - 1) add(s.land + 0.5, 0.5);
  });
  const out = new Float64Array(frames);
  for (let f = 0; f < frames; f++) out[f] = readMonotone(times, values, f / CLIP_RATE);
  return out;
}
