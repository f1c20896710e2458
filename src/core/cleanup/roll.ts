/**
 * How a foot must move so that what is planted rests [Kovar et al. 2002, §4; Oracle §7]: a roll over its pads in closed form.
 *
 * Between two frames a planted foot turns about one point of its planted pad: the heel's at strike, the ball's, the tip's, or the
 * toe joint itself. Which one, the capture says: the point that moves least. What that point still moves is the slide, and it is
 * taken out frame by frame; summed over the plant this leaves one place to choose, the nearest to the capture's. Nothing is
 * guessed about where the foot rolls from heel to toe, so the roll survives.
 */
import { gaussian } from "../math/interpolate.ts";
import { PAD, PAD_ROW, type PadTrack } from "./soles.ts";

/**
 * Correction of a foot: tilts of foot and toes about the foot's level left (radians, heel up positive), a turn about the upright through its ankle (from the first ground axis to the second), then a move.
 */
export interface FootCorrection {
  tilt: Float64Array;
  toeTilt: Float64Array;
  turn: Float64Array;
  /** Where the captured foot points on the ground: frames x 2, of length 1. */
  heading: Float64Array;
  /** frames x 3: two ground axes, height; metres. */
  move: Float64Array;
  /** Planted stretches, first frame and one past the last, with the still frames beside them. */
  plants: { from: number; to: number }[];
}

export interface RollOptions {
  rate: number;
  /** Leg length, metres. */
  leg: number;
  /** Seconds in which a correction comes and goes where no plant is: 30 frames at 60 Hz [Oracle §7]. */
  blend: number;
}

/**
 * A foot that is still low and slow beside its plant belongs to it, for so long: seconds, metres, metres a second at a leg of 0.93 m.
 * Longer and faster, clean-up moved the feet of motions that slide by half a millimetre by 9 cm in the air; much shorter or slower, it
 * misses what an oracle's label ends too early.
 */
const BESIDE = 0.05;
const BESIDE_HEIGHT = 0.06;
const BESIDE_SPEED = 0.7;
/**
 * A label is good to a frame: beside it, while the foot's other pad bears, a slow pad that is no higher than this bears too, for so
 * long. Seconds; metres and metres a second at a leg of 0.93 m.
 */
const PAD_BESIDE = 0.034;
const PAD_RISE = 0.014;
const PAD_SPEED = 0.3;
/** Faster than this nothing stands, whatever its label: metres a second at a leg of 0.93 m. */
const LANDED = 0.9;
/** Faster than this the figure is elsewhere, metres a second at a leg of 0.93 m. */
const JUMP = 8;
/** Softness of what is done to heights, seconds. */
const HEIGHT_SOFT = 0.1;
/**
 * A frame in which heel or toe alone bears says so much of a plant's height, against one of a flat foot. Pads hang over the ground
 * at strike and push-off; with as much to say they pulled the flat foot of a run under it, by 5 mm.
 */
const EDGE_SAYS = 0.1;
/** Plants whose heights differ by more than this are taken to stand on uneven ground, metres at a leg of 0.93 m. */
const UNEVEN = 0.075;
/** A correction that moves at a plant's edge comes to rest within this time, seconds. */
const SETTLE = 0.13;

/** Of what the slope of a flat foot changes, this share is taken out; it fades beside the flat frames in so many seconds. */
const SLOPE_SHARE = 0.95;
const SLOPE_FADE = 0.1;

const smooth = (u: number): number => {
  const t = Math.max(0, Math.min(1, u));
  return t * t * (3 - 2 * t);
};

interface Plant {
  /** First frame and one past the last, with the frames beside it. */
  from: number;
  to: number;
  /** Of its flat frames, or of all: the capture's height of what bears. */
  height: number;
}

/**
 * The corrections of one foot.
 *
 * @param bits contact bits a frame: 1 heel, 2 toe.
 * @param gain what a metre costs the knee, radians, a frame: a plant stays nearest to the capture where the leg is straight.
 */
