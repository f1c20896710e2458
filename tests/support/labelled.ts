/** The hand-checked captures beside the repository, and how an edited motion differs from them. */
import { readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import type { Clip } from "../../src/core/capture/clip.ts";
import { importBvh } from "../../src/core/capture/import.ts";
import { parseContactsCsv } from "../../src/core/contacts/csv.ts";
import { createRandom } from "../../src/core/math/random.ts";
import { SHARED } from "./shared.ts";

export interface LabelledClip {
  name: string;
  clip: Clip;
  rate: number;
  /** Labels at the source's rate, and at the clip's. */
  truth: Uint8Array;
  labels: Uint8Array;
}

export function labelledClips(): LabelledClip[] {
  const folder = join(SHARED, "mocap", "labels");
  return readdirSync(folder)
    .filter((f) => f.endsWith(".csv"))
    .sort()
    .map((file) => {
      const name = file.replace(/\.csv$/, "");
      const path = join(
        SHARED,
        "mocap",
        name.startsWith("dataset-1") ? "bandai-1" : "bandai-2",
        `${name}.bvh`,
      );
      const { clip, report } = importBvh(readFileSync(path, "utf8"), name);
      const truth = parseContactsCsv(readFileSync(join(folder, file), "utf8"), file);
      const labels = Uint8Array.from(
        { length: clip.frames },
        (_, i) => truth[Math.min(truth.length - 1, Math.round((i * report.rate) / 60))],
      );
      return { name, clip, rate: report.rate, truth, labels };
    });
}

/** Labels at the source's rate. */
export const atSourceRate = (labels: Uint8Array, c: LabelledClip): Uint8Array =>
  Uint8Array.from(c.truth, (_, i) => labels[Math.min(labels.length - 1, Math.round((i * 60) / c.rate))]);

/** The figure drifts as a whole: 3 cm up and down in 4 s, 12 cm to a side and back in 5 s. */
export function drifting(clip: Clip, seed: number): Clip {
  const r = createRandom(seed);
  const a = r.between(0, 2 * Math.PI);
  const b = r.between(0, 2 * Math.PI);
  const way = r.between(0, 2 * Math.PI);
  const root = clip.root.slice();
  for (let f = 0; f < clip.frames; f++) {
    const t = f / 60;
    const aside = 0.12 * Math.sin((2 * Math.PI * t) / 5 + b);
    root[3 * f] += aside * Math.cos(way);
    root[3 * f + 1] += 0.03 * Math.sin((2 * Math.PI * t) / 4 + a);
    root[3 * f + 2] += aside * Math.sin(way);
  }
  return { ...clip, root };
}
