/**
 * The pads of a file's feet: heel pad under and behind the ankle, toe pad from ball to tip, as places fixed to the file's own
 * foot and toes joints.
 *
 * No capture says where its soles are. The sole is the plane of the ground in the frames where the foot lies flat and stillest;
 * lengths that the file lacks follow the ankle-to-ball distance (foot proportions, about those of the project's own foot).
 */
import { quatConjugate, quatRotate } from "../math/quaternion.ts";

/** Points of a foot in a row of `PadTrack.points`, three numbers each: two ground axes and the height. */
export const PAD_ROW = 18;
export const PAD = { ankle: 0, heelNear: 3, heelFar: 6, ball: 9, tip: 12, joint: 15 } as const;

export interface PadTrack {
  frames: number;
  /** frames x PAD_ROW, metres. */
  points: Float64Array;
  /** Height of the ground under the foot when it lies flat, metres. */
  ground: number;
}

/** World kinematics of a file: rotations xyzw and places in metres, frames x joints. */
export interface FileMotion {
  frames: number;
  joints: number;
  rate: number;
  q: Float64Array;
  p: Float64Array;
  /** Indices of the two ground axes and of the height in a place, turning the same way: z, x, y or x, y, z. */
  axes: readonly [number, number, number];
}

/** A foot's joints; the toes' joint is -1 where the file has none. */
export interface FootJoints {
  foot: number;
  toes: number;
  /** Length of the toes' end site or child, metres; 0 for none. */
  toeEnd: number;
}

/** Heel pad: from under the ankle to this share of the ankle-to-ball distance behind it. */
const HEEL_BACK = 0.45;
/** Toe tip in front of the ball where the file has no end, as a share of the same. */
const TIP_FORWARD = 0.5;
/** A shoe is a little longer than its toes. */
const SHOE = 1.15;
/** Heights of planted toe joints over a floor at 0 that can be believed, and the usual one, at a leg of 0.93 m. */
const BALL_LEAST = 0.008;
const BALL_MOST = 0.0595;
const BALL_USUAL = 0.0247;
const ANKLE_USUAL = 0.09;
/** Resting heights of left and right that differ by more than this are no matter of shape, at a leg of 0.93 m. */
const UNALIKE = 0.009;
/** Ankle to ball where there are no toes: of the leg. */
const BASE = 0.135;

/** A foot's sole in the axes of its own joints: where its pads are, whatever the foot does. */
export interface Sole {
  /** Up and forward of the flat foot in the axes of the foot's joint and of the toes' (the foot's again where there are none). */
  upFoot: Float64Array;
  aheadFoot: Float64Array;
  upToes: Float64Array;
  aheadToes: Float64Array;
  /** Heights of ankle and ball over the sole, and lengths from ankle to ball and from ball to tip, metres. */
  ankle: number;
  ball: number;
  length: number;
  tip: number;
  /** Height of the ground under it when it lies flat, metres. */
  ground: number;
}

/**
 * Soles of both feet.
 *
 * @param bits contact bits of a file frame and side: 1 heel, 2 toe.
 * @param leg leg length, metres.
 * @param forward a place ahead of the ankle for skeletons without toes: the imported clip's tip.
 */
export function solesOf(
  motion: FileMotion,
  feet: readonly FootJoints[],
  bits: (f: number, side: number) => number,
  leg: number,
  forward: (f: number, side: number) => readonly [number, number],
): Sole[] {
  const flats = feet.map((foot, side) => flatFrames(motion, foot, side, bits));
  const s = leg / 0.93;
  const [, , up] = motion.axes;
  const heights = feet.map((foot, side) =>
    median(flats[side].map((f) => height(motion, foot.toes < 0 ? foot.foot : foot.toes, f, up))),
  );
  // Feet of one body are alike: when one rests much higher, the figure drifts up and down, and the truth is between.
  if (Math.abs(heights[0] - heights[1]) > UNALIKE * s) heights.fill((heights[0] + heights[1]) / 2);
  const toed = feet.every((f) => f.toes >= 0);
  const usual = (toed ? BALL_USUAL : ANKLE_USUAL) * s;
  const least = (toed ? BALL_LEAST : 0.05) * s;
  const most = (toed ? BALL_MOST : 0.14) * s;
  const atZero = heights.every((h) => h >= least && h <= most);
  const ground = atZero ? 0 : Math.min(...heights) - usual;
  return feet.map((foot, side) =>
    soleOf(motion, foot, flats[side], heights[side] - ground, ground, leg, (f) => forward(f, side)),
  );
}

