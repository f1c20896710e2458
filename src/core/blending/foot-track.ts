/**
 * Where a foot is wanted: planted in closed form at its footstep, or on its way between two [Barycentric §4.5].
 *
 * On its way the ankle goes the eased straight line between its two planted places plus what the blended clips do beside
 * it, so it leaves and lands exactly; footsteps may lie at different heights and slope.
 */
import { wrapAngle } from "../math/angle.ts";
import { plantedAnkle } from "../motion/sole.ts";
import type { FootShape } from "../skeleton/skeleton.ts";
import {
  AIR,
  ANKLE,
  type Batch,
  F_LAND,
  F_LIFT,
  F_NEXT,
  FOOT,
  FOOT_STATE,
  LAND_PITCH,
  LAST_SIDE,
  LEAVE,
  NOW,
  PITCH,
  PLACE,
  STATE,
  STAY,
  STEPPING,
  TARGET,
} from "./batch.ts";
import { easedShare } from "./library.ts";
import { sampleStance, sampleSwing } from "./sample.ts";

/** The pitch shown follows the wanted one no faster than this, rad/s: plans that change late make no jump. */
const PITCH_RATE = 9;
/** Least clearance in the middle of a swing, metres. */
const CLEAR = 0.008;
/** Share of a swing in which a foot that goes up comes to the height of its footstep; one that goes down takes as much of the swing's end. */
const UP_BY = 0.75;
/** Likewise of the ground that it has to clear: toes are over the edge of a step before the ankle is. */
const OVER_BY = 0.55;
/** How softly a climbing foot is lifted over that ground: metres for each metre of the climb, and metres at most. */
const SOFT = 0.3;
const MOST_SOFT = 0.03;

const planted = new Float64Array(3);
const spot = new Float64Array(3);
const leaveMix = { mix: 0, scale: 1 };

/** Ankle place of a foot planted at a place block of the state (x, y, z, yaw, normal x, normal z). */
function ankleOver(s: Float64Array, place: number, shape: FootShape, pitch: number): void {
  plantedAnkle(planted, shape, pitch);
  const yaw = s[place + 3];
  const nx = s[place + 4];
  const nz = s[place + 5];
  const fx = Math.sin(yaw) * planted[0];
  const fz = Math.cos(yaw) * planted[0];
  const up = planted[1];
  if (nx === 0 && nz === 0) {
    spot[0] = s[place] + fx;
    spot[1] = s[place + 1] + up;
    spot[2] = s[place + 2] + fz;
    return;
  }
  // The shortest turn from up to the normal, applied to (fx, up, fz).
  const ny = Math.sqrt(Math.max(0.01, 1 - nx * nx - nz * nz));
  const along = (nx * fx + nz * fz) / (1 + ny);
  spot[0] = s[place] + fx - nx * along + nx * up;
  spot[1] = s[place + 1] + ny * up - (nx * fx + nz * fz);
  spot[2] = s[place + 2] + fz - nz * along + nz * up;
}

/** Remembers how the foot leaves the ground: call at the lift, before AIR is set. */
export function leaveGround(b: Batch, i: number, side: number): void {
  const s = b.state;
  const f = STATE * i + FOOT + FOOT_STATE * side;
  const pitch = s[f + PITCH];
  ankleOver(s, f + PLACE, b.library.skeleton.foot, pitch);
  s[f + LEAVE] = spot[0];
  s[f + LEAVE + 1] = spot[1];
  s[f + LEAVE + 2] = spot[2];
  s[f + LEAVE + 3] = pitch;
  s[f + LEAVE + 4] = planted[2];
  sampleSwing(b.scratch.swing, b, 3 * i + 1 + side, side, 1);
  s[f + LAND_PITCH] = b.scratch.swing[3];
}

/** Which mix says how a planted foot leaves: that of the other foot's step under way, else its own last one, softened. */
function leavingMix(b: Batch, i: number, side: number): void {
  const o = STATE * i;
  const walking = b.state[o + STEPPING] === 1 && b.state[o + LAST_SIDE] !== side;
  leaveMix.mix = walking ? 3 * i : 3 * i + 1 + side;
  leaveMix.scale = walking ? 1 : 0.7;
}

