/**
 * First pass of the synthesis [TaskLoco §6]: for every frame the root, the joints as the captures have them (joined
 * without a seam), and both feet exactly on the plan. The second pass closes the limbs.
 *
 * Runs forward in time: what is planned later never changes an earlier frame.
 */
import { CLIP_RATE } from "../capture/clip.ts";
import { wrapAngle } from "../math/angle.ts";
import type { GroundPose } from "../math/frame2.ts";
import { minimumJerk } from "../math/interpolate.ts";
import {
  quatConjugate,
  quatFromAxisAngle,
  quatFromRotationVector,
  quatMultiply,
  quatNormalize,
  quatToRotationVector,
} from "../math/quaternion.ts";
import { forwardKinematics } from "../skeleton/forward-kinematics.ts";
import { J, JOINT_COUNT } from "../skeleton/joints.ts";
import type { Skeleton } from "../skeleton/skeleton.ts";
import { FOOT_STRIDE, pitchOf, plantedFoot, toeBendOf } from "./foot-pose.ts";
import { mapPoint, mapTurn } from "./ground-map.ts";
import { createInertia, decay, type Inertia } from "./inertia.ts";
import { sampleClip } from "./sample.ts";
import { readTable, type SegmentSetup } from "./segment-setup.ts";
import { contactsOfPitch, pivotPlace } from "./sole.ts";

const Q = JOINT_COUNT * 4;
const DT = 1 / CLIP_RATE;
/** Time in which a join dies out: joints and root; feet's pitch. Seconds. */
const JOIN_TIME = 0.6;
const PITCH_TIME = 0.2;
/** The least of it, and the difference from which it takes the full time, radians. */
const QUICK_PITCH = 0.08;
const SETTLING = 0.2;
/** A foot's pitch in a plant, radians. */
const LEAST_PITCH = -1.25;
const MOST_PITCH = 0.6;
/** Seconds after landing in which a foot only comes down: neither its heel nor its toes may rise again. */
const LANDS = 0.1;
/** Source frames within which a capture's foot has come down after its landing. */
const COMES_DOWN = 20;
/** A planted foot this near to flat lies flat: captures' feet rest a degree off, and a footstep is where the foot is flat. Radians. */
const FLAT = (1.2 * Math.PI) / 180;
/** The same while it lands, radians, and for how long, seconds. */
const LANDING_FLAT = (3.2 * Math.PI) / 180;
const LANDING = 0.2;
/** Part of a pivot on the ball after which its heel comes down: a pivot is a footstep of its own, so the foot rests at its end. */
const SETTLE = 0.5;

export interface BodyTrack {
  frames: number;
  /** frames x 3. */
  root: Float64Array;
  /** frames x JOINT_COUNT x 4, local, before the limbs are closed. */
  rotations: Float64Array;
  /** frames x 2 x FOOT_STRIDE: left, right. */
  feet: Float64Array;
  contacts: Uint8Array;
  /** Index of the segment of each frame, and source frame shown. */
  segmentOf: Int32Array;
  sourceFrame: Float64Array;
  /** What balance added to the root, x, z a frame, metres. */
  shift: Float64Array;
  /** How far the hips were lowered for the legs to reach, metres a frame. */
  drop: Float64Array;
  /** How far heels were raised beyond their captures', left and right a frame, radians. */
  heels: Float64Array;
}

export function createBodyTrack(frames: number): BodyTrack {
  return {
    frames,
    root: new Float64Array(3 * frames),
    rotations: new Float64Array(Q * frames),
    feet: new Float64Array(2 * FOOT_STRIDE * frames),
    contacts: new Uint8Array(frames),
    segmentOf: new Int32Array(frames),
    sourceFrame: new Float64Array(frames),
    shift: new Float64Array(2 * frames),
    drop: new Float64Array(frames),
    heels: new Float64Array(2 * frames),
  };
}

interface Body {
  root: Float64Array;
  rotations: Float64Array;
  /** Foot pitch of each foot in the capture, and the mapped foot rows. */
  pitch: [number, number];
  feet: Float64Array;
}

const createBody = (): Body => ({
  root: new Float64Array(3),
  rotations: new Float64Array(Q),
  pitch: [0, 0],
  feet: new Float64Array(2 * FOOT_STRIDE),
});

