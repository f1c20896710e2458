/**
 * A score rendered into a capture: layers from the ground up, closed by inverse kinematics, corrected so that the whole
 * body's zero-moment point follows the planned pressure. See docs/studio.md.
 */
import { CLIP_RATE, type Clip } from "../core/capture/clip.ts";
import type { Sidecar } from "../core/capture/sidecar.ts";
import { gaussian } from "../core/math/interpolate.ts";
import { JOINT_COUNT } from "../core/skeleton/joints.ts";
import { createSkeleton, type Skeleton } from "../core/skeleton/skeleton.ts";
import type { ContactTrack } from "../core/steps/types.ts";
import { shapeOf } from "./gait-shape.ts";
import { type BodyAngles, renderBody } from "./layers/body.ts";
import { type Load, pendulum, zeroMomentPoint } from "./layers/centre-of-mass.ts";
import { type FootTrack, renderFoot } from "./layers/feet.ts";
import { ballisticHeight, flightFrames, loadFactor } from "./layers/flight.ts";
import { type Gait, renderGait } from "./layers/gait.ts";
import { calmKnees } from "./layers/knees.ts";
import { loosenArms } from "./layers/loose-arms.ts";
import { closeBody, hipsOver, legsOf, placeHips, trunkRotations } from "./layers/posture.ts";
import { type Pressure, planPressure } from "./layers/pressure.ts";
import { pinSeats, smoothJoins } from "./layers/seat.ts";
import { createTaskLayer, renderTasks, type TaskLayer } from "./layers/tasks.ts";
import { layersOf, type Score } from "./score.ts";

export interface Rendered {
  clip: Clip;
  contacts: ContactTrack;
  sidecar: Sidecar;
}

/** What the layers made of a score, for those who look into it. */
export interface Workings extends Rendered {
  feet: readonly [FootTrack, FootTrack];
  gait: Gait;
  body: BodyAngles;
  pressure: Pressure;
  tasks: TaskLayer;
  /** Way of the hips over the ground, x, z a frame; by how much knees raised them, metres. */
  way: Float64Array;
  raise: Float64Array;
  /** The whole body's zero-moment point of the last round, x, z a frame; empty where balance is off. */
  zeroMoment: Float64Array;
}

/** Largest error of the zero-moment point that a round answers, metres. */
const MOST_CORRECTION = 0.09;
/** Rounds of correcting the pelvis by the whole body's zero-moment point. */
const ROUNDS = 4;
/** Under this share of the weight on the feet there is no zero-moment point to speak of. */
const LIGHT = 0.3;
const Q = 4 * JOINT_COUNT;

/** Renders a score; the same score gives the same capture. */
export function renderScore(score: Score): Rendered {
  const { clip, contacts, sidecar } = renderWorkings(score);
  return { clip, contacts, sidecar };
}

/** Renders a score and keeps every layer's tracks. */
export function renderWorkings(score: Score): Workings {
  const on = layersOf(score);
  const skeleton = createSkeleton(score.actor.height, score.actor.proportions);
  const frames = Math.max(2, Math.ceil(score.duration * CLIP_RATE) + 1);
  const feet: [FootTrack, FootTrack] = [
    renderFoot(score, "left", skeleton, frames),
    renderFoot(score, "right", skeleton, frames),
  ];
  const gait = renderGait(score, skeleton.legLength, frames);
  if (!on.rhythm) gait.amount.fill(0);
  const body = renderBody(score, feet, gait, skeleton, frames);
  const tasks = createTaskLayer(frames);
  if (on.tasks) renderTasks(score, body, tasks, skeleton, frames);
  const pressure = planPressure(score, feet, skeleton, frames);
  if (on.tasks) pinSeats(score, body, tasks, skeleton, frames);

  const clip: Clip = {
    name: score.name,
    skeleton,
    rate: CLIP_RATE,
    frames,
    root: new Float64Array(3 * frames),
    rotations: new Float64Array(Q * frames),
  };
  const positions = new Float64Array(3 * JOINT_COUNT * frames);
  const flight = on.flight ? flightFrames(feet, frames) : null;
  const { early } = shapeOf(score.actor);
  const { way, height, weight } = firstWay(pressure, body, tasks, skeleton, flight, early, on.balance);
  const wished = Float64Array.from(body.hipHeight);
  if (on.alive) loosenArms(body, gait, way);
  trunkRotations(clip, body);
  const planned = feet.map((t) => ({ ankle: t.ankle.slice(), toeBend: t.toeBend.slice() }));
  const rounds = on.balance ? ROUNDS : 0;
  let raise: Float64Array = new Float64Array(frames);
  let zeroMoment: Float64Array = new Float64Array(0);
  let load: Float64Array | null = weight;
  for (let round = 0; ; round++) {
    placeHips(clip, way, body, feet, skeleton);
    feet.forEach((t, side) => {
      t.ankle.set(planned[side].ankle);
      t.toeBend.set(planned[side].toeBend);
    });
    if (on.knees) {
      raise = calmKnees(feet, legsOf(clip, skeleton, flight));
      for (let f = 0; f < frames; f++) clip.root[3 * f + 1] += raise[f];
    }
    closeBody(clip, feet, body, tasks, skeleton, positions, round === rounds);
    if (round === rounds) break;
    const carried = tasks.load.share.some((s) => s > 0) ? tasks.load : null;
    const fallen = correct(
      { clip, body, pressure, tasks, way, wished, height, positions, early },
      flight,
      carried,
      load,
    );
    load = fallen.weight;
    zeroMoment = fallen.zeroMoment;
  }
  hemisphere(clip);
  const contacts = new Uint8Array(frames);
  for (let f = 0; f < frames; f++) contacts[f] = feet[0].contacts[f] | (feet[1].contacts[f] << 2);
  const sidecar = sidecarOf(score, contacts);
  return { clip, contacts, sidecar, feet, gait, body, pressure, tasks, way, raise, zeroMoment };
}

