/**
 * The pendulum's footsteps [Footsteps §3]: a state is where the middle of mass is and how it moves as a step ends, and which foot
 * comes next; an action is the parabola's direction, speed and time; createFootstep leads from one to the next.
 */
import { KIND, P, POSE, S, STATE } from "./state.ts";
import type { Gait } from "./types.ts";
import { nextYawInterval } from "./yaw-interval.ts";

/** Time in which a walker comes to rest, seconds. */
export const STOP_TIME = 0.35;
/** Twist of the torso that lets a body through a gap sideways, radians over the heading of the feet. */
export const TWIST = 1.2;

/** Cosine of how far a torso turns at most as one starts: 115 degrees. One that is twisted the other way first comes back. */
const MOST_SWEEP = -0.77;

const interval = new Float64Array(2);

/** Notes what a step costs [Footsteps eqs. 13-16] and returns the sum, J/kg. */
function energy(steps: Float64Array, p: number, fixed: number, speed: number, bend: number): number {
  steps[p + P.fixedEnergy] = fixed;
  steps[p + P.speedEnergy] = speed;
  steps[p + P.bendEnergy] = bend;
  steps[p + P.nearness] = 0;
  return fixed + speed + bend;
}

/**
 * Steps from a walking state: the parabola's direction is the motion's, turned by `theta` away from the planted foot; both ends of
 * the parabola lean to the foot by that angle [Footsteps eqs. 6-12]. Writes the state at its end to `out` and the step to `steps`.
 *
 * @param turnCos, turnSin cosine and sine of theta, 0 to about 75 degrees. @param speed wanted, metres a second.
 * @returns energy of the step, J/kg [Footsteps eqs. 13-16]; -1 when no foot could point that way or reach so far.
 */
export function createFootstep(
  out: Float64Array,
  o: number,
  steps: Float64Array,
  p: number,
  s: Float64Array,
  i: number,
  theta: number,
  turnCos: number,
  turnSin: number,
  speed: number,
  duration: number,
  gait: Gait,
): number {
  if (!footCouldPoint(s, i, theta, gait)) return -1;
  action[ACTION.theta] = theta;
  action[ACTION.cos] = turnCos;
  action[ACTION.sin] = turnSin;
  action[ACTION.speed] = speed;
  action[ACTION.duration] = duration;
  if (!weighFootstep(s, i, gait)) return -1;
  makeFootstep(out, o, steps, p, s, i, gait);
  return weighed[WEIGHED.fixedEnergy] + weighed[WEIGHED.speedEnergy] + weighed[WEIGHED.bendEnergy];
}

/** Whether a foot that leads to a parabola turned by `theta` could point anywhere [Footsteps eq. 12]. */
export const footCouldPoint = (s: Float64Array, i: number, theta: number, gait: Gait): boolean =>
  nextYawInterval(interval, s[i + S.inner], s[i + S.outer], s[i + S.theta], theta, gait.yawRange);

/**
 * The action that `weighFootstep` weighs: angle of the parabola to the motion, its cosine and sine, speed, time. Numbers that are
 * handed over in an array cost no memory: this is done for hundreds of footsteps a plan.
 */
export const action = new Float64Array(5);
export const ACTION = { theta: 0, cos: 1, sin: 2, speed: 3, duration: 4 } as const;
/** Numbers of an action. */
export const ACTIONS = 5;

/** What `weighFootstep` finds: where the step leads, its energies, and the parabola and foot. */
export const weighed = new Float64Array(11);
export const WEIGHED = {
  x: 0,
  z: 1,
  fixedEnergy: 2,
  speedEnergy: 3,
  bendEnergy: 4,
  px: 5,
  pz: 6,
  along: 7,
  toFoot: 8,
  footX: 9,
  footZ: 10,
} as const;

/**
 * The part of `createFootstep` that a footstep's worth depends on, into `weighed`. Most footsteps that are thought of are never looked at;
 * `makeFootstep` writes down those that are.
 *
 * @returns false when the foot would be out of reach.
 */
