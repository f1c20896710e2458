/**
 * Foot constraints [Express §7.1]: each plant gets one place and one yaw, and the ankle's way between plants passes into them.
 *
 * Where a foot rests it rolls in closed form about heel, ball and tip, so that nothing slides; its place is the mean of where
 * the unconstrained foot would be, its yaw the mean swivel. In the air the unconstrained path is displaced by a Hermite curve
 * that takes over place and speed at both ends.
 */
import { wrapAngle } from "../math/angle.ts";
import { smoothstep, softEnvelope } from "../math/interpolate.ts";
import { contactsOfPitch, plantedAnkle } from "../motion/sole.ts";
import type { FootShape } from "../skeleton/skeleton.ts";
import type { Foot } from "../steps/types.ts";

/** Feet over a motion; a row a frame, left then right. */
export interface FeetTrack {
  frames: number;
  /** Print on the ground as if the foot were flat: x, up, z. In: unconstrained. */
  print: Float64Array;
  yaw: Float64Array;
  /** Toe up positive. */
  pitch: Float64Array;
  toeBend: Float64Array;
  /** What of the foot's rotation yaw and pitch leave out: a rotation vector in its own frame, 3 a foot. */
  tilt: Float64Array;
  /** Bit a foot. */
  down: Uint8Array;
  /** Standing still in its final place (1) or moving. */
  still: Uint8Array;
  /** Starting or stopping (1) or at full stride. */
  slow: Uint8Array;
  /** Out: ankle joints, x, y, z. */
  ankle: Float64Array;
  contacts: Uint8Array;
}

/** Where a foot rests, and when. */
export interface StylePlant {
  foot: Foot;
  x: number;
  z: number;
  yaw: number;
  /** First frame, and one past the last. */
  from: number;
  to: number;
}

export function createFeetTrack(frames: number): FeetTrack {
  return {
    frames,
    print: new Float64Array(6 * frames),
    yaw: new Float64Array(2 * frames),
    pitch: new Float64Array(2 * frames),
    toeBend: new Float64Array(2 * frames),
    tilt: new Float64Array(6 * frames),
    down: new Uint8Array(frames),
    still: new Uint8Array(frames),
    slow: new Uint8Array(frames),
    ankle: new Float64Array(6 * frames),
    contacts: new Uint8Array(frames),
  };
}

/** Flat foot: pitches that count fully for the place of a plant, radians. */
const FLAT = 0.12;
/** Clearance of a swinging sole, metres at a leg of 0.93 m. */
const CLEAR = 0.008;
/** A foot that would scrape is raised over so many frames either side; in the first and last share of its way it is not. */
const LIFT_OVER = 6;
const LIFT_ENDS = 5;
/** Its tilt comes and goes over such a share of its way: the inverse. */
const TILT_ENDS = 4;
/** Largest speed difference that the way between plants takes over, metres a frame. */
const MOST_SPEED = 0.012;

const out = new Float64Array(3);

/** Ankle joint of a print at a pitch. */
function ankleOf(shape: FootShape, x: number, y: number, z: number, yaw: number, pitch: number): void {
  plantedAnkle(out, shape, Math.max(-1.5, Math.min(0.8, pitch)));
  const ahead = out[0];
  const up = out[1];
  const bend = out[2];
  out[0] = x + Math.sin(yaw) * ahead;
  out[1] = y + up;
  out[2] = z + Math.cos(yaw) * ahead;
  plantBend = bend;
}
let plantBend = 0;

/** Unconstrained ankles, for showing what the constraints are there for; contacts are claimed as if they held. */
export function freeFeet(track: FeetTrack, shape: FootShape): void {
  for (let f = 0; f < track.frames; f++) {
    let bits = 0;
    for (let side = 0; side < 2; side++) {
      const i = 2 * f + side;
      const p = 6 * f + 3 * side;
      ankleOf(shape, track.print[p], track.print[p + 1], track.print[p + 2], track.yaw[i], track.pitch[i]);
      for (let k = 0; k < 3; k++) track.ankle[p + k] = out[k];
      if ((track.down[f] >> side) & 1) bits |= contactsOfPitch(track.pitch[i]) << (2 * side);
    }
    track.contacts[f] = bits;
  }
}

