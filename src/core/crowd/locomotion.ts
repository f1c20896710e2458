/**
 * The pendulum's footsteps [Footsteps §3]: a state is where the middle of mass is and how it moves as a step ends, and which foot
 * comes next; an action is the parabola's direction, speed and time; createFootstep leads from one to the next.
 */
import type { Gait } from "./types.ts";

/** Numbers of a state in a flat array. */
export const STATE = 12;
/** Offsets of a state: middle of mass, direction of motion (unit), speed, side of the next foot (1 left), last foot's place, facing (unit), time. */
export const S = {
  x: 0,
  z: 1,
  ux: 2,
  uz: 3,
  speed: 4,
  side: 5,
  footX: 6,
  footZ: 7,
  faceX: 8,
  faceZ: 9,
  time: 10,
} as const;

/** A step as it is walked: from where, which way, how fast, how bent, how long. */
export interface Step {
  /** 0 stands, 1 walks a parabola, 2 comes to a stop. */
  kind: 0 | 1 | 2;
  start: number;
  duration: number;
  x: number;
  z: number;
  /** The parabola's direction, unit. */
  px: number;
  pz: number;
  /** Speed along it, and towards the foot at its start, metres a second. */
  along: number;
  toFoot: number;
  /** Side of the planted foot: 1 left, -1 right. */
  side: number;
  footX: number;
  footZ: number;
  /** Facing before and after, unit. */
  fromX: number;
  fromZ: number;
  toX: number;
  toZ: number;
}

export const createStep = (): Step => ({
  kind: 0,
  start: 0,
  duration: 0,
  x: 0,
  z: 0,
  px: 0,
  pz: 1,
  along: 0,
  toFoot: 0,
  side: 1,
  footX: 0,
  footZ: 0,
  fromX: 0,
  fromZ: 1,
  toX: 0,
  toZ: 1,
});

/** Time in which a walker comes to rest, seconds. */
export const STOP_TIME = 0.35;

/**
 * Steps from a state: the parabola's direction is the motion's, turned by `turn` away from the planted foot; both ends of the
 * parabola lean to the foot by that angle [Footsteps eqs. 6-9, 11]. Writes the state at its end to `out` and the step.
 *
 * @param turnCos, turnSin cosine and sine of the turn, 0 to about 75 degrees. @param speed wanted, metres a second.
 * @returns energy of the step, J/kg [Footsteps eqs. 13-16].
 */
export function createFootstep(
  out: Float64Array,
  o: number,
  step: Step,
  s: Float64Array,
  i: number,
  turnCos: number,
  turnSin: number,
  speed: number,
  duration: number,
  gait: Gait,
): number {
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
  step.kind = 1;
  step.start = s[i + S.time];
  step.duration = duration;
  step.x = x;
  step.z = z;
  step.px = px;
  step.pz = pz;
  step.along = along;
  step.toFoot = toFoot;
  step.side = side;
  step.footX = x + px * along * 0.5 * duration + side * pz * aside;
  step.footZ = z + pz * along * 0.5 * duration - side * px * aside;
  step.fromX = s[i + S.faceX];
  step.fromZ = s[i + S.faceZ];
  step.toX = px;
  step.toZ = pz;
  out[o + S.x] = x + px * along * duration;
  out[o + S.z] = z + pz * along * duration;
  out[o + S.ux] = turnCos * px - side * turnSin * pz;
  out[o + S.uz] = turnCos * pz + side * turnSin * px;
  out[o + S.speed] = speed;
  out[o + S.side] = -side;
  out[o + S.footX] = step.footX;
  out[o + S.footZ] = step.footZ;
  out[o + S.faceX] = px;
  out[o + S.faceZ] = pz;
  out[o + S.time] = step.start + duration;
  // Half the angle between the legs: sin theta = distance of the footfalls / (2 l); cos 2 theta = 1 - 2 sin^2 theta.
  const fx = step.footX - s[i + S.footX];
  const fz = step.footZ - s[i + S.footZ];
  const sin2 = Math.min(0.5, (fx * fx + fz * fz) / (4 * gait.leg * gait.leg));
  const kept = s[i + S.speed] * (1 - 2 * sin2);
  return (
    gait.power * duration + 0.5 * Math.abs(speed * speed - kept * kept) + gait.bend * alpha * speed * duration
  );
}

/** Comes to rest along the way it moves, over STOP_TIME; from rest it stands. Returns the energy. */
export function createStop(
  out: Float64Array,
  o: number,
  step: Step,
  s: Float64Array,
  i: number,
  duration: number,
  gait: Gait,
): number {
  const speed = s[i + S.speed];
  const run = speed > 0 ? (speed * STOP_TIME) / 2 : 0;
  step.kind = speed > 0 ? 2 : 0;
  step.start = s[i + S.time];
  step.duration = duration;
  step.x = s[i + S.x];
  step.z = s[i + S.z];
  step.px = s[i + S.ux];
  step.pz = s[i + S.uz];
  step.along = speed;
  step.toFoot = 0;
  step.side = s[i + S.side];
  step.footX = step.x + step.px * run + step.side * step.pz * gait.footAside;
  step.footZ = step.z + step.pz * run - step.side * step.px * gait.footAside;
  step.fromX = step.toX = s[i + S.faceX];
  step.fromZ = step.toZ = s[i + S.faceZ];
  for (let k = 0; k < STATE; k++) out[o + k] = s[i + k];
  out[o + S.x] += step.px * run;
  out[o + S.z] += step.pz * run;
  out[o + S.speed] = 0;
  out[o + S.footX] = step.footX;
  out[o + S.footZ] = step.footZ;
  out[o + S.time] = step.start + duration;
  return gait.power * duration + 0.5 * speed * speed;
}

/** Where a walker is at a time in (or after) its step, and how it faces: x, z, facing x, z in `out`. After it, it comes to rest. */
export function evaluateStep(out: Float64Array, o: number, step: Step, time: number): void {
  let t = time - step.start;
  if (t < 0) t = 0;
  const within = t < step.duration ? t : step.duration;
  let x = step.x;
  let z = step.z;
  let after = 0;
  if (step.kind === 1) {
    const u = within - step.duration / 2;
    const along = step.along * within;
    const aside = (step.toFoot / step.duration) * (step.duration * step.duration * 0.25 - u * u);
    x += step.px * along + step.side * step.pz * aside;
    z += step.pz * along - step.side * step.px * aside;
    after = t - within;
    if (after > 0) {
      // The stop that is always possible: along the motion at the step's end.
      const b = after < STOP_TIME ? after : STOP_TIME;
      const run = b - (b * b) / (2 * STOP_TIME);
      x += (step.px * step.along - step.side * step.pz * step.toFoot) * run;
      z += (step.pz * step.along + step.side * step.px * step.toFoot) * run;
    }
  } else if (step.kind === 2) {
    const b = t < STOP_TIME ? t : STOP_TIME;
    const run = step.along * (b - (b * b) / (2 * STOP_TIME));
    x += step.px * run;
    z += step.pz * run;
  }
  const w = step.duration > 0 ? within / step.duration : 1;
  const s = w * w * (3 - 2 * w);
  let fx = step.fromX + s * (step.toX - step.fromX);
  let fz = step.fromZ + s * (step.toZ - step.fromZ);
  const n = Math.sqrt(fx * fx + fz * fz);
  if (n > 1e-6) {
    fx /= n;
    fz /= n;
  } else {
    fx = step.toX;
    fz = step.toZ;
  }
  out[o] = x;
  out[o + 1] = z;
  out[o + 2] = fx;
  out[o + 3] = fz;
}
