/**
 * The hands at their tasks: pen on the board, both hands at the box, the box carried between.
 *
 * Where a capture's hand was in its own task's frame, laid on the scene's task, is where the hand must be; between tasks the
 * box rides where the body's own hands are.
 */

import { wrapAngle } from "../math/angle.ts";
import { GRAVITY } from "../math/gravity.ts";
import { minimumJerk } from "../math/interpolate.ts";
import { quatFromAxisAngle, quatRotate } from "../math/quaternion.ts";
import { forwardKinematics } from "../skeleton/forward-kinematics.ts";
import { J, JOINT_COUNT } from "../skeleton/joints.ts";
import type { Skeleton } from "../skeleton/skeleton.ts";
import type { BodyTrack } from "./body-pass.ts";
import type { HandTargets, LimbWorkspace } from "./limb-pass.ts";
import { sampleClip } from "./sample.ts";
import type { SegmentSetup } from "./segment-setup.ts";
import { mapByTask, shows, type TaskWindow, windowWeight } from "./task-windows.ts";
import type { BoxTrack, InkStroke } from "./types.ts";

/** A box from its grasp to where it is put down. */
export interface Carry {
  lift: TaskWindow;
  place: TaskWindow | null;
  first: number;
  last: number;
  /** Frame at which the hands are free again. */
  over: number;
  track: BoxTrack;
}

export interface HandState {
  windows: TaskWindow[];
  carries: Carry[];
  /** Places where nothing was carried: the hands go through it all the same. */
  alone: TaskWindow[];
  ink: { times: number[]; points: number[]; task: string }[];
  /** Last gap between the task's and the body's hands, per window: hands' middle or pen. */
  gaps: Float64Array;
  /** How firmly each hand writes in the present frame. */
  writing: [number, number];
  /** Whether each window's capture is what is shown at its contact: -1 not looked at, 0 no, 1 yes. */
  seen: Int8Array;
  /** Source frame that is shown at each window's contact: the capture's own contact but for stretched time. */
  sourceAtContact: Float64Array;
  /** Where the pen of each window was against its task at contact. */
  penStart: Float64Array;
}

/** Most frames in which hands come back from a box that they have put down or let go, and the least. */
const LET_GO = 40;
const LET_GO_QUICKLY = 12;
/** Half a box's width and the palm's way to it, metres. */
const BOX_HALF = 0.18;
const PALM_GAP = 0.01;
/** Half a box's height, metres, and what pulls it to the floor, m/s^2. */
const BOX_RISE = 0.13;

export function createHandState(windows: TaskWindow[], frames: number): HandState {
  const carries: Carry[] = [];
  const alone: TaskWindow[] = [];
  let open: TaskWindow | null = null;
  const close = (lift: TaskWindow, place: TaskWindow | null, next: TaskWindow | null = null) => {
    const first = lift.contact;
    // A second box takes the hands: the first is let go in time for them to come back.
    const until = next ? Math.max(first, next.from - LET_GO) : frames - 1;
    const last = Math.min(frames - 1, place ? place.contact : until);
    if (last < first) return;
    const over = place ? place.over : next ? Math.max(last + LET_GO_QUICKLY, next.from) : last + 1;
    carries.push({
      lift,
      place,
      first,
      last,
      over,
      track: {
        lift: lift.task.id,
        place: place?.task.id ?? null,
        first,
        frames: last - first + 1,
        transforms: new Float32Array(7 * (last - first + 1)),
      },
    });
  };
  for (const w of windows) {
    if (w.task.category === "lift") {
      if (open) close(open, null, w);
      open = w;
    } else if (w.task.category === "place" && open) {
      close(open, w);
      open = null;
    } else if (w.task.category === "place") alone.push(w);
  }
  if (open) close(open, null);
  return {
    windows,
    carries,
    alone,
    ink: [],
    writing: [0, 0],
    gaps: new Float64Array(3 * Math.max(1, windows.length)),
    seen: new Int8Array(Math.max(1, windows.length)).fill(-1),
    sourceAtContact: new Float64Array(Math.max(1, windows.length)),
    penStart: new Float64Array(3 * Math.max(1, windows.length)),
  };
}

const v = new Float64Array(12);
const root = new Float64Array(3);
const pose = new Float64Array(4 * JOINT_COUNT);
const p = new Float64Array(3 * JOINT_COUNT);
const wr = new Float64Array(4 * JOINT_COUNT);
const q = new Float64Array(4);