export function correctFoot(
  pads: PadTrack,
  bits: Uint8Array,
  gain: Float64Array,
  o: RollOptions,
): FootCorrection {
  const n = pads.frames;
  const out: FootCorrection = {
    tilt: new Float64Array(n),
    toeTilt: new Float64Array(n),
    turn: new Float64Array(n),
    heading: new Float64Array(2 * n),
    move: new Float64Array(3 * n),
    plants: [],
  };
  for (let f = 0; f < n; f++) {
    const o = f * PAD_ROW;
    const x = pads.points[o + PAD.joint] - pads.points[o + PAD.heelFar];
    const z = pads.points[o + PAD.joint + 1] - pads.points[o + PAD.heelFar + 1];
    const l = Math.hypot(x, z) || 1;
    out.heading[2 * f] = x / l;
    out.heading[2 * f + 1] = z / l;
  }
  const points = pads.points.slice();
  const { plants, worn } = findPlants(pads, bits, o);
  out.plants = plants;
  for (const plant of plants) {
    holdSlopes(points, worn, plant, out, o.rate);
    holdHeading(points, worn, plant, out.turn);
    rollPlant(points, worn, gain, plant, out.move);
  }
  levelPlants(pads, points, worn, plants, out.move, o);
  blendBetween(plants, n, o, out);
  return out;
}

/** Plants, and bits that include the still frames beside them. */
function findPlants(pads: PadTrack, bits: Uint8Array, o: RollOptions): { plants: Plant[]; worn: Uint8Array } {
  const n = pads.frames;
  const worn = bits.slice();
  const plants: Plant[] = [];
  const scale = o.leg / 0.93;
  const reach = Math.round(BESIDE * o.rate);
  const slide = new Float64Array(2);
  const lowest = (f: number, bit: number): number => Math.min(...padHeights(pads.points, f, bit));
  // Heights over where the pad bears: an edited motion may float as a whole.
  const beside = (f: number, g: number, bit: number, edge: number): boolean => {
    stillest(slide, pads.points, Math.min(f, g), bit);
    return (
      lowest(f, bit) - lowest(edge, bit) < BESIDE_HEIGHT * scale &&
      Math.hypot(slide[0], slide[1]) * o.rate < BESIDE_SPEED * scale
    );
  };
  // Nothing that is planted is carried elsewhere in a frame: a capture that jumps begins anew there.
  const jumps = (f: number): boolean => {
    const a = f * PAD_ROW + PAD.joint;
    const b = a + PAD_ROW;
    const x = pads.points[b] - pads.points[a];
    const z = pads.points[b + 1] - pads.points[a + 1];
    return Math.hypot(x, z) * o.rate > JUMP * scale;
  };
  for (let f = 0; f < n; ) {
    if (!bits[f]) {
      f++;
      continue;
    }
    let to = f + 1;
    while (to < n && bits[to] && !jumps(to - 1)) to++;
    const labelled = to;
    let from = f;
    // A label that comes a frame too early or goes a frame too late holds a foot that no force holds.
    const fast = (g: number, bit: number): boolean => {
      stillest(slide, pads.points, g, bit);
      return Math.hypot(slide[0], slide[1]) * o.rate > LANDED * scale;
    };
    while (from + 2 < to && bits[from] !== 3 && fast(from, bits[from])) worn[from++] = 0;
    while (to - 2 > from && bits[to - 1] !== 3 && fast(to - 2, bits[to - 1])) worn[--to] = 0;
    const lastEnd = plants.length > 0 ? plants[plants.length - 1].to : 0;
    const first = from;
    for (let k = 0; k < reach && from > lastEnd + 1; k++) {
      const bit = bits[f] & 1 ? 1 : 2;
      if (!beside(from - 1, from, bit, first)) break;
      from--;
      worn[from] = bit;
    }
    let end = to;
    for (let k = 0; k < reach && end < n && !bits[end]; k++) {
      const bit = bits[to - 1] & 2 ? 2 : 1;
      if (!beside(end, end - 1, bit, to - 1)) break;
      worn[end] = bit;
      end++;
    }
    plants.push({ from, to: end, height: 0 });
    f = Math.max(labelled, end);
  }
  for (const plant of plants) widenPads(pads.points, worn, plant, o);
  return { plants, worn };
}

