/** The character's mesh: surface nets over the distance fields, with normals, materials and skin weights. No DOM, no three.js. */
import { J, JOINT_COUNT, PARENTS } from "../../core/skeleton/joints.ts";
import type { Skeleton } from "../../core/skeleton/skeleton.ts";
import { bodyFields, type Field, PARTS, restPlaces } from "./body-shape.ts";

export interface CharacterMesh {
  positions: Float32Array;
  normals: Float32Array;
  /** Triangles, grouped by part in the order of PARTS. */
  indices: Uint32Array;
  /** First index and count of each part. */
  groups: [number, number][];
  /** Four bones a vertex. */
  skinIndices: Uint16Array;
  skinWeights: Float32Array;
}

interface Raw {
  positions: number[];
  normals: number[];
  /** Triangles of each part. */
  triangles: number[][];
  /** Bones that a vertex may follow; null for any. */
  only: (number | null)[];
}

/**
 * Meshes the character for a skeleton, in its rest pose.
 *
 * @param fineness 1 for one character near by; 2 and more for crowds.
 */
export function buildCharacterMesh(skeleton: Skeleton, fineness = 1): CharacterMesh {
  const raw: Raw = { positions: [], normals: [], triangles: PARTS.map(() => []), only: [] };
  const bones: (number | null)[] = [
    null,
    J.head,
    J.leftHand,
    J.leftFoot,
    J.leftToes,
    J.rightHand,
    J.rightFoot,
    J.rightToes,
  ];
  bodyFields(skeleton, fineness).forEach((field, i) => {
    surfaceNets(raw, field, bones[i]);
  });
  const indices: number[] = [];
  const groups: [number, number][] = raw.triangles.map((t) => {
    const from = indices.length;
    for (const v of t) indices.push(v);
    return [from, t.length];
  });
  const count = raw.positions.length / 3;
  const skinIndices = new Uint16Array(4 * count);
  const skinWeights = new Float32Array(4 * count);
  skin(raw, skeleton, skinIndices, skinWeights);
  return {
    positions: Float32Array.from(raw.positions),
    normals: Float32Array.from(raw.normals),
    indices: Uint32Array.from(indices),
    groups,
    skinIndices,
    skinWeights,
  };
}

/** Naive surface nets [Gibson 1998]: one vertex a cell that the surface crosses, a quad an edge. Far blocks are skipped. */
function surfaceNets(raw: Raw, field: Field, only: number | null): void {
  const { cell, high } = field;
  // Two cells all round: where the surface came into the outermost ones, it had a hole.
  const low = field.low.map((v) => v - 2 * cell);
  const n = [0, 1, 2].map((k) => Math.ceil((high[k] + 2 * cell - low[k]) / cell) + 1);
  const [nx, ny, nz] = n;
  const value = new Float32Array(nx * ny * nz).fill(1);
  const B = 6;
  for (let bz = 0; bz < nz; bz += B) {
    for (let by = 0; by < ny; by += B) {
      for (let bx = 0; bx < nx; bx += B) {
        const c = field.distance(
          low[0] + (bx + B / 2) * cell,
          low[1] + (by + B / 2) * cell,
          low[2] + (bz + B / 2) * cell,
        );
        // Smooth unions bend distances a little: keep a margin.
        if (Math.abs(c) > B * cell * 1.25) {
          if (c < 0)
            for (let z = bz; z < Math.min(nz, bz + B); z++)
              for (let y = by; y < Math.min(ny, by + B); y++)
                value.fill(-1, (z * ny + y) * nx + bx, (z * ny + y) * nx + Math.min(nx, bx + B));
          continue;
        }
        for (let z = bz; z < Math.min(nz, bz + B); z++)
          for (let y = by; y < Math.min(ny, by + B); y++)
            for (let x = bx; x < Math.min(nx, bx + B); x++)
              value[(z * ny + y) * nx + x] = field.distance(
                low[0] + x * cell,
                low[1] + y * cell,
                low[2] + z * cell,
              );
      }
    }
  }
  const vertex = new Int32Array(nx * ny * nz).fill(-1);
  const corner = [0, 1, nx, nx + 1, nx * ny, nx * ny + 1, nx * ny + nx, nx * ny + nx + 1];
  const h = cell * 0.4;
  for (let z = 0; z + 1 < nz; z++) {
    for (let y = 0; y + 1 < ny; y++) {
      for (let x = 0; x + 1 < nx; x++) {
        const i = (z * ny + y) * nx + x;
        let inside = 0;
        for (let k = 0; k < 8; k++) if (value[i + corner[k]] < 0) inside |= 1 << k;
        if (inside === 0 || inside === 255) continue;
        let sx = 0;
        let sy = 0;
        let sz = 0;
        let count = 0;
        for (let a = 0; a < 8; a++) {
          for (const bit of [1, 2, 4]) {
            const b = a | bit;
            if (b === a || ((inside >> a) & 1) === ((inside >> b) & 1)) continue;
            const va = value[i + corner[a]];
            const vb = value[i + corner[b]];
            const t = va / (va - vb);
            sx += (a & 1) + (bit === 1 ? t : 0);
            sy += ((a >> 1) & 1) + (bit === 2 ? t : 0);
            sz += ((a >> 2) & 1) + (bit === 4 ? t : 0);
            count++;
          }
        }
        const px = low[0] + (x + sx / count) * cell;
        const py = low[1] + (y + sy / count) * cell;
        const pz = low[2] + (z + sz / count) * cell;
        const gx = field.distance(px + h, py, pz) - field.distance(px - h, py, pz);
        const gy = field.distance(px, py + h, pz) - field.distance(px, py - h, pz);
        const gz = field.distance(px, py, pz + h) - field.distance(px, py, pz - h);
        const g = Math.hypot(gx, gy, gz) || 1;
        vertex[i] = raw.positions.length / 3;
        raw.positions.push(px, py, pz);
        raw.normals.push(gx / g, gy / g, gz / g);
        raw.only.push(only);
      }
    }
  }
  const quad = (
    a: number,
    b: number,
    c: number,
    d: number,
    flip: boolean,
    px: number,
    py: number,
    pz: number,
  ) => {
    if (a < 0 || b < 0 || c < 0 || d < 0) return;
    const list = raw.triangles[PARTS.indexOf(field.part(px, py, pz))];
    if (flip) list.push(a, c, b, a, d, c);
    else list.push(a, b, c, a, c, d);
  };
  for (let z = 1; z + 1 < nz; z++) {
    for (let y = 1; y + 1 < ny; y++) {
      for (let x = 1; x + 1 < nx; x++) {
        const i = (z * ny + y) * nx + x;
        const here = value[i] < 0;
        const px = low[0] + x * cell;
        const py = low[1] + y * cell;
        const pz = low[2] + z * cell;
        if (here !== value[i + 1] < 0)
          quad(vertex[i - nx - nx * ny], vertex[i - nx * ny], vertex[i], vertex[i - nx], !here, px, py, pz);
        if (here !== value[i + nx] < 0)
          quad(vertex[i - 1 - nx * ny], vertex[i - 1], vertex[i], vertex[i - nx * ny], !here, px, py, pz);
        if (here !== value[i + nx * ny] < 0)
          quad(vertex[i - 1 - nx], vertex[i - nx], vertex[i], vertex[i - 1], !here, px, py, pz);
      }
    }
  }
}

