/**
 * What a task asks of the body: bending to a box, sitting down and rising, leaning to a board; and where the hands are.
 */
import { CLIP_RATE } from "../../core/capture/clip.ts";
import { minimumJerk, smoothstep, unit } from "../../core/math/interpolate.ts";
import type { Skeleton } from "../../core/skeleton/skeleton.ts";
import type { LiftEvent, PlaceEvent, Score, SitEvent, WriteEvent } from "../score.ts";
import { type BodyAngles, pulse } from "./body.ts";
import type { Load, Pins } from "./centre-of-mass.ts";

const DEG = Math.PI / 180;
const BODY_MASS = 72;

/** Where each hand's palm (lift, place) or pen tip (write) is wanted: weight and place a frame; with the way it points. */
export interface HandTracks {
  /** frames: 0 free to 1 held. Left, right. */
  weight: [Float64Array, Float64Array];
  /** frames x 3, the palm or pen tip. */
  place: [Float64Array, Float64Array];
  /** frames x 3, the way the hand points, unit. */
  point: [Float64Array, Float64Array];
}

export interface TaskLayer {
  hands: HandTracks;
  pins: Pins;
  load: Load;
  /** Box centre a frame (x, y, z) and yaw, and whether it is held; for the hands. */
  box: Float64Array;
  boxYaw: Float64Array;
  held: Float64Array;
  /** Frames that carry a box: its place follows the body (filled by the renderer). */
  carry: Float64Array;
  boxSize: [number, number, number];
  /** The box's place and yaw at its table, kept while the rounds of correction move the body. */
  original: { box: Float64Array; yaw: Float64Array } | null;
}

export function createTaskLayer(frames: number): TaskLayer {
  const make = (n: number) => new Float64Array(n * frames);
  return {
    hands: { weight: [make(1), make(1)], place: [make(3), make(3)], point: [make(3), make(3)] },
    pins: { pinned: new Uint8Array(frames), place: make(2) },
    load: { share: make(1), place: make(3) },
    box: make(3),
    boxYaw: make(1),
    held: make(1),
    carry: make(1),
    boxSize: [0.36, 0.26, 0.28],
    original: null,
  };
}

/** Bends the body for the score's tasks and lays the hands' targets that do not depend on the body. Mutates both. */
export function renderTasks(
  score: Score,
  body: BodyAngles,
  layer: TaskLayer,
  skeleton: Skeleton,
  frames: number,
): void {
  let lift: LiftEvent | null = null;
  for (const event of score.events) {
    if (event.type === "write")
      write(
        event,
        event.task.effort === 0 ? shortOf(event, score, skeleton) : 0,
        body,
        layer,
        skeleton,
        frames,
      );
    if (event.type === "sit") sit(event, body, layer, skeleton, frames);
    if (event.type === "lift") {
      lift = event;
      layer.boxSize = event.size;
      bend(event, body, skeleton, frames);
    }
    if (event.type === "place") {
      bend(event, body, skeleton, frames);
      if (lift) holdBox(lift, event, body, layer, frames);
      lift = null;
    }
  }
  if (lift) holdBox(lift, null, body, layer, frames);
}

/** Seconds that a hand takes from hanging to the board, and back. */
const REACH = 0.75;
const RETURN = 0.65;

/** Where a writer stands beside the point, metres at 1.75 m, as `standFor` of the choreography has it; and how far a quick tap leans over for what it stops short, radians a metre. */
const BESIDE = 0.17;
const LEAN = 0.22;

/** How far the feet stand to the right of where they would to write at ease, metres, as the body faces. */
function shortOf({ task }: WriteEvent, score: Score, skeleton: Skeleton): number {
  const at = { left: score.start.left, right: score.start.right };
  for (const s of score.steps) if (s.land <= task.contact) at[s.foot] = s;
  const side = (task.hand === "left" ? -1 : 1) * BESIDE * (skeleton.height / 1.75);
  const x = task.position[0] + Math.cos(task.yaw) * side - (at.left.x + at.right.x) / 2;
  const z = task.position[2] - Math.sin(task.yaw) * side - (at.left.z + at.right.z) / 2;
  const yaw = (at.left.yaw + at.right.yaw) / 2;
  return x * Math.cos(yaw) - z * Math.sin(yaw);
}

