/** Heights and speeds of heels and toes over a motion: what a person looks at while labelling. */
import { LEG_ROW, type MotionTrack, POINT } from "./motion-track.ts";

/**
 * Left heel, left toe, right heel, right toe: frames x 4; heights in metres over the ground y = 0, speeds in metres a second.
 * A toe is the lower, and the slower, of ball and tip: either bears.
 */
export function footCurves(track: MotionTrack): { heights: Float32Array; speeds: Float32Array } {
  const n = track.frames;
  const heights = new Float32Array(4 * n);
  const speeds = new Float32Array(4 * n);
  const place = (f: number, side: number, point: number): number => (2 * f + side) * LEG_ROW + point;
  const speed = (f: number, side: number, point: number): number => {
    const a = place(Math.max(0, f - 1), side, point);
    const b = place(Math.min(n - 1, f + 1), side, point);
    const p = track.points;
    const gap = Math.min(n - 1, f + 1) - Math.max(0, f - 1);
    return (Math.hypot(p[b] - p[a], p[b + 1] - p[a + 1], p[b + 2] - p[a + 2]) * 60) / Math.max(1, gap);
  };
  for (let f = 0; f < n; f++)
    for (let side = 0; side < 2; side++) {
      const height = (point: number): number => track.points[place(f, side, point) + 1];
      heights[4 * f + 2 * side] = height(POINT.heel);
      heights[4 * f + 2 * side + 1] = Math.min(height(POINT.ball), height(POINT.tip));
      speeds[4 * f + 2 * side] = speed(f, side, POINT.heel);
      speeds[4 * f + 2 * side + 1] = Math.min(speed(f, side, POINT.ball), speed(f, side, POINT.tip));
    }
  return { heights, speeds };
}
