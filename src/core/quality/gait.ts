/**
 * Gait analysis of a motion with contacts: sagittal curves of hip, knee and ankle over the cycle, and the facts that
 * gait laboratories report [Perry, Gait Analysis; Winter, Biomechanics and Motor Control].
 *
 * A cycle runs from one first contact of a foot (heel or toe) to its next. Angles lie in the vertical plane of the
 * cycle's travel: hip = thigh against the vertical, forward positive; knee = thigh against shank, flexion positive;
 * ankle = shank against foot, 0 with the shank upright over a flat foot, dorsiflexion positive. Left and right cycles
 * are pooled.
 */
import type { Clip } from "../capture/clip.ts";
import { forwardKinematics } from "../skeleton/forward-kinematics.ts";
import { J, JOINT_COUNT } from "../skeleton/joints.ts";
import type { ContactTrack } from "../steps/types.ts";

/** Phases at which a curve is read: 0 to 100 % of the cycle. */
export const GAIT_PHASES = 101;

export interface GaitCurve {
  /** Degrees, GAIT_PHASES. */
  mean: Float64Array;
  sd: Float64Array;
}

export interface GaitFacts {
  /** Seconds from a foot's first contact to its next. */
  cycle: number;
  /** Metres a second. */
  speed: number;
  /** Steps a minute. */
  cadence: number;
  /** Metres: a foot's travel in a cycle; one step's; across the way. */
  stride: number;
  stepLength: number;
  stepWidth: number;
  /** Shares of the cycle. */
  stance: number;
  doubleSupport: number;
  flight: number;
  /** Share of the cycle at which the whole foot is down, and at which the heel leaves. */
  toeOn: number;
  heelOff: number;
  /** Hips, metres. */
  pelvisHeight: number;
  pelvisVertical: number;
  pelvisLateral: number;
  /** Toe joint's highest place over its rest, and the tip's lowest place in mid-swing, metres. */
  toeLift: number;
  tipClearance: number;
  /** Foot's yaw against the way, outwards, degrees. */
  toeOut: number;
  /** Lean of the line from the hips to the neck, forwards, degrees. */
  trunkLean: number;
  /** Forward swing of the upper arm from its hindmost to its foremost, and the elbow's range, degrees. */
  armRange: number;
  elbowRange: number;
}

export interface GaitAnalysis {
  cycles: number;
  hip: GaitCurve;
  knee: GaitCurve;
  ankle: GaitCurve;
  facts: GaitFacts;
}

interface Cycle {
  side: 0 | 1;
  from: number;
  to: number;
}

const DEG = 180 / Math.PI;

/**
 * Measures the steady cycles of a motion: those whose travel bends less than 15 degrees and whose speed is within 30 %
 * of the median's.
 *
 * @returns null when there is no such cycle.
 */
export function measureGait(clip: Clip, contacts: ContactTrack): GaitAnalysis | null {
  const all = placesOf(clip);
  const cycles = steadyCycles(clip, contacts);
  if (cycles.length === 0) return null;
  const tracks: Float64Array[][] = [[], [], []];
  const sums = new Map<keyof GaitFacts, number>();
  for (const c of cycles) {
    const curves = sagittal(clip, all, c);
    curves.forEach((curve, k) => {
      tracks[k].push(curve);
    });
    const facts = factsOf(clip, all, contacts, c);
    for (const key of Object.keys(facts) as (keyof GaitFacts)[])
      sums.set(key, (sums.get(key) ?? 0) + facts[key] / cycles.length);
  }
  const [hip, knee, ankle] = tracks.map(average);
  return { cycles: cycles.length, hip, knee, ankle, facts: Object.fromEntries(sums) as unknown as GaitFacts };
}

/** Joint places and the forward axes of both feet: frames x (JOINT_COUNT x 3 + 6). */
interface Places {
  joints: Float64Array;
  /** frames x 2 x 3: toe tips. */
  tips: Float64Array;
}

function placesOf(clip: Clip): Places {
  const joints = new Float64Array(3 * JOINT_COUNT * clip.frames);
  const tips = new Float64Array(6 * clip.frames);
  const p = new Float64Array(3 * JOINT_COUNT);
  const q = new Float64Array(4 * JOINT_COUNT);
  const { foot } = clip.skeleton;
  for (let f = 0; f < clip.frames; f++) {
    forwardKinematics(p, q, clip.skeleton, clip.root, 3 * f, clip.rotations, 4 * JOINT_COUNT * f);
    joints.set(p, 3 * JOINT_COUNT * f);
    for (let side = 0; side < 2; side++) {
      const toe = side === 0 ? J.leftToes : J.rightToes;
      const [x, y, z, w] = q.subarray(4 * toe, 4 * toe + 4);
      // The tip in the toe's frame: forward and down to the sole.
      const v = [0, -foot.ballHeight, foot.tipForward];
      const t = [2 * (y * v[2] - z * v[1]), 2 * (z * v[0] - x * v[2]), 2 * (x * v[1] - y * v[0])];
      tips[6 * f + 3 * side] = p[3 * toe] + v[0] + w * t[0] + y * t[2] - z * t[1];
      tips[6 * f + 3 * side + 1] = p[3 * toe + 1] + v[1] + w * t[1] + z * t[0] - x * t[2];
      tips[6 * f + 3 * side + 2] = p[3 * toe + 2] + v[2] + w * t[2] + x * t[1] - y * t[0];
    }
  }
  return { joints, tips };
}

