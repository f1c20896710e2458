/** Crowds as files: places, facing, body circles and planted feet at 20 Hz, and every footstep. */
import { arcTangent } from "./elementary.ts";
import type { CrowdTrack } from "./simulate.ts";
import { BODY_RADIUS, SHOULDER } from "./types.ts";

/** The trajectory document. `facing` a points to (cos a, sin a) in (x, z); body circles: [forward, aside, radius]. */
export function trajectoryOf(track: CrowdTrack, plannerMs: number[] | null): object {
  const round = (v: number): number => Math.round(v * 1e5) / 1e5;
  const angle = (f: [number, number] | null): number | null =>
    f === null ? null : round(arcTangent(f[1], f[0]));
  return {
    dt: track.dt,
    radius: 2 * BODY_RADIUS,
    positions: track.positions,
    facing: track.facing.map((row) => row.map(angle)),
    body: [
      [0, -SHOULDER, BODY_RADIUS],
      [0, 0, BODY_RADIUS],
      [0, SHOULDER, BODY_RADIUS],
    ],
    feet: track.feet,
    footsteps: track.footsteps.map((s) => ({
      agent: s.agent,
      foot: s.side > 0 ? "left" : "right",
      position: [round(s.x), 0, round(s.z)],
      yaw: round(s.yaw),
      lift: s.lift === null ? null : round(s.lift),
      land: round(s.land),
    })),
    statistics: track.statistics,
    arrived: track.arrived,
    ...(plannerMs ? { planner_ms: plannerMs } : {}),
  };
}
