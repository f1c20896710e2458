/**
 * The character's surface as a distance field: round cones and ellipsoids with smooth unions, in the rest pose.
 *
 * Places are those of the skeleton's joints; radii are for a height of 1.75 m and scale with it.
 */
import { J, JOINT_COUNT, PARENTS } from "../../core/skeleton/joints.ts";
import type { Skeleton } from "../../core/skeleton/skeleton.ts";

/** Which material a piece of the surface has. */
export const PARTS = ["body", "ivory", "leftHeel", "leftToe", "rightHeel", "rightToe"] as const;
export type Part = (typeof PARTS)[number];

type V3 = readonly [number, number, number];

/** World places of the joints in the rest pose. */
export function restPlaces(skeleton: Skeleton): Float64Array {
  const out = new Float64Array(3 * JOINT_COUNT);
  for (let j = 0; j < JOINT_COUNT; j++) {
    const p = PARENTS[j];
    for (let k = 0; k < 3; k++) out[3 * j + k] = (p < 0 ? 0 : out[3 * p + k]) + skeleton.offsets[3 * j + k];
  }
  return out;
}

/** Distance to a cone with round ends [Quilez, distance functions]. */
function roundCone(x: number, y: number, z: number, a: V3, b: V3, r1: number, r2: number): number {
  const bx = b[0] - a[0];
  const by = b[1] - a[1];
  const bz = b[2] - a[2];
  const l2 = bx * bx + by * by + bz * bz;
  const rr = r1 - r2;
  const a2 = l2 - rr * rr;
  const il2 = 1 / l2;
  const px = x - a[0];
  const py = y - a[1];
  const pz = z - a[2];
  const yy = px * bx + py * by + pz * bz;
  const zz = yy - l2;
  const qx = px * l2 - bx * yy;
  const qy = py * l2 - by * yy;
  const qz = pz * l2 - bz * yy;
  const x2 = qx * qx + qy * qy + qz * qz;
  const y2 = yy * yy * l2;
  const z2 = zz * zz * l2;
  const k = Math.sign(rr) * rr * rr * x2;
  if (Math.sign(zz) * a2 * z2 > k) return Math.sqrt(x2 + z2) * il2 - r2;
  if (Math.sign(yy) * a2 * y2 < k) return Math.sqrt(x2 + y2) * il2 - r1;
  return (Math.sqrt(x2 * a2 * il2) + yy * rr) * il2 - r1;
}

function ellipsoid(x: number, y: number, z: number, c: V3, r: V3): number {
  const px = (x - c[0]) / r[0];
  const py = (y - c[1]) / r[1];
  const pz = (z - c[2]) / r[2];
  const k0 = Math.sqrt(px * px + py * py + pz * pz);
  const k1 = Math.sqrt((px / r[0]) ** 2 + (py / r[1]) ** 2 + (pz / r[2]) ** 2);
  return k1 < 1e-9 ? -Math.min(...r) : (k0 * (k0 - 1)) / k1;
}

/** Smooth union over a width of k. */
function blend(a: number, b: number, k: number): number {
  const h = Math.max(0, k - Math.abs(a - b)) / k;
  return Math.min(a, b) - h * h * k * 0.25;
}

export interface Field {
  distance(x: number, y: number, z: number): number;
  /** Box that holds the surface. */
  low: V3;
  high: V3;
  /** Cell size, metres. */
  cell: number;
  part(x: number, y: number, z: number): Part;
}

/** The pieces of the figure, each meshed by itself: body with head, two hands, and shoes in two pieces. */
export function bodyFields(skeleton: Skeleton, fineness = 1): Field[] {
  const p = restPlaces(skeleton);
  const s = skeleton.height / 1.75;
  const at = (j: number, dx = 0, dy = 0, dz = 0): V3 => [
    p[3 * j] + dx * s,
    p[3 * j + 1] + dy * s,
    p[3 * j + 2] + dz * s,
  ];
  const r = (v: number) => v * s;
  const body = torso(at, r);
  const fields: Field[] = [
    {
      distance: body,
      low: [-0.8 * s, p[3 * J.leftFoot + 1] - 0.02 * s, -0.2 * s],
      high: [0.8 * s, 1.8 * s, 0.22 * s],
      cell: 0.012 * fineness,
      part: () => "body",
    },
    head(at, r, s, fineness),
  ];
  for (const side of [1, -1] as const)
    fields.push(hand(at, r, s, side, fineness), ...shoe(at, skeleton, side, fineness));
  return fields;
}

type At = (j: number, dx?: number, dy?: number, dz?: number) => V3;

