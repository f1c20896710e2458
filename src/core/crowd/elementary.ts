/**
 * Sine, cosine, arc tangent and exponential by + - * / alone, so that crowds, where small differences grow, come out bit for bit
 * the same in every engine. Accurate to about 1e-12.
 */

const HALF_PI = 1.5707963267948966;
const TWO_PI = 6.283185307179586;

/** Sine of an angle, radians, of moderate size. */
export function sine(a: number): number {
  let x = a - TWO_PI * Math.floor(a / TWO_PI + 0.5);
  if (x > HALF_PI) x = Math.PI - x;
  else if (x < -HALF_PI) x = -Math.PI - x;
  const x2 = x * x;
  let term = x;
  let sum = x;
  for (let k = 1; k <= 9; k++) {
    term *= -x2 / (2 * k * (2 * k + 1));
    sum += term;
  }
  return sum;
}

/** Cosine of an angle, radians. */
export const cosine = (a: number): number => sine(a + HALF_PI);

/** Arc tangent of y / x in (-pi, pi]; 0 of nothing. */
export function arcTangent(y: number, x: number): number {
  const ax = Math.abs(x);
  const ay = Math.abs(y);
  if (ax === 0 && ay === 0) return 0;
  let t = ay < ax ? ay / ax : ax / ay;
  // Three halvings of the angle leave a series that converges at once.
  let scale = 1;
  for (let k = 0; k < 3; k++) {
    t /= 1 + Math.sqrt(1 + t * t);
    scale *= 2;
  }
  const t2 = t * t;
  let sum = 0;
  for (let k = 8; k >= 0; k--) sum = sum * -t2 + 1 / (2 * k + 1);
  let a = scale * t * sum;
  if (ay >= ax) a = HALF_PI - a;
  if (x < 0) a = Math.PI - a;
  return y < 0 ? -a : a;
}

/** e to the power of a, for |a| up to about 20. */
export function exponential(a: number): number {
  // Eight halvings leave a short series; squaring brings it back.
  const x = a / 256;
  let sum = 1;
  for (let k = 8; k >= 1; k--) sum = 1 + (x / k) * sum;
  for (let k = 0; k < 8; k++) sum *= sum;
  return sum;
}
