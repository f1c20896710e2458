/**
 * The feet: heel strike, roll, flat, heel-off, toe-off, swing, pivots, slides. Closed form in the foot's pitch while
 * the foot is down, so nothing slides; a shaped path between the exact ends while it is in the air.
 *
 * Shapes are low-order keys after textbook gait curves [Perry, Gait Analysis; Winter, Biomechanics and Motor Control],
 * see docs/studio.md for each.
 */
import { CLIP_RATE } from "../../core/capture/clip.ts";
import { wrapAngle } from "../../core/math/angle.ts";
import {
  gaussian,
  minimumJerk,
  readKeys,
  readMonotone,
  smoothstep,
  softEnvelope,
  unit,
} from "../../core/math/interpolate.ts";
import { contactsOfPitch, pivotPlace, plantedAnkle } from "../../core/motion/sole.ts";
import type { FootShape, Skeleton } from "../../core/skeleton/skeleton.ts";
import type { Foot } from "../../core/steps/types.ts";
import { type GaitShape, shapeOf } from "../gait-shape.ts";
import { layersOf, type Mood, moodOf, type Score, type ScoreStance, type ScoreStep } from "../score.ts";

const DEG = Math.PI / 180;

/** One foot over the whole performance, a row a frame. */
export interface FootTrack {
  /** Ankle joint, frames x 3. */
  ankle: Float64Array;
  yaw: Float64Array;
  pitch: Float64Array;
  toeBend: Float64Array;
  /** 1 heel, 2 toe. */
  contacts: Uint8Array;
  /** Where the foot rests, or came from while it swings: x, z, yaw. */
  rest: Float64Array;
  /** 0 when down, else the fraction of the swing, just above 0 to 1. */
  swing: Float64Array;
  /** Whether the foot pivots or slides. */
  turning: Uint8Array;
}

interface Move extends ScoreStep {
  from: ScoreStance;
  /** Distance, leg lengths. */
  reach: number;
  /** How much of a full step's roll and rise it has, 0 to 1; the push after the actor's mood. */
  whole: number;
  push: number;
  strike: number;
}

const isWalk = (s: ScoreStep): boolean => s.kind === "walk" || s.kind === "turnStep" || s.kind === "run";
const isPivot = (s: ScoreStep): boolean => s.kind === "heelPivot" || s.kind === "toePivot";

function movesOf(score: Score, foot: Foot, leg: number, gait: GaitShape, mood: Mood): Move[] {
  let from: ScoreStance = score.start[foot];
  return score.steps
    .filter((s) => s.foot === foot)
    .map((s) => {
      const reach = Math.hypot(s.x - from.x, s.z - from.z) / leg;
      const turn = Math.abs(wrapAngle(s.yaw - from.yaw));
      // Shorter and turning steps roll less than a full one.
      const size = unit(reach / gait.full);
      // Backwards the foot neither pushes off behind nor strikes with the heel.
      const ahead = Math.cos(
        wrapAngle(Math.atan2(s.x - from.x, s.z - from.z) - from.yaw - wrapAngle(s.yaw - from.yaw) / 2),
      );
      const forwardness = reach < 0.05 ? 0 : smoothstep((ahead + 0.2) / 0.9);
      const whole = (0.3 + 0.7 * size) * (0.35 + 0.65 * forwardness) * (1 - 0.25 * unit(turn / 1.2));
      const move: Move = {
        ...s,
        from,
        reach,
        whole,
        push: isWalk(s) ? mood.push * whole : 0.28 + 0.25 * unit(reach / 0.6),
        strike: isWalk(s)
          ? mood.strike * (0.1 + 0.9 * size * size) * forwardness * (1 - 0.6 * unit(turn / 1.2))
          : 0,
      };
      from = { x: s.x, z: s.z, yaw: s.yaw };
      return move;
    });
}