/** Pitch wanted of a planted foot at time t. */
function plantedPitch(b: Batch, i: number, side: number, t: number): number {
  const s = b.state;
  const f = STATE * i + FOOT + FOOT_STATE * side;
  const next = s[f + F_NEXT];
  const stay = Math.max(0.12, Math.min(s[f + STAY], next - s[f + F_LAND]));
  let pitch = 0;
  const settle = (t - s[f + F_LAND]) / stay;
  if (settle < 1) pitch += sampleStance(b, 3 * i + 1 + side, side, 0, settle);
  const leave = 1 - (next - t) / stay;
  if (leave > 0) {
    leavingMix(b, i, side);
    pitch += leaveMix.scale * sampleStance(b, leaveMix.mix, side, 1, leave);
  }
  return pitch;
}

/**
 * The ankle's place, the foot's rotation and the toes' bend wanted at time t, into the foot's block (ANKLE).
 *
 * @param dt seconds since the frame before, for the pitch's rate.
 */
export function footAt(b: Batch, i: number, side: number, t: number, dt: number): void {
  const s = b.state;
  const o = STATE * i;
  const f = o + FOOT + FOOT_STATE * side;
  const shape = b.library.skeleton.foot;
  if (s[f + AIR] === 0) {
    const wanted = plantedPitch(b, i, side, t);
    const most = PITCH_RATE * dt;
    s[f + PITCH] += Math.max(-most, Math.min(most, wanted - s[f + PITCH]));
    plant(b, f);
    return;
  }
  const swing = b.scratch.swing;
  const length = s[f + F_LAND] - s[f + F_LIFT];
  const u = Math.max(0, Math.min(1, (t - s[f + F_LIFT]) / length));
  const mix = 3 * i + 1 + side;
  let pitchOff = 0;
  let toeOff = 0;
  if (u < 0.6) {
    sampleSwing(swing, b, mix, side, 0);
    const early = 1 - easedShare(u / 0.6);
    pitchOff = early * (s[f + LEAVE + 3] - swing[3]);
    toeOff = early * (s[f + LEAVE + 4] - swing[4]);
  }
  sampleSwing(swing, b, mix, side, u);
  const pitch = swing[3] + pitchOff;
  ankleOver(s, f + TARGET, shape, s[f + LAND_PITCH]);
  const share = easedShare(u);
  const yaw = s[o + NOW + 2];
  const c = Math.cos(yaw);
  const n = Math.sin(yaw);
  const rise = spot[1] - s[f + LEAVE + 1];
  // Up early, down late: over the edge of a step or a stone.
  const v = climbed(rise, u, UP_BY);
  const over = 4 * u * u * (1 - u) * (1 - u) * Math.abs(rise);
  const bend = swing[4] + toeOff;
  const climb = s[f + TARGET + 1] - s[f + PLACE + 1];
  const ground = s[f + PLACE + 1] + easedShare(climbed(climb, u, OVER_BY)) * climb;
  const up = s[f + LEAVE + 1] + easedShare(v) * rise + over + swing[1];
  // Blends and other feet's pitches must not push heel or toes through the ground.
  const low = ground + CLEAR * 4 * u * (1 - u) - up - lowest(shape, pitch, bend);
  s[f + ANKLE] = s[f + LEAVE] + share * (spot[0] - s[f + LEAVE]) + c * swing[0] + n * swing[2];
  const soft = 4 * u * (1 - u) * Math.min(MOST_SOFT, SOFT * Math.abs(climb));
  s[f + ANKLE + 1] = up + 0.5 * (low + Math.sqrt(low * low + soft * soft));
  s[f + ANKLE + 2] = s[f + LEAVE + 2] + share * (spot[2] - s[f + LEAVE + 2]) - n * swing[0] + c * swing[2];
  s[f + PITCH] = pitch;
  const turn = wrapAngle(s[f + TARGET + 3] - s[f + PLACE + 3]);
  rotateFoot(
    s,
    f,
    s[f + PLACE + 3] + share * turn,
    pitch,
    s[f + PLACE + 4] + share * (s[f + TARGET + 4] - s[f + PLACE + 4]),
    s[f + PLACE + 5] + share * (s[f + TARGET + 5] - s[f + PLACE + 5]),
  );
  s[f + ANKLE + 7] = bend;
}

/** Share of a climb that is made at share u of a swing: up by share `by`, down from the same before the end. */
const climbed = (rise: number, u: number, by: number): number =>
  rise > 0 ? Math.min(1, u / by) : Math.max(0, (u - 1 + by) / by);

/** Ankles bend up no farther than about this over a planted foot; beyond, the heel rises. Softness; radians. */
const MOST_BEND = 0.66;
const BEND_SOFT = 0.04;