function torso(at: At, r: (v: number) => number): (x: number, y: number, z: number) => number {
  const pelvis = at(J.hips, 0, -0.025, -0.005);
  const waist = at(J.spine, 0, 0.05, 0.006);
  const ribs = at(J.chest, 0, 0.105, 0.004);
  const upper = at(J.upperChest, 0, 0.055, 0.0);
  const neckLow = at(J.neck, 0, -0.045, -0.006);
  const neckHigh = at(J.head, 0, 0.03, 0.004);
  const pairs = [J.leftUpperArm, J.rightUpperArm].map((j) => ({
    shoulder: at(j),
    elbow: at(j + 1),
    wrist: at(j + 2),
    collar: at(J.upperChest, 0, 0.115, -0.006),
  }));
  const legs = [J.leftUpperLeg, J.rightUpperLeg].map((j, i) => ({
    hip: at(j, i === 0 ? -0.004 : 0.004, -0.01, 0),
    knee: at(j + 1, 0, 0, 0.004),
    calf: at(j + 1, i === 0 ? 0.006 : -0.006, -0.12, -0.016),
    ankle: at(j + 2, 0, 0.015, -0.004),
    seat: at(j, i === 0 ? -0.012 : 0.012, 0.0, -0.052),
  }));
  return (x, y, z) => {
    let d = ellipsoid(x, y, z, pelvis, [r(0.15), r(0.105), r(0.1)]);
    d = blend(d, ellipsoid(x, y, z, waist, [r(0.122), r(0.13), r(0.086)]), r(0.085));
    d = blend(d, ellipsoid(x, y, z, ribs, [r(0.142), r(0.16), r(0.1)]), r(0.085));
    d = blend(d, ellipsoid(x, y, z, upper, [r(0.15), r(0.1), r(0.088)]), r(0.07));
    d = blend(d, roundCone(x, y, z, neckLow, neckHigh, r(0.056), r(0.05)), r(0.05));
    for (const leg of legs) {
      let l = roundCone(x, y, z, leg.hip, leg.knee, r(0.083), r(0.052));
      l = blend(l, roundCone(x, y, z, leg.knee, leg.ankle, r(0.051), r(0.036)), r(0.03));
      l = blend(l, ellipsoid(x, y, z, leg.calf, [r(0.05), r(0.12), r(0.052)]), r(0.03));
      d = blend(d, l, r(0.05));
      d = blend(d, ellipsoid(x, y, z, leg.seat, [r(0.085), r(0.085), r(0.07)]), r(0.05));
    }
    for (const arm of pairs) {
      let a = roundCone(x, y, z, arm.collar, arm.shoulder, r(0.058), r(0.056));
      a = blend(a, roundCone(x, y, z, arm.shoulder, arm.elbow, r(0.053), r(0.039)), r(0.045));
      a = blend(a, roundCone(x, y, z, arm.elbow, arm.wrist, r(0.04), r(0.027)), r(0.02));
      d = blend(d, a, r(0.05));
    }
    return d;
  };
}

function head(at: At, r: (v: number) => number, s: number, fineness: number): Field {
  const skull = at(J.head, 0, 0.095, 0.008);
  const jaw = at(J.head, 0, 0.035, 0.038);
  const chin = at(J.head, 0, 0.0, 0.066);
  const brow = at(J.head, 0, 0.103, 0.088);
  const noseHigh = at(J.head, 0, 0.09, 0.098);
  const noseLow = at(J.head, 0, 0.058, 0.111);
  const back = at(J.head, 0, 0.105, -0.02);
  const distance = (x: number, y: number, z: number) => {
    let d = ellipsoid(x, y, z, skull, [r(0.076), r(0.1), r(0.09)]);
    d = blend(d, ellipsoid(x, y, z, back, [r(0.074), r(0.082), r(0.078)]), r(0.04));
    d = blend(d, ellipsoid(x, y, z, jaw, [r(0.058), r(0.062), r(0.056)]), r(0.04));
    d = blend(d, ellipsoid(x, y, z, chin, [r(0.026), r(0.02), r(0.024)]), r(0.03));
    d = blend(d, ellipsoid(x, y, z, brow, [r(0.045), r(0.012), r(0.014)]), r(0.02));
    d = blend(d, roundCone(x, y, z, noseHigh, noseLow, r(0.008), r(0.013)), r(0.016));
    return d;
  };
  const c = at(J.head, 0, 0.09, 0.028);
  // The face is the front of the head, cut by a plane leaning back 21 degrees.
  const lean = (21 * Math.PI) / 180;
  return {
    distance,
    low: [skull[0] - 0.12 * s, skull[1] - 0.15 * s, skull[2] - 0.13 * s],
    high: [skull[0] + 0.12 * s, skull[1] + 0.13 * s, skull[2] + 0.16 * s],
    cell: 0.0065 * fineness,
    part: (_x, y, z) =>
      (z - c[2]) * Math.cos(lean) - (y - c[1]) * Math.sin(lean) > 0.004 * s ? "ivory" : "body",
  };
}