/** Plants of a track in order of time, placed by the mean of their frames. */
export function findPlants(track: FeetTrack): StylePlant[] {
  const plants: StylePlant[] = [];
  for (let side = 0; side < 2; side++) {
    for (let f = 0; f < track.frames; f++) {
      if (!((track.down[f] >> side) & 1)) continue;
      let to = f;
      let x = 0;
      let z = 0;
      let turn = 0;
      let total = 0;
      const yaw0 = track.yaw[2 * f + side];
      for (; to < track.frames && (track.down[to] >> side) & 1; to++) {
        const i = 2 * to + side;
        const flat = track.pitch[i] / FLAT;
        // Flat frames say best where the foot is; where it stands still they alone do.
        const w = (track.still[to] ? 200 : 1) / (1 + flat * flat * flat * flat);
        x += w * track.print[6 * to + 3 * side];
        z += w * track.print[6 * to + 3 * side + 2];
        turn += w * wrapAngle(track.yaw[i] - yaw0);
        total += w;
      }
      plants.push({
        foot: side === 0 ? "left" : "right",
        x: x / total,
        z: z / total,
        yaw: wrapAngle(yaw0 + turn / total),
        from: f,
        to,
      });
      f = to;
    }
  }
  return plants.sort((a, b) => a.from - b.from || (a.foot < b.foot ? -1 : 1));
}

const DEG = Math.PI / 180;

/** What tells that heel or toes of a resting foot hover: pitches, radians, up from flat. */
interface Hover {
  /** Between these it is neither on the ground nor clearly off it: 3.5 and 15 mm at its point. */
  down: number;
  off: number;
  /** One that turns by less than `slow` a frame (12 cm/s at its point) and is up by less than `still` (18 mm) stops. */
  slow: number;
  still: number;
  /** Where it hovers, what is up by less than the first lies down; from the second on it is up as it was. */
  lies: number;
  up: number;
}
const HEEL: Hover = {
  down: 1.2 * DEG,
  off: 4.5 * DEG,
  slow: 0.0125,
  still: 5.5 * DEG,
  lies: DEG,
  up: 5.5 * DEG,
};
const TOE: Hover = {
  down: 0.8 * DEG,
  off: 3.4 * DEG,
  slow: 0.008,
  still: 4.2 * DEG,
  lies: 0.7 * DEG,
  up: 4.2 * DEG,
};
/** What is between ground and air for so many frames hovers: one that is lifted or put down passes through in five. So many still ones stop. */
const HOVER_FRAMES = 6;
const STILL_FRAMES = 4;
/** Times that it is put down at most. */
const SETTLE_TIMES = 6;
/** At its ends a plant keeps its pitch, frames: it has to meet the air's; where it leaves the ground nearly flat, fewer are enough. */
const PLANT_ENDS = 4;
const LEAVES_FLAT = 1.5;

/**
 * Puts hovering heels and toes down: shorter strides, blends and stops raise the heel of a resting foot, or lower its toes, so slowly
 * or so little that they would neither bear nor leave the ground. They stay down longer, then rise as others do, or come down
 * earlier. Not in the paper.
 */