/** Palm or pen point of a hand: beyond the joint along the hand. */
function tip(
  out: Float64Array,
  o: number,
  positions: Float64Array,
  world: Float64Array,
  side: number,
  skeleton: Skeleton,
): void {
  const hand = side === 0 ? J.leftHand : J.rightHand;
  quatRotate(out, o, world, 4 * hand, side === 0 ? skeleton.palm : -skeleton.palm, 0, 0);
  for (let k = 0; k < 3; k++) out[o + k] += positions[3 * hand + k];
}

/** The capture's hand tips laid on the plan's task: left at out[0..2], right at out[3..5]. False where the capture is another. */
function tipsByTask(out: Float64Array, w: TaskWindow, setup: SegmentSetup, source: number): boolean {
  if (!shows(w, setup.segment.clip, source)) return false;
  const { clip } = setup.source;
  sampleClip(root, pose, clip, Math.max(0, Math.min(clip.frames - 1, source)));
  forwardKinematics(p, wr, clip.skeleton, root, 0, pose, 0);
  for (let side = 0; side < 2; side++) {
    tip(out, 3 * side, p, wr, side, clip.skeleton);
    mapByTask(out, 3 * side, w, out[3 * side], out[3 * side + 1], out[3 * side + 2]);
  }
  return true;
}

/**
 * Targets of both hand joints at a frame; weights 0 where they are free. Also notes the box's place and the ink.
 *
 * @param limbs the frame with its legs closed: the hands as the body has them.
 */
export function handTargets(
  targets: HandTargets,
  state: HandState,
  limbs: LimbWorkspace,
  track: BodyTrack,
  setups: readonly SegmentSetup[],
  frame: number,
  skeleton: Skeleton,
): void {
  targets.weight[0] = 0;
  targets.weight[1] = 0;
  state.writing[0] = state.writing[1] = 0;
  const setup = setups[track.segmentOf[frame]];
  const source = track.sourceFrame[frame];
  for (let i = 0; i < state.windows.length; i++) {
    if (state.seen[i] >= 0) continue;
    const w = state.windows[i];
    const f = Math.max(0, Math.min(track.frames - 1, w.contact));
    state.sourceAtContact[i] = track.sourceFrame[f];
    state.seen[i] = shows(w, setups[track.segmentOf[f]].segment.clip, track.sourceFrame[f]) ? 1 : 0;
  }
  for (let i = 0; i < state.windows.length; i++) {
    const w = state.windows[i];
    if (w.task.category !== "write") continue;
    const weight = windowWeight(w, frame);
    if (weight <= 0) continue;
    state.writing[w.task.hand === "left" ? 0 : 1] = weight;
    writeTarget(targets, state, i, limbs, setup, source, frame, weight, skeleton);
  }
  boxTargets(targets, state, limbs, setup, source, frame, skeleton);
}

/** The hand joint that puts the tip at (x, y, z), the hand pointing as it does. */
function joint(
  targets: HandTargets,
  side: number,
  limbs: LimbWorkspace,
  x: number,
  y: number,
  z: number,
  weight: number,
  skeleton: Skeleton,
): void {
  const hand = side === 0 ? J.leftHand : J.rightHand;
  quatRotate(v, 9, limbs.world, 4 * hand, side === 0 ? skeleton.palm : -skeleton.palm, 0, 0);
  targets.weight[side] = Math.max(targets.weight[side], weight);
  targets.place[3 * side] = x - v[9];
  targets.place[3 * side + 1] = y - v[10];
  targets.place[3 * side + 2] = z - v[11];
}