/** @param short metres that a lean to the left, or right, makes up for. */
function write(
  event: WriteEvent,
  short: number,
  body: BodyAngles,
  layer: TaskLayer,
  skeleton: Skeleton,
  frames: number,
): void {
  const { task, strokes } = event;
  const side = task.hand === "left" ? 0 : 1;
  const s = Math.sin(task.yaw);
  const c = Math.cos(task.yaw);
  const last = strokes[strokes.length - 1];
  const end = Math.max(task.end, last ? last.times[last.times.length - 1] : task.end);
  const from = task.contact - REACH;
  const scale = skeleton.height / 1.75;
  // Looking and leaning a little towards what is written.
  const high = (task.position[1] - 1.38 * scale) / scale;
  for (
    let f = Math.max(0, Math.floor(from * CLIP_RATE));
    f < Math.min(frames, (end + RETURN) * CLIP_RATE);
    f++
  ) {
    const t = f / CLIP_RATE;
    const w = pulse(t, from, task.contact, end, end + RETURN);
    layer.hands.weight[side][f] = w;
    const p = penAt(strokes, Math.max(task.contact, Math.min(end, t)));
    // The writer's right is -X of a frame that faces the board.
    const x = task.position[0] - c * p[0];
    const z = task.position[2] + s * p[0];
    // Off the board by a hand's breadth while it comes and goes, touching from contact to end.
    const away = 0.1 * (1 - w) + (t > task.contact && t < end ? p[2] : 0);
    layer.hands.place[side].set([x - s * away, task.position[1] + p[1], z - c * away], 3 * f);
    const up = Math.max(-0.2, Math.min(1.1, 0.55 + 1.1 * high));
    const n = Math.hypot(1, up);
    layer.hands.point[side].set([s / n, up / n, c / n], 3 * f);
    standAtBoard(f, w, side, high, p, body, skeleton);
    // Positive roll: left side up.
    body.chestRoll[f] -= w * LEAN * short;
    body.headRoll[f] += 0.5 * w * LEAN * short;
  }
}

/**
 * Standing at a board: the weight goes over the writing side's leg and the other knee rests, that shoulder comes forward,
 * trunk and eyes follow the pen, the free arm hangs loosely bent.
 */
function standAtBoard(
  f: number,
  w: number,
  side: number,
  high: number,
  pen: readonly [number, number, number],
  body: BodyAngles,
  skeleton: Skeleton,
): void {
  const sign = side === 0 ? 1 : -1;
  // Chest and head turn after the pen: to the writer's right is a smaller yaw.
  const aside = Math.atan2(pen[0], 0.55);
  const above = Math.atan2(pen[1], 0.55);
  body.chestPitch[f] += w * ((4.5 - 6 * high) * DEG - 0.15 * above);
  body.pelvisPitch[f] += w * (2 - 1.5 * high) * DEG;
  body.headPitch[f] += w * ((-12 * high + 2) * DEG - 0.8 * above);
  body.pelvisYaw[f] -= w * sign * 2.5 * DEG;
  body.chestYaw[f] -= w * (sign * 7 * DEG + 0.35 * aside);
  body.headYaw[f] -= w * (0.7 * aside - sign * 2 * DEG);
  // The resting leg's side hangs; the reaching shoulder rises a little over it.
  body.pelvisRoll[f] += w * sign * 2.6 * DEG;
  body.chestRoll[f] += w * sign * (1.2 + 2.5 * high) * DEG;
  body.headRoll[f] -= w * sign * 2.2 * DEG;
  body.arms[side].out[f] += 0.3 * w * 20 * DEG;
  const rest = body.arms[1 - side];
  rest.elbow[f] += w * 12 * DEG;
  rest.swing[f] += w * 4 * DEG;
  rest.turn[f] += w * 8 * DEG;
  body.hipHeight[f] -= w * 0.009 * skeleton.legLength;
}