export function settleFeet(track: FeetTrack, plants: readonly StylePlant[]): void {
  for (const plant of plants) {
    const side = plant.foot === "left" ? 0 : 1;
    const flat = track.pitch[2 * (plant.to - 1) + side] > -HEEL.off;
    for (const [way, limits] of [
      [-1, HEEL],
      [1, TOE],
    ] as const) {
      const leaves = way < 0 && flat ? LEAVES_FLAT : PLANT_ENDS;
      // What hovered higher may hover lower then: another time brings it down, and what still hovers lies down whole.
      for (let time = 0; time <= SETTLE_TIMES && hovers(track, plant, side, way, limits); time++) {
        const [lies, from] =
          time < SETTLE_TIMES ? [limits.lies, limits.up] : [limits.still, 1.5 * limits.still];
        for (let f = plant.from; f < plant.to; f++) {
          const i = 2 * f + side;
          const up = way * track.pitch[i];
          if (up <= 0) continue;
          const down = 1 - smoothstep((up - lies) / (from - lies));
          const inside = smoothstep((f - plant.from + 1) / PLANT_ENDS) * smoothstep((plant.to - f) / leaves);
          track.pitch[i] *= 1 - down * inside;
        }
      }
    }
  }
}

/** Whether a plant's heel (way -1) or toes (1) stay between the ground and clearly off it, or as good as stop there. */
function hovers(track: FeetTrack, plant: StylePlant, side: number, way: 1 | -1, limits: Hover): boolean {
  let run = 0;
  let still = 0;
  for (let f = plant.from; f < plant.to; f++) {
    const up = way * track.pitch[2 * f + side];
    run = up > limits.down && up < limits.off ? run + 1 : 0;
    const slow = Math.abs(up - way * track.pitch[2 * Math.max(plant.from, f - 1) + side]) < limits.slow;
    still = slow && !rests(up, way) && up < limits.still ? still + 1 : 0;
    if (run >= HOVER_FRAMES || still >= STILL_FRAMES) return true;
  }
  return false;
}

/** Whether heel or toes that are up by so much are claimed as planted. */
const rests = (up: number, way: 1 | -1): boolean => (contactsOfPitch(way * up) & (way < 0 ? 1 : 2)) !== 0;

/**
 * Enforces plants: writes ankles, yaws, toe bends and contacts.
 *
 * @param plants from `findPlants`, perhaps moved.
 */
export function constrainFeet(
  track: FeetTrack,
  plants: readonly StylePlant[],
  shape: FootShape,
  leg: number,
): void {
  const n = track.frames;
  // Displacement of ankle (3), yaw and toe bend where a foot is down.
  const shift = new Float64Array(5 * n);
  track.contacts.fill(0);
  for (let side = 0; side < 2; side++) {
    const foot = side === 0 ? "left" : "right";
    const own = plants.filter((p) => p.foot === foot);
    for (let f = 0; f < n; f++) {
      const i = 2 * f + side;
      const p = 6 * f + 3 * side;
      ankleOf(shape, track.print[p], track.print[p + 1], track.print[p + 2], track.yaw[i], track.pitch[i]);
      for (let k = 0; k < 3; k++) track.ankle[p + k] = out[k];
    }
    for (const plant of own) {
      for (let f = plant.from; f < plant.to; f++) {
        const i = 2 * f + side;
        const p = 6 * f + 3 * side;
        ankleOf(shape, plant.x, 0, plant.z, plant.yaw, track.pitch[i]);
        const s = 5 * f;
        for (let k = 0; k < 3; k++) shift[s + k] = out[k] - track.ankle[p + k];
        shift[s + 3] = wrapAngle(plant.yaw - track.yaw[i]);
        shift[s + 4] = plantBend - track.toeBend[i];
        for (let k = 0; k < 3; k++) {
          track.ankle[p + k] = out[k];
          track.tilt[p + k] = 0;
        }
        track.yaw[i] += shift[s + 3];
        track.toeBend[i] = plantBend;
        track.contacts[f] |= contactsOfPitch(track.pitch[i]) << (2 * side);
      }
    }
    for (let k = 0; k <= own.length; k++)
      swing(track, side, k > 0 ? own[k - 1] : null, own[k] ?? null, shift, shape, leg);
  }
}

/**
 * A foot this near to where it will rest, or has rested, rests there already: across and over the ground, metres. One that
 * stays for a while just over its place, at a stop, was put down there long ago.
 */
