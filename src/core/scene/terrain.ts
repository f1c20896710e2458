/** Heights and slopes of a scene's ground. */
import type { Terrain } from "./types.ts";

/**
 * Height of the ground at (x, z), metres.
 *
 * A slope rises towards its yaw and is 0 at the origin. A height field lies about the origin; `heights` are
 * rows along x of its (cells + 1) corners, from -x -z; between corners bilinear, beyond its edge the edge's.
 */
export function groundHeight(t: Terrain, x: number, z: number): number {
  if (t.kind === "flat") return 0;
  if (t.kind === "slope") return Math.tan(t.angle) * (x * Math.sin(t.yaw) + z * Math.cos(t.yaw));
  const [nx, nz] = t.cells;
  const u = Math.max(0, Math.min(nx, (x / t.size[0] + 0.5) * nx));
  const v = Math.max(0, Math.min(nz, (z / t.size[1] + 0.5) * nz));
  const i = Math.min(nx - 1, Math.floor(u));
  const j = Math.min(nz - 1, Math.floor(v));
  const h = (a: number, b: number) => t.heights[b * (nx + 1) + a];
  const fu = u - i;
  const fv = v - j;
  return (
    (h(i, j) * (1 - fu) + h(i + 1, j) * fu) * (1 - fv) + (h(i, j + 1) * (1 - fu) + h(i + 1, j + 1) * fu) * fv
  );
}

/** Reach of a foot over which the ground's slope is taken, metres: half a foot. */
const SPAN = 0.09;

/** Horizontal part (x, z) of the ground's unit normal under a foot. */
export function groundNormal(t: Terrain, x: number, z: number): [number, number] {
  if (t.kind === "flat") return [0, 0];
  const dx = (groundHeight(t, x + SPAN, z) - groundHeight(t, x - SPAN, z)) / (2 * SPAN);
  const dz = (groundHeight(t, x, z + SPAN) - groundHeight(t, x, z - SPAN)) / (2 * SPAN);
  const n = Math.sqrt(1 + dx * dx + dz * dz);
  return [-dx / n, -dz / n];
}
