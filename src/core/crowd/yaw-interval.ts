/**
 * Which way a foot may point [Footsteps §3.3, eq. 12, and §4.1]. An interval [inner, outer] is measured from its own parabola's
 * direction, growing outwards (to the left for a left foot), so that left and right are mirror images and no arc tangent is needed.
 */

/**
 * How far the parabola's direction turns from one step to the next, seen outwards of the next foot: the motion leaves the
 * first parabola `thetaBefore` that way and meets the next one `theta` outwards of it.
 */
export const turnBetween = (thetaBefore: number, theta: number): number => thetaBefore - theta;

/**
 * The next foot's interval [Footsteps eq. 12, an intersection]: between its parabola and the motion at its start, not turned in
 * over the foot before nor out by more than `range` from it. Writes inner and outer to `out`; false when nothing is left.
 *
 * @param inner, outer the interval of the foot before. @param theta angle between motion and parabola, 0 or more, radians.
 */
export function nextYawInterval(
  out: Float64Array,
  inner: number,
  outer: number,
  thetaBefore: number,
  theta: number,
  range: number,
): boolean {
  const turn = turnBetween(thetaBefore, theta);
  const low = -outer - turn;
  const high = -inner - turn + range;
  out[0] = low > 0 ? low : 0;
  out[1] = high < theta ? high : theta;
  return out[0] <= out[1] + 1e-9;
}

/**
 * The exact yaw of a foot once the next step is known [Footsteps §4.1]: its interval is narrowed by the next foot's, by the same
 * arithmetic, and in what is left the yaw nearest to the next step's parabola is taken.
 *
 * @returns radians, outwards of the foot's own parabola.
 */
export function chooseYaw(
  inner: number,
  outer: number,
  theta: number,
  next: { inner: number; outer: number; theta: number } | null,
  range: number,
): number {
  if (!next) return inner;
  const turn = turnBetween(theta, next.theta);
  const low = Math.max(inner, -next.outer - turn);
  const high = Math.min(outer, -next.inner - turn + range);
  // The next parabola, seen outwards of this foot from its own.
  const wanted = -turn;
  return wanted < low ? low : wanted > high ? (high < low ? low : high) : wanted;
}