function hand(at: At, r: (v: number) => number, s: number, side: 1 | -1, fineness: number): Field {
  const wrist = side === 1 ? J.leftHand : J.rightHand;
  const m = (x: number, y: number, z: number) => at(wrist, side * x, y, z);
  const palmA = m(0.03, 0, 0.004);
  const palmB = m(0.075, -0.002, 0.004);
  // Four fingers, a little curled; the thumb apart, towards the front.
  const fingers = [0.03, 0.01, -0.011, -0.03].map((z, i) => {
    const l = [0.062, 0.07, 0.066, 0.052][i];
    return {
      a: m(0.085, -0.002, z),
      b: m(0.085 + l * 0.55, -0.014, z * 1.05),
      c: m(0.085 + l * 0.86, -0.038, z * 1.02),
    };
  });
  const thumb = { a: m(0.03, -0.004, 0.03), b: m(0.062, -0.012, 0.052), c: m(0.088, -0.022, 0.056) };
  const distance = (x: number, y: number, z: number) => {
    let d = roundCone(x, y, z, m(-0.012, 0, 0), palmA, r(0.026), r(0.026));
    d = blend(d, ellipsoid(x, y, z, palmB, [r(0.04), r(0.0165), r(0.041)]), r(0.03));
    for (const f of fingers) {
      d = blend(d, roundCone(x, y, z, f.a, f.b, r(0.0105), r(0.0095)), r(0.01));
      d = blend(d, roundCone(x, y, z, f.b, f.c, r(0.0095), r(0.0075)), r(0.006));
    }
    d = blend(d, roundCone(x, y, z, thumb.a, thumb.b, r(0.014), r(0.011)), r(0.016));
    d = blend(d, roundCone(x, y, z, thumb.b, thumb.c, r(0.011), r(0.008)), r(0.006));
    return d;
  };
  const c = at(wrist, side * 0.07);
  return {
    distance,
    low: [c[0] - 0.12 * s, c[1] - 0.08 * s, c[2] - 0.08 * s],
    high: [c[0] + 0.12 * s, c[1] + 0.06 * s, c[2] + 0.09 * s],
    cell: 0.006 * fineness,
    part: () => "ivory",
  };
}

/** A shoe in two pieces with a groove at the ball of the foot. */
function shoe(at: At, skeleton: Skeleton, side: 1 | -1, fineness: number): Field[] {
  const { foot } = skeleton;
  const ankle = side === 1 ? J.leftFoot : J.rightFoot;
  const k = foot.ballForward / 0.125;
  const m = (x: number, y: number, z: number): V3 => {
    const a = at(ankle);
    return [a[0] + x * k, y * k, a[2] + z * k];
  };
  const groove = at(ankle)[2] + 0.118 * k;
  const flat = (d: number, y: number) => Math.max(d, -y);
  const heelField = (x: number, y: number, z: number) => {
    let d = roundCone(x, y, z, m(0, 0.034, -0.02), m(side * 0.004, 0.032, 0.1), 0.038 * k, 0.045 * k);
    d = blend(d, roundCone(x, y, z, m(0, 0.105, -0.006), m(0, 0.06, 0.0), 0.04 * k, 0.042 * k), 0.03 * k);
    d = blend(
      d,
      roundCone(x, y, z, m(0, 0.075, 0.02), m(side * 0.003, 0.04, 0.1), 0.034 * k, 0.032 * k),
      0.03 * k,
    );
    return Math.max(flat(d, y), z - groove);
  };
  const toeField = (x: number, y: number, z: number) => {
    let d = roundCone(
      x,
      y,
      z,
      m(side * 0.004, 0.03, 0.112),
      m(side * 0.0, 0.024, 0.165),
      0.046 * k,
      0.034 * k,
    );
    d = blend(d, ellipsoid(x, y, z, m(0, 0.026, 0.14), [0.048 * k, 0.034 * k, 0.058 * k]), 0.02 * k);
    return Math.max(flat(d, y), groove + 0.0035 * k - z);
  };
  const box = (z0: number, z1: number): { low: V3; high: V3 } => ({
    low: m(-0.08, -0.02, z0),
    high: m(0.08, 0.17, z1),
  });
  const name = side === 1 ? "left" : "right";
  return [
    { distance: heelField, ...box(-0.09, 0.15), cell: 0.0065 * fineness, part: () => `${name}Heel` as Part },
    { distance: toeField, ...box(0.08, 0.24), cell: 0.006 * fineness, part: () => `${name}Toe` as Part },
  ];
}