/** Pitch of the foot at lift-off and at landing of a move. */
const liftPitch = (m: Move, gait: GaitShape): number =>
  isWalk(m)
    ? gait.push * DEG * m.push
    : m.kind === "slide"
      ? 0
      : m.kind === "heelPivot"
        ? 9 * DEG
        : m.kind === "toePivot"
          ? -9 * DEG
          : -40 * DEG * m.push;
const landPitch = (m: Move, gait: GaitShape): number =>
  isWalk(m)
    ? gait.strike * DEG * m.strike + (m.strike < 0.12 ? -5 * DEG * (1 - m.strike / 0.12) : 0)
    : m.kind === "slide"
      ? 0
      : isPivot(m)
        ? liftPitch(m, gait)
        : -7 * DEG;

/** Renders one foot. */
export function renderFoot(score: Score, foot: Foot, skeleton: Skeleton, frames: number): FootTrack {
  const shape = skeleton.foot;
  const leg = skeleton.legLength;
  const gait = shapeOf(score.actor);
  const mood = moodOf(score.actor);
  const track: FootTrack = {
    ankle: new Float64Array(3 * frames),
    yaw: new Float64Array(frames),
    pitch: new Float64Array(frames),
    toeBend: new Float64Array(frames),
    contacts: new Uint8Array(frames),
    rest: new Float64Array(3 * frames),
    swing: new Float64Array(frames),
    turning: new Uint8Array(frames),
  };
  const moves = movesOf(score, foot, leg, gait, mood);
  if (layersOf(score).roll) stancePitch(track.pitch, moves, frames, gait);
  const out = new Float64Array(3);
  let k = 0;
  for (let f = 0; f < frames; f++) {
    const t = f / CLIP_RATE;
    while (k < moves.length && t >= moves[k].land - 1e-9) k++;
    const m = moves[k];
    const rest: ScoreStance = k === 0 ? score.start[foot] : moves[k - 1];
    track.rest.set([rest.x, rest.z, rest.yaw], 3 * f);
    const moving = m !== undefined && t >= m.lift - 1e-9;
    if (!moving) {
      down(track, f, shape, rest, track.pitch[f], out);
      track.contacts[f] = contactsOfPitch(track.pitch[f]);
      continue;
    }
    const u = (t - m.lift) / (m.land - m.lift);
    track.swing[f] = Math.max(1e-6, u);
    if (isPivot(m)) {
      const end = m.kind === "heelPivot" ? "heel" : "ball";
      const on = pivotPlace(shape, m.from, m.from.yaw + wrapAngle(m.yaw - m.from.yaw) * minimumJerk(u), end);
      down(track, f, shape, on, track.pitch[f], out);
      track.contacts[f] = end === "heel" ? 1 : 2;
      track.turning[f] = 1;
    } else if (m.kind === "slide") {
      const s = minimumJerk(u);
      const on = {
        x: m.from.x + s * (m.x - m.from.x),
        z: m.from.z + s * (m.z - m.from.z),
        yaw: m.from.yaw + s * wrapAngle(m.yaw - m.from.yaw),
      };
      down(track, f, shape, on, 0, out);
      track.turning[f] = 1;
    }
  }
  for (const m of moves) if (!isPivot(m) && m.kind !== "slide") swing(track, m, skeleton, gait, mood);
  boundToes(track, shape);
  return track;
}

function down(
  track: FootTrack,
  f: number,
  shape: FootShape,
  on: ScoreStance,
  pitch: number,
  out: Float64Array,
): void {
  plantedAnkle(out, shape, pitch);
  track.ankle[3 * f] = on.x + Math.sin(on.yaw) * out[0];
  track.ankle[3 * f + 1] = out[1];
  track.ankle[3 * f + 2] = on.z + Math.cos(on.yaw) * out[0];
  track.yaw[f] = on.yaw;
  track.pitch[f] = pitch;
  track.toeBend[f] = out[2];
}