function writeTarget(
  targets: HandTargets,
  state: HandState,
  index: number,
  limbs: LimbWorkspace,
  setup: SegmentSetup,
  source: number,
  frame: number,
  weight: number,
  skeleton: Skeleton,
): void {
  const w = state.windows[index];
  const side = w.task.hand === "left" ? 0 : 1;
  tip(v, 6, limbs.positions, limbs.world, side, skeleton);
  const g = 3 * index;
  if (frame <= w.end && tipsByTask(v, w, setup, source)) {
    const o = 3 * side;
    if (frame <= w.contact) {
      // The stroke begins at the point itself, whatever the arm's length has done to the capture's.
      if (frame === w.contact) {
        state.penStart[g] = v[o] - w.target.x;
        state.penStart[g + 1] = v[o + 1] - w.target.y;
        state.penStart[g + 2] = v[o + 2] - w.target.z;
      } else tipAtContact(state, index, side, setup);
    }
    const s = Math.sin(w.target.yaw);
    const c = Math.cos(w.target.yaw);
    let x = v[o] - state.penStart[g];
    const y = v[o + 1] - state.penStart[g + 1];
    let z = v[o + 2] - state.penStart[g + 2];
    // On the board from contact to end, but where the capture lifts the pen.
    const depth = (x - w.target.x) * s + (z - w.target.z) * c;
    const touching = frame >= w.contact && depth > -0.008 * (skeleton.height / 1.75);
    if (frame >= w.contact && (touching || depth > 0)) {
      x -= depth * s;
      z -= depth * c;
    }
    if (touching) note(state, w, frame, x, y, z);
    else if (frame >= w.contact) breakStroke(state, w);
    for (let k = 0; k < 3; k++) state.gaps[g + k] = [x, y, z][k] - v[6 + k];
  } else if (frame > w.end) breakStroke(state, w);
  else if (state.seen[index] === 0) aimAtTarget(state, index, v[6], v[7], v[8]);
  joint(
    targets,
    side,
    limbs,
    v[6] + weight * state.gaps[g],
    v[7] + weight * state.gaps[g + 1],
    v[8] + weight * state.gaps[g + 2],
    weight,
    skeleton,
  );
}

/** Where no capture shows the task at its contact, the hands go to the task's own place. */
function aimAtTarget(state: HandState, index: number, x: number, y: number, z: number): void {
  const { target } = state.windows[index];
  state.gaps[3 * index] = target.x - x;
  state.gaps[3 * index + 1] = target.y - y;
  state.gaps[3 * index + 2] = target.z - z;
}

/** Looks ahead to where the capture's pen is at contact, so that the lead aims there from the start. */
function tipAtContact(state: HandState, index: number, side: number, setup: SegmentSetup): void {
  const w = state.windows[index];
  const g = 3 * index;
  const save = v.slice(0, 6);
  tipsByTask(v, w, setup, state.sourceAtContact[index]);
  state.penStart[g] = v[3 * side] - w.target.x;
  state.penStart[g + 1] = v[3 * side + 1] - w.target.y;
  state.penStart[g + 2] = v[3 * side + 2] - w.target.z;
  v.set(save);
}

function note(state: HandState, w: TaskWindow, frame: number, x: number, y: number, z: number): void {
  let stroke = state.ink[state.ink.length - 1];
  const time = frame / 60;
  if (
    !stroke ||
    stroke.task !== w.task.id ||
    stroke.times.length === 0 ||
    time - stroke.times[stroke.times.length - 1] > 0.03
  ) {
    if (stroke && stroke.task === w.task.id && stroke.times.length === 0) stroke.times.length = 0;
    else {
      stroke = { task: w.task.id, times: [], points: [] };
      state.ink.push(stroke);
    }
  }
  stroke.times.push(time);
  stroke.points.push(x, y, z);
}

function breakStroke(state: HandState, w: TaskWindow): void {
  const stroke = state.ink[state.ink.length - 1];
  if (stroke && stroke.task === w.task.id && stroke.times.length > 0)
    state.ink.push({ task: w.task.id, times: [], points: [] });
}