/** Within a plant: each pad's stretches grow over the frames beside them in which it all but rests on the ground. */
function widenPads(points: Float64Array, worn: Uint8Array, { from, to }: Plant, o: RollOptions): void {
  const scale = o.leg / 0.93;
  const reach = Math.max(1, Math.round(PAD_BESIDE * o.rate));
  const slide = new Float64Array(2);
  const labelled = worn.slice(from, to);
  for (const bit of [1, 2]) {
    const bears = (f: number): boolean => (labelled[f - from] & bit) !== 0;
    const low = (f: number): number => Math.min(...padHeights(points, f, bit));
    const widen = (edge: number, step: 1 | -1): void => {
      for (let k = 1; k <= reach; k++) {
        const f = edge + k * step;
        if (f < from || f >= to || bears(f) || labelled[f - from] === 0) return;
        stillest(slide, points, step > 0 ? f - 1 : f, bit);
        if (Math.hypot(slide[0], slide[1]) * o.rate > PAD_SPEED * scale) return;
        if (low(f) - low(edge) > PAD_RISE * scale) return;
        worn[f] |= bit;
      }
    };
    for (let f = from; f < to; f++) {
      if (!bears(f)) continue;
      if (f > from && !bears(f - 1)) widen(f, -1);
      if (f + 1 < to && !bears(f + 1)) widen(f, 1);
    }
  }
}

const padHeights = (points: Float64Array, f: number, bit: number): [number, number] => {
  const o = f * PAD_ROW + 2;
  return bit === 1
    ? [points[o + PAD.heelNear], points[o + PAD.heelFar]]
    : [points[o + PAD.ball], points[o + PAD.tip]];
};

/** What the stillest point of a pad moves on the ground from frame f to the next. */
export function stillest(out: Float64Array, points: Float64Array, f: number, bit: number): void {
  const a = f * PAD_ROW + (bit === 1 ? PAD.heelNear : PAD.ball);
  const b = f * PAD_ROW + (bit === 1 ? PAD.heelFar : PAD.tip);
  const ax = points[a + PAD_ROW] - points[a];
  const az = points[a + PAD_ROW + 1] - points[a + 1];
  const ex = points[b + PAD_ROW] - points[b] - ax;
  const ez = points[b + PAD_ROW + 1] - points[b + 1] - az;
  const e = ex * ex + ez * ez;
  const u = e > 1e-16 ? Math.max(0, Math.min(1, -(ax * ex + az * ez) / e)) : 0;
  out[0] = ax + u * ex;
  out[1] = az + u * ez;
  if (bit === 1) return;
  // Captures without bending toes turn the foot about the toe joint itself.
  const j = f * PAD_ROW + PAD.joint;
  const jx = points[j + PAD_ROW] - points[j];
  const jz = points[j + PAD_ROW + 1] - points[j + 1];
  if (jx * jx + jz * jz >= out[0] * out[0] + out[1] * out[1]) return;
  out[0] = jx;
  out[1] = jz;
}

/**
 * What heel and toe move in common: of the toe pad and the toe joint, whatever goes with the heel. The stillest of each alone would
 * do for a foot that rolls on the spot; where the whole figure drifts it is the one that happens to go against the drift.
 */
