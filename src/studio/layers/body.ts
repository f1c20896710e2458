/**
 * Pelvis, trunk, head and arms: the turning of the body with the feet, and the rhythm of the walk as short harmonic
 * series of the gait phase. Amplitudes after textbook gait data and averages of real walks; see docs/studio.md.
 */
import { CLIP_RATE } from "../../core/capture/clip.ts";
import { wrapAngle } from "../../core/math/angle.ts";
import {
  gaussian,
  harmonicsOf,
  minimumJerk,
  readHarmonics,
  smoothstep,
  unit,
  unwrap,
} from "../../core/math/interpolate.ts";
import { createRandom } from "../../core/math/random.ts";
import type { Skeleton } from "../../core/skeleton/skeleton.ts";
import { shapeOf } from "../gait-shape.ts";
import { layersOf, moodOf, paceOf, type Score } from "../score.ts";
import type { FootTrack } from "./feet.ts";
import type { Gait } from "./gait.ts";
import { addLean } from "./lean.ts";
import { addPhrase } from "./phrase.ts";
import { addSingleSteps } from "./single-steps.ts";

const DEG = Math.PI / 180;

/** Angles of the upper body, radians a frame; pitch forward, roll to the right side down, as documented on each. */
export interface BodyAngles {
  /** Of the pitches, what the chest leans for speed gained. */
  lean: Float64Array;
  /** Turning of pelvis, upper chest and head in the world. */
  pelvisYaw: Float64Array;
  chestYaw: Float64Array;
  headYaw: Float64Array;
  /** Forward lean (nose down) of each in the world. */
  pelvisPitch: Float64Array;
  chestPitch: Float64Array;
  headPitch: Float64Array;
  /** Tilt towards the left side up. */
  pelvisRoll: Float64Array;
  chestRoll: Float64Array;
  headRoll: Float64Array;
  /** Each arm, left and right: forward swing, out to the side, turned in, elbow bend. */
  arms: [ArmAngles, ArmAngles];
  /** Height of the hip joints' middle over the ground, metres. */
  hipHeight: Float64Array;
}

export interface ArmAngles {
  swing: Float64Array;
  out: Float64Array;
  turn: Float64Array;
  elbow: Float64Array;
}

/** Harmonics of a step that the hips' height has: what is above them, some 8 Hz, is no walker's but the keys'. */
const HEIGHT_HARMONICS = 4;

/** How hard a step to the side comes down, beside a walking step of full length. */
const SIDE_RING = 0.5;

/** Standing: a little under full length. */
const STANDING_HEIGHT = 0.9945;

/** Upper arm of someone who stands, degrees ahead of the vertical. */
const HANGING = 2;
/** And to its side. */
const HANGING_OUT = 13;