export function weighFootstep(s: Float64Array, i: number, gait: Gait): boolean {
  const turnCos = action[ACTION.cos];
  const turnSin = action[ACTION.sin];
  const speed = action[ACTION.speed];
  const duration = action[ACTION.duration];
  const side = s[i + S.side];
  const ux = s[i + S.ux];
  const uz = s[i + S.uz];
  // Left of (x, z) is (z, -x).
  const px = turnCos * ux - side * turnSin * uz;
  const pz = turnCos * uz + side * turnSin * ux;
  const along = speed * turnCos;
  const toFoot = speed * turnSin;
  const alpha = toFoot / duration;
  const aside = (toFoot * duration) / 4 + gait.footAside;
  const x = s[i + S.x];
  const z = s[i + S.z];
  const footX = x + px * along * 0.5 * duration + side * pz * aside;
  const footZ = z + pz * along * 0.5 * duration - side * px * aside;
  // Half the angle between the legs: sin theta = distance of the footfalls / (2 l); cos 2 theta = 1 - 2 sin^2 theta.
  const fx = footX - s[i + S.footX];
  const fz = footZ - s[i + S.footZ];
  const apart2 = fx * fx + fz * fz;
  if (apart2 > gait.strideMost * gait.strideMost) return false;
  const kept = s[i + S.speed] * (1 - 2 * Math.min(0.5, apart2 / (4 * gait.leg * gait.leg)));
  weighed[WEIGHED.x] = x + px * along * duration;
  weighed[WEIGHED.z] = z + pz * along * duration;
  weighed[WEIGHED.fixedEnergy] = gait.power * duration;
  weighed[WEIGHED.speedEnergy] = 0.5 * Math.abs(speed * speed - kept * kept);
  weighed[WEIGHED.bendEnergy] = gait.bend * alpha * speed * duration;
  weighed[WEIGHED.px] = px;
  weighed[WEIGHED.pz] = pz;
  weighed[WEIGHED.along] = along;
  weighed[WEIGHED.toFoot] = toFoot;
  weighed[WEIGHED.footX] = footX;
  weighed[WEIGHED.footZ] = footZ;
  return true;
}

/** Writes down the footstep that was weighed last: its step and the state at its end. */
export function makeFootstep(
  out: Float64Array,
  o: number,
  steps: Float64Array,
  p: number,
  s: Float64Array,
  i: number,
  gait: Gait,
): void {
  const theta = action[ACTION.theta];
  footCouldPoint(s, i, theta, gait);
  const duration = action[ACTION.duration];
  const side = s[i + S.side];
  const px = weighed[WEIGHED.px];
  const pz = weighed[WEIGHED.pz];
  steps[p + P.kind] = KIND.walk;
  steps[p + P.start] = s[i + S.time];
  steps[p + P.duration] = duration;
  steps[p + P.x] = s[i + S.x];
  steps[p + P.z] = s[i + S.z];
  steps[p + P.px] = px;
  steps[p + P.pz] = pz;
  steps[p + P.along] = weighed[WEIGHED.along];
  steps[p + P.toFoot] = weighed[WEIGHED.toFoot];
  steps[p + P.side] = side;
  steps[p + P.footX] = weighed[WEIGHED.footX];
  steps[p + P.footZ] = weighed[WEIGHED.footZ];
  steps[p + P.fromX] = s[i + S.faceX];
  steps[p + P.fromZ] = s[i + S.faceZ];
  steps[p + P.toX] = px;
  steps[p + P.toZ] = pz;
  steps[p + P.fromHeadX] = s[i + S.headX];
  steps[p + P.fromHeadZ] = s[i + S.headZ];
  steps[p + P.headX] = px;
  steps[p + P.headZ] = pz;
  steps[p + P.inner] = interval[0];
  steps[p + P.outer] = interval[1];
  steps[p + P.theta] = theta;
  steps[p + P.yaw] = interval[0];
  steps[p + P.fixedEnergy] = weighed[WEIGHED.fixedEnergy];
  steps[p + P.speedEnergy] = weighed[WEIGHED.speedEnergy];
  steps[p + P.bendEnergy] = weighed[WEIGHED.bendEnergy];
  steps[p + P.nearness] = 0;
  // The motion leaves the parabola turned away from the foot once more.
  const turnCos = action[ACTION.cos];
  const turnSin = action[ACTION.sin];
  out[o + S.x] = weighed[WEIGHED.x];
  out[o + S.z] = weighed[WEIGHED.z];
  out[o + S.ux] = turnCos * px - side * turnSin * pz;
  out[o + S.uz] = turnCos * pz + side * turnSin * px;
  out[o + S.speed] = action[ACTION.speed];
  out[o + S.side] = -side;
  out[o + S.footX] = weighed[WEIGHED.footX];
  out[o + S.footZ] = weighed[WEIGHED.footZ];
  out[o + S.faceX] = px;
  out[o + S.faceZ] = pz;
  out[o + S.headX] = px;
  out[o + S.headZ] = pz;
  out[o + S.time] = s[i + S.time] + duration;
  out[o + S.theta] = theta;
  out[o + S.inner] = interval[0];
  out[o + S.outer] = interval[1];
}