/** State that is handed from frame to frame. */
export interface BodyState {
  rootInertia: Inertia;
  jointInertia: Inertia;
  pitchInertia: [Inertia, Inertia];
  /** Difference of the foot's row to its warped capture where its swing begins: place, rotation vector, toe bend. */
  liftGap: Float64Array;
  /** ... how fast it changes, a second, and the time since the last planted frame. */
  liftSpeed: Float64Array;
  liftAge: [number, number];
  landGap: Float64Array;
  swinging: [boolean, boolean];
  /** A foot that has just pivoted on its ball and now lies flat. */
  settled: [boolean, boolean];
  lastPitch: [number, number];
  lastPitchSpeed: [number, number];
  /** Seconds since each foot has landed. */
  landedAge: [number, number];
  /** Source frame until which a capture's foot still comes down, after ours has landed in another capture. */
  comesDown: [number, number];
}

export function createBodyState(): BodyState {
  return {
    rootInertia: createInertia(3),
    jointInertia: createInertia(3 * JOINT_COUNT),
    pitchInertia: [createInertia(1), createInertia(1)],
    liftGap: new Float64Array(14),
    liftSpeed: new Float64Array(14),
    liftAge: [0, 0],
    landGap: new Float64Array(14),
    swinging: [false, false],
    settled: [false, false],
    lastPitch: [0, 0],
    lastPitchSpeed: [0, 0],
    landedAge: [1, 1],
    comesDown: [0, 0],
  };
}

const positions = new Float64Array(JOINT_COUNT * 3);
const world = new Float64Array(JOINT_COUNT * 4);
const q = new Float64Array(16);
const v = new Float64Array(8);
const row = new Float64Array(FOOT_STRIDE);
const here = createBody();
const next = createBody();
const earlier = createBody();
const FEET = [J.leftFoot, J.rightFoot] as const;
const TOES = [J.leftToes, J.rightToes] as const;

/** Fills the track from frame `from` (a segment's first, or 0) to its end. */
export function runBodyPass(
  track: BodyTrack,
  setups: readonly SegmentSetup[],
  skeleton: Skeleton,
  state: BodyState,
): void {
  setups.forEach((setup, index) => {
    const { segment } = setup;
    beginSegment(track, setup, state);
    for (let k = 0; k < segment.frames; k++) {
      const frame = segment.start + k;
      if (frame >= track.frames) return;
      const source = segment.from + (k * (segment.to - segment.from)) / segment.frames;
      track.segmentOf[frame] = index;
      track.sourceFrame[frame] = source;
      mapBody(here, setup, source);
      writeFrame(track, frame, here, state);
      writeFeet(track, frame, setup, source, skeleton, state);
      advance(state);
    }
  });
}

/** Fraction of the swing foot's way at a source frame; 0 before, 1 after. */
function travelled(setup: SegmentSetup, source: number): number {
  if (!setup.step) return 0;
  return source <= setup.step.start
    ? 0
    : source >= setup.step.end
      ? 1
      : readTable(setup.travel, source - setup.step.start);
}

/**
 * Fraction of its part of the warp that the root has made at a source frame: softly over the whole segment. By the swing foot's own
 * way the hips would set off and stop with a jerk at lift and landing, where that foot already, or still, moves.
 */
function carried(setup: SegmentSetup, source: number): number {
  if (!setup.step) return 0;
  const { from, to } = setup.segment;
  return minimumJerk((source - from) / (to - from));
}

/** The capture's pose at a frame, laid on the plan's ground. */
function mapBody(body: Body, setup: SegmentSetup, source: number): void {
  sampleClip(body.root, body.rotations, setup.source.clip, source);
  forwardKinematics(positions, world, setup.source.clip.skeleton, body.root, 0, body.rotations, 0);
  const w = carried(setup, source);
  for (let f = 0; f < 2; f++) {
    const joint = FEET[f];
    body.pitch[f] = pitchOf(world, 4 * joint);
    const o = f * FOOT_STRIDE;
    for (let k = 0; k < 3; k++) body.feet[o + k] = positions[3 * joint + k];
    for (let k = 0; k < 4; k++) body.feet[o + 3 + k] = world[4 * joint + k];
    body.feet[o + 7] = toeBendOf(body.rotations, 4 * TOES[f]);
  }
  const x = body.root[0];
  const z = body.root[2];
  mapPoint(body.root, 0, setup.map, w, x, z);
  const h0 = (setup.heightBefore[0] + setup.heightBefore[1]) / 2;
  const h1 = (setup.heightAfter[0] + setup.heightAfter[1]) / 2;
  body.root[1] += h0 + w * (h1 - h0);
  quatFromAxisAngle(q, 0, 0, 1, 0, mapTurn(setup.map, w));
  quatMultiply(body.rotations, 0, q, 0, body.rotations, 0);
}