/** The walk's own motion of the upper body over the feet. */
export function renderBody(
  score: Score,
  feet: readonly [FootTrack, FootTrack],
  gait: Gait,
  skeleton: Skeleton,
  frames: number,
): BodyAngles {
  const make = () => new Float64Array(frames);
  const arm = (): ArmAngles => ({ swing: make(), out: make(), turn: make(), elbow: make() });
  const b: BodyAngles = {
    lean: make(),
    pelvisYaw: make(),
    chestYaw: make(),
    headYaw: make(),
    pelvisPitch: make(),
    chestPitch: make(),
    headPitch: make(),
    pelvisRoll: make(),
    chestRoll: make(),
    headRoll: make(),
    arms: [arm(), arm()],
    hipHeight: make(),
  };
  const leg = skeleton.legLength;
  const scale = skeleton.height / 1.75;
  const shape = shapeOf(score.actor);
  const mood = moodOf(score.actor);
  const heights = harmonicsOf(shape.heights, HEIGHT_HARMONICS);
  // Facing: the mean of the feet, smooth; chest and head lead it.
  const facing = make();
  // Each foot's own turning is continuous; their mean then never jumps, however far apart they point.
  const turned = feet.map((t) => Float64Array.from(t.yaw));
  for (const yaw of turned) unwrap(yaw);
  const apart = 2 * Math.PI * Math.round((turned[1][0] - turned[0][0]) / (2 * Math.PI));
  for (let f = 0; f < frames; f++) facing[f] = (turned[0][f] + turned[1][f] - apart) / 2;
  gaussian(facing, 1, 9);
  const on = layersOf(score);
  const look = on.gaze ? gazeYaw(score, feet, facing, frames) : facing;
  const at = (track: Float64Array, t: number) => {
    const x = Math.max(0, Math.min(frames - 1.001, t * CLIP_RATE));
    const i = Math.floor(x);
    return track[i] + (x - i) * (track[i + 1] - track[i]);
  };
  for (let f = 0; f < frames; f++) {
    const t = f / CLIP_RATE;
    const w = gait.phase[f];
    const e = gait.amount[f];
    b.pelvisYaw[f] = facing[f] + e * mood.twist * -shape.pelvisYaw * DEG * Math.cos(w - shape.pelvisLead);
    b.chestYaw[f] =
      at(facing, t + 0.13) + e * mood.twist * -shape.chestYaw * DEG * Math.cos(w - shape.chestLag);
    b.headYaw[f] = at(look, t) + e * 0.8 * DEG * Math.cos(w);
    b.pelvisPitch[f] =
      0.25 * mood.lean * DEG + e * (shape.pelvisTilt * DEG + 1.6 * DEG * Math.cos(2 * w - 0.3));
    b.chestPitch[f] = (1 + mood.lean) * DEG + e * (shape.lean * DEG + 1.1 * DEG * Math.cos(2 * w - 0.2));
    b.headPitch[f] = (3 + mood.head) * DEG + e * 1 * DEG * Math.cos(2 * w - 1.6);
    b.pelvisRoll[f] = e * mood.sway * shape.pelvisList * DEG * (Math.sin(w) + 0.35 * Math.sin(3 * w));
    b.chestRoll[f] = e * mood.sway * -1.8 * DEG * Math.sin(w + 0.5);
    for (let side = 0; side < 2; side++) {
      const p = side === 0 ? w : w + Math.PI;
      const a = b.arms[side];
      const swing = e * mood.swing;
      a.swing[f] =
        ((1 - e) * HANGING + e * shape.armMean + mood.armsForward) * DEG +
        swing * (shape.armSwing * DEG * Math.cos(p - shape.armLag) + 1.8 * DEG * Math.cos(2 * p)) +
        (side === 0 ? swing * 0.8 * DEG : 0);
      a.elbow[f] =
        mood.elbow * DEG +
        (1 - e) * 15 * DEG +
        e * shape.elbowMean * DEG +
        swing *
          (shape.elbowSwing * DEG * Math.cos(p - shape.elbowLag) +
            shape.elbowTwice * DEG * Math.cos(2 * p - shape.elbowTwiceLag));
      a.out[f] =
        ((1 - e) * HANGING_OUT + e * shape.armOut + mood.armsOut) * DEG +
        swing * shape.armOpen * DEG * Math.cos(p - shape.armOpenLag);
      a.turn[f] = 25 * DEG + swing * 10 * DEG * Math.cos(p - shape.armLag);
    }
    // Two half cycles a cycle: the phase counts from left strikes, half cycles from any.
    const half = w / Math.PI;
    const walking = readHarmonics(heights, half);
    const k = Math.min(1, e * 1.05);
    b.hipHeight[f] =
      leg * (STANDING_HEIGHT + k * (walking - STANDING_HEIGHT)) -
      scale * (mood.crouch * (0.35 + 0.65 * k) + k * mood.bounce * (0.5 + 0.5 * Math.cos(2 * w - 0.6)));
  }
  addSingleSteps(b, score, facing, gait, skeleton, on.gaze ? gazing(score, frames) : make(), frames);
  if (on.lean) addLean(b, feet, facing, paceOf(score.actor).stance < 0.5);
  if (score.actor.phrase) addPhrase(b, gait, score.actor.phrase);
  if (on.alive) alive(b, score, gait, frames);
  return b;
}

/** Where the head points: the gaze's targets, else the way ahead, about 0.25 s before the body. */
function gazeYaw(
  score: Score,
  feet: readonly [FootTrack, FootTrack],
  facing: Float64Array,
  frames: number,
): Float64Array {
  const out = new Float64Array(frames);
  const keys = score.gaze;
  for (let f = 0; f < frames; f++) {
    const t = f / CLIP_RATE;
    const ahead = facing[Math.min(frames - 1, f + Math.round(0.26 * CLIP_RATE))];
    let k = -1;
    while (k + 1 < keys.length && keys[k + 1].time <= t) k++;
    const target = k >= 0 ? keys[k].target : null;
    out[f] = ahead;
    if (target) {
      const x = (feet[0].ankle[3 * f] + feet[1].ankle[3 * f]) / 2;
      const z = (feet[0].ankle[3 * f + 2] + feet[1].ankle[3 * f + 2]) / 2;
      const d = Math.hypot(target[0] - x, target[2] - z);
      if (d > 0.15) {
        const turn = wrapAngle(Math.atan2(target[0] - x, target[2] - z) - ahead);
        // Eyes take the rest beyond what the neck does with ease.
        out[f] = ahead + Math.max(-58 * DEG, Math.min(58 * DEG, turn * 0.9));
      }
    }
  }
  gaussian(out, 1, 8);
  return out;
}

/** Where the eyes have a target, 1, softly; else 0. */
function gazing(score: Score, frames: number): Float64Array {
  const out = new Float64Array(frames);
  let k = -1;
  for (let f = 0; f < frames; f++) {
    while (k + 1 < score.gaze.length && score.gaze[k + 1].time <= f / CLIP_RATE) k++;
    out[f] = k >= 0 && score.gaze[k].target ? 1 : 0;
  }
  gaussian(out, 1, 8);
  return out;
}