/** Twists the torso of a step over its feet, to go sideways through a gap: `way` 1 to the left, -1 to the right. */
export function twistTorso(out: Float64Array, o: number, steps: Float64Array, p: number, way: number): void {
  const cos = 0.3623577544766736;
  const sin = 0.9320390859672263 * way;
  const hx = steps[p + P.headX];
  const hz = steps[p + P.headZ];
  out[o + S.faceX] = steps[p + P.toX] = cos * hx + sin * hz;
  out[o + S.faceZ] = steps[p + P.toZ] = cos * hz - sin * hx;
}

/** Makes a shift keep the facing and heading that it begins with, where turning would bring a shoulder into a wall. */
export function keepFacing(
  out: Float64Array,
  o: number,
  steps: Float64Array,
  p: number,
  footAside: number,
): void {
  const headX = steps[p + P.fromHeadX];
  const headZ = steps[p + P.fromHeadZ];
  const side = steps[p + P.side];
  out[o + S.faceX] = steps[p + P.toX] = steps[p + P.fromX];
  out[o + S.faceZ] = steps[p + P.toZ] = steps[p + P.fromZ];
  out[o + S.headX] = steps[p + P.headX] = headX;
  out[o + S.headZ] = steps[p + P.headZ] = headZ;
  out[o + S.footX] = steps[p + P.footX] = out[o + S.x] + side * headZ * footAside;
  out[o + S.footZ] = steps[p + P.footZ] = out[o + S.z] - side * headX * footAside;
}

/** What starts, stops, stands and shifts have in common. */
function fromState(
  steps: Float64Array,
  p: number,
  s: Float64Array,
  i: number,
  kind: number,
  duration: number,
): void {
  steps[p + P.along] = 0;
  steps[p + P.toFoot] = 0;
  steps[p + P.footX] = 0;
  steps[p + P.footZ] = 0;
  steps[p + P.inner] = 0;
  steps[p + P.outer] = 0;
  steps[p + P.theta] = 0;
  steps[p + P.yaw] = 0;
  steps[p + P.kind] = kind;
  steps[p + P.start] = s[i + S.time];
  steps[p + P.duration] = duration;
  steps[p + P.x] = s[i + S.x];
  steps[p + P.z] = s[i + S.z];
  steps[p + P.px] = s[i + S.ux];
  steps[p + P.pz] = s[i + S.uz];
  steps[p + P.side] = s[i + S.side];
  steps[p + P.fromX] = steps[p + P.toX] = s[i + S.faceX];
  steps[p + P.fromZ] = steps[p + P.toZ] = s[i + S.faceZ];
  steps[p + P.fromHeadX] = steps[p + P.headX] = s[i + S.headX];
  steps[p + P.fromHeadZ] = steps[p + P.headZ] = s[i + S.headZ];
}

/** The state at rest: both feet point along the heading, so either may go on. */
function atRest(out: Float64Array, o: number): void {
  out[o + S.speed] = 0;
  out[o + S.theta] = 0;
  out[o + S.inner] = 0;
  out[o + S.outer] = 0;
}

/** Comes to rest along the way it moves, over STOP_TIME; from rest it stands. Returns the energy. */
export function createStop(
  out: Float64Array,
  o: number,
  steps: Float64Array,
  p: number,
  s: Float64Array,
  i: number,
  duration: number,
  gait: Gait,
): number {
  const speed = s[i + S.speed];
  const run = speed > 0 ? (speed * STOP_TIME) / 2 : 0;
  fromState(steps, p, s, i, speed > 0 ? KIND.stop : KIND.stand, duration);
  const px = steps[p + P.px];
  const pz = steps[p + P.pz];
  const side = steps[p + P.side];
  steps[p + P.along] = speed;
  const x = steps[p + P.x] + px * run;
  const z = steps[p + P.z] + pz * run;
  steps[p + P.footX] = x + side * s[i + S.headZ] * gait.footAside;
  steps[p + P.footZ] = z - side * s[i + S.headX] * gait.footAside;
  for (let k = 0; k < STATE; k++) out[o + k] = s[i + k];
  out[o + S.x] = x;
  out[o + S.z] = z;
  out[o + S.footX] = steps[p + P.footX];
  out[o + S.footZ] = steps[p + P.footZ];
  out[o + S.time] = s[i + S.time] + duration;
  atRest(out, o);
  return energy(steps, p, gait.power * duration, 0.5 * speed * speed, 0);
}

