/**
 * Inertial joins: where two motion segments meet, the difference in value and speed is carried over and dies out.
 *
 * "We also use root motion warping to match incoming root motion trajectory in order to create smooth transitions
 * between successive segments" [TaskLoco §6]; here for the root, every joint and the feet's pitch, as a quintic
 * that starts with the old value and speed and ends at rest [Bollo, "Inertialization", GDC 2018, idea].
 */

/** Value at time t of the quintic from offset x0 with speed v0 to rest at T, with zero acceleration at T. */
export function decay(x0: number, v0: number, t: number, T: number): number {
  if (t >= T) return 0;
  const u = t / T;
  const w = 1 - u;
  const w3 = w * w * w;
  // Hermite basis of order five with x(0) = x0, x'(0) = v0, x''(0) = 0 and nothing left at T.
  return x0 * w3 * (1 + 3 * u + 6 * u * u) + v0 * T * u * w3 * (1 + 3 * u);
}

/** Offsets of `channels` numbers, all dying out over one time; restarted at every join. */
export interface Inertia {
  channels: number;
  value: Float64Array;
  speed: Float64Array;
  /** Seconds since the last join, and until nothing is left. */
  age: number;
  length: number;
}

export function createInertia(channels: number): Inertia {
  return {
    channels,
    value: new Float64Array(channels),
    speed: new Float64Array(channels),
    age: 0,
    length: 0,
  };
}

/** Present offset of a channel. */
export function offsetOf(inertia: Inertia, channel: number): number {
  return decay(inertia.value[channel], inertia.speed[channel], inertia.age, inertia.length);
}
