/** `contacts`: four contact bits a frame of the BVH given, at its own rate. */
import { writeFileSync } from "node:fs";
import { CONTACT_METHODS, type ContactMethod, detectContacts } from "../../core/contacts/baselines.ts";
import { contactsCsv } from "../../core/contacts/csv.ts";
import { needed, one, outputs, readOptions, UsageError } from "../args.ts";
import { readCapture } from "../read.ts";

export const contactsCommand = {
  usage: "contacts --bvh F... --out F.csv | DIR/ [--method height|speed|both]",
  run(args: string[]) {
    const o = readOptions(args, { bvh: "many", out: "one", method: "one" });
    needed(o, "bvh");
    const files = o.values.get("bvh") ?? [];
    const to = outputs(files, needed(o, "out"), "csv");
    const method = (one(o, "method") ?? "both") as ContactMethod;
    if (!CONTACT_METHODS.includes(method))
      throw new UsageError(`--method: one of ${CONTACT_METHODS.join(", ")} is needed.`);
    return files.map((f, i) => {
      const { clip, report } = readCapture(f);
      writeFileSync(to[i], contactsCsv(detectContacts(clip, method), clip.rate, report.rate, report.frames));
      return { file: f, frames: report.frames, method };
    });
  },
};