/**
 * Lets the heel of a planted foot rise where the shank leans farther than the ankle bends.
 *
 * @param bend the ankle's bend, toe towards shin positive, as the leg is closed now.
 * @returns whether the ankle wanted has changed: the leg is then closed again.
 */
export function easeAnkle(b: Batch, i: number, side: number, bend: number): boolean {
  const over = (bend - MOST_BEND) / BEND_SOFT;
  if (over < -3) return false;
  const s = b.state;
  const f = STATE * i + FOOT + FOOT_STATE * side;
  const pitch = s[f + PITCH] - BEND_SOFT * Math.log1p(Math.exp(Math.min(over, 20)));
  s[f + PITCH] = Math.max(-1.3, pitch);
  plant(b, f);
  return true;
}

/** Likewise of a foot in the air: it gives way itself. */
const MOST_BEND_IN_AIR = 0.72;

/**
 * Lets a foot in the air hang where the ankle would bend beyond its range.
 *
 * @param bend as in `easeAnkle`. @returns whether the foot wanted has changed: the leg is then closed again.
 */
export function easeAirborne(b: Batch, i: number, side: number, bend: number): boolean {
  const over = (bend - MOST_BEND_IN_AIR) / BEND_SOFT;
  if (over < -3) return false;
  const half = (BEND_SOFT * Math.log1p(Math.exp(Math.min(over, 20)))) / 2;
  const q = STATE * i + FOOT + FOOT_STATE * side + ANKLE + 3;
  const s = b.state;
  const x = s[q];
  const y = s[q + 1];
  const z = s[q + 2];
  const w = s[q + 3];
  const sin = Math.sin(half);
  const cos = Math.cos(half);
  s[q] = x * cos + w * sin;
  s[q + 1] = y * cos + z * sin;
  s[q + 2] = z * cos - y * sin;
  s[q + 3] = w * cos - x * sin;
  return true;
}

/** The ankle wanted of a planted foot at its pitch. */
function plant(b: Batch, f: number): void {
  const s = b.state;
  ankleOver(s, f + PLACE, b.library.skeleton.foot, s[f + PITCH]);
  s[f + ANKLE] = spot[0];
  s[f + ANKLE + 1] = spot[1];
  s[f + ANKLE + 2] = spot[2];
  rotateFoot(s, f, s[f + PLACE + 3], s[f + PITCH], s[f + PLACE + 4], s[f + PLACE + 5]);
  s[f + ANKLE + 7] = planted[2];
}

/** Height of the sole's lowest point (heel, ball, tip) over the ankle, negative. */
function lowest(shape: FootShape, pitch: number, bend: number): number {
  const c = Math.cos(pitch);
  const n = Math.sin(pitch);
  const heel = -shape.ankleHeight * c - shape.heelBack * n;
  const joint = shape.ballForward * n - (shape.ankleHeight - shape.ballHeight) * c;
  const ct = Math.cos(pitch + bend);
  const ball = joint - shape.ballHeight * ct;
  const tip = ball + shape.tipForward * Math.sin(pitch + bend);
  return Math.min(heel, ball, tip);
}

/** Foot rotation xyzw into the block: yaw, then pitch (toe up positive), tilted from up to the ground's normal. */
function rotateFoot(s: Float64Array, f: number, yaw: number, pitch: number, nx: number, nz: number): void {
  const cy = Math.cos(yaw / 2);
  const sy = Math.sin(yaw / 2);
  const cx = Math.cos(pitch / 2);
  const sx = -Math.sin(pitch / 2);
  const x = cy * sx;
  const y = sy * cx;
  const z = -sy * sx;
  const w = cy * cx;
  const q = f + ANKLE + 3;
  if (nx === 0 && nz === 0) {
    s[q] = x;
    s[q + 1] = y;
    s[q + 2] = z;
    s[q + 3] = w;
    return;
  }
  const ny = Math.sqrt(Math.max(0.01, 1 - nx * nx - nz * nz));
  const l = 1 / Math.sqrt(2 + 2 * ny);
  const tx = nz * l;
  const tz = -nx * l;
  const tw = (1 + ny) * l;
  s[q] = tw * x + tx * w - tz * y;
  s[q + 1] = tw * y - tx * z + tz * x;
  s[q + 2] = tw * z + tx * y + tz * w;
  s[q + 3] = tw * w - tx * x - tz * z;
}