/** Breathing, sway, the ring after each strike, and a little seeded noise: without them a figure looks cast. */
function alive(b: BodyAngles, score: Score, gait: Gait, frames: number): void {
  const random = createRandom(score.seed + 17);
  const wander = (rate: number, sd: number): Float64Array => {
    // Noise of about `rate` Hz: white, smoothed, brought to its deviation.
    const x = Float64Array.from({ length: frames }, () => random.normal());
    gaussian(x, 1, CLIP_RATE / (2 * Math.PI * rate));
    const s = Math.sqrt(x.reduce((a, v) => a + v * v, 0) / frames) || 1;
    for (let f = 0; f < frames; f++) x[f] *= sd / s;
    return x;
  };
  const add = (track: Float64Array, noise: Float64Array) => {
    for (let f = 0; f < frames; f++) track[f] += noise[f];
  };
  for (const track of [b.pelvisPitch, b.pelvisRoll, b.chestPitch, b.chestRoll, b.chestYaw]) {
    add(track, wander(2.6, 0.06 * DEG));
    add(track, wander(0.25, 0.35 * DEG));
  }
  for (const track of [b.headPitch, b.headYaw, b.headRoll]) {
    add(track, wander(2.6, 0.08 * DEG));
    add(track, wander(0.2, 0.9 * DEG));
  }
  for (const arm of b.arms) {
    for (const track of [arm.swing, arm.out, arm.elbow]) {
      add(track, wander(2.4, 0.16 * DEG));
      add(track, wander(0.2, 0.6 * DEG));
    }
  }
  const { wobble } = moodOf(score.actor);
  if (wobble > 0) {
    // Unsteady: the trunk tips one way, the arms go the other, and paddle.
    const tip = wander(0.55, wobble * DEG);
    const nod = wander(0.4, 0.5 * wobble * DEG);
    const paddles = b.arms.map(() => ({
      up: wander(0.85, 2 * wobble * DEG),
      way: wander(0.7, 2.6 * wobble * DEG),
    }));
    for (let f = 0; f < frames; f++) {
      b.chestRoll[f] += tip[f];
      b.pelvisRoll[f] += 0.35 * tip[f];
      b.headRoll[f] += 0.5 * tip[f];
      b.chestPitch[f] += nod[f];
      b.arms.forEach((arm, side) => {
        const sign = side === 0 ? 1 : -1;
        // Hanging arms waver less than those held out.
        const out = smoothstep(arm.out[f] / (70 * DEG));
        arm.out[f] += out * (paddles[side].up[f] - sign * 3 * tip[f]);
        arm.swing[f] += (0.3 + 0.7 * out) * (0.6 * paddles[side].way[f] + sign * 1.5 * nod[f]);
        arm.turn[f] += out * paddles[side].way[f];
      });
    }
  }
  // Breathing, 0.25 Hz.
  const start = random.between(0, 2 * Math.PI);
  for (let f = 0; f < frames; f++)
    b.chestPitch[f] -= 0.35 * DEG * Math.sin(start + (2 * Math.PI * 0.25 * f) / CLIP_RATE);
  // The ring after a strike: what hangs free, arms and head, rings most; hips and trunk so little that the knees' curves stay.
  for (const { kind, land: time } of score.steps) {
    const side = kind === "side" || kind === "close";
    if (!side && kind !== "walk" && kind !== "turnStep" && kind !== "run") continue;
    for (let k = 0; k < 24; k++) {
      const f = Math.ceil(time * CLIP_RATE) + k;
      if (f >= frames) break;
      const t = f / CLIP_RATE - time;
      const e = side ? SIDE_RING : gait.amount[f];
      const ring = 0.45 * e * Math.exp(-t / 0.07) * Math.sin(2 * Math.PI * 6.5 * t) * smoothstep(t / 0.02);
      b.hipHeight[f] -= 0.0018 * ring;
      b.chestPitch[f] += 0.5 * DEG * ring;
      if (f + 2 < frames) b.headPitch[f + 2] += 0.5 * DEG * ring;
      for (const arm of b.arms) {
        arm.swing[f] -= 1.1 * DEG * ring;
        if (f + 3 < frames) arm.elbow[f + 3] += 1.8 * DEG * ring;
      }
    }
  }
}

/** A bump from 0 to 1 to 0 over given times, each flank by minimum jerk. */
export function pulse(t: number, from: number, up: number, downFrom: number, to: number): number {
  if (t <= from || t >= to) return 0;
  if (t < up) return minimumJerk(unit((t - from) / Math.max(1e-6, up - from)));
  if (t <= downFrom) return 1;
  return 1 - minimumJerk(unit((t - downFrom) / Math.max(1e-6, to - downFrom)));
}
