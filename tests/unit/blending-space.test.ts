/** Foot and root spaces of footstep-parameterised blending: triangles, weights, Algorithm 1, means of rotations. */
import fc from "fast-check";
import { beforeAll, describe, expect, it } from "vitest";
import {
  createFootSpace,
  createLocated,
  type FootSpace,
  locate,
} from "../../src/core/blending/foot-space.ts";
import type { BlendLibrary } from "../../src/core/blending/library.ts";
import { blendRows, meanRotation } from "../../src/core/blending/mean-rotation.ts";
import { type Choice, chooseMix, createChoice, createMix, type Mix } from "../../src/core/blending/mix.ts";
import { createRootSpace, rootWeights } from "../../src/core/blending/polar-bands.ts";
import { quatFromRotationVector, quatSlerp } from "../../src/core/math/quaternion.ts";
import { createRandom } from "../../src/core/math/random.ts";
import { createSkeleton } from "../../src/core/skeleton/skeleton.ts";
import { studioBlendLibrary } from "../../src/studio/blend-library.ts";

let library: BlendLibrary;
beforeAll(() => {
  library = studioBlendLibrary(createSkeleton(1.75));
}, 60_000);

/** Determinant of three rows (x, z, 1): nothing of the code under test. */
const det = (a: number, b: number, c: number, d: number, e: number, f: number): number =>
  a * d + b * e + c * f - d * e - c * b - a * f;

/** All triangles that hold a point, with its weights by Cramer's rule. */
function holders(space: FootSpace, x: number, z: number): { triangle: number; weights: number[] }[] {
  const out: { triangle: number; weights: number[] }[] = [];
  const p = space.points;
  for (let t = 0; t < space.triangles.length / 3; t++) {
    const a = 2 * space.triangles[3 * t];
    const b = 2 * space.triangles[3 * t + 1];
    const c = 2 * space.triangles[3 * t + 2];
    const d = det(p[a], p[a + 1], p[b], p[b + 1], p[c], p[c + 1]);
    const weights = [
      det(x, z, p[b], p[b + 1], p[c], p[c + 1]) / d,
      det(p[a], p[a + 1], x, z, p[c], p[c + 1]) / d,
      det(p[a], p[a + 1], p[b], p[b + 1], x, z) / d,
    ];
    if (weights.every((w) => w > -1e-9)) out.push({ triangle: t, weights });
  }
  return out;
}

const boundsOf = (p: Float64Array) => {
  const xs = Array.from(p).filter((_, i) => i % 2 === 0);
  const zs = Array.from(p).filter((_, i) => i % 2 === 1);
  return [Math.min(...xs), Math.max(...xs), Math.min(...zs), Math.max(...zs)];
};