/** Seconds over which the hips lag the pressure where nobody asks for balance. */
const DRIFT = 0.3;

/** The hips' way before any correction: the pendulum's over the planned pressure, or, without balance, that smoothed. */
function firstWay(
  pressure: Pressure,
  body: BodyAngles,
  tasks: TaskLayer,
  skeleton: Skeleton,
  flight: Uint8Array | null,
  early: number,
  balanced: boolean,
): { way: Float64Array; height: Float64Array; weight: Float64Array | null } {
  const height = Float64Array.from(body.hipHeight, (h) => h + 0.05 * skeleton.height);
  const weight = flight ? loadFactor(ballisticHeight(height, flight, early)) : null;
  let way: Float64Array;
  if (balanced) way = pendulum(pressure.point, height, tasks.pins, weight);
  else {
    way = Float64Array.from(pressure.point);
    gaussian(way, 2, DRIFT * CLIP_RATE);
    for (let f = 0; f < height.length; f++)
      if (tasks.pins.pinned[f]) way.set(tasks.pins.place.subarray(2 * f, 2 * f + 2), 2 * f);
  }
  smoothJoins(way, tasks.pins.pinned);
  return { way, height, weight };
}

interface Round {
  clip: Clip;
  body: BodyAngles;
  pressure: Pressure;
  tasks: TaskLayer;
  way: Float64Array;
  /** Hip heights that the gait wishes. */
  wished: Float64Array;
  height: Float64Array;
  positions: Float64Array;
  /** How early the push on the ground comes. */
  early: number;
}

/** One round of bringing the whole body's zero-moment point to the planned pressure. Mutates the way and the hip heights. */
function correct(
  r: Round,
  flight: Uint8Array | null,
  carried: Load | null,
  before: Float64Array | null,
): { weight: Float64Array | null; zeroMoment: Float64Array } {
  const { clip, body, pressure, tasks, way, wished, height, positions, early } = r;
  const { frames, skeleton } = clip;
  const centre = new Float64Array(3 * frames);
  const q = zeroMomentPoint(positions, JOINT_COUNT, frames, centre, carried);
  const zeroMoment = q.slice();
  let weight = before;
  if (flight) {
    // The whole body falls freely in flight, not the pelvis alone.
    const wish = Float64Array.from(
      { length: frames },
      (_, f) => centre[3 * f + 1] + wished[f] + hipsOver(body, skeleton, f) - clip.root[3 * f + 1],
    );
    const fallen = ballisticHeight(wish, flight, early);
    for (let f = 0; f < frames; f++) body.hipHeight[f] = wished[f] + fallen[f] - wish[f];
    weight = loadFactor(fallen);
    for (let f = 0; f < frames; f++) {
      if (weight[f] >= LIGHT) continue;
      q[2 * f] = pressure.point[2 * f];
      q[2 * f + 1] = pressure.point[2 * f + 1];
    }
  }
  // A leg out of reach throws its zero-moment point far off: one round believes a hand's breadth at most.
  for (let k = 0; k < q.length; k++)
    q[k] = Math.max(-MOST_CORRECTION, Math.min(MOST_CORRECTION, pressure.point[k] - q[k]));
  for (let f = 0; f < frames; f++) if (tasks.pins.pinned[f]) q[2 * f] = q[2 * f + 1] = 0;
  gaussian(q, 2, 2);
  const still = { pinned: tasks.pins.pinned, place: new Float64Array(2 * frames) };
  const correction = pendulum(q, height, still, weight);
  smoothJoins(correction, tasks.pins.pinned);
  for (let k = 0; k < way.length; k++) way[k] += correction[k];
  return { weight, zeroMoment };
}

/** Consecutive rotations in one hemisphere. */
function hemisphere(clip: Clip): void {
  const r = clip.rotations;
  for (let f = 1; f < clip.frames; f++) {
    for (let j = 0; j < JOINT_COUNT; j++) {
      const a = Q * f + 4 * j;
      const b = a - Q;
      if (r[a] * r[b] + r[a + 1] * r[b + 1] + r[a + 2] * r[b + 2] + r[a + 3] * r[b + 3] < 0)
        for (let k = 0; k < 4; k++) r[a + k] = -r[a + k];
    }
  }
}

function sidecarOf(score: Score, contacts: ContactTrack): Sidecar {
  const runs = (bit: number): [number, number][] => {
    const out: [number, number][] = [];
    let from = -1;
    for (let f = 0; f <= contacts.length; f++) {
      const on = f < contacts.length && (contacts[f] & bit) !== 0;
      if (on && from < 0) from = f;
      if (!on && from >= 0) {
        out.push([from, f]);
        from = -1;
      }
    }
    return out;
  };
  const lift = score.events.find((e) => e.type === "lift");
  return {
    version: 1,
    name: score.name,
    licence: "CC0-1.0",
    height: score.actor.height,
    rate: CLIP_RATE,
    tasks: score.events.map((e) => e.task),
    contacts: { leftHeel: runs(1), leftToe: runs(2), rightHeel: runs(4), rightToe: runs(8) },
    steps: score.steps.map((s) => ({
      foot: s.foot,
      category: s.kind,
      lift: s.lift,
      land: s.land,
      x: s.x,
      z: s.z,
      yaw: s.yaw,
    })),
    ...(lift && lift.type === "lift" ? { load: lift.mass } : {}),
  };
}