function slideOfBoth(out: Float64Array, points: Float64Array, f: number): void {
  stillest(out, points, f, 1);
  const hx = out[0];
  const hz = out[1];
  const step = (at: number): [number, number] => {
    const o = f * PAD_ROW + at;
    return [points[o + PAD_ROW] - points[o], points[o + PAD_ROW + 1] - points[o + 1]];
  };
  const [ax, az] = step(PAD.ball);
  const [bx, bz] = step(PAD.tip);
  const [jx, jz] = step(PAD.joint);
  const ex = bx - ax;
  const ez = bz - az;
  const e = ex * ex + ez * ez;
  const u = e > 1e-16 ? Math.max(0, Math.min(1, ((hx - ax) * ex + (hz - az) * ez) / e)) : 0;
  const tx = ax + u * ex;
  const tz = az + u * ez;
  const pad = Math.hypot(tx - hx, tz - hz) <= Math.hypot(jx - hx, jz - hz);
  out[0] = (hx + (pad ? tx : jx)) / 2;
  out[1] = (hz + (pad ? tz : jz)) / 2;
}

/**
 * Tilts foot and toes so that their slopes change less while heel and toe are both down: a foot that rests on both does not pitch.
 * What they are tilted at the first and last flat frame fades in the frames beside.
 */
function holdSlopes(
  points: Float64Array,
  bits: Uint8Array,
  { from, to }: Plant,
  out: FootCorrection,
  rate: number,
): void {
  const flats: number[] = [];
  for (let f = from; f < to; f++) if (bits[f] === 3) flats.push(f);
  if (flats.length < 2) return;
  const fade = Math.max(1, SLOPE_FADE * rate);
  const hold = (tilt: Float64Array, back: number, front: number): void => {
    const slope = (f: number): number => {
      const o = f * PAD_ROW;
      const along =
        (points[o + front] - points[o + back]) * out.heading[2 * f] +
        (points[o + front + 1] - points[o + back + 1]) * out.heading[2 * f + 1];
      return Math.atan2(points[o + back + 2] - points[o + front + 2], along);
    };
    const held = flats.map(slope).sort((a, b) => a - b)[flats.length >> 1];
    for (const f of flats) tilt[f] = SLOPE_SHARE * (held - slope(f));
    for (let f = from; f < to; f++) {
      if (bits[f] === 3) continue;
      const nearest = flats.reduce((best, g) => (Math.abs(g - f) < Math.abs(best - f) ? g : best));
      tilt[f] = tilt[nearest] * (1 - smooth(Math.abs(nearest - f) / fade));
    }
  };
  hold(out.tilt, PAD.heelFar, PAD.joint);
  hold(out.toeTilt, PAD.ball, PAD.tip);
  for (let f = from; f < to; f++) tiltPoints(points, f, out);
}

/** Turns what belongs to the foot about the ankle, heel up; the toes go with their joint and have their own tilt. */
function tiltPoints(points: Float64Array, f: number, { heading, tilt, toeTilt }: FootCorrection): void {
  const o = f * PAD_ROW;
  const x = heading[2 * f];
  const z = heading[2 * f + 1];
  const before = [0, 1, 2].map((k) => points[o + PAD.joint + k]);
  const swing = (at: number, centre: readonly number[], angle: number): void => {
    const c = Math.cos(angle);
    const s = Math.sin(angle);
    const along = (points[o + at] - centre[0]) * x + (points[o + at + 1] - centre[1]) * z;
    const rise = points[o + at + 2] - centre[2];
    const moved = c * along + s * rise - along;
    points[o + at] += moved * x;
    points[o + at + 1] += moved * z;
    points[o + at + 2] = centre[2] + c * rise - s * along;
  };
  for (const at of [PAD.ball, PAD.tip]) swing(at, before, toeTilt[f]);
  const ankle = [points[o], points[o + 1], points[o + 2]];
  for (const at of [PAD.heelNear, PAD.heelFar, PAD.joint]) swing(at, ankle, tilt[f]);
  for (const at of [PAD.ball, PAD.tip])
    for (let k = 0; k < 3; k++) points[o + at + k] += points[o + PAD.joint + k] - before[k];
}