/** Pitch over all frames: stance from strike to lift-off, pivots, and the swing's shape between. */
function stancePitch(pitch: Float64Array, moves: readonly Move[], frames: number, gait: GaitShape): void {
  let landed = Number.NEGATIVE_INFINITY;
  let before: Move | null = null;
  for (let k = 0; k <= moves.length; k++) {
    const m = moves[k] ?? null;
    const lift = m ? m.lift : Number.POSITIVE_INFINITY;
    const last = m ? Math.min(frames - 1, Math.ceil(lift * CLIP_RATE) - 1) : frames - 1;
    const room = lift - landed;
    const flatAfter = before
      ? Math.min(isPivot(before) ? 0.13 : isWalk(before) ? gait.flat : 0.08, 0.35 * room)
      : 0;
    const air = m ? m.land - m.lift : 0;
    const rise = m ? Math.min(isPivot(m) ? 0.14 : isWalk(m) ? gait.heelRise * air : 0.24, 0.6 * room) : 0;
    for (let f = Math.max(0, Math.ceil(landed * CLIP_RATE - 1e-6)); f <= last; f++) {
      const t = f / CLIP_RATE;
      let p = 0;
      if (before && t < landed + flatAfter) {
        const u = (t - landed) / flatAfter;
        p +=
          landPitch(before, gait) * (isPivot(before) ? 1 - smoothstep(u) : (1 - u) * (1 - u) * (1 + 0.8 * u));
      }
      if (m && t > lift - rise) {
        const u = (t - (lift - rise)) / rise;
        p += liftPitch(m, gait) * (isPivot(m) ? smoothstep(u) : u ** (isWalk(m) ? gait.heelPower : 2.2));
      }
      pitch[f] = p;
    }
    if (!m) break;
    for (
      let f = Math.max(0, Math.ceil(lift * CLIP_RATE - 1e-6));
      f < Math.min(frames, m.land * CLIP_RATE - 1e-6);
      f++
    ) {
      const u = (f / CLIP_RATE - lift) / (m.land - lift);
      pitch[f] = isPivot(m)
        ? liftPitch(m, gait)
        : liftPitch(m, gait) * readKeys(gait.pushOverSwing, u) +
          landPitch(m, gait) * readKeys(gait.strikeOverSwing, u);
    }
    landed = m.land;
    before = m;
  }
  // One frame of smoothing: whatever the pitch is, the point that bears stays put.
  gaussian(pitch, 1, 0.8);
}

