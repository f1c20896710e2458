/**
 * Unit quaternions xyzw in flat arrays: `out` first, then the array and offset of each operand. No allocation.
 * Rotations act on column vectors: (a b) v = a (b v).
 */

export type Numbers = Float64Array | Float32Array | number[];

export function quatSet(out: Numbers, o: number, x: number, y: number, z: number, w: number): void {
  out[o] = x;
  out[o + 1] = y;
  out[o + 2] = z;
  out[o + 3] = w;
}

export function quatIdentity(out: Numbers, o: number): void {
  quatSet(out, o, 0, 0, 0, 1);
}

export function quatCopy(out: Numbers, o: number, a: Numbers, ai: number): void {
  for (let k = 0; k < 4; k++) out[o + k] = a[ai + k];
}

/** out = a b. `out` may be either operand. */
export function quatMultiply(out: Numbers, o: number, a: Numbers, ai: number, b: Numbers, bi: number): void {
  const ax = a[ai];
  const ay = a[ai + 1];
  const az = a[ai + 2];
  const aw = a[ai + 3];
  const bx = b[bi];
  const by = b[bi + 1];
  const bz = b[bi + 2];
  const bw = b[bi + 3];
  out[o] = aw * bx + ax * bw + ay * bz - az * by;
  out[o + 1] = aw * by - ax * bz + ay * bw + az * bx;
  out[o + 2] = aw * bz + ax * by - ay * bx + az * bw;
  out[o + 3] = aw * bw - ax * bx - ay * by - az * bz;
}

/** out = conjugate(a) b. */
export function quatInverseMultiply(
  out: Numbers,
  o: number,
  a: Numbers,
  ai: number,
  b: Numbers,
  bi: number,
): void {
  const ax = -a[ai];
  const ay = -a[ai + 1];
  const az = -a[ai + 2];
  const aw = a[ai + 3];
  const bx = b[bi];
  const by = b[bi + 1];
  const bz = b[bi + 2];
  const bw = b[bi + 3];
  out[o] = aw * bx + ax * bw + ay * bz - az * by;
  out[o + 1] = aw * by - ax * bz + ay * bw + az * bx;
  out[o + 2] = aw * bz + ax * by - ay * bx + az * bw;
  out[o + 3] = aw * bw - ax * bx - ay * by - az * bz;
}

/** out = conjugate(a). */
export function quatConjugate(out: Numbers, o: number, a: Numbers, ai: number): void {
  quatSet(out, o, -a[ai], -a[ai + 1], -a[ai + 2], a[ai + 3]);
}

/** Scaled to unit length; the identity when it has none. */
export function quatNormalize(out: Numbers, o: number): void {
  const n = Math.sqrt(
    out[o] * out[o] + out[o + 1] * out[o + 1] + out[o + 2] * out[o + 2] + out[o + 3] * out[o + 3],
  );
  if (n < 1e-12) {
    quatIdentity(out, o);
    return;
  }
  const f = 1 / n;
  for (let k = 0; k < 4; k++) out[o + k] *= f;
}

export function quatFromAxisAngle(
  out: Numbers,
  o: number,
  x: number,
  y: number,
  z: number,
  angle: number,
): void {
  const s = Math.sin(angle / 2);
  quatSet(out, o, x * s, y * s, z * s, Math.cos(angle / 2));
}

/** Rotation vector (axis times angle) to quaternion. */
export function quatFromRotationVector(out: Numbers, o: number, x: number, y: number, z: number): void {
  const a = Math.sqrt(x * x + y * y + z * z);
  const s = a < 1e-9 ? 0.5 - (a * a) / 48 : Math.sin(a / 2) / a;
  quatSet(out, o, x * s, y * s, z * s, Math.cos(a / 2));
}

/** Quaternion to rotation vector of length at most pi. */
export function quatToRotationVector(out: Numbers, o: number, a: Numbers, ai: number): void {
  const sign = a[ai + 3] < 0 ? -1 : 1;
  const x = a[ai] * sign;
  const y = a[ai + 1] * sign;
  const z = a[ai + 2] * sign;
  const s = Math.sqrt(x * x + y * y + z * z);
  const f = s < 1e-9 ? 2 : (2 * Math.atan2(s, a[ai + 3] * sign)) / s;
  out[o] = x * f;
  out[o + 1] = y * f;
  out[o + 2] = z * f;
}

