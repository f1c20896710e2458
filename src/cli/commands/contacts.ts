/** `contacts`: four contact bits a frame of the BVH given, at its own rate. */
import { contactsCsv } from "../../core/contacts/csv.ts";
import { needed, one, outputs, readOptions } from "../args.ts";
import { readCapture } from "../read.ts";
import { writeOutput } from "../write.ts";
import { detector } from "./contact-model.ts";

export const contactsCommand = {
  usage: "contacts --bvh F... --out F.csv | DIR/ [--method oracle|height|speed|both] [--model F]",
  run(args: string[]) {
    const o = readOptions(args, { bvh: "many", out: "one", method: "one", model: "one" });
    needed(o, "bvh");
    const files = o.values.get("bvh") ?? [];
    const to = outputs(files, needed(o, "out"), "csv");
    const method = one(o, "method") ?? "oracle";
    const detect = detector(method, one(o, "model"));
    return files.map((f, i) => {
      const { clip, report } = readCapture(f);
      writeOutput(to[i], contactsCsv(detect(clip), clip.rate, report.rate, report.frames));
      return { file: f, frames: report.frames, method, warnings: report.warnings };
    });
  },
};