/** First contacts of a foot that was in the air. */
function strikes(contacts: ContactTrack, side: 0 | 1): number[] {
  const bits = side === 0 ? 3 : 12;
  const out: number[] = [];
  for (let f = 1; f < contacts.length; f++)
    if ((contacts[f] & bits) !== 0 && (contacts[f - 1] & bits) === 0) out.push(f);
  return out;
}

function steadyCycles(clip: Clip, contacts: ContactTrack): Cycle[] {
  const found: (Cycle & { speed: number; bend: number })[] = [];
  for (const side of [0, 1] as const) {
    const at = strikes(contacts, side);
    for (let k = 0; k + 1 < at.length; k++) {
      const [from, to] = [at[k], at[k + 1]];
      const half = (from + to) >> 1;
      const way = (a: number, b: number) => [
        clip.root[3 * b] - clip.root[3 * a],
        clip.root[3 * b + 2] - clip.root[3 * a + 2],
      ];
      const [x, z] = way(from, to);
      const [x0, z0] = way(from, half);
      const [x1, z1] = way(half, to);
      const bend = Math.abs(Math.atan2(x0 * z1 - x1 * z0, x0 * x1 + z0 * z1));
      found.push({ side, from, to, bend, speed: (Math.hypot(x, z) / (to - from)) * clip.rate });
    }
  }
  const speeds = found.map((c) => c.speed).sort((a, b) => a - b);
  const median = speeds[speeds.length >> 1] ?? 0;
  if (median < 0.2) return [];
  return found.filter((c) => c.bend < 15 / DEG && Math.abs(c.speed - median) < 0.3 * median);
}

/** Travel of a cycle as a unit vector x, z. */
function travel(clip: Clip, c: Cycle): [number, number] {
  const x = clip.root[3 * c.to] - clip.root[3 * c.from];
  const z = clip.root[3 * c.to + 2] - clip.root[3 * c.from + 2];
  const n = Math.hypot(x, z) || 1;
  return [x / n, z / n];
}

/** Hip, knee and ankle over one cycle, degrees. */
function sagittal(clip: Clip, places: Places, c: Cycle): Float64Array[] {
  const [tx, tz] = travel(clip, c);
  const upper = c.side === 0 ? J.leftUpperLeg : J.rightUpperLeg;
  const out = [0, 1, 2].map(() => new Float64Array(GAIT_PHASES));
  const { foot } = clip.skeleton;
  // The ankle-to-ball line of a flat foot points down by this.
  const rest = Math.atan2(foot.ankleHeight - foot.ballHeight, foot.ballForward);
  const angles = (f: number): [number, number, number] => {
    const at = (j: number, k: number) => places.joints[3 * (JOINT_COUNT * f + j) + k];
    const line = (a: number, b: number): [number, number] => [
      (at(b, 0) - at(a, 0)) * tx + (at(b, 2) - at(a, 2)) * tz,
      at(b, 1) - at(a, 1),
    ];
    const [hx, hy] = line(upper, upper + 1);
    const [kx, ky] = line(upper + 1, upper + 2);
    const [fx, fy] = line(upper + 2, upper + 3);
    const thigh = Math.atan2(hx, -hy);
    const shank = Math.atan2(kx, -ky);
    const pitch = Math.atan2(fy, fx) + rest;
    return [thigh * DEG, (thigh - shank) * DEG, (pitch - shank) * DEG];
  };
  for (let k = 0; k < GAIT_PHASES; k++) {
    const x = c.from + ((c.to - c.from) * k) / (GAIT_PHASES - 1);
    const i = Math.min(clip.frames - 2, Math.floor(x));
    const a = angles(i);
    const b = angles(i + 1);
    for (let j = 0; j < 3; j++) {
      const turn = ((((b[j] - a[j]) % 360) + 540) % 360) - 180;
      out[j][k] = a[j] + (x - i) * turn;
    }
  }
  return out;
}