/**
 * Starts from rest: the weight falls forward off a foot that stays where it stands, evenly faster, while the other swings.
 *
 * @param dx, dz way to go, unit. @param angle its yaw over the feet's heading, radians: the foot on the far side stays.
 * @returns the energy, J/kg; -1 where feet or torso could not turn so far in one step.
 */
export function createStart(
  out: Float64Array,
  o: number,
  steps: Float64Array,
  p: number,
  s: Float64Array,
  i: number,
  dx: number,
  dz: number,
  angle: number,
  speed: number,
  duration: number,
  gait: Gait,
): number {
  const off = Math.abs(angle);
  if (off > gait.yawRange || s[i + S.faceX] * dx + s[i + S.faceZ] * dz < MOST_SWEEP) return -1;
  fromState(steps, p, s, i, KIND.start, duration);
  const side = off < 1e-3 ? s[i + S.side] : angle > 0 ? -1 : 1;
  const x = s[i + S.x];
  const z = s[i + S.z];
  steps[p + P.px] = dx;
  steps[p + P.pz] = dz;
  steps[p + P.along] = speed;
  steps[p + P.side] = side;
  steps[p + P.footX] = x + side * s[i + S.headZ] * gait.footAside;
  steps[p + P.footZ] = z - side * s[i + S.headX] * gait.footAside;
  steps[p + P.toX] = steps[p + P.headX] = dx;
  steps[p + P.toZ] = steps[p + P.headZ] = dz;
  // The foot that stays points along the old heading, which is outwards of the new way.
  const outwards = off;
  steps[p + P.inner] = steps[p + P.outer] = steps[p + P.yaw] = outwards;
  out[o + S.x] = x + 0.5 * speed * duration * dx;
  out[o + S.z] = z + 0.5 * speed * duration * dz;
  out[o + S.ux] = dx;
  out[o + S.uz] = dz;
  out[o + S.speed] = speed;
  out[o + S.side] = -side;
  out[o + S.footX] = steps[p + P.footX];
  out[o + S.footZ] = steps[p + P.footZ];
  out[o + S.faceX] = out[o + S.headX] = dx;
  out[o + S.faceZ] = out[o + S.headZ] = dz;
  out[o + S.time] = s[i + S.time] + duration;
  out[o + S.theta] = 0;
  out[o + S.inner] = out[o + S.outer] = outwards;
  return energy(steps, p, gait.power * duration, 0.5 * speed * speed, 0);
}

/**
 * Shifts both feet from rest to rest, one after the other: sideways, back, or turning on the spot. The foot on the side of the
 * shift (or turn) goes first, so that legs never cross.
 *
 * @param dx, dz way, unit. @param far metres. @param headX, headZ the feet's heading afterwards, which the torso follows.
 * @param turn its yaw over the heading before, radians. @returns the energy, J/kg.
 */
export function createShift(
  out: Float64Array,
  o: number,
  steps: Float64Array,
  p: number,
  s: Float64Array,
  i: number,
  dx: number,
  dz: number,
  far: number,
  headX: number,
  headZ: number,
  turn: number,
  duration: number,
  gait: Gait,
): number {
  if (Math.abs(turn) > gait.yawRange) return -1;
  fromState(steps, p, s, i, KIND.shift, duration);
  const left = dx * s[i + S.headZ] - dz * s[i + S.headX];
  const side = far > 0 && Math.abs(left) > 0.3 ? (left > 0 ? 1 : -1) : turn >= 0 ? 1 : -1;
  const x = s[i + S.x] + dx * far;
  const z = s[i + S.z] + dz * far;
  steps[p + P.px] = dx;
  steps[p + P.pz] = dz;
  steps[p + P.along] = far;
  steps[p + P.side] = side;
  steps[p + P.footX] = x + side * headZ * gait.footAside;
  steps[p + P.footZ] = z - side * headX * gait.footAside;
  steps[p + P.toX] = steps[p + P.headX] = headX;
  steps[p + P.toZ] = steps[p + P.headZ] = headZ;
  for (let k = 0; k < STATE; k++) out[o + k] = s[i + k];
  out[o + S.x] = x;
  out[o + S.z] = z;
  out[o + S.side] = side;
  out[o + S.footX] = steps[p + P.footX];
  out[o + S.footZ] = steps[p + P.footZ];
  out[o + S.faceX] = out[o + S.headX] = headX;
  out[o + S.faceZ] = out[o + S.headZ] = headZ;
  out[o + S.time] = s[i + S.time] + duration;
  atRest(out, o);
  // It speeds up and brakes once for each foot.
  const fastest = (1.5 * far) / duration;
  return energy(steps, p, gait.power * duration, 2 * fastest * fastest, gait.bend * Math.abs(turn) * 0.5);
}

