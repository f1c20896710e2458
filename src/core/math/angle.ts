/** Angles in radians, wrapped to (-pi, pi]. */

const TWO_PI = 2 * Math.PI;

/** The same angle in (-pi, pi]. */
export function wrapAngle(a: number): number {
  const w = a - TWO_PI * Math.floor((a + Math.PI) / TWO_PI);
  // floor puts -pi - 2 k pi on -pi; the contract's interval is open there.
  return w <= -Math.PI ? w + TWO_PI : w;
}

/** Signed difference `to - from`, wrapped. */
export function angleBetween(from: number, to: number): number {
  return wrapAngle(to - from);
}

/** Angle at fraction `t` of the shorter way from `a` to `b`. */
export function lerpAngle(a: number, b: number, t: number): number {
  return wrapAngle(a + t * wrapAngle(b - a));
}

export const degrees = (radians: number): number => (radians * 180) / Math.PI;
export const radians = (degreesValue: number): number => (degreesValue * Math.PI) / 180;