/** Intrinsic yaw (about y), pitch (about x), roll (about z): R = Ry Rx Rz. Radians. */
export function quatFromYawPitchRoll(
  out: Numbers,
  o: number,
  yaw: number,
  pitch: number,
  roll: number,
): void {
  const cy = Math.cos(yaw / 2);
  const sy = Math.sin(yaw / 2);
  const cx = Math.cos(pitch / 2);
  const sx = Math.sin(pitch / 2);
  const cz = Math.cos(roll / 2);
  const sz = Math.sin(roll / 2);
  quatSet(
    out,
    o,
    cy * sx * cz + sy * cx * sz,
    sy * cx * cz - cy * sx * sz,
    cy * cx * sz - sy * sx * cz,
    cy * cx * cz + sy * sx * sz,
  );
}

/** Spherical interpolation along the shorter arc; `out` may be an operand. */
export function quatSlerp(
  out: Numbers,
  o: number,
  a: Numbers,
  ai: number,
  b: Numbers,
  bi: number,
  t: number,
): void {
  const ax = a[ai];
  const ay = a[ai + 1];
  const az = a[ai + 2];
  const aw = a[ai + 3];
  let bx = b[bi];
  let by = b[bi + 1];
  let bz = b[bi + 2];
  let bw = b[bi + 3];
  let c = ax * bx + ay * by + az * bz + aw * bw;
  if (c < 0) {
    c = -c;
    bx = -bx;
    by = -by;
    bz = -bz;
    bw = -bw;
  }
  let wa = 1 - t;
  let wb = t;
  if (c < 0.9999) {
    const angle = Math.acos(c);
    const s = Math.sin(angle);
    wa = Math.sin((1 - t) * angle) / s;
    wb = Math.sin(t * angle) / s;
  }
  quatSet(out, o, wa * ax + wb * bx, wa * ay + wb * by, wa * az + wb * bz, wa * aw + wb * bw);
  quatNormalize(out, o);
}

/** Vector v (x, y, z) rotated by q, written to out. */
export function quatRotate(
  out: Numbers,
  o: number,
  q: Numbers,
  qi: number,
  x: number,
  y: number,
  z: number,
): void {
  const ax = q[qi];
  const ay = q[qi + 1];
  const az = q[qi + 2];
  const aw = q[qi + 3];
  const tx = 2 * (ay * z - az * y);
  const ty = 2 * (az * x - ax * z);
  const tz = 2 * (ax * y - ay * x);
  out[o] = x + aw * tx + (ay * tz - az * ty);
  out[o + 1] = y + aw * ty + (az * tx - ax * tz);
  out[o + 2] = z + aw * tz + (ax * ty - ay * tx);
}

/** The shortest rotation that turns unit vector a onto unit vector b. */
export function quatBetween(
  out: Numbers,
  o: number,
  ax: number,
  ay: number,
  az: number,
  bx: number,
  by: number,
  bz: number,
): void {
  const d = ax * bx + ay * by + az * bz;
  if (d < -0.999999) {
    // Opposite: turn half round about any axis square to a.
    let x = 0;
    let y = -az;
    let z = ay;
    if (y * y + z * z < 1e-6) {
      x = az;
      y = 0;
      z = -ax;
    }
    const n = 1 / Math.sqrt(x * x + y * y + z * z);
    quatSet(out, o, x * n, y * n, z * n, 0);
    return;
  }
  quatSet(out, o, ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx, 1 + d);
  quatNormalize(out, o);
}

/**
 * Yaw of the rotation: the heading of its +Z axis on the ground, or of its -Y axis when +Z is near vertical
 * (a body bent over by more than 80 degrees), radians from +Z towards +X.
 */
export function quatYaw(q: Numbers, qi: number): number {
  const x = q[qi];
  const y = q[qi + 1];
  const z = q[qi + 2];
  const w = q[qi + 3];
  const fx = 2 * (x * z + w * y);
  const fz = 1 - 2 * (x * x + y * y);
  if (fx * fx + fz * fz > 0.03) return Math.atan2(fx, fz);
  const fy = 2 * (y * z - w * x);
  const s = fy < 0 ? 1 : -1;
  return Math.atan2(s * 2 * (x * y - w * z), s * 2 * (y * z + w * x));
}