/**
 * Sets the offsets so that value and speed go on from the frames before. Both are compared with the capture's own one frame before
 * the segment: most segments begin as a foot strikes the ground, where speeds before and after differ in any capture.
 */
function beginSegment(track: BodyTrack, setup: SegmentSetup, state: BodyState): void {
  const frame = setup.segment.start;
  state.swinging[0] = false;
  state.swinging[1] = false;
  if (frame === 0) {
    for (const inertia of [state.rootInertia, state.jointInertia, ...state.pitchInertia]) inertia.length = 0;
    return;
  }
  const rate = (setup.segment.to - setup.segment.from) / setup.segment.frames;
  mapBody(here, setup, setup.segment.from - rate);
  mapBody(earlier, setup, setup.segment.from - 2 * rate);
  const p1 = frame - 1;
  const p2 = Math.max(0, frame - 2);
  const r = state.rootInertia;
  for (let k = 0; k < 3; k++) {
    const before = track.root[3 * p1 + k];
    r.value[k] = before - here.root[k];
    r.speed[k] = (before - track.root[3 * p2 + k] - (here.root[k] - earlier.root[k])) / DT;
  }
  r.age = DT;
  r.length = JOIN_TIME;
  const ji = state.jointInertia;
  if (!setup.continues) {
    for (let j = 0; j < JOINT_COUNT; j++) {
      const a = Q * p1 + 4 * j;
      quatConjugate(q, 0, track.rotations, Q * p2 + 4 * j);
      quatMultiply(q, 0, track.rotations, a, q, 0);
      quatToRotationVector(v, 0, q, 0);
      quatConjugate(q, 4, here.rotations, 4 * j);
      quatMultiply(q, 8, track.rotations, a, q, 4);
      quatToRotationVector(v, 3, q, 8);
      quatConjugate(q, 4, earlier.rotations, 4 * j);
      quatMultiply(q, 8, here.rotations, 4 * j, q, 4);
      quatToRotationVector(q, 12, q, 8);
      for (let k = 0; k < 3; k++) {
        ji.value[3 * j + k] = v[3 + k];
        ji.speed[3 * j + k] = (v[k] - q[12 + k]) / DT;
      }
    }
    ji.age = DT;
    ji.length = JOIN_TIME;
  }
  for (let f = 0; f < 2; f++) {
    const inertia = state.pitchInertia[f];
    const held = setup.plantBefore[f] === "enforce";
    const lands = state.landedAge[f] < LANDS;
    // It has landed in its own way and comes down from there, whether a new capture's strikes harder or lands on its toes.
    state.comesDown[f] = lands && !setup.continues ? comesDownAt(setup, f as 0 | 1) : 0;
    const clamp = (p: number) =>
      held ? 0 : landedPitch(setup, p, f as 0 | 1, setup.segment.from - rate, state);
    inertia.value[0] = state.lastPitch[f] - clamp(here.pitch[f]);
    inertia.speed[0] = (state.lastPitchSpeed[f] - (clamp(here.pitch[f]) - clamp(earlier.pitch[f]))) / DT;
    // A speed that would carry the foot far past its place is not handed on.
    inertia.speed[0] = Math.max(-4, Math.min(4, inertia.speed[0]));
    inertia.age = DT;
    // A foot a little off flat settles at once.
    const size = Math.min(1, Math.abs(inertia.value[0]) / SETTLING);
    inertia.length = QUICK_PITCH + size * (PITCH_TIME - QUICK_PITCH);
    if (lands) {
      // The ground stops its slap: handed on in full, the heel would bounce. From 2.5 on the quintic swings past its end.
      const most = (2.5 * Math.abs(inertia.value[0])) / inertia.length;
      if (inertia.value[0] >= 0) inertia.speed[0] = Math.max(-most, inertia.speed[0]);
      else inertia.speed[0] = Math.min(most, inertia.speed[0]);
    }
    if (setup.plantBefore[f] !== "never") continue;
    // A foot that nothing holds goes on from where it was, in another capture.
    takeGap(track, frame, setup, f as 0 | 1, setup.segment.from, state);
    state.liftAge[f] = 0;
  }
}

