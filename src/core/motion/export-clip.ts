/** A motion as it leaves the program: at a chosen rate, travelling or in place; footsteps as rows of text. */
import type { Clip } from "../capture/clip.ts";
import { JOINT_COUNT } from "../skeleton/joints.ts";
import type { Plan } from "../tasks/plan-types.ts";
import { sampleClip } from "./sample.ts";

/** Frames a second that a motion can be exported at. */
export const EXPORT_RATES = [24, 25, 30, 60, 120] as const;

export interface ExportOptions {
  /** Frames a second. */
  rate: number;
  /** Whether the hips stay over the origin; their height is kept. */
  inPlace: boolean;
}

/** The clip resampled; a new one. Its last frame is at or before the source's last. @throws RangeError for a rate of 0 or less. */
export function exportClip(clip: Clip, options: ExportOptions): Clip {
  if (!(options.rate > 0)) throw new RangeError(`rate: more than 0 is needed, found ${options.rate}.`);
  const frames = Math.max(1, Math.floor(((clip.frames - 1) * options.rate) / clip.rate + 1e-9) + 1);
  const root = new Float64Array(3 * frames);
  const rotations = new Float64Array(4 * JOINT_COUNT * frames);
  for (let f = 0; f < frames; f++) {
    sampleClip(
      root.subarray(3 * f, 3 * f + 3),
      rotations.subarray(4 * JOINT_COUNT * f, 4 * JOINT_COUNT * (f + 1)),
      clip,
      (f * clip.rate) / options.rate,
    );
    if (options.inPlace) {
      root[3 * f] = 0;
      root[3 * f + 2] = 0;
    }
  }
  return { ...clip, rate: options.rate, frames, root, rotations };
}

const FOOTSTEP_HEAD = "foot,x,y,z,yaw,category,phase,task,lift,land";

/** A plan's footsteps as comma-separated rows, the two start stances first with no category, phase, task or lift. */
export function footstepsCsv(plan: Plan): string {
  const n = (v: number): string => v.toFixed(4);
  // Ids are the user's own: quoted where they must be.
  const text = (s: string): string => (/[",\n\r]/.test(s) ? `"${s.replaceAll('"', '""')}"` : s);
  const rows = [
    ...plan.start.map((f) => [f.foot, n(f.x), n(f.y), n(f.z), n(f.yaw), "", "", "", "", "0.0000"]),
    ...plan.steps.map((s) => [
      s.foot,
      n(s.x),
      n(s.y),
      n(s.z),
      n(s.yaw),
      s.category,
      s.phase,
      text(plan.tasks[s.task]?.id ?? ""),
      n(s.lift),
      n(s.land),
    ]),
  ];
  return `${[FOOTSTEP_HEAD, ...rows.map((r) => r.join(","))].join("\n")}\n`;
}