describe("foot space", () => {
  it("agrees with an independent search on 100,000 random queries (seed 7)", () => {
    const r = createRandom(7);
    const located = createLocated();
    let inside = 0;
    const wrong: string[] = [];
    let worst = 0;
    for (const space of library.feet) {
      const [x0, x1, z0, z1] = boundsOf(space.points);
      for (let n = 0; n < 50_000; n++) {
        const x = r.between(x0 - 0.2, x1 + 0.2);
        const z = r.between(z0 - 0.2, z1 + 0.2);
        // From the last triangle, as the runtime does.
        locate(located, space, x, z, located.triangle);
        const found = holders(space, x, z);
        if (found.length === 0 && located.outside === 0) wrong.push(`(${x}, ${z}) is outside`);
        if (found.length > 0) {
          inside++;
          const same = found.find((f) => f.triangle === located.triangle);
          if (!same) wrong.push(`(${x}, ${z}) is in triangle ${found[0].triangle}`);
          for (let k = 0; k < 3; k++)
            worst = Math.max(worst, Math.abs(located.weights[k] - (same?.weights[k] ?? 2)));
        }
        let sum = 0;
        let px = 0;
        let pz = 0;
        for (let k = 0; k < 3; k++) {
          const w = located.weights[k];
          const c = space.triangles[3 * located.triangle + k];
          if (w < 0) wrong.push(`(${x}, ${z}) has weight ${w}`);
          sum += w;
          px += w * space.points[2 * c];
          pz += w * space.points[2 * c + 1];
        }
        worst = Math.max(worst, Math.abs(sum - 1), Math.hypot(px - located.x, pz - located.z));
      }
    }
    expect(wrong).toEqual([]);
    expect(worst).toBeLessThan(1e-9);
    expect(inside).toBeGreaterThan(20_000);
  }, 60_000);

  it("has no landing point inside any triangle's circle", () => {
    for (const { points, triangles } of library.feet)
      for (let t = 0; t < triangles.length; t += 3) {
        const [ax, az, bx, bz, cx, cz] = [0, 1, 2].flatMap((k) => [
          points[2 * triangles[t + k]],
          points[2 * triangles[t + k] + 1],
        ]);
        const d = 2 * (ax * (bz - cz) + bx * (cz - az) + cx * (az - bz));
        const sq = [ax * ax + az * az, bx * bx + bz * bz, cx * cx + cz * cz];
        const ox = (sq[0] * (bz - cz) + sq[1] * (cz - az) + sq[2] * (az - bz)) / d;
        const oz = (sq[0] * (cx - bx) + sq[1] * (ax - cx) + sq[2] * (bx - ax)) / d;
        const radius = Math.hypot(ax - ox, az - oz);
        for (let i = 0; i < points.length; i += 2)
          expect(Math.hypot(points[i] - ox, points[i + 1] - oz)).toBeGreaterThan(radius * (1 - 1e-7) - 1e-9);
      }
  });

  it("projects a query outside on the hull's nearest point", () => {
    const r = createRandom(3);
    const located = createLocated();
    for (const space of library.feet) {
      const [x0, x1, z0, z1] = boundsOf(space.points);
      for (let n = 0; n < 3000; n++) {
        const x = r.between(x0 - 1, x1 + 1);
        const z = r.between(z0 - 1, z1 + 1);
        locate(located, space, x, z, located.triangle);
        if (located.outside === 0) continue;
        // Nearest point over fine samples of every pair of points on the hull.
        let nearest = Number.POSITIVE_INFINITY;
        for (let k = 0; k < space.hull.length; k++) {
          const a = space.hull[k];
          const b = space.hull[(k + 1) % space.hull.length];
          for (let u = 0; u <= 1; u += 0.02) {
            const hx = space.points[2 * a] + u * (space.points[2 * b] - space.points[2 * a]);
            const hz = space.points[2 * a + 1] + u * (space.points[2 * b + 1] - space.points[2 * a + 1]);
            nearest = Math.min(nearest, Math.hypot(x - hx, z - hz));
          }
        }
        expect(located.outside).toBeLessThanOrEqual(nearest + 1e-9);
        expect(located.outside).toBeGreaterThan(nearest - 0.02);
        expect(Math.hypot(x - located.x, z - located.z)).toBeCloseTo(located.outside, 9);
      }
    }
  });

  it("ends on any triangulation, from any triangle, at any scale", () => {
    fc.assert(
      fc.property(
        fc.array(fc.tuple(fc.integer({ min: -9, max: 9 }), fc.integer({ min: -9, max: 9 })), {
          minLength: 3,
          maxLength: 24,
        }),
        fc.constantFrom(1e-6, 1, 1e6),
        fc.tuple(
          fc.double({ min: -12, max: 12, noNaN: true }),
          fc.double({ min: -12, max: 12, noNaN: true }),
        ),
        fc.integer({ min: -3, max: 60 }),
        (list, scale, [x, z], from) => {
          const points = Float64Array.from(list.flatMap(([a, b]) => [a * scale, b * scale]));
          let space: FootSpace;
          try {
            space = createFootSpace(points);
          } catch (error) {
            expect(error).toBeInstanceOf(RangeError);
            return;
          }
          const located = createLocated();
          locate(located, space, x * scale, z * scale, from);
          const sum = located.weights[0] + located.weights[1] + located.weights[2];
          expect(sum).toBeCloseTo(1, 6);
          expect(located.triangle).toBeLessThan(space.triangles.length / 3);
        },
      ),
      { numRuns: 300, seed: 11 },
    );
  });

  it("names the fault of points on one line", () => {
    expect(() => createFootSpace(Float64Array.from([0, 0, 1, 1, 2, 2]))).toThrow(/not on one line/);
  });
});

/** Where a mix lands when its clips' landing points are weighed. */
function landingOf(mix: Mix, space: FootSpace): [number, number] {
  let x = 0;
  let z = 0;
  for (let k = 0; k < mix.count; k++) {
    x += mix.weights[k] * space.points[2 * mix.clips[k]];
    z += mix.weights[k] * space.points[2 * mix.clips[k] + 1];
  }
  return [x, z];
}

