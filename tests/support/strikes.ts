/** Footstep frames that others annotated on another skeleton, and how plants agree with them. */
import { readFileSync } from "node:fs";
import { join } from "node:path";
import type { Clip } from "../../src/core/capture/clip.ts";
import { importBvh } from "../../src/core/capture/import.ts";
import { SHARED } from "./shared.ts";

export interface StrikeClip {
  clip: Clip;
  /** Clip frame and side, 0 left, of each strike. */
  strikes: { frame: number; side: number }[];
}

export function strikeClips(): StrikeClip[] {
  return ["LocomotionFlat04_000", "LocomotionFlat04_000_mirror"].map((name) => {
    const { clip, report } = importBvh(
      readFileSync(join(SHARED, "mocap", "pfnn", `${name}.bvh`), "utf8"),
      name,
    );
    const rows = readFileSync(join(SHARED, "mocap", "labels", "pfnn", `${name}.strikes.csv`), "utf8");
    const strikes = rows
      .trim()
      .split("\n")
      .slice(1)
      .map((row) => row.split(","))
      .map(([frame, foot]) => ({
        frame: (Number(frame) * clip.rate) / report.rate,
        side: foot === "left" ? 0 : 1,
      }));
    return { clip, strikes };
  });
}

/** A strike may lie so far outside of its plant, seconds. */
const SLACK = 0.1;

/**
 * Each strike belongs to one plant of its foot, heel or toe, and lies in it. Plants that the clip's ends cut were struck
 * before it or are left after it: they count when a strike is in them, and are no fault when none is.
 */
export function countStrikes(
  labels: Uint8Array,
  { clip, strikes }: StrikeClip,
): { matched: number; plants: number; strikes: number } {
  const slack = SLACK * clip.rate;
  let matched = 0;
  let plants = 0;
  for (let side = 0; side < 2; side++) {
    const open = strikes.filter((s) => s.side === side);
    for (let f = 0; f < labels.length; ) {
      const on = (g: number): boolean => ((labels[g] >> (2 * side)) & 3) !== 0;
      if (!on(f)) {
        f++;
        continue;
      }
      let end = f;
      while (end < labels.length && on(end)) end++;
      const first = f;
      const hit = open.findIndex((s) => s.frame >= first - slack && s.frame < end + slack);
      if (hit >= 0) {
        open.splice(hit, 1);
        matched++;
        plants++;
      } else if (first > 0 && end < labels.length) plants++;
      f = end;
    }
  }
  return { matched, plants, strikes: strikes.length };
}