/** Root and joints of a frame with what is left of the last join. */
function writeFrame(track: BodyTrack, frame: number, body: Body, state: BodyState): void {
  const r = state.rootInertia;
  for (let k = 0; k < 3; k++)
    track.root[3 * frame + k] = body.root[k] + decay(r.value[k], r.speed[k], r.age, r.length);
  const ji = state.jointInertia;
  const base = Q * frame;
  if (ji.age >= ji.length) {
    for (let k = 0; k < Q; k++) track.rotations[base + k] = body.rotations[k];
    return;
  }
  for (let j = 0; j < JOINT_COUNT; j++) {
    const o = 3 * j;
    quatFromRotationVector(
      q,
      0,
      decay(ji.value[o], ji.speed[o], ji.age, ji.length),
      decay(ji.value[o + 1], ji.speed[o + 1], ji.age, ji.length),
      decay(ji.value[o + 2], ji.speed[o + 2], ji.age, ji.length),
    );
    quatMultiply(track.rotations, base + 4 * j, q, 0, body.rotations, 4 * j);
    quatNormalize(track.rotations, base + 4 * j);
  }
}

/** Both feet of a frame, and its contacts. */
function writeFeet(
  track: BodyTrack,
  frame: number,
  setup: SegmentSetup,
  source: number,
  skeleton: Skeleton,
  state: BodyState,
): void {
  let contacts = 0;
  for (let f = 0 as 0 | 1; f < 2; f = (f + 1) as 0 | 1) {
    const o = (2 * frame + f) * FOOT_STRIDE;
    const step = setup.swing === f ? setup.step : null;
    const moving = step !== null && source >= step.start && source < step.end;
    const landed = step !== null && source >= step.end;
    const pi = state.pitchInertia[f];
    const plant = moving ? undefined : landed ? setup.plantAfter[f] : setup.plantBefore[f];
    const raw = plant === "enforce" ? 0 : landedPitch(setup, here.pitch[f], f, source, state);
    if (state.settled[f] && !moving) {
      state.settled[f] = false;
      pi.value[0] = -raw;
      pi.speed[0] = 0;
      pi.age = 0;
      pi.length = PITCH_TIME;
    }
    const pitch = Math.max(
      LEAST_PITCH,
      Math.min(MOST_PITCH, raw + decay(pi.value[0], pi.speed[0], pi.age, pi.length)),
    );
    if (plant === "never") {
      state.liftAge[f] += DT;
      swingFoot(track.feet, o, setup, f, source, here);
      addLift(track.feet, o, state, f, state.liftAge[f], PITCH_TIME);
      const free = pitchOf(track.feet, o + 3);
      state.lastPitchSpeed[f] = frame > 0 ? free - state.lastPitch[f] : 0;
      state.lastPitch[f] = free;
      continue;
    }
    if (!moving) {
      const on = landed ? setup.planAfter[f] : setup.planBefore[f];
      plantedFoot(
        track.feet,
        o,
        skeleton.foot,
        on,
        landed ? setup.heightAfter[f] : setup.heightBefore[f],
        pitch,
      );
      contacts |= contactsOfPitch(pitch) << (2 * f);
      state.lastPitchSpeed[f] = frame > 0 ? pitch - state.lastPitch[f] : 0;
      state.lastPitch[f] = pitch;
      continue;
    }
    const t = source - step.start;
    if (setup.pivot) {
      const y0 = setup.yaw[0];
      const y1 = setup.yaw[setup.yaw.length - 1];
      const done =
        Math.abs(y1 - y0) > 0.02 ? (readTable(setup.yaw, t) - y0) / (y1 - y0) : readTable(setup.travel, t);
      const from = setup.planBefore[f];
      const turn = wrapAngle(setup.planAfter[f].yaw - from.yaw);
      const on = pivotPlace(skeleton.foot, from, from.yaw + turn * done, setup.pivot);
      let bears = pitch;
      if (setup.pivot === "ball") {
        const u = t / (step.end - step.start);
        bears *= u > SETTLE ? 1 - smooth((u - SETTLE) / (1 - SETTLE)) : 1;
        state.settled[f] = true;
      }
      plantedFoot(track.feet, o, skeleton.foot, on, setup.heightBefore[f], bears);
      contacts |= (setup.pivot === "heel" ? 1 : 2) << (2 * f);
      state.lastPitchSpeed[f] = bears - state.lastPitch[f];
      state.lastPitch[f] = bears;
      continue;
    }
    if (!state.swinging[f]) {
      state.swinging[f] = true;
      startSwing(track, frame, setup, f, source, skeleton, state);
      state.liftAge[f] = 0;
    }
    state.liftAge[f] += DT;
    swingFoot(track.feet, o, setup, f, source, here);
    const u = t / (step.end - step.start);
    const late = u > 0.5 ? smooth((u - 0.5) / 0.5) : 0;
    const part = setup.plantBefore[f] === "enforce" ? HELD_LIFT_PART : LIFT_PART;
    addLift(track.feet, o, state, f, state.liftAge[f], (part * (step.end - step.start)) / CLIP_RATE);
    addGap(track.feet, o, state.landGap, 7 * f, late);
    // The plant that follows starts from the pitch that the swing has led to.
    state.landedAge[f] = 0;
    pi.length = 0;
    const swung = pitchOf(track.feet, o + 3);
    state.lastPitchSpeed[f] = swung - state.lastPitch[f];
    state.lastPitch[f] = swung;
  }
  track.contacts[frame] = contacts;
}