/** Where each bone's segment ends: its child, or beyond. */
function boneEnds(skeleton: Skeleton, rest: Float64Array): Float64Array {
  const ends = new Float64Array(3 * JOINT_COUNT);
  const child: Record<number, number> = {};
  for (let j = JOINT_COUNT - 1; j > 0; j--)
    if (![J.leftShoulder, J.rightShoulder, J.leftUpperLeg, J.rightUpperLeg].includes(j as never))
      child[PARENTS[j]] = j;
  for (let j = 0; j < JOINT_COUNT; j++) {
    const c = child[j];
    for (let k = 0; k < 3; k++) ends[3 * j + k] = c !== undefined ? rest[3 * c + k] : rest[3 * j + k];
  }
  ends[3 * J.head + 1] += 0.17 * (skeleton.height / 1.75);
  ends[3 * J.leftHand] += 0.1;
  ends[3 * J.rightHand] -= 0.1;
  ends[3 * J.leftToes + 2] += 0.06;
  ends[3 * J.rightToes + 2] += 0.06;
  return ends;
}

/** Weights: the nearest bone and its neighbours, by distance to their segments; sharp away from joints, soft at them. */
function skin(raw: Raw, skeleton: Skeleton, indices: Uint16Array, weights: Float32Array): void {
  const rest = restPlaces(skeleton);
  const ends = boneEnds(skeleton, rest);
  const s = skeleton.height / 1.75;
  const count = raw.positions.length / 3;
  const d = new Float64Array(JOINT_COUNT);
  // Softness of each joint's blend, metres.
  const neighbours = Array.from({ length: JOINT_COUNT }, (_, j) => {
    const out = [j];
    if (PARENTS[j] >= 0) out.push(PARENTS[j]);
    for (let c = 1; c < JOINT_COUNT; c++) if (PARENTS[c] === j) out.push(c);
    return out;
  });
  for (let v = 0; v < count; v++) {
    const only = raw.only[v];
    if (only !== null) {
      indices[4 * v] = only;
      weights[4 * v] = 1;
      continue;
    }
    const x = raw.positions[3 * v];
    const y = raw.positions[3 * v + 1];
    const z = raw.positions[3 * v + 2];
    let best = 0;
    for (let j = 0; j < JOINT_COUNT; j++) {
      d[j] = segment(x, y, z, rest, ends, 3 * j);
      // The pelvis is wide: it holds what lies about it.
      if (j === J.hips) d[j] -= 0.03 * s;
      if (d[j] < d[best]) best = j;
    }
    const near = neighbours[best]
      .map((j) => ({ j, w: Math.exp(-(d[j] - d[best]) / (0.022 * s)) }))
      .sort((a, b) => b.w - a.w)
      .slice(0, 4);
    const total = near.reduce((t, e) => t + e.w, 0);
    near.forEach((e, k) => {
      indices[4 * v + k] = e.j;
      weights[4 * v + k] = e.w / total;
    });
  }
}

function segment(x: number, y: number, z: number, a: Float64Array, b: Float64Array, o: number): number {
  const ex = b[o] - a[o];
  const ey = b[o + 1] - a[o + 1];
  const ez = b[o + 2] - a[o + 2];
  const l = ex * ex + ey * ey + ez * ez;
  const t =
    l > 1e-12
      ? Math.max(0, Math.min(1, ((x - a[o]) * ex + (y - a[o + 1]) * ey + (z - a[o + 2]) * ez) / l))
      : 0;
  return Math.hypot(x - a[o] - t * ex, y - a[o + 1] - t * ey, z - a[o + 2] - t * ez);
}