function factsOf(clip: Clip, places: Places, contacts: ContactTrack, c: Cycle): GaitFacts {
  const [tx, tz] = travel(clip, c);
  const own = c.side === 0 ? 3 : 12;
  const other = own ^ 15;
  const heel = c.side === 0 ? 1 : 4;
  const toe = heel << 1;
  const n = c.to - c.from;
  const at = (f: number, j: number, k: number) => places.joints[3 * (JOINT_COUNT * f + j) + k];
  let stance = 0;
  let both = 0;
  let none = 0;
  let toeOn = n;
  let heelOff = 0;
  let otherStrike = -1;
  for (let f = c.from; f < c.to; f++) {
    const o = (contacts[f] & own) !== 0;
    const p = (contacts[f] & other) !== 0;
    if (o) stance++;
    if (o && p) both++;
    if (!o && !p) none++;
    if ((contacts[f] & toe) !== 0) toeOn = Math.min(toeOn, f - c.from);
    if ((contacts[f] & heel) !== 0) heelOff = f - c.from + 1;
    if (p && f > c.from && (contacts[f - 1] & other) === 0) otherStrike = f;
  }
  const foot = c.side === 0 ? J.leftFoot : J.rightFoot;
  const opposite = c.side === 0 ? J.rightFoot : J.leftFoot;
  const toes = foot + 1;
  const along = (f: number, j: number) => at(f, j, 0) * tx + at(f, j, 2) * tz;
  // Character's left of the way is positive.
  const across = (f: number, j: number) => at(f, j, 0) * tz - at(f, j, 2) * tx;
  let low = Number.POSITIVE_INFINITY;
  let high = Number.NEGATIVE_INFINITY;
  let left = Number.POSITIVE_INFINITY;
  let right = Number.NEGATIVE_INFINITY;
  let height = 0;
  let lift = 0;
  let trunk = 0;
  let clearance = Number.POSITIVE_INFINITY;
  const arm = [Number.POSITIVE_INFINITY, Number.NEGATIVE_INFINITY];
  const elbow = [Number.POSITIVE_INFINITY, Number.NEGATIVE_INFINITY];
  const upper = c.side === 0 ? J.leftUpperArm : J.rightUpperArm;
  const drift = (across(c.to, J.hips) - across(c.from, J.hips)) / n;
  for (let f = c.from; f < c.to; f++) {
    const y = at(f, J.hips, 1);
    low = Math.min(low, y);
    high = Math.max(high, y);
    height += y / n;
    const s = across(f, J.hips) - drift * (f - c.from);
    left = Math.min(left, s);
    right = Math.max(right, s);
    lift = Math.max(lift, at(f, toes, 1) - clip.skeleton.foot.ballHeight);
    const u = (f - c.from - stance) / Math.max(1, n - stance);
    if (u > 0.25 && u < 0.8) clearance = Math.min(clearance, places.tips[6 * f + (c.side === 0 ? 0 : 3) + 1]);
    const lean = (a: number, b: number) => {
      const x = along(f, b) - along(f, a);
      return Math.atan2(x, at(f, a, 1) - at(f, b, 1));
    };
    trunk -= (lean(J.neck, J.hips) * DEG) / n;
    const swing = lean(upper, upper + 1) * DEG;
    arm[0] = Math.min(arm[0], swing);
    arm[1] = Math.max(arm[1], swing);
    const v = [0, 1, 2].map((k) => at(f, upper + 1, k) - at(f, upper, k));
    const w = [0, 1, 2].map((k) => at(f, upper + 2, k) - at(f, upper + 1, k));
    const cos = (v[0] * w[0] + v[1] * w[1] + v[2] * w[2]) / (Math.hypot(...v) * Math.hypot(...w) || 1);
    const bend = Math.acos(Math.max(-1, Math.min(1, cos))) * DEG;
    elbow[0] = Math.min(elbow[0], bend);
    elbow[1] = Math.max(elbow[1], bend);
  }
  const middle = c.from + Math.max(1, stance >> 1);
  const yaw = Math.atan2(
    at(middle, toes, 0) - at(middle, foot, 0),
    at(middle, toes, 2) - at(middle, foot, 2),
  );
  const course = Math.atan2(tx, tz);
  const out = Math.atan2(Math.sin(yaw - course), Math.cos(yaw - course)) * (c.side === 0 ? 1 : -1);
  const sign = c.side === 0 ? 1 : -1;
  const rested = otherStrike >= 0 ? Math.min(clip.frames - 1, otherStrike + Math.round(0.1 * n)) : -1;
  const stride = along(c.to, J.hips) - along(c.from, J.hips);
  const cycle = n / clip.rate;
  return {
    cycle,
    speed: stride / cycle,
    cadence: 120 / cycle,
    stride,
    stepLength: rested >= 0 ? along(rested, opposite) - along(middle, foot) : stride / 2,
    stepWidth: rested >= 0 ? sign * (across(middle, foot) - across(rested, opposite)) : 0,
    stance: stance / n,
    doubleSupport: both / n,
    flight: none / n,
    toeOn: toeOn / n,
    heelOff: heelOff / n,
    pelvisHeight: height,
    pelvisVertical: high - low,
    pelvisLateral: right - left,
    toeLift: lift,
    tipClearance: Number.isFinite(clearance) ? clearance : 0,
    toeOut: out * DEG,
    trunkLean: trunk,
    armRange: arm[1] - arm[0],
    elbowRange: elbow[1] - elbow[0],
  };
}

function average(rows: Float64Array[]): GaitCurve {
  const mean = new Float64Array(GAIT_PHASES);
  const sd = new Float64Array(GAIT_PHASES);
  for (let k = 0; k < GAIT_PHASES; k++) {
    for (const r of rows) mean[k] += r[k] / rows.length;
    for (const r of rows) sd[k] += (r[k] - mean[k]) ** 2 / Math.max(1, rows.length - 1);
    sd[k] = Math.sqrt(sd[k]);
  }
  return { mean, sd };
}