/**
 * Turns the foot so that its heading stays while heel and toe are both down; between such stretches the turn goes over from one to
 * the other, before the first and after the last it stays. Each stretch has a heading of its own: a foot that turns on the spot
 * swivels on heel or toe between them.
 */
function holdHeading(points: Float64Array, bits: Uint8Array, { from, to }: Plant, turn: Float64Array): void {
  const heading = (f: number): [number, number] => {
    const o = f * PAD_ROW;
    const dx = points[o + PAD.ball] - points[o + PAD.heelFar];
    const dz = points[o + PAD.ball + 1] - points[o + PAD.heelFar + 1];
    const l = Math.hypot(dx, dz) || 1;
    return [dx / l, dz / l];
  };
  let last = -1;
  for (let first = from; first < to; first++) {
    if (bits[first] !== 3) continue;
    let end = first;
    let x = 0;
    let z = 0;
    for (; end < to && bits[end] === 3; end++) {
      const [dx, dz] = heading(end);
      x += dx;
      z += dz;
    }
    for (let f = first; f < end; f++) {
      const [dx, dz] = heading(f);
      turn[f] = Math.atan2(dx * z - dz * x, dx * x + dz * z);
    }
    for (let f = last < 0 ? from : last + 1; f < first; f++)
      turn[f] =
        last < 0
          ? turn[first]
          : turn[last] + smooth((f - last) / (first - last)) * (turn[first] - turn[last]);
    last = end - 1;
    first = last;
  }
  if (last < 0) return;
  turn.fill(turn[last], last + 1, to);
  for (let f = from; f < to; f++) {
    const c = Math.cos(turn[f]);
    const s = Math.sin(turn[f]);
    const o = f * PAD_ROW;
    for (let k = 3; k < PAD_ROW; k += 3) {
      const dx = points[o + k] - points[o];
      const dz = points[o + k + 1] - points[o + 1];
      points[o + k] = points[o] + c * dx - s * dz;
      points[o + k + 1] = points[o + 1] + s * dx + c * dz;
    }
  }
}

/** Takes the slide out of a plant, and puts it where the capture has it on average. */
function rollPlant(
  points: Float64Array,
  bits: Uint8Array,
  gain: Float64Array,
  { from, to }: Plant,
  move: Float64Array,
): void {
  const slide = new Float64Array(2);
  let x = 0;
  let z = 0;
  let meanX = 0;
  let meanZ = 0;
  let total = 0;
  for (let f = from; f < to; f++) {
    move[3 * f] = x;
    move[3 * f + 1] = z;
    const weight = gain[f] ** 2;
    meanX += weight * x;
    meanZ += weight * z;
    total += weight;
    if (f + 1 === to) break;
    // Pads that bear in both frames; where heel hands over to toe between two frames, either.
    const both = bits[f] & bits[f + 1] || bits[f] | bits[f + 1];
    if (both === 3) slideOfBoth(slide, points, f);
    else stillest(slide, points, f, both);
    x -= slide[0];
    z -= slide[1];
  }
  for (let f = from; f < to; f++) {
    move[3 * f] -= meanX / total;
    move[3 * f + 1] -= meanZ / total;
  }
}