/**
 * Where a walker is at a time in (or after) its step: middle of mass, facing, and the planted foot that stands out most; POSE
 * numbers into `out`. After the step it comes to rest.
 */
export function evaluateStep(
  out: Float64Array,
  o: number,
  steps: Float64Array,
  p: number,
  time: number,
  footAside: number,
): void {
  clock[0] = time;
  stance.footAside = footAside;
  evaluateMoments(out, o, steps, p, clock, 0, 0, 1, stance);
}

const clock = new Float64Array(1);
const stance = { footAside: 0 };

/** Time between moments at which poses are compared, seconds. */
export const MOMENT = 0.1;

/**
 * The same at moments `first`, `first + stride`, ... up to `last` after the time in `since`, one after the other into `out`.
 *
 * @param gait whose `footAside` is asked for. Numbers that are handed over alone would each be put on the heap.
 */
export function evaluateMoments(
  out: Float64Array,
  o: number,
  steps: Float64Array,
  p: number,
  since: Float64Array,
  first: number,
  last: number,
  stride: number,
  gait: { readonly footAside: number },
): void {
  const time = since[0];
  const { footAside } = gait;
  const kind = steps[p + P.kind];
  const start = steps[p + P.start];
  const duration = steps[p + P.duration];
  const startX = steps[p + P.x];
  const startZ = steps[p + P.z];
  const px = steps[p + P.px];
  const pz = steps[p + P.pz];
  const along = steps[p + P.along];
  const toFoot = steps[p + P.toFoot];
  const side = steps[p + P.side];
  const stepFootX = steps[p + P.footX];
  const stepFootZ = steps[p + P.footZ];
  const fromX = steps[p + P.fromX];
  const fromZ = steps[p + P.fromZ];
  const toX = steps[p + P.toX];
  const toZ = steps[p + P.toZ];
  let at = o;
  for (let k = first; k <= last; k += stride, at += POSE) {
    const now = time + k * MOMENT;
    const t = now > start ? now - start : 0;
    const within = t < duration ? t : duration;
    let x = startX;
    let z = startZ;
    let footX = stepFootX;
    let footZ = stepFootZ;
    if (kind === KIND.walk || kind === KIND.start) {
      let vx = px * along;
      let vz = pz * along;
      if (kind === KIND.walk) {
        const aside = (toFoot / duration) * within * (duration - within) * side;
        x += vx * within + pz * aside;
        z += vz * within - px * aside;
        vx -= side * pz * toFoot;
        vz += side * px * toFoot;
      } else {
        const run = (0.5 * along * within * within) / duration;
        x += px * run;
        z += pz * run;
      }
      if (t > within) {
        // The stop that is always possible: along the motion at the step's end, onto the other foot.
        const b = t - within < STOP_TIME ? t - within : STOP_TIME;
        const run = b - (b * b) / (2 * STOP_TIME);
        footX = x + vx * (STOP_TIME / 2) - side * steps[p + P.headZ] * footAside;
        footZ = z + vz * (STOP_TIME / 2) + side * steps[p + P.headX] * footAside;
        x += vx * run;
        z += vz * run;
      }
    } else if (kind === KIND.stop) {
      const b = t < STOP_TIME ? t : STOP_TIME;
      const run = along * (b - (b * b) / (2 * STOP_TIME));
      x += px * run;
      z += pz * run;
    } else if (kind === KIND.shift) {
      const w = within / duration;
      if (2 * within < duration) {
        // The other foot still stands where it stood.
        footX = x - side * steps[p + P.fromHeadZ] * footAside;
        footZ = z + side * steps[p + P.fromHeadX] * footAside;
      }
      const run = along * w * w * (3 - 2 * w);
      x += px * run;
      z += pz * run;
    }
    out[at] = x;
    out[at + 1] = z;
    out[at + 4] = footX;
    out[at + 5] = footZ;
    const w = duration > 0 ? within / duration : 1;
    out[at + 2] = toX;
    out[at + 3] = toZ;
    if (w >= 1) continue;
    const s = w * w * (3 - 2 * w);
    const fx = fromX + s * (toX - fromX);
    const fz = fromZ + s * (toZ - fromZ);
    const n2 = fx * fx + fz * fz;
    if (n2 <= 1e-12) continue;
    const n = Math.sqrt(n2);
    out[at + 2] = fx / n;
    out[at + 3] = fz / n;
  }
}

/** A pose's numbers copied. */
export function copyPose(out: Float64Array, o: number, from: Float64Array, i: number): void {
  for (let k = 0; k < POSE; k++) out[o + k] = from[i + k];
}