/** Pen place on the board at a time: right, up, and how far off the board between strokes. */
function penAt(strokes: WriteEvent["strokes"], t: number): [number, number, number] {
  for (let k = 0; k < strokes.length; k++) {
    const { times, points } = strokes[k];
    if (t < times[0]) {
      const before = strokes[k - 1];
      if (!before) return [points[0][0], points[0][1], 0];
      const a = before.points[before.points.length - 1];
      const t0 = before.times[before.times.length - 1];
      const u = minimumJerk((t - t0) / (times[0] - t0));
      return [
        a[0] + u * (points[0][0] - a[0]),
        a[1] + u * (points[0][1] - a[1]),
        0.03 * Math.sin(Math.PI * u) ** 2,
      ];
    }
    const n = times.length - 1;
    if (t <= times[n]) {
      let i = 0;
      while (i < n - 1 && times[i + 1] < t) i++;
      const u = n > 0 ? unit((t - times[i]) / Math.max(1e-6, times[i + 1] - times[i])) : 0;
      const j = Math.min(n, i + 1);
      return [
        points[i][0] + u * (points[j][0] - points[i][0]),
        points[i][1] + u * (points[j][1] - points[i][1]),
        0,
      ];
    }
  }
  const end = strokes[strokes.length - 1];
  if (!end) return [0, 0, 0];
  const p = end.points[end.points.length - 1];
  return [p[0], p[1], 0];
}

/** Trunk, pelvis and knees for taking a box from, or putting it to, a height. */
function bend(event: LiftEvent | PlaceEvent, body: BodyAngles, skeleton: Skeleton, frames: number): void {
  const { task } = event;
  const scale = skeleton.height / 1.75;
  const need = unit((0.98 * scale - task.position[1]) / (0.6 * scale));
  const lifting = event.type === "lift";
  for (
    let f = Math.max(0, Math.floor(task.start * CLIP_RATE));
    f < Math.min(frames, (task.end + 0.1) * CLIP_RATE);
    f++
  ) {
    const t = f / CLIP_RATE;
    // Legs move first going up, the trunk follows by 0.12 s.
    const legs = pulse(t, task.start, task.contact, task.contact + (lifting ? 0.05 : 0.1), task.end);
    const trunk = pulse(t, task.start, task.contact, task.contact + (lifting ? 0.15 : 0.15), task.end + 0.1);
    body.hipHeight[f] -= legs * (0.03 + 0.34 * need * need) * skeleton.legLength;
    body.pelvisPitch[f] += trunk * (7 + 30 * need) * DEG;
    body.chestPitch[f] += trunk * (15 + 42 * need) * DEG;
    body.headPitch[f] += trunk * (22 + 22 * need) * DEG;
  }
}

/** Thickness from the palm's middle to the box, metres. */
const PALM_GAP = 0.01;

/** The box from its grasp to where it is put down (or the end): held before the belly while it is carried. */
function holdBox(
  lift: LiftEvent,
  place: PlaceEvent | null,
  body: BodyAngles,
  layer: TaskLayer,
  frames: number,
): void {
  const a = lift.task;
  const b = place?.task ?? null;
  const end = b ? b.contact : frames / CLIP_RATE;
  const over = b ? b.end : end;
  const share = lift.mass / BODY_MASS;
  for (
    let f = Math.max(0, Math.floor(a.start * CLIP_RATE));
    f < Math.min(frames, (over + 0.2) * CLIP_RATE);
    f++
  ) {
    const t = f / CLIP_RATE;
    const reach = minimumJerk((t - a.start) / (a.contact - a.start));
    const release = b ? 1 - minimumJerk((t - b.contact - 0.06) / Math.max(0.3, b.end - b.contact)) : 1;
    const w = Math.min(reach, release);
    for (let side = 0; side < 2; side++) layer.hands.weight[side][f] = w;
    const held = t >= a.contact && t <= end ? 1 : 0;
    layer.held[f] = held;
    layer.load.share[f] =
      held * share * Math.min(smoothstep((t - a.contact) / 0.25), b ? smoothstep((end - t) / 0.25) : 1);
    // Share of the body's own carrying place: 0 at the table, 1 in the walk.
    const up = minimumJerk((t - a.contact - 0.05) / Math.max(0.4, a.end - a.contact));
    const down = b ? 1 - minimumJerk((t - b.start) / Math.max(0.4, b.contact - b.start)) : 1;
    layer.carry[f] = Math.min(up, down);
    const from = t < (b ? (a.end + b.start) / 2 : Number.POSITIVE_INFINITY) ? a : (b ?? a);
    layer.box.set(from.position, 3 * f);
    layer.boxYaw[f] = from.yaw;
    // Ten kilograms in front bring the trunk back.
    const lean = layer.load.share[f] * Math.min(up, down);
    body.chestPitch[f] -= lean * 44 * DEG;
    body.pelvisPitch[f] -= lean * 14 * DEG;
    body.headPitch[f] += lean * 20 * DEG;
    for (const arm of body.arms) {
      const k = 1 - Math.min(up, down) * held;
      arm.swing[f] *= k;
      arm.elbow[f] = arm.elbow[f] * k + (1 - k) * 70 * DEG;
    }
  }
}

