/**
 * Clips baked for blending: every animation step as rows at even phases, in flat arrays that a batch reads without
 * allocation [Barycentric §4.1].
 *
 * A step's index is 2 x clip + (0 left, 1 right). Its body rows run from its lift (u = 0) over its landing (u = 1) and on, so
 * that walks and runs, which lift the other foot after or before it, are in step at the landing: local rotations (the
 * hips' seen from the root's frame) and the hips' place in that frame. Its swing rows run over s = 0..1 from lift
 * to landing: what the ankle does beside the eased straight way between its planted places. Its stance rows run over the time the foot stays down:
 * its pitch while it settles, and while it leaves. All is scaled to the character's leg.
 */
import { wrapAngle } from "../math/angle.ts";
import { midPose, toLocal } from "../math/frame2.ts";
import { quatFromAxisAngle, quatMultiply } from "../math/quaternion.ts";
import { pitchOf, toeBendOf } from "../motion/foot-pose.ts";
import { plantedAnkle } from "../motion/sole.ts";
import { forwardKinematics } from "../skeleton/forward-kinematics.ts";
import { J, JOINT_COUNT } from "../skeleton/joints.ts";
import type { Skeleton } from "../skeleton/skeleton.ts";
import { analyseClip, type Cycle, landFrame, liftFrame, rootFrame } from "./analyse.ts";
import { createFootSpace, type FootSpace } from "./foot-space.ts";
import { createRootSpace, type RootSpace } from "./polar-bands.ts";
import type { ClipAnalysis, CyclicSource } from "./types.ts";

/** Rotations, then the hips' place x, y, z; one number left over. */
export const BODY_ROW = 4 * JOINT_COUNT + 4;
export const HIPS_AT = 4 * JOINT_COUNT;
/** Phases that a step's rows reach over, 0 at its lift and 1 at its landing, and how many rows. */
export const BODY_SPAN = 1.75;
export const BODY_ROWS = 43;
/** Phase at which the other foot lands in clips that fly. */
export const FLIGHT = 0.2;
/** Lateral, up, forward beside the eased way (root's frame), foot pitch (toe up), toe bend. */
export const SWING_ROW = 5;
export const SWING_ROWS = 25;
/** Pitch while settling, pitch while leaving. */
export const STANCE_ROW = 2;
export const STANCE_ROWS = 25;
/**
 * Landing x, z, yaw; displacement to landing x, z, yaw; to the next lift x, z, yaw; seconds of swing, duration, stance; the
 * landed foot seen from the root at the next lift x, z.
 */
export const MOVE_ROW = 14;

export interface BlendLibrary {
  skeleton: Skeleton;
  names: string[];
  analyses: ClipAnalysis[];
  /** Omega_left and Omega_right. */
  feet: [FootSpace, FootSpace];
  root: RootSpace;
  body: Float32Array;
  swing: Float32Array;
  stance: Float32Array;
  moves: Float64Array;
  /** Mean root velocity of each clip: lateral, forward, turn. */
  velocities: Float64Array;
  /** Standing at ease: a body row seen from the middle of the feet. */
  stand: Float32Array;
  /** Left foot's place beside the middle when standing, and its toe-out. */
  standFoot: { x: number; z: number; yaw: number };
}

/** Share of the way at s: eased at both ends. */
export const easedShare = (s: number): number => s * s * (3 - 2 * s);

/** A foot flatter than this lies flat, radians. */
const FLAT = (1.2 * Math.PI) / 180;

/**
 * Analyses and bakes clips for a character.
 *
 * @param sources cyclic clips; the first one begins standing.
 * @throws CycleError, RangeError naming the clip or what is missing.
 */