/** The airborne path between the exact ends, with clearance; fills ankle, yaw and toe bend. */
function swing(track: FootTrack, m: Move, skeleton: Skeleton, gait: GaitShape, mood: Mood): void {
  const shape = skeleton.foot;
  const leg = skeleton.legLength;
  const scale = leg / 0.93;
  const first = Math.ceil(m.lift * CLIP_RATE - 1e-6);
  const last = Math.min(track.yaw.length - 1, Math.ceil(m.land * CLIP_RATE - 1e-6) - 1);
  const frames = track.yaw.length;
  if (last < first) return;
  const d = m.land - m.lift;
  const out = new Float64Array(3);
  // Ends and end speeds from the closed forms, by small differences of the pitch.
  const end = (on: ScoreStance, pitch: number) => {
    plantedAnkle(out, shape, pitch);
    return [on.x + Math.sin(on.yaw) * out[0], out[1], on.z + Math.cos(on.yaw) * out[0]];
  };
  const pitch0 =
    track.pitch[Math.max(0, first - 1)] +
    (track.pitch[first] - track.pitch[Math.max(0, first - 1)]) * (m.lift * CLIP_RATE - (first - 1));
  const speed0 = (track.pitch[Math.max(0, first - 1)] - track.pitch[Math.max(0, first - 2)]) * CLIP_RATE;
  const after = Math.min(frames - 1, last + 1);
  const pitch1 = track.pitch[after];
  const p0 = end(m.from, pitch0);
  const p0b = end(m.from, pitch0 - speed0 * 0.002);
  const p1 = end(m, pitch1);
  const v0 = p0.map((v, i) => (v - p0b[i]) / 0.002);
  const walk = isWalk(m);
  // A small step leaves the ground with some speed, as a foot does that is picked up.
  if (!walk) v0[1] = Math.max(v0[1], 0.32 * scale);
  const forward = [Math.sin(m.yaw), 0, Math.cos(m.yaw)];
  const v1 = walk
    ? [0.25 * forward[0] * m.strike, -0.2 * scale, 0.25 * forward[2] * m.strike]
    : [0, -0.22 * scale, 0];
  // The fitted rise belongs to the ankle that a full push leaves high behind: with less of a push there is less of it.
  const size = walk ? m.whole : 0;
  const hump = walk ? 0.06 * (1 - size) + mood.lift : 0.062;
  const turn = wrapAngle(m.yaw - m.from.yaw);
  const rawSpeed = (at: 0 | 1) => {
    const h = 1e-3;
    const a = at === 0 ? 0 : 1 - h;
    const share = (u: number) => (walk ? readKeys(gait.way, u) : smallWay(u));
    const rise = (u: number) =>
      (walk ? readKeys(gait.rise, u) * size * scale : 0) + hump * scale * humpShape(u);
    const ds = (share(a + h) - share(a)) / h / d;
    const dr = (rise(a + h) - rise(a)) / h / d;
    return [ds * (p1[0] - p0[0]), ds * (p1[1] - p0[1]) + dr, ds * (p1[2] - p0[2])];
  };
  const r0 = rawSpeed(0);
  const r1 = rawSpeed(1);
  const bendAt = (pitch: number) => {
    plantedAnkle(out, shape, pitch);
    return out[2];
  };
  const bend0 = bendAt(pitch0);
  const bendSpeed0 = (bend0 - bendAt(pitch0 - speed0 * 0.002)) / 0.002;
  const n = last - first + 1;
  const path = new Float64Array(3 * n);
  let lack = 0;
  for (let i = 0; i < n; i++) {
    const f = first + i;
    const u = unit((f / CLIP_RATE - m.lift) / d);
    const s = walk ? readKeys(gait.way, u) : smallWay(u);
    const rise = (walk ? readKeys(gait.rise, u) * size * scale : 0) + hump * scale * humpShape(u);
    const k0 = d * u * (1 - u) ** 6;
    const k1 = d * (1 - u) * u ** 4;
    for (let c = 0; c < 3; c++) {
      path[3 * i + c] =
        p0[c] + s * (p1[c] - p0[c]) + (c === 1 ? rise : 0) + (v0[c] - r0[c]) * k0 - (v1[c] - r1[c]) * k1;
    }
    track.yaw[f] = m.from.yaw + turn * (walk ? smoothstep((u - 0.05) / 0.9) : minimumJerk(u));
    // Clearance of heel, ball and tip.
    const low = path[3 * i + 1] + lowestOfFoot(shape, track.pitch[f]);
    const wanted = clearanceAt(u) * scale;
    const bump = Math.sin(Math.PI * u) ** 2;
    if (u > 0.12 && u < 0.92) lack = Math.max(lack, (wanted - low) / bump);
  }
  for (let i = 0; i < n; i++) {
    const f = first + i;
    const u = unit((f / CLIP_RATE - m.lift) / d);
    path[3 * i + 1] += lack * Math.sin(Math.PI * u) ** 2;
    const floor = -lowestOfFoot(shape, track.pitch[f]) + 0.0005;
    if (u > 0.06) path[3 * i + 1] = Math.max(path[3 * i + 1], floor);
    track.ankle.set([path[3 * i], path[3 * i + 1], path[3 * i + 2]], 3 * f);
    const bend =
      decay(bend0, bendSpeed0, u * d) + 4 * DEG * smoothstep((u - 0.6) / 0.4) * (walk ? m.strike : 0);
    track.toeBend[f] = bend;
    track.contacts[f] = 0;
  }
}

/** Seconds in which unloaded toes spring back, and how much further than at toe-off they may bend meanwhile. */
const SPRING = 0.032;
const FURTHER = 0.15;