/** What counts as flat, by the seconds since the foot has landed: one that comes down on its toes is let down. */
const flatOf = (age: number): number =>
  FLAT + (LANDING_FLAT - FLAT) * (1 - smooth(Math.max(0, Math.min(1, (age - LANDING) / LANDING))));

/** Pitch of a foot that bears: within limits, and flat where the capture's is nearly. */
function restingPitch(pitch: number, flat = FLAT): number {
  const p = Math.max(LEAST_PITCH, Math.min(MOST_PITCH, pitch));
  const over = Math.abs(p) / flat - 1;
  return over >= 2 ? p : over <= 0 ? 0 : p * smooth(over / 2);
}

/** The same in its segment: where nobody steps, a foot that the capture was about to roll over its heel stays flat. */
function bearingPitch(setup: SegmentSetup, pitch: number, flat = FLAT): number {
  const p = restingPitch(pitch, flat);
  return setup.step ? p : Math.min(0, p);
}

/** The same; flat where the capture's foot still comes down and ours has landed in its own way. */
const landedPitch = (
  setup: SegmentSetup,
  pitch: number,
  f: 0 | 1,
  source: number,
  state: BodyState,
): number => (source < state.comesDown[f] ? 0 : bearingPitch(setup, pitch, flatOf(state.landedAge[f])));

/**
 * Source frame at which a capture's foot that strikes with its heel, or lands on its toes, as the segment begins lies flat; 0 where
 * it does not come down: it lies already, or its heel is on its way up.
 */
function comesDownAt(setup: SegmentSetup, f: 0 | 1): number {
  const { from } = setup.segment;
  let before = Number.POSITIVE_INFINITY;
  for (let k = 0; k <= COMES_DOWN; k++) {
    mapBody(next, setup, from + k);
    const size = Math.abs(bearingPitch(setup, next.pitch[f], LANDING_FLAT));
    if (size === 0) return k === 0 ? 0 : from + k;
    if (size > before) return 0;
    before = size;
  }
  return 0;
}

const smooth = (u: number): number => u * u * u * (u * (6 * u - 15) + 10);

/**
 * The gaps between the warped capture and the closed form at both ends of a swing. At the lift the speed counts too: a heel that
 * rises by its own pitch may be slower than the capture's swing, and a leg that is nearly straight shows every jump at the knee.
 */
function startSwing(
  track: BodyTrack,
  frame: number,
  setup: SegmentSetup,
  f: 0 | 1,
  source: number,
  skeleton: Skeleton,
  state: BodyState,
): void {
  const step = setup.step!;
  const g = 7 * f;
  takeGap(track, frame, setup, f, source, state);
  mapBody(next, setup, step.end);
  if (setup.plantAfter[f] === "never") {
    // Nothing holds it where it lands: it comes down as the capture's does.
    state.landGap.fill(0, g, g + 7);
    return;
  }
  const p = setup.plantAfter[f] === "enforce" ? 0 : restingPitch(next.pitch[f]);
  plantedFoot(row, 0, skeleton.foot, setup.planAfter[f], setup.heightAfter[f], p);
  gap(state.landGap, g, setup, f, step.end, row);
}