function boxTargets(
  targets: HandTargets,
  state: HandState,
  limbs: LimbWorkspace,
  setup: SegmentSetup,
  source: number,
  frame: number,
  skeleton: Skeleton,
): void {
  for (const w of state.alone) {
    const weight = windowWeight(w, frame);
    if (weight <= 0) continue;
    emptyHanded(targets, state, w, limbs, setup, source, frame, weight, skeleton);
    return;
  }
  for (const carry of state.carries) {
    const { lift, place } = carry;
    if (frame < lift.from || frame > carry.over) continue;
    tip(v, 0, limbs.positions, limbs.world, 0, skeleton);
    tip(v, 3, limbs.positions, limbs.world, 1, skeleton);
    for (let side = 0 as 0 | 1; side < 2; side = (side + 1) as 0 | 1)
      if (state.writing[side] > 0) besideOther(v, side, state.writing[side], limbs);
    const body = [(v[0] + v[3]) / 2, (v[1] + v[4]) / 2, (v[2] + v[5]) / 2];
    const bodyYaw = Math.atan2(-(v[2] - v[5]), v[0] - v[3]);
    const held = frame >= carry.first && frame <= carry.last;
    const centre = [...body];
    let yaw = wrapAngle(bodyYaw);
    let led = 0;
    for (const w of place ? [lift, place] : [lift]) {
      const i = state.windows.indexOf(w);
      const g = 3 * i;
      const weight = windowWeight(w, frame);
      if (weight <= 0) continue;
      led = Math.max(led, weight);
      if (frame <= w.end && tipsByTask(v, w, setup, source)) {
        const mid = [(v[0] + v[3]) / 2, (v[1] + v[4]) / 2, (v[2] + v[5]) / 2];
        // At contact the hands' middle is the box's centre.
        for (let k = 0; k < 3; k++) state.gaps[g + k] = mid[k] - body[k];
        if (frame <= w.contact || w === place) correctAtContact(state, w, i, setup);
        const fade =
          w === lift
            ? frame <= w.contact
              ? 1
              : 1 - minimumJerk((frame - w.contact) / Math.max(1, w.end - w.contact))
            : 1;
        for (let k = 0; k < 3; k++) state.gaps[g + k] -= fade * state.penStart[g + k];
      } else if (frame <= w.end && state.seen[i] === 0) aimAtTarget(state, i, body[0], body[1], body[2]);
      for (let k = 0; k < 3; k++) centre[k] += weight * state.gaps[g + k];
      const toTask =
        w === lift
          ? frame <= w.contact
            ? weight
            : weight * (1 - minimumJerk((frame - w.contact) / Math.max(1, w.end - w.contact)))
          : frame <= w.contact
            ? weight
            : 1;
      yaw = wrapAngle(yaw + toTask * wrapAngle(w.target.yaw - yaw));
    }
    if (led < 1) raise(centre, yaw, 1 - led, limbs, skeleton);
    const reach =
      frame < carry.first
        ? windowWeight(lift, frame)
        : held
          ? 1
          : 1 - minimumJerk((frame - carry.last) / Math.max(1, Math.min(LET_GO, carry.over - carry.last)));
    if (held) {
      const t = carry.track.transforms;
      const o = 7 * (frame - carry.first);
      quatFromAxisAngle(q, 0, 0, 1, 0, yaw);
      t.set([centre[0], centre[1], centre[2], q[0], q[1], q[2], q[3]], o);
    }
    const half = BOX_HALF + PALM_GAP + 0.04 * (1 - reach);
    const c = Math.cos(yaw);
    const s = Math.sin(yaw);
    tip(v, 0, limbs.positions, limbs.world, 0, skeleton);
    tip(v, 3, limbs.positions, limbs.world, 1, skeleton);
    for (let side = 0; side < 2; side++) {
      const sign = side === 0 ? 1 : -1;
      const x = centre[0] + sign * c * half;
      const z = centre[2] - sign * s * half;
      const own = 3 * side;
      const hx = v[own] + reach * (x - v[own]);
      const hy = v[own + 1] + reach * (centre[1] - v[own + 1]);
      const hz = v[own + 2] + reach * (z - v[own + 2]);
      // A hand that writes has left the box.
      const away = state.writing[side];
      const wrote = targets.place.slice(3 * side, 3 * side + 3);
      joint(targets, side, limbs, hx, hy, hz, reach, skeleton);
      if (away > 0)
        for (let k = 0; k < 3; k++) targets.place[own + k] += away * (wrote[k] - targets.place[own + k]);
    }
    return;
  }
}

/** A hand that writes holds no box: by `share` it is taken to be where the other one is, on its own side of the body. Mutates both hands' tips. */
function besideOther(tips: Float64Array, side: 0 | 1, share: number, limbs: LimbWorkspace): void {
  const own = 3 * side;
  const other = 3 - own;
  quatRotate(tips, 9, limbs.world, 0, 1, 0, 0);
  let across = 0;
  for (let k = 0; k < 3; k++) across += (tips[other + k] - limbs.positions[k]) * tips[9 + k];
  for (let k = 0; k < 3; k++) {
    const mirrored = tips[other + k] - 2 * across * tips[9 + k];
    tips[own + k] += share * (mirrored - tips[own + k]);
  }
}

/**
 * Ways of the boxes from their grasp to where they come to rest: one that was let go for another falls to the floor and lies there
 * as it was held.
 *
 * @param frames length of the motion.
 */
export function boxTracks(state: HandState, frames: number): BoxTrack[] {
  return state.carries.map(({ track, last, place }) => {
    if (place || last >= frames - 1) return track;
    const end = track.transforms.length - 7;
    const drop = Math.max(0, track.transforms[end + 1] - BOX_RISE);
    const fall = Math.min(frames - 1 - last, Math.ceil(60 * Math.sqrt((2 * drop) / GRAVITY)));
    const transforms = new Float32Array(track.transforms.length + 7 * fall);
    transforms.set(track.transforms);
    for (let k = 1; k <= fall; k++) {
      const o = end + 7 * k;
      transforms.copyWithin(o, end, end + 7);
      transforms[o + 1] -= Math.min(drop, (GRAVITY * (k / 60) ** 2) / 2);
    }
    return { ...track, frames: track.frames + fall, transforms };
  });
}