/** Fills the hands' places from the box's place and yaw. */
export function handsOnBox(layer: TaskLayer, frames: number): void {
  const half = layer.boxSize[0] / 2 + PALM_GAP;
  for (let f = 0; f < frames; f++) {
    if (layer.held[f] === 0 && layer.hands.weight[0][f] === 0) continue;
    if (layer.hands.weight[0][f] === 0 || layer.hands.weight[1][f] === 0) continue;
    const yaw = layer.boxYaw[f];
    const c = Math.cos(yaw);
    const s = Math.sin(yaw);
    for (let side = 0; side < 2; side++) {
      const open = (1 - layer.hands.weight[side][f]) * 0.05 + half;
      const sign = side === 0 ? 1 : -1;
      layer.hands.place[side].set(
        [
          layer.box[3 * f] + sign * c * open,
          layer.box[3 * f + 1] - 0.02 * (1 - layer.hands.weight[side][f]),
          layer.box[3 * f + 2] - sign * s * open,
        ],
        3 * f,
      );
      // Fingers forward and a little down.
      layer.hands.point[side].set([s * 0.96, -0.28, c * 0.96], 3 * f);
    }
  }
}

/** Seconds from leaving upright to the seat, and from the seat to upright. */
const RISE = 0.95;
/** Hip joints over the seat when seated, metres at 1.75 m. */
export const SEAT_UNDER_HIPS = 0.09;

function sit(event: SitEvent, body: BodyAngles, layer: TaskLayer, skeleton: Skeleton, frames: number): void {
  const { task } = event;
  const scale = skeleton.height / 1.75;
  const seatHip = task.position[1] + SEAT_UNDER_HIPS * scale;
  const rise = event.rise ?? Number.POSITIVE_INFINITY;
  const off = event.rise === null ? Number.POSITIVE_INFINITY : task.end;
  const up = off + RISE;
  for (
    let f = Math.max(0, Math.floor(task.start * CLIP_RATE));
    f < Math.min(frames, up * CLIP_RATE + 1);
    f++
  ) {
    const t = f / CLIP_RATE;
    const downU = smoothstep((t - task.start) / (task.contact - task.start)) ** 1.1;
    const riseU = off === Number.POSITIVE_INFINITY ? 0 : smoothstep((t - off) / RISE);
    const seated = Math.min(downU, 1 - riseU);
    body.hipHeight[f] += seated * (seatHip - body.hipHeight[f]);
    // Trunk forward going down and when rising; upright between.
    const leanDown = pulse(t, task.start, task.contact - 0.05, task.contact + 0.02, task.contact + 1.0);
    const leanUp = off === Number.POSITIVE_INFINITY ? 0 : pulse(t, rise, off, off + 0.05, off + RISE + 0.1);
    const lean = Math.max(leanDown, leanUp);
    body.chestPitch[f] += lean * 46 * DEG;
    body.pelvisPitch[f] += lean * 30 * DEG + seated * (1 - lean) * -8 * DEG;
    body.headPitch[f] += lean * 30 * DEG;
    const rest = seated * (1 - lean);
    for (const arm of body.arms) {
      // Hands come to rest over the thighs.
      arm.swing[f] += lean * 30 * DEG + rest * 22 * DEG;
      arm.elbow[f] += lean * 15 * DEG + rest * 24 * DEG;
      arm.turn[f] += rest * 12 * DEG;
      arm.out[f] += rest * 4 * DEG;
    }
    if (t >= task.contact && t <= off) {
      layer.pins.pinned[f] = 1;
      layer.pins.place[2 * f] = task.position[0];
      layer.pins.place[2 * f + 1] = task.position[2];
    }
  }
}
