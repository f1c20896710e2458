/** The hand-checked captures beside the repository, and how an edited motion differs from them. */
import { readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import type { BvhFile } from "../../src/core/capture/bvh-parse.ts";
import type { Clip } from "../../src/core/capture/clip.ts";
import { importBvh } from "../../src/core/capture/import.ts";
import { parseContactsCsv } from "../../src/core/contacts/csv.ts";
import { smoothstep } from "../../src/core/math/interpolate.ts";
import { createRandom } from "../../src/core/math/random.ts";
import { SHARED } from "./shared.ts";

export interface LabelledClip {
  name: string;
  /** The BVH file. */
  text: string;
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
      const text = readFileSync(path, "utf8");
      const { clip, report } = importBvh(text, name);
      const truth = parseContactsCsv(readFileSync(join(folder, file), "utf8"), file);
      const labels = Uint8Array.from(
        { length: clip.frames },
        (_, i) => truth[Math.min(truth.length - 1, Math.round((i * report.rate) / 60))],
      );
      return { name, text, clip, rate: report.rate, truth, labels };
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

/** What an edit does to a file: it drifts as `drifting` has it, or goes over to 15 cm beside itself within half a second. */
export type Skate = "none" | "drift" | "blend";

/** A file whose first three channels are the root's place in centimetres, with skate. */
export function skating(file: BvhFile, skate: Skate, seed: number): BvhFile {
  const out: BvhFile = { ...file, values: file.values.slice() };
  const row = file.values.length / file.frames;
  const r = createRandom(seed);
  const way = r.between(0, 2 * Math.PI);
  const a = r.between(0, 2 * Math.PI);
  const b = r.between(0, 2 * Math.PI);
  const begin = 0.3 * file.frames * file.frameTime;
  for (let f = 0; f < file.frames; f++) {
    const t = f * file.frameTime;
    let aside = 0;
    if (skate === "drift") {
      aside = 12 * Math.sin((2 * Math.PI * t) / 5 + b);
      out.values[f * row + 1] += 3 * Math.sin((2 * Math.PI * t) / 4 + a);
    } else if (skate === "blend") aside = 15 * smoothstep((t - begin) / 0.5);
    out.values[f * row] += aside * Math.cos(way);
    out.values[f * row + 2] += aside * Math.sin(way);
  }
  return out;
}