export function bakeLibrary(sources: readonly CyclicSource[], skeleton: Skeleton): BlendLibrary {
  const cycles = sources.map(analyseClip);
  const n = sources.length;
  const library: BlendLibrary = {
    skeleton,
    names: sources.map((s) => s.name),
    analyses: [],
    feet: [createFootSpaceOf(sources, cycles, skeleton, 0), createFootSpaceOf(sources, cycles, skeleton, 1)],
    root: createRootSpace([]),
    body: new Float32Array(2 * n * BODY_ROWS * BODY_ROW),
    swing: new Float32Array(2 * n * SWING_ROWS * SWING_ROW),
    stance: new Float32Array(2 * n * STANCE_ROWS * STANCE_ROW),
    moves: new Float64Array(2 * n * MOVE_ROW),
    velocities: new Float64Array(3 * n),
    stand: new Float32Array(BODY_ROW),
    standFoot: { x: 0, z: 0, yaw: 0 },
  };
  sources.forEach((source, c) => {
    const scale = skeleton.legLength / source.clip.skeleton.legLength;
    const time = Math.sqrt(scale);
    const cycle = cycles[c];
    const a = cycle.analysis;
    const velocity = {
      x: (a.velocity.x * scale) / time,
      z: (a.velocity.z * scale) / time,
      yaw: a.velocity.yaw / time,
    };
    library.velocities.set([velocity.x, velocity.z, velocity.yaw], 3 * c);
    library.analyses.push({ ...a, velocity });
    for (let side = 0; side < 2; side++) {
      const s = a.steps[side];
      const ended = toLocal(s.whole, s.landing);
      library.moves.set(
        [
          s.landing.x * scale,
          s.landing.z * scale,
          s.landing.yaw,
          s.displacement.x * scale,
          s.displacement.z * scale,
          s.displacement.yaw,
          s.whole.x * scale,
          s.whole.z * scale,
          s.whole.yaw,
          s.swing * time,
          s.duration * time,
          s.stance * time,
          ended.x * scale,
          ended.z * scale,
        ],
        MOVE_ROW * (2 * c + side),
      );
      bakeBody(library, source, cycle, 2 * c + side, scale);
      bakeFoot(library, source, cycle, 2 * c + side, scale);
    }
  });
  library.root = createRootSpace(
    sources.map((_, c) => ({
      x: library.velocities[3 * c],
      z: library.velocities[3 * c + 1],
      yaw: library.velocities[3 * c + 2],
    })),
  );
  bakeStand(library, sources[0]);
  alignHemispheres(library);
  return library;
}

function createFootSpaceOf(
  sources: readonly CyclicSource[],
  cycles: readonly Cycle[],
  skeleton: Skeleton,
  side: number,
): FootSpace {
  const points = new Float64Array(2 * sources.length);
  sources.forEach((s, c) => {
    const scale = skeleton.legLength / s.clip.skeleton.legLength;
    const p = cycles[c].analysis.steps[side].landing;
    points[2 * c] = p.x * scale;
    points[2 * c + 1] = p.z * scale;
  });
  return createFootSpace(points);
}

/** Index in the source's steps of the cycle's step of a side. */
function stepOf(source: CyclicSource, cycle: Cycle, side: number): number {
  return (source.steps[cycle.first].foot === "left") === (side === 0) ? cycle.first : cycle.first + 1;
}

/** Local rotations and hips' place at a frame between two, the hips seen from the root's frame there. */
function readBody(out: Float64Array, source: CyclicSource, cycle: Cycle, at: number, scale: number): void {
  const { clip } = source;
  const f = Math.max(0, Math.min(clip.frames - 2, Math.floor(at)));
  const u = Math.max(0, Math.min(1, at - f));
  const q = 4 * JOINT_COUNT;
  for (let k = 0; k < q; k++)
    out[k] = clip.rotations[q * f + k] * (1 - u) + clip.rotations[q * (f + 1) + k] * u;
  for (let j = 0; j < JOINT_COUNT; j++) {
    const o = 4 * j;
    const n = 1 / Math.sqrt(out[o] ** 2 + out[o + 1] ** 2 + out[o + 2] ** 2 + out[o + 3] ** 2);
    for (let k = 0; k < 4; k++) out[o + k] *= n;
  }
  const hips = [0, 1, 2].map((k) => clip.root[3 * f + k] * (1 - u) + clip.root[3 * (f + 1) + k] * u);
  const frame = rootFrame(cycle.root, (at - cycle.analysis.frames.first) / clip.rate);
  const p = toLocal(frame, { x: hips[0], z: hips[2], yaw: 0 });
  out[HIPS_AT] = p.x * scale;
  out[HIPS_AT + 1] = hips[1] * scale;
  out[HIPS_AT + 2] = p.z * scale;
  const turn = new Float64Array(4);
  quatFromAxisAngle(turn, 0, 0, 1, 0, -frame.yaw);
  quatMultiply(out, 0, turn, 0, out, 0);
}