const RESTS_ACROSS = 0.006;
const RESTS_OVER = 0.008;
const HOVERS_OVER = 0.022;
const HOVERS_FOR = 6;
/** A plant grows by so many frames at most, at either end. */
const MOST_GROWTH = 45;

/**
 * At starts and stops plants grow over the frames in which the constrained foot is as good as in its place, and anywhere over those
 * in which it hovers there: what stands on the ground is claimed.
 *
 * @param plants from `findPlants`, changed in place. @returns whether any grew: the feet are to be constrained anew.
 */
export function growPlants(track: FeetTrack, plants: readonly StylePlant[]): boolean {
  let grown = false;
  for (const plant of plants) {
    const side = plant.foot === "left" ? 0 : 1;
    const bit = 1 << side;
    const free = (f: number) => f >= 0 && f < track.frames && (track.down[f] & bit) === 0;
    /** Frames from `rest` on, in one direction, that are near to it. */
    const frames = (rest: number, way: 1 | -1, over: number): number => {
      let n = 0;
      const b = 6 * rest + 3 * side;
      const { ankle } = track;
      // One frame of air is left to a neighbour that stands.
      while (n < MOST_GROWTH && free(rest + way * (n + 2))) {
        const a = b + 6 * way * (n + 1);
        const across = Math.hypot(ankle[a] - ankle[b], ankle[a + 2] - ankle[b + 2]);
        if (across > RESTS_ACROSS || Math.abs(ankle[a + 1] - ankle[b + 1]) > over) break;
        n++;
      }
      return n;
    };
    for (const way of [-1, 1] as const) {
      const rest = way < 0 ? plant.from : plant.to - 1;
      const hovering = frames(rest, way, HOVERS_OVER);
      if (hovering < HOVERS_FOR && !track.slow[rest]) continue;
      const n = hovering >= HOVERS_FOR ? hovering : frames(rest, way, RESTS_OVER);
      for (let k = 1; k <= n; k++) track.down[rest + way * k] |= bit;
      if (way < 0) plant.from -= n;
      else plant.to += n;
      grown ||= n > 0;
    }
  }
  return grown;
}

/** The air between two plants; before the first or after the last, one end's displacement is kept. */
function swing(
  track: FeetTrack,
  side: number,
  before: StylePlant | null,
  after: StylePlant | null,
  shift: Float64Array,
  shape: FootShape,
  leg: number,
): void {
  const last = before ? before.to - 1 : -1;
  const next = after ? after.from : track.frames;
  const length = next - last;
  const need = new Float64Array(Math.max(0, length - 1));
  for (let f = last + 1; f < next; f++) {
    const u = (f - last) / length;
    const v = 1 - u;
    const i = 2 * f + side;
    const p = 6 * f + 3 * side;
    // Quintic ease between the ends' displacements; speeds are taken over near each end.
    const s = before && after ? u * u * u * (10 + u * (6 * u - 15)) : after ? 1 : 0;
    const h0 = before && after ? length * u * v ** 4 : 0;
    const h1 = before && after ? length * v * u ** 4 : 0;
    for (let k = 0; k < 5; k++) {
      const a = before ? shift[5 * last + k] : 0;
      const b = after ? shift[5 * next + k] : 0;
      // Bent toes spring back when they lift: what bent them on the ground does not go on in the air.
      const most = k === 4 ? 0 : MOST_SPEED * (leg / 0.93) * (k === 3 ? 8 : 1);
      const m0 = before && before.to - before.from > 1 ? clamp(a - shift[5 * (last - 1) + k], most) : 0;
      const m1 = after && after.to - after.from > 1 ? clamp(shift[5 * (next + 1) + k] - b, most) : 0;
      const d = (1 - s) * a + s * b + h0 * m0 - h1 * m1;
      if (k < 3) track.ankle[p + k] += d;
      else if (k === 3) track.yaw[i] += d;
      else track.toeBend[i] += d;
    }
    const wanted = CLEAR * (leg / 0.93) * Math.min(1, 6 * u, 6 * v);
    const low = track.ankle[p + 1] + lowestOf(shape, track.pitch[i], track.toeBend[i]);
    need[f - last - 1] = Math.max(0, wanted - low);
  }
  if (before && before.to - before.from > 1) springBack(track, side, last, next);
  // Raised where it would scrape, softly, and nowhere else.
  const lift = softEnvelope(need, Math.max(2, Math.min(LIFT_OVER, length >> 2)));
  for (let f = last + 1; f < next; f++) {
    const u = (f - last) / length;
    const i = 2 * f + side;
    const p = 6 * f + 3 * side;
    // A resting foot is not tilted; in the air it is as in the sample.
    const free = (before ? smoothstep(TILT_ENDS * u) : 1) * (after ? smoothstep(TILT_ENDS * (1 - u)) : 1);
    for (let k = 0; k < 3; k++) track.tilt[p + k] *= free;
    track.ankle[p + 1] += lift[f - last - 1] * smoothstep(LIFT_ENDS * u) * smoothstep(LIFT_ENDS * (1 - u));
    // What this does not reach, near the ends: the toes give way, then the ankle.
    const heelAndBall = track.ankle[p + 1] + lowestOf(shape, track.pitch[i], 1);
    if (heelAndBall < 0) track.ankle[p + 1] -= heelAndBall;
    const grounded = tipClearBend(shape, track.pitch[i], track.ankle[p + 1] + 1e-4);
    if (grounded > track.toeBend[i]) track.toeBend[i] = Math.min(grounded, track.toeBend[i] + MOST_TOE_GIVE);
  }
}

