/** What each layer does over a performance, as tracks to plot. */
import { wrapAngle } from "../core/math/angle.ts";
import type { Workings } from "./render.ts";
import type { Layer } from "./score.ts";

export interface LayerTrack {
  layer: Layer;
  /** What the lines are, in a few words. */
  says: string;
  unit: string;
  /** One or two lines, a value a frame. */
  lines: Float32Array[];
}

const DEG = 180 / Math.PI;

/** The tracks of every layer, in the layers' order. */
export function layerTracks(w: Workings): LayerTrack[] {
  const n = w.clip.frames;
  const { body, feet, gait } = w;
  const track = (value: (f: number) => number) => Float32Array.from({ length: n }, (_, f) => value(f));
  // Across the way from the first to the last frame: to the left.
  const dx = w.way[2 * n - 2] - w.way[0];
  const dz = w.way[2 * n - 1] - w.way[1];
  const far = Math.hypot(dx, dz) || 1;
  const across = (x: Float64Array) => (f: number) =>
    (100 * ((x[2 * f] - w.way[0]) * dz - (x[2 * f + 1] - w.way[1]) * dx)) / far;
  const turn = (a: Float64Array, b: Float64Array) => (f: number) => DEG * wrapAngle(a[f] - b[f]);
  return [
    {
      layer: "roll",
      says: "pitch of the left and the right foot, toe up",
      unit: "°",
      lines: feet.map((t) => track((f) => DEG * t.pitch[f])),
    },
    {
      layer: "balance",
      says: "hips and pressure across the way",
      unit: "cm",
      lines: [track(across(w.way)), track(across(w.pressure.point))],
    },
    {
      layer: "rhythm",
      says: "amount of gait; chest against pelvis",
      unit: "",
      lines: [track((f) => gait.amount[f]), track((f) => turn(body.chestYaw, body.pelvisYaw)(f) / 30)],
    },
    {
      layer: "lean",
      says: "trunk ahead for speed gained, back for speed lost",
      unit: "°",
      lines: [track((f) => DEG * body.lean[f])],
    },
    {
      layer: "knees",
      says: "hips raised for the knees' sake",
      unit: "mm",
      lines: [track((f) => 1000 * w.raise[f])],
    },
    { layer: "flight", says: "height of the hips", unit: "m", lines: [track((f) => w.clip.root[3 * f + 1])] },
    {
      layer: "gaze",
      says: "head against chest",
      unit: "°",
      lines: [track(turn(body.headYaw, body.chestYaw))],
    },
    {
      layer: "tasks",
      says: "left and right hand led by a task",
      unit: "",
      lines: w.tasks.hands.weight.map((h) => track((f) => h[f])),
    },
    {
      layer: "alive",
      says: "chest tips forward and to the side",
      unit: "°",
      lines: [track((f) => DEG * body.chestPitch[f]), track((f) => DEG * body.chestRoll[f])],
    },
  ];
}