function bakeBody(
  library: BlendLibrary,
  source: CyclicSource,
  cycle: Cycle,
  step: number,
  scale: number,
): void {
  const i = stepOf(source, cycle, step % 2);
  const lift = liftFrame(source.steps[i]);
  const swing = landFrame(source.steps[i]) - lift;
  const other = landFrame(source.steps[i - 1]) - lift;
  // Frames after the lift at a phase: in step at the other foot's landing, where that comes later, and at this one's.
  const frameAt = (u: number): number => {
    if (other <= 1 || u >= 1) return swing * u;
    return u < FLIGHT ? (other * u) / FLIGHT : other + ((swing - other) * (u - FLIGHT)) / (1 - FLIGHT);
  };
  const row = new Float64Array(BODY_ROW);
  for (let r = 0; r < BODY_ROWS; r++) {
    readBody(row, source, cycle, lift + frameAt((BODY_SPAN * r) / (BODY_ROWS - 1)), scale);
    library.body.set(row, (step * BODY_ROWS + r) * BODY_ROW);
  }
}

interface FootFrame {
  x: number;
  y: number;
  z: number;
  pitch: number;
  toe: number;
}

/** Ankle place, pitch and toe bend of a foot at every frame of a range. */
function footFrames(source: CyclicSource, side: number, from: number, to: number): FootFrame[] {
  const { clip } = source;
  const joint = side === 0 ? J.leftFoot : J.rightFoot;
  const p = new Float64Array(3 * JOINT_COUNT);
  const w = new Float64Array(4 * JOINT_COUNT);
  const out: FootFrame[] = [];
  for (let f = from; f <= to; f++) {
    forwardKinematics(p, w, clip.skeleton, clip.root, 3 * f, clip.rotations, 4 * JOINT_COUNT * f);
    out.push({
      x: p[3 * joint],
      y: p[3 * joint + 1],
      z: p[3 * joint + 2],
      pitch: pitchOf(w, 4 * joint),
      toe: toeBendOf(clip.rotations, 4 * (JOINT_COUNT * f + joint + 1)),
    });
  }
  return out;
}

const between = (list: readonly FootFrame[], at: number, key: keyof FootFrame): number => {
  const i = Math.max(0, Math.min(list.length - 2, Math.floor(at)));
  return list[i][key] + (at - i) * (list[i + 1][key] - list[i][key]);
};

function bakeFoot(
  library: BlendLibrary,
  source: CyclicSource,
  cycle: Cycle,
  step: number,
  scale: number,
): void {
  const { clip, steps } = source;
  const side = step % 2;
  const i = stepOf(source, cycle, side);
  const own = steps[i];
  const lift = liftFrame(own);
  const land = landFrame(own);
  const shape = clip.skeleton.foot;
  // The stance after the landing, or the one before the lift where the clip ends too soon.
  const next = steps.findIndex((s, k) => k > i && s.foot === own.foot);
  const before = steps.findLastIndex((s, k) => k < i && s.foot === own.foot);
  const from = next >= 0 ? land : before >= 0 ? landFrame(steps[before]) : lift;
  const to = next >= 0 ? liftFrame(steps[next]) : lift;
  const settled = bakeStance(library, footFrames(source, side, from, Math.max(from + 1, to)), step);
  const air = footFrames(source, side, lift, land);
  const last = air.length - 1;
  const planted = new Float64Array(3);
  const ends = [own.from, own.to].map((place, k) => {
    plantedAnkle(planted, shape, Math.max(-1.4, Math.min(0.7, air[k * last].pitch)));
    return {
      x: place.x + Math.sin(place.yaw) * planted[0],
      y: planted[1],
      z: place.z + Math.cos(place.yaw) * planted[0],
    };
  });
  const beside = (at: number, share: number) => ({
    x: between(air, at, "x") - (ends[0].x + share * (ends[1].x - ends[0].x)),
    y: between(air, at, "y") - (ends[0].y + share * (ends[1].y - ends[0].y)),
    z: between(air, at, "z") - (ends[0].z + share * (ends[1].z - ends[0].z)),
  });
  const first = beside(0, 0);
  const end = beside(last, 1);
  const rate = clip.rate;
  const begin = cycle.analysis.frames.first;
  for (let r = 0; r < SWING_ROWS; r++) {
    const s = r / (SWING_ROWS - 1);
    const d = beside(s * last, easedShare(s));
    const yaw = rootFrame(cycle.root, (lift - begin + s * last) / rate).yaw;
    // What detection left of the ends is spread over the swing, so that it leaves and lands exactly.
    const local = toLocal(
      { x: 0, z: 0, yaw },
      { x: d.x - (1 - s) * first.x - s * end.x, z: d.z - (1 - s) * first.z - s * end.z, yaw: 0 },
    );
    library.swing.set(
      [
        local.x * scale,
        (d.y - (1 - s) * first.y - s * end.y) * scale,
        local.z * scale,
        between(air, s * last, "pitch") + s * (settled - air[last].pitch),
        between(air, s * last, "toe"),
      ],
      (step * SWING_ROWS + r) * SWING_ROW,
    );
  }
}