/** The gap of the last two frames to the warped capture, and how fast it changes: what `addLift` lets die out. */
function takeGap(
  track: BodyTrack,
  frame: number,
  setup: SegmentSetup,
  f: 0 | 1,
  source: number,
  state: BodyState,
): void {
  const rate = (setup.segment.to - setup.segment.from) / setup.segment.frames;
  const g = 7 * f;
  for (let back = 0; back < 2; back++) {
    // A plan that begins with a lift has nothing before it.
    const at = Math.max(0, frame - 1 - back);
    mapBody(next, setup, source - (1 + back) * rate);
    for (let k = 0; k < FOOT_STRIDE; k++) row[k] = track.feet[(2 * at + f) * FOOT_STRIDE + k];
    gap(back === 0 ? state.liftGap : state.liftSpeed, g, setup, f, source - (1 + back) * rate, row);
  }
  for (let k = g; k < g + 7; k++) state.liftSpeed[k] = (state.liftGap[k] - state.liftSpeed[k]) / DT;
}

/** Part of a swing in which what is left of the plant before it dies out. */
const LIFT_PART = 0.4;
/** Likewise after a foot that the user held flat to its last moment: it has all of its roll to make up for. */
const HELD_LIFT_PART = 0.6;

/** What is left of the lift's gap, added to a foot `age` seconds after its last planted frame. */
function addLift(
  feet: Float64Array,
  o: number,
  state: BodyState,
  f: 0 | 1,
  age: number,
  length: number,
): void {
  if (age >= length) return;
  for (let k = 0; k < 7; k++)
    left[k] = decay(state.liftGap[7 * f + k], state.liftSpeed[7 * f + k], age, length);
  addGap(feet, o, left, 0, 1);
}
const left = new Float64Array(7);

const swung = new Float64Array(FOOT_STRIDE);

function gap(
  out: Float64Array,
  o: number,
  setup: SegmentSetup,
  f: 0 | 1,
  source: number,
  target: Float64Array,
): void {
  swingFoot(swung, 0, setup, f, source, next);
  for (let k = 0; k < 3; k++) out[o + k] = target[k] - swung[k];
  quatConjugate(q, 0, swung, 3);
  quatMultiply(q, 4, target, 3, q, 0);
  quatToRotationVector(out, o + 3, q, 4);
  out[o + 6] = target[7] - swung[7];
}

function addGap(feet: Float64Array, o: number, gaps: Float64Array, g: number, weight: number): void {
  if (weight === 0) return;
  for (let k = 0; k < 3; k++) feet[o + k] += weight * gaps[g + k];
  quatFromRotationVector(q, 0, weight * gaps[g + 3], weight * gaps[g + 4], weight * gaps[g + 5]);
  quatMultiply(feet, o + 3, q, 0, feet, o + 3);
  quatNormalize(feet, o + 3);
  feet[o + 7] += weight * gaps[g + 6];
}

/** The capture's swing foot between its footsteps on the plan: warped by the fraction of the way travelled. */
function swingFoot(
  out: Float64Array,
  o: number,
  setup: SegmentSetup,
  f: 0 | 1,
  source: number,
  body: Body,
): void {
  const w = travelled(setup, source);
  const i = f * FOOT_STRIDE;
  const turn0 = wrapAngle(setup.planBefore[f].yaw - setup.sourceBefore[f].yaw);
  const turn1 = turn0 + wrapAngle(setup.planAfter[f].yaw - setup.sourceAfter[f].yaw - turn0);
  lay(v, setup.sourceBefore[f], setup.planBefore[f], turn0, body.feet[i], body.feet[i + 2]);
  const x0 = v[0];
  const z0 = v[1];
  lay(v, setup.sourceAfter[f], setup.planAfter[f], turn1, body.feet[i], body.feet[i + 2]);
  out[o] = x0 + w * (v[0] - x0);
  out[o + 1] = body.feet[i + 1] + setup.heightBefore[f] + w * (setup.heightAfter[f] - setup.heightBefore[f]);
  out[o + 2] = z0 + w * (v[1] - z0);
  quatFromAxisAngle(q, 0, 0, 1, 0, turn0 + w * (turn1 - turn0));
  quatMultiply(out, o + 3, q, 0, body.feet, i + 3);
  out[o + 7] = body.feet[i + 7];
}

function lay(
  out: Float64Array,
  source: GroundPose,
  plan: GroundPose,
  turn: number,
  x: number,
  z: number,
): void {
  const c = Math.cos(turn);
  const s = Math.sin(turn);
  const dx = x - source.x;
  const dz = z - source.z;
  out[0] = plan.x + c * dx + s * dz;
  out[1] = plan.z - s * dx + c * dz;
}

function advance(state: BodyState): void {
  state.rootInertia.age += DT;
  state.jointInertia.age += DT;
  state.pitchInertia[0].age += DT;
  state.pitchInertia[1].age += DT;
  state.landedAge[0] += DT;
  state.landedAge[1] += DT;
}
