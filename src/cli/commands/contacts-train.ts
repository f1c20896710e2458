/** `contacts-train`: the oracle's model from labelled clips. */
import { parseContactsCsv } from "../../core/contacts/csv.ts";
import { encodeOracle } from "../../core/contacts/model-file.ts";
import { trackOf } from "../../core/contacts/motion-track.ts";
import { OWN_ORACLE, PAPER_ORACLE, trainOracle } from "../../core/contacts/oracle.ts";
import { needed, one, readOptions, UsageError } from "../args.ts";
import { readCapture, readText } from "../read.ts";
import { writeOutput } from "../write.ts";
import { readModel, startingModel } from "./contact-model.ts";

export const contactsTrainCommand = {
  usage: "contacts-train --pairs A.bvh=A.csv ... --out F [--features own|paper] [--onto starting|F]",
  run(args: string[]) {
    const o = readOptions(args, { pairs: "many", out: "one", features: "one", onto: "one" });
    const onto = one(o, "onto");
    // The starting oracle alone needs no pairs.
    if (onto !== "starting") needed(o, "pairs");
    const out = needed(o, "out");
    const features = one(o, "features") ?? "own";
    if (features !== "own" && features !== "paper")
      throw new UsageError("--features: one of own, paper is needed.");
    const sources = (o.values.get("pairs") ?? []).map((pair) => {
      const cut = pair.indexOf("=");
      if (cut < 1) throw new UsageError(`--pairs: ${pair}: CLIP.bvh=LABELS.csv is needed.`);
      const bvh = pair.slice(0, cut);
      const csv = pair.slice(cut + 1);
      const { clip, report } = readCapture(bvh);
      const rows = parseContactsCsv(readText(csv), csv);
      if (rows.length !== report.frames)
        throw new Error(
          `${csv}: ${rows.length} rows for the ${report.frames} frames of ${bvh}: labels of another clip.`,
        );
      const labels = Uint8Array.from(
        { length: clip.frames },
        (_, f) => rows[Math.min(rows.length - 1, Math.round((f * report.rate) / clip.rate))],
      );
      return { track: trackOf(clip), labels };
    });
    const before = onto === undefined ? null : onto === "starting" ? startingModel() : readModel(onto);
    if (before && before.options.set !== features)
      throw new UsageError(`--onto: ${onto} has the ${before.options.set} features.`);
    const oracle = trainOracle(
      [...(before?.sources ?? []), ...sources],
      before?.options ?? (features === "own" ? OWN_ORACLE : PAPER_ORACLE),
      before?.base ?? null,
    );
    const bytes = encodeOracle(oracle);
    writeOutput(out, bytes);
    return { file: out, bytes: bytes.length, clips: sources.length, examples: oracle.index.count, features };
  },
};