describe("Algorithm 1", () => {
  const mix = createMix();
  const choice: Choice = createChoice();
  /** Random queries inside a hull with random root velocities. */
  function* queries(seed: number, count: number) {
    const r = createRandom(seed);
    const weights = new Float64Array(library.names.length);
    for (let n = 0; n < count; n++) {
      const space = library.feet[n % 2];
      const t = r.below(space.triangles.length / 3);
      const a = r.next();
      const b = r.next() * (1 - a);
      const l = [a, b, 1 - a - b];
      let x = 0;
      let z = 0;
      l.forEach((w, k) => {
        x += w * space.points[2 * space.triangles[3 * t + k]];
        z += w * space.points[2 * space.triangles[3 * t + k] + 1];
      });
      rootWeights(weights, library.root, r.between(-0.4, 0.4), r.between(-0.7, 3), r.between(-1.5, 1.5));
      yield { space, x, z, weights, four: r.next() };
    }
  }

  it("lands on q with lambda4 = 0, whatever is replaced (seed 5)", () => {
    for (const q of queries(5, 5000)) {
      chooseMix(mix, choice, q.space, q.x, q.z, q.weights, 0.12, 0);
      const [x, z] = landingOf(mix, q.space);
      expect(Math.hypot(x - q.x, z - q.z)).toBeLessThan(1e-7);
    }
  });

  it("lands on r with lambda4 = 1 (seed 6)", () => {
    for (const q of queries(6, 5000)) {
      chooseMix(mix, choice, q.space, q.x, q.z, q.weights, 0.12, 1);
      const [x, z] = landingOf(mix, q.space);
      expect(Math.hypot(x - choice.rx, z - choice.rz)).toBeLessThan(1e-7);
    }
  });

  it("never has a negative weight; up to beta it lands on q, beyond on the way to r (seed 8)", () => {
    let beyond = 0;
    let least = 0;
    const worst = { sum: 0, landing: 0, within: 0, segment: 0, spent: 0 };
    for (const q of queries(8, 20_000)) {
      chooseMix(mix, choice, q.space, q.x, q.z, q.weights, 0.12, q.four);
      let sum = 0;
      for (let k = 0; k < mix.count; k++) {
        least = Math.min(least, mix.weights[k]);
        sum += mix.weights[k];
      }
      worst.sum = Math.max(worst.sum, Math.abs(sum - 1));
      const [x, z] = landingOf(mix, q.space);
      worst.landing = Math.max(worst.landing, Math.hypot(x - choice.x, z - choice.z));
      const done = Math.hypot(x - q.x, z - q.z);
      if (q.four <= choice.beta - 1e-9) worst.within = Math.max(worst.within, done);
      else {
        beyond++;
        // On the segment, and no farther along than need be: one of the corners has nothing left.
        const way = Math.hypot(choice.rx - q.x, choice.rz - q.z);
        const left = Math.hypot(choice.rx - x, choice.rz - z);
        worst.segment = Math.max(worst.segment, Math.abs(done + left - way));
        worst.spent = Math.max(worst.spent, Math.min(...choice.lambda));
      }
    }
    expect(least).toBe(0);
    for (const v of Object.values(worst)) expect(v).toBeLessThan(1e-6);
    expect(beyond).toBeGreaterThan(1000);
  });

  it("replaces a corner only by a clip of the root's that lands within epsilon of it", () => {
    const before = createChoice();
    let replaced = 0;
    for (const q of queries(9, 5000)) {
      chooseMix(mix, before, q.space, q.x, q.z, null, 0, 0);
      const was = Array.from(before.corners);
      chooseMix(mix, choice, q.space, q.x, q.z, q.weights, 0.12, 0);
      const heavy = Array.from(q.weights)
        .map((w, i) => [w, i])
        .sort((a, b) => b[0] - a[0])
        .slice(0, 3)
        .map(([, i]) => i);
      for (let k = 0; k < 3; k++) {
        const c = choice.corners[k];
        if (c === was[k]) continue;
        replaced++;
        expect(heavy).toContain(c);
        const p = q.space.points;
        expect(Math.hypot(p[2 * c] - p[2 * was[k]], p[2 * c + 1] - p[2 * was[k] + 1])).toBeLessThan(0.12);
      }
    }
    expect(replaced).toBeGreaterThan(200);
  });
});