/** Pitches of a stance, split where the foot lies flattest. @returns the pitch it begins with. */
function bakeStance(library: BlendLibrary, down: readonly FootFrame[], step: number): number {
  const n = down.length - 1;
  const pitch = (s: number) => {
    const v = between(down, s * n, "pitch");
    return Math.sign(v) * Math.max(0, Math.abs(v) - FLAT * Math.min(1, 4 * s, 4 * (1 - s)));
  };
  let flattest = 0.3;
  let least = Number.POSITIVE_INFINITY;
  for (let s = 0.15; s <= 0.7; s += 0.01) {
    const v = Math.abs(between(down, s * n, "pitch")) + 0.02 * Math.abs(s - 0.35);
    if (v < least) {
      least = v;
      flattest = s;
    }
  }
  for (let r = 0; r < STANCE_ROWS; r++) {
    const s = r / (STANCE_ROWS - 1);
    // Nothing is left of either part at the split.
    const fade = Math.min(1, Math.abs(s - flattest) / 0.08);
    library.stance.set(
      s < flattest ? [pitch(s) * fade, 0] : [0, pitch(s) * fade],
      (step * STANCE_ROWS + r) * STANCE_ROW,
    );
  }
  return pitch(0);
}

/** The pose before the first step, seen from the middle of the feet. */
function bakeStand(library: BlendLibrary, source: CyclicSource): void {
  const { clip, steps } = source;
  const scale = library.skeleton.legLength / clip.skeleton.legLength;
  const left = steps.find((s) => s.foot === "left");
  const right = steps.find((s) => s.foot === "right");
  if (!left || !right) return;
  const middle = midPose(left.from, right.from);
  const foot = toLocal(middle, left.from);
  library.standFoot = { x: foot.x * scale, z: foot.z * scale, yaw: wrapAngle(foot.yaw) };
  const q = 4 * JOINT_COUNT;
  const row = new Float64Array(BODY_ROW);
  row.set(clip.rotations.subarray(0, q));
  const turn = new Float64Array(4);
  quatFromAxisAngle(turn, 0, 0, 1, 0, -middle.yaw);
  quatMultiply(row, 0, turn, 0, row, 0);
  const hips = toLocal(middle, { x: clip.root[0], z: clip.root[2], yaw: 0 });
  row.set([hips.x * scale, clip.root[1] * scale, hips.z * scale], HIPS_AT);
  library.stand.set(row);
}

/** Every rotation in the hemisphere of the standing pose, so that weighted sums mean something. */
function alignHemispheres(library: BlendLibrary): void {
  const { body, stand } = library;
  for (let o = 0; o < body.length; o += BODY_ROW) {
    for (let j = 0; j < JOINT_COUNT; j++) {
      let d = 0;
      for (let k = 0; k < 4; k++) d += body[o + 4 * j + k] * stand[4 * j + k];
      if (d < 0) for (let k = 0; k < 4; k++) body[o + 4 * j + k] *= -1;
    }
  }
}