/** An arm that carries is bent at least to this share of its length; softness, metres. */
const CARRYING_ARM = 0.93;
const RAISE_EASE = 0.02;

/**
 * Raises what is carried to where the arms reach it bent. In captures of other things the hands hang, and a box between hanging
 * hands would be held by straight arms and a bowed trunk. Mutates `centre`, by `share` of the way.
 */
function raise(centre: number[], yaw: number, share: number, limbs: LimbWorkspace, skeleton: Skeleton): void {
  const o = skeleton.offsets;
  const most = CARRYING_ARM * (Math.abs(o[3 * J.leftLowerArm]) + Math.abs(o[3 * J.leftHand]));
  const half = BOX_HALF + PALM_GAP;
  let need = 0;
  for (let side = 0; side < 2; side++) {
    const shoulder = 3 * (side === 0 ? J.leftUpperArm : J.rightUpperArm);
    const hand = 4 * (side === 0 ? J.leftHand : J.rightHand);
    const sign = side === 0 ? 1 : -1;
    quatRotate(v, 9, limbs.world, hand, sign * skeleton.palm, 0, 0);
    const x = centre[0] + sign * Math.cos(yaw) * half - v[9] - limbs.positions[shoulder];
    const y = centre[1] - v[10] - limbs.positions[shoulder + 1];
    const z = centre[2] - sign * Math.sin(yaw) * half - v[11] - limbs.positions[shoulder + 2];
    const across = Math.min(0.9 * most, Math.hypot(x, z));
    const over = -Math.sqrt(most * most - across * across) - y;
    need += 0.25 * (over + Math.sqrt(over * over + RAISE_EASE * RAISE_EASE));
  }
  centre[1] += share * need;
}

/** How far the capture's hands' middle at contact is from its box, as laid on the plan: nothing for the studio's own build. */
function correctAtContact(state: HandState, w: TaskWindow, i: number, setup: SegmentSetup): void {
  const save = v.slice(0, 6);
  if (tipsByTask(v, w, setup, state.sourceAtContact[i])) {
    const g = 3 * i;
    state.penStart[g] = (v[0] + v[3]) / 2 - w.target.x;
    state.penStart[g + 1] = (v[1] + v[4]) / 2 - w.target.y;
    state.penStart[g + 2] = (v[2] + v[5]) / 2 - w.target.z;
  }
  v.set(save);
}

/** Strokes as typed arrays. */
export function inkOf(state: HandState): InkStroke[] {
  return state.ink
    .filter((s) => s.times.length > 1)
    .map((s) => ({ task: s.task, times: Float32Array.from(s.times), points: Float32Array.from(s.points) }));
}

/** Both hands to where a box's sides would be, from the capture's own hands. */
function emptyHanded(
  targets: HandTargets,
  state: HandState,
  w: TaskWindow,
  limbs: LimbWorkspace,
  setup: SegmentSetup,
  source: number,
  frame: number,
  weight: number,
  skeleton: Skeleton,
): void {
  const g = 3 * state.windows.indexOf(w);
  tip(v, 0, limbs.positions, limbs.world, 0, skeleton);
  tip(v, 3, limbs.positions, limbs.world, 1, skeleton);
  const own = v.slice(0, 6);
  const body = [0, 1, 2].map((k) => (own[k] + own[3 + k]) / 2);
  if (frame <= w.end && tipsByTask(v, w, setup, source)) {
    for (let k = 0; k < 3; k++) state.gaps[g + k] = (v[k] + v[3 + k]) / 2 - body[k];
    correctAtContact(state, w, g / 3, setup);
    for (let k = 0; k < 3; k++) state.gaps[g + k] -= state.penStart[g + k];
  } else if (frame <= w.end && state.seen[g / 3] === 0) aimAtTarget(state, g / 3, body[0], body[1], body[2]);
  for (let side = 0; side < 2; side++) {
    const o = 3 * side;
    joint(
      targets,
      side,
      limbs,
      own[o] + weight * state.gaps[g],
      own[o + 1] + weight * state.gaps[g + 1],
      own[o + 2] + weight * state.gaps[g + 2],
      weight,
      skeleton,
    );
  }
}