const height = (m: FileMotion, joint: number, f: number, up: number): number =>
  m.p[3 * (f * m.joints + joint) + up];

function median(values: number[]): number {
  const sorted = [...values].sort((a, b) => a - b);
  const n = sorted.length;
  return n === 0 ? 0 : (sorted[(n - 1) >> 1] + sorted[n >> 1]) / 2;
}

/** The stiller half of the frames in which heel and toe bear; what bears at all, or moves least, where there are none. */
function flatFrames(
  m: FileMotion,
  foot: FootJoints,
  side: number,
  bits: (f: number, side: number) => number,
): number[] {
  const speed = Float64Array.from({ length: m.frames }, (_, f) => {
    const a = 3 * (Math.max(0, f - 1) * m.joints);
    const b = 3 * (Math.min(m.frames - 1, f + 1) * m.joints);
    return Math.max(
      ...[foot.foot, foot.toes].map((j) =>
        j < 0
          ? 0
          : Math.hypot(
              m.p[b + 3 * j] - m.p[a + 3 * j],
              m.p[b + 3 * j + 1] - m.p[a + 3 * j + 1],
              m.p[b + 3 * j + 2] - m.p[a + 3 * j + 2],
            ),
      ),
    );
  });
  for (const wanted of [(b: number) => b === 3, (b: number) => b > 0, () => true]) {
    const found: number[] = [];
    for (let f = 0; f < m.frames; f++) if (wanted(bits(f, side))) found.push(f);
    if (found.length < 3 && m.frames > 3) continue;
    found.sort((a, b) => speed[a] - speed[b] || a - b);
    return found.slice(0, Math.max(1, Math.ceil(0.6 * found.length)));
  }
  return [0];
}

function soleOf(
  m: FileMotion,
  foot: FootJoints,
  flat: number[],
  rest: number,
  ground: number,
  leg: number,
  forward: (f: number) => readonly [number, number],
): Sole {
  const [ga, gb, up] = m.axes;
  const toes = foot.toes >= 0 ? foot.toes : foot.foot;
  const v = new Float64Array(3);
  const inverse = new Float64Array(4);
  // Up and forward of the flat foot in the joints' own axes.
  const mean = (joint: number, direction: (f: number) => readonly [number, number, number]): Float64Array => {
    const out = new Float64Array(3);
    for (const f of flat) {
      quatConjugate(inverse, 0, m.q, 4 * (f * m.joints + joint));
      const d = direction(f);
      quatRotate(v, 0, inverse, 0, d[0], d[1], d[2]);
      for (let k = 0; k < 3; k++) out[k] += v[k];
    }
    return unit(out);
  };
  const upward = [0, 0, 0] as [number, number, number];
  upward[up] = 1;
  const ahead = (f: number): readonly [number, number, number] => {
    const d = [0, 0, 0] as [number, number, number];
    if (foot.toes >= 0) {
      const a = 3 * (f * m.joints + foot.foot);
      const t = 3 * (f * m.joints + foot.toes);
      d[ga] = m.p[t + ga] - m.p[a + ga];
      d[gb] = m.p[t + gb] - m.p[a + gb];
    } else [d[ga], d[gb]] = forward(f);
    const l = Math.hypot(d[0], d[1], d[2]) || 1;
    return [d[0] / l, d[1] / l, d[2] / l];
  };
  const upFoot = mean(foot.foot, () => upward);
  const upToes = mean(toes, () => upward);
  const aheadFoot = upright(mean(foot.foot, ahead), upFoot);
  const aheadToes = upright(mean(toes, ahead), upToes);
  const rise = median(flat.map((f) => height(m, foot.foot, f, up) - height(m, toes, f, up)));
  const ankle = rest + rise;
  const length = foot.toes < 0 ? BASE * leg : median(flat.map((f) => gap(m, foot.foot, foot.toes, f)));
  const ball = foot.toes < 0 ? 0.2 * ankle : rest;
  const tip = SHOE * (foot.toeEnd > 0.1 * length ? foot.toeEnd : TIP_FORWARD * length);
  return { upFoot, aheadFoot, upToes, aheadToes, ankle, ball, length, tip, ground };
}