/** Frames in which toes that leave the ground come round to the sample's bend, and the rate of the damped spring that they are, a frame. */
const SPRING_OVER = 16;
const SPRING = 0.5;

/** The bend goes on as it was on the ground; let go at once, toes of runners snapped down faster than the sample's. */
function springBack(track: FeetTrack, side: number, last: number, next: number): void {
  const at = (f: number): number => 2 * f + side;
  let bend = track.toeBend[at(last)];
  let speed = bend - track.toeBend[at(last - 1)];
  const over = Math.min(SPRING_OVER, (next - last) >> 1);
  for (let k = 1; k < over; k++) {
    const i = at(last + k);
    speed += SPRING * SPRING * (track.toeBend[i] - bend) - 2 * SPRING * speed;
    bend += speed;
    track.toeBend[i] += (1 - smoothstep(k / over)) * (bend - track.toeBend[i]);
  }
}

const clamp = (v: number, most: number): number => Math.max(-most, Math.min(most, v));

/** Most that toes give way in the air, radians. */
const MOST_TOE_GIVE = 0.64;

/** The toe bend at which the tip just touches the ground, the ankle joint `height` over it; radians. */
function tipClearBend(shape: FootShape, pitch: number, height: number): number {
  const joint =
    shape.ballForward * Math.sin(pitch) - (shape.ankleHeight - shape.ballHeight) * Math.cos(pitch);
  const reach = Math.hypot(shape.tipForward, shape.ballHeight);
  const steep = Math.asin(Math.max(-1, Math.min(1, -(height + joint) / reach)));
  return steep + Math.atan2(shape.ballHeight, shape.tipForward) - pitch;
}

/** Height of the lowest of heel, ball and tip against the ankle joint. */
function lowestOf(shape: FootShape, pitch: number, bend: number): number {
  const s = Math.sin(pitch);
  const c = Math.cos(pitch);
  const heel = -shape.heelBack * s - shape.ankleHeight * c;
  const joint = shape.ballForward * s - (shape.ankleHeight - shape.ballHeight) * c;
  const ball = joint - shape.ballHeight * c;
  const tip = joint + shape.tipForward * Math.sin(pitch + bend) - shape.ballHeight * Math.cos(pitch + bend);
  return Math.min(heel, ball, tip);
}