/** A bend that was changing when the foot left the ground, seconds later: critically damped back to straight. */
function decay(bend: number, speed: number, t: number): number {
  const rate = Math.min(speed, (FURTHER * bend) / SPRING) + bend / SPRING;
  return (bend + rate * t) * Math.exp(-t / SPRING);
}

/** A small step's lift: quick off the ground and quick down, so that the foot is seen to leave and to land. */
const humpShape = (u: number): number =>
  u <= 0 || u >= 1 ? 0 : (u ** HUMP_UP * (1 - u) ** HUMP_DOWN) / HUMP_TOP;
const HUMP_UP = 1.15;
const HUMP_DOWN = 1.12;
const HUMP_TOP =
  (HUMP_UP / (HUMP_UP + HUMP_DOWN)) ** HUMP_UP * (HUMP_DOWN / (HUMP_UP + HUMP_DOWN)) ** HUMP_DOWN;

/** Share of the way of a small step: minimum jerk, livelier at its ends. */
const smallWay = (u: number): number => 0.35 * minimumJerk(u) + 0.65 * smoothstep(u);

/** Height of the lowest of heel point and ball sole against the ankle joint, at a pitch. */
export function lowestOfFoot(shape: FootShape, pitch: number): number {
  const s = Math.sin(pitch);
  const c = Math.cos(pitch);
  const heel = -shape.heelBack * s - shape.ankleHeight * c;
  const ball = shape.ballForward * s - (shape.ankleHeight - shape.ballHeight) * c - shape.ballHeight;
  return Math.min(heel, ball);
}

/** Least height of heel and ball over the ground at a fraction of the swing, metres at a leg of 0.93 m. */
export const clearanceAt = (u: number): number => 0.012 * readMonotone([0, 0.15, 0.85, 1], [0, 1, 1, 0], u);

/** Share of the swing over which the toes' tip leaves the ground, and comes back to it. */
const TIP_UP = 0.1;
/** Frames over which toes that must give way do so, and over which that begins and ends at the swing's ends. */
const GIVE = 3;
/** Most that toes bend. */
const MOST_BEND = 65 * DEG;

/**
 * Bends the toes of an airborne foot so that their tip stays at least 3 mm up, 7 in mid-swing, from the ground at the swing's
 * ends; softly, also where the foot hangs so steeply that a little less height asks for a lot of bend. Mutates the bends.
 */
export function boundToes(track: FootTrack, shape: FootShape): void {
  const frames = track.yaw.length;
  const reach = Math.hypot(shape.tipForward, shape.ballHeight);
  const droop = Math.atan2(shape.ballHeight, shape.tipForward);
  const airborne = (f: number) => track.swing[f] > 0 && !track.turning[f];
  for (let from = 0; from < frames; from++) {
    if (!airborne(from)) continue;
    let to = from;
    while (to + 1 < frames && airborne(to + 1) && track.swing[to + 1] >= track.swing[to]) to++;
    const lacks = new Float64Array(to - from + 1);
    for (let f = from; f <= to; f++) {
      const u = track.swing[f];
      const pitch = track.pitch[f];
      const rise = shape.ankleHeight - shape.ballHeight;
      const ball = track.ankle[3 * f + 1] + shape.ballForward * Math.sin(pitch) - rise * Math.cos(pitch);
      const least = 0.003 * unit(u / TIP_UP) * unit((1 - u) / TIP_UP) + 0.35 * clearanceAt(u);
      // Tip over the ground: ball + reach sin(pitch + bend - droop).
      const needed = Math.asin(Math.max(-1, Math.min(1, (least - ball) / reach))) + droop - pitch;
      lacks[f - from] = Math.max(0, Math.min(MOST_BEND, needed) - track.toeBend[f]);
    }
    const soft = softEnvelope(lacks, GIVE);
    for (let f = from; f <= to; f++) {
      const i = f - from;
      const end = smoothstep(Math.min(i + 1, to - f + 1) / (GIVE + 1));
      track.toeBend[f] = Math.min(MOST_BEND, track.toeBend[f] + Math.max(lacks[i], end * soft[i]));
    }
    from = to;
  }
}
