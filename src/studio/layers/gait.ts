/**
 * The rhythm: a phase that is 0 at each left strike and pi at each right one, and how much of it there is.
 *
 * Trunk, pelvis and arms are short harmonic series of this phase; standing and single steps have no rhythm.
 */
import { CLIP_RATE } from "../../core/capture/clip.ts";
import { wrapAngle } from "../../core/math/angle.ts";
import { smoothstep, unit } from "../../core/math/interpolate.ts";
import { shapeOf } from "../gait-shape.ts";
import { paceOf, type Score, type ScoreStep } from "../score.ts";

export interface Gait {
  /** Radians, growing. */
  phase: Float64Array;
  /** 0 standing to 1 walking at full stride. */
  amount: Float64Array;
}

interface Beat {
  time: number;
  phase: number;
  size: number;
}

/** Longest time between two strikes of one walk, seconds; of a slow actor, in steps of the pace. */
const LONGEST = 0.95;
const LONGEST_STEPS = 1.35;

/** Phase and amount over the frames of a score. */
export function renderGait(score: Score, leg: number, frames: number): Gait {
  const { full } = shapeOf(score.actor);
  const longest = Math.max(LONGEST, LONGEST_STEPS * paceOf(score.actor).time);
  const phase = new Float64Array(frames);
  const amount = new Float64Array(frames);
  const walks = score.steps
    .filter((s) => s.kind === "walk" || s.kind === "turnStep" || s.kind === "run")
    .sort((a, b) => a.land - b.land);
  const groups: ScoreStep[][] = [];
  for (const s of walks) {
    const group = groups[groups.length - 1];
    const last = group?.[group.length - 1];
    if (last && last.foot !== s.foot && s.land - last.land < longest) group.push(s);
    else groups.push([s]);
  }
  const place: Record<"left" | "right", { x: number; z: number; yaw: number }> = {
    left: score.start.left,
    right: score.start.right,
  };
  const sizes = new Map<ScoreStep, number>();
  for (const s of [...score.steps].sort((a, b) => a.land - b.land)) {
    const from = place[s.foot];
    const turn = Math.abs(wrapAngle(s.yaw - from.yaw));
    const way = Math.hypot(s.x - from.x, s.z - from.z);
    const ahead = way < 1e-6 ? 1 : Math.cos(wrapAngle(Math.atan2(s.x - from.x, s.z - from.z) - s.yaw));
    sizes.set(
      s,
      unit(way / (Math.min(1.25, 1.12 * full) * leg)) * (ahead < 0 ? 0.6 : 1) * (1 - 0.35 * unit(turn)),
    );
    place[s.foot] = s;
  }
  for (const group of groups) {
    const step =
      group.length > 1 ? (group[group.length - 1].land - group[0].land) / (group.length - 1) : 0.58;
    const start = group[0].foot === "left" ? 0 : Math.PI;
    const beats: Beat[] = group.map((s, i) => ({
      time: s.land,
      phase: start + Math.PI * i,
      size: sizes.get(s) ?? 0,
    }));
    const first = beats[0];
    const last = beats[beats.length - 1];
    // The phase runs on before and after, so that arms do not freeze while the amount fades.
    const from = first.time - 1.0 * step;
    const to = last.time + 1.3 * step;
    for (let f = Math.max(0, Math.floor(from * CLIP_RATE)); f < Math.min(frames, to * CLIP_RATE); f++) {
      const t = f / CLIP_RATE;
      let i = 0;
      while (i + 2 < beats.length && beats[i + 1].time < t) i++;
      const a = beats[i];
      const b = beats[Math.min(beats.length - 1, i + 1)];
      const rate = b.time > a.time ? (b.phase - a.phase) / (b.time - a.time) : Math.PI / step;
      const p = a.phase + (t - a.time) * rate;
      const u = b.time > a.time ? unit((t - a.time) / (b.time - a.time)) : 1;
      const size = a.size + (b.size - a.size) * smoothstep(u);
      const rise = smoothstep((t - from) / (first.time - from + 0.35 * step));
      const fall = 1 - smoothstep((t - (last.time - 0.45 * step)) / (1.6 * step));
      const value = size * rise * fall * (group.length > 1 ? 1 : 0.6);
      if (value > amount[f]) {
        amount[f] = value;
        phase[f] = p;
      }
    }
  }
  return { phase, amount };
}