/** Where the pads of a foot are, frame by frame. */
export function padsOf(m: FileMotion, foot: FootJoints, sole: Sole): PadTrack {
  const { upFoot, aheadFoot, upToes, aheadToes, ankle, ball, length, tip, ground } = sole;
  const [ga, gb, up] = m.axes;
  const v = new Float64Array(3);
  const out: PadTrack = { frames: m.frames, points: new Float64Array(PAD_ROW * m.frames), ground };
  const put = (
    f: number,
    at: number,
    joint: number,
    u: Float64Array,
    a: Float64Array,
    rise: number,
    along: number,
  ): void => {
    const o = f * m.joints + joint;
    quatRotate(
      v,
      0,
      m.q,
      4 * o,
      u[0] * rise + a[0] * along,
      u[1] * rise + a[1] * along,
      u[2] * rise + a[2] * along,
    );
    const i = f * PAD_ROW + at;
    out.points[i] = m.p[3 * o + ga] + v[ga];
    out.points[i + 1] = m.p[3 * o + gb] + v[gb];
    out.points[i + 2] = m.p[3 * o + up] + v[up];
  };
  for (let f = 0; f < m.frames; f++) {
    put(f, PAD.ankle, foot.foot, upFoot, aheadFoot, 0, 0);
    put(f, PAD.heelNear, foot.foot, upFoot, aheadFoot, -ankle, 0);
    put(f, PAD.heelFar, foot.foot, upFoot, aheadFoot, -ankle, -HEEL_BACK * length);
    if (foot.toes >= 0) {
      put(f, PAD.joint, foot.toes, upToes, aheadToes, 0, 0);
      put(f, PAD.ball, foot.toes, upToes, aheadToes, -ball, 0);
      put(f, PAD.tip, foot.toes, upToes, aheadToes, -ball, tip);
    } else {
      put(f, PAD.joint, foot.foot, upFoot, aheadFoot, ball - ankle, length);
      put(f, PAD.ball, foot.foot, upFoot, aheadFoot, -ankle, length);
      put(f, PAD.tip, foot.foot, upFoot, aheadFoot, -ankle, length + tip);
    }
  }
  return out;
}

function unit(v: Float64Array): Float64Array {
  const l = Math.hypot(v[0], v[1], v[2]) || 1;
  return v.map((x) => x / l);
}

/** What of `v` is at right angles to `u`, of length 1. */
function upright(v: Float64Array, u: Float64Array): Float64Array {
  const d = v[0] * u[0] + v[1] * u[1] + v[2] * u[2];
  return unit(v.map((x, k) => x - d * u[k]));
}

function gap(m: FileMotion, a: number, b: number, f: number): number {
  const i = 3 * (f * m.joints + a);
  const j = 3 * (f * m.joints + b);
  return Math.hypot(m.p[i] - m.p[j], m.p[i + 1] - m.p[j + 1], m.p[i + 2] - m.p[j + 2]);
}