describe("root space", () => {
  it("gives an example's own velocity to that example alone, and sums to one everywhere", () => {
    const n = library.names.length;
    const w = new Float64Array(n);
    for (let i = 0; i < n; i++) {
      const [x, z, yaw] = library.velocities.subarray(3 * i, 3 * i + 3);
      rootWeights(w, library.root, x, z, yaw);
      expect(w[i], library.names[i]).toBeGreaterThan(0.95);
    }
    const r = createRandom(2);
    for (let k = 0; k < 5000; k++) {
      rootWeights(w, library.root, r.between(-2, 2), r.between(-2, 4), r.between(-3, 3));
      let sum = 0;
      for (const v of w) sum += v;
      expect(Math.min(...w)).toBeGreaterThanOrEqual(0);
      expect(sum).toBeCloseTo(1, 9);
    }
  });

  it("treats two speeds of one direction as a straight line", () => {
    const space = createRootSpace([
      { x: 0, z: 1, yaw: 0 },
      { x: 0, z: 2, yaw: 0 },
    ]);
    const w = new Float64Array(2);
    for (const u of [0, 0.25, 0.5, 0.75, 1]) {
      rootWeights(w, space, 0, 1 + u, 0);
      expect(w[1]).toBeCloseTo(u, 9);
    }
  });
});

describe("means of rotations", () => {
  const vector = (most: number) =>
    fc
      .tuple(
        fc.double({ min: -1, max: 1, noNaN: true }),
        fc.double({ min: -1, max: 1, noNaN: true }),
        fc.double({ min: -1, max: 1, noNaN: true }),
      )
      .map((v) => v.map((x) => x * most) as [number, number, number]);
  const angle = (a: Float64Array, ai: number, b: Float64Array, bi: number) => {
    let d = 0;
    for (let k = 0; k < 4; k++) d += a[ai + k] * b[bi + k];
    return 2 * Math.acos(Math.min(1, Math.abs(d)));
  };

  it("is slerp for two, whatever their signs", () => {
    fc.assert(
      fc.property(
        vector(1.2),
        vector(1.2),
        fc.double({ min: 0, max: 1, noNaN: true }),
        fc.boolean(),
        (a, b, t, flip) => {
          const q = new Float64Array(8);
          quatFromRotationVector(q, 0, ...a);
          quatFromRotationVector(q, 4, ...b);
          if (flip) for (let k = 4; k < 8; k++) q[k] = -q[k];
          const out = new Float64Array(8);
          meanRotation(out, 0, q, [1 - t, t], 2);
          quatSlerp(out, 4, q, 0, q, 4, t);
          expect(angle(out, 0, out, 4)).toBeLessThan(1e-6);
        },
      ),
      { seed: 4, numRuns: 300 },
    );
  });

  it("does not depend on the order, and the batch's one step is within 0.05 degrees of it", () => {
    fc.assert(
      fc.property(
        fc.array(vector(0.75), { minLength: 3, maxLength: 6 }),
        fc.array(fc.double({ min: 0.05, max: 1, noNaN: true }), { minLength: 6, maxLength: 6 }),
        (list, raw) => {
          const n = list.length;
          const sum = raw.slice(0, n).reduce((s, v) => s + v, 0);
          const w = Float64Array.from(raw.slice(0, n), (v) => v / sum);
          const q = new Float64Array(4 * n);
          list.forEach((v, k) => {
            quatFromRotationVector(q, 4 * k, ...v);
          });
          const back = new Float64Array(4 * n);
          for (let k = 0; k < n; k++) back.set(q.subarray(4 * k, 4 * k + 4), 4 * (n - 1 - k));
          const out = new Float64Array(12);
          meanRotation(out, 0, q, w, n);
          meanRotation(out, 4, back, Float64Array.from(w).reverse(), n);
          expect(angle(out, 0, out, 4)).toBeLessThan(1e-6);
          const fast = new Float64Array(4);
          blendRows(fast, q, 4, w, n, 0, 1);
          expect((angle(fast, 0, out, 0) * 180) / Math.PI).toBeLessThan(0.05);
        },
      ),
      { seed: 4, numRuns: 500 },
    );
  });
});