/** Puts what bears on the ground, softly: a plant's height follows no drift. */
function levelPlants(
  pads: PadTrack,
  points: Float64Array,
  bits: Uint8Array,
  plants: Plant[],
  move: Float64Array,
  o: RollOptions,
): void {
  // Height of what bears over a ground at 0; a pad that the ground cuts bears.
  const gapOf = (f: number, ground: number): number => {
    let sum = 0;
    let count = 0;
    for (const bit of [1, 2]) {
      if (!(bits[f] & bit)) continue;
      const [a, b] = padHeights(points, f, bit);
      const low = Math.min(a, b) - ground;
      const high = Math.max(a, b) - ground;
      sum += low > 0 ? low : Math.min(high, 0);
      count++;
    }
    return count > 0 ? sum / count : 0;
  };
  const middle = (values: number[]): number => values.sort((a, b) => a - b)[values.length >> 1] ?? 0;
  const level: number[] = [];
  for (const plant of plants) {
    const flat: number[] = [];
    const any: number[] = [];
    for (let f = plant.from; f < plant.to; f++) {
      const lows = [1, 2]
        .filter((bit) => bits[f] & bit)
        .map((bit) => Math.min(...padHeights(points, f, bit)));
      const low = lows.reduce((a, b) => a + b, 0) / Math.max(1, lows.length);
      any.push(low);
      if (bits[f] === 3) flat.push(low);
    }
    plant.height = middle(flat.length > 1 ? flat : any);
    if (flat.length > 1) level.push(plant.height);
  }
  // Where a foot lies flat the ground is; a toe alone may well hang over it.
  const heights = level.length > 0 ? level : plants.map((p) => p.height);
  const spread = Math.max(...heights) - Math.min(...heights);
  const uneven = spread > UNEVEN * (o.leg / 0.93);
  for (const plant of plants) {
    const ground = uneven ? plant.height : pads.ground;
    const need = Float64Array.from(
      { length: plant.to - plant.from },
      (_, k) => -gapOf(plant.from + k, ground),
    );
    const weight = need.map((_, k) => (bits[plant.from + k] === 3 ? 1 : EDGE_SAYS));
    for (let k = 0; k < need.length; k++) need[k] *= weight[k];
    const soft = Math.max(0.5, HEIGHT_SOFT * o.rate);
    gaussian(need, 1, soft);
    gaussian(weight, 1, soft);
    for (let f = plant.from; f < plant.to; f++)
      move[3 * f + 2] = need[f - plant.from] / weight[f - plant.from];
  }
}

/** Corrections between plants: the last one's goes and the next one's comes, and neither starts with a jerk. */
function blendBetween(plants: readonly Plant[], n: number, o: RollOptions, out: FootCorrection): void {
  const blend = Math.max(2, Math.round(o.blend * o.rate));
  const settle = SETTLE * o.rate;
  const channels: [track: Float64Array, stride: number, at: number][] = [
    [out.move, 3, 0],
    [out.move, 3, 1],
    [out.move, 3, 2],
    [out.turn, 1, 0],
    [out.tilt, 1, 0],
    [out.toeTilt, 1, 0],
  ];
  for (let i = 0; i <= plants.length; i++) {
    const from = i > 0 ? plants[i - 1].to : 0;
    const to = i < plants.length ? plants[i].from : n;
    const before = i > 0;
    const after = i < plants.length;
    const a = from - 1;
    const b = to;
    for (const [track, stride, at] of channels) {
      const value = (f: number): number => track[stride * f + at];
      const end = before ? value(a) : 0;
      const start = after ? value(b) : 0;
      const leaving = before && a - plants[i - 1].from > 0 ? end - value(a - 1) : 0;
      const coming = after && plants[i].to - b > 1 ? value(b + 1) - start : 0;
      const gap = to - from + 1;
      const length = Math.min(blend, gap);
      for (let f = from; f < to; f++) {
        const since = f - a;
        const till = b - f;
        // A gap that is shorter than both blends is one blend from the last to the next.
        const joined = gap < 2 * blend && before && after;
        const s = smooth(since / gap);
        const wa = !before ? 0 : joined ? 1 - s : 1 - smooth(since / length);
        const wb = !after ? 0 : joined ? s : 1 - smooth(till / length);
        const t = Math.min(settle, gap);
        track[stride * f + at] =
          wa * end +
          wb * start +
          leaving * since * (1 - smooth(since / t)) -
          coming * till * (1 - smooth(till / t));
      }
    }
  }
}
