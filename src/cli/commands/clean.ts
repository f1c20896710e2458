/** `clean`: footskate removed; the file keeps its rate, joints and channels. */
import { parseBvh } from "../../core/capture/bvh-parse.ts";
import { importBvh } from "../../core/capture/import.ts";
import { cleanBvh } from "../../core/cleanup/clean-bvh.ts";
import { rewriteBvh } from "../../core/cleanup/file-motion.ts";
import { needed, one, outputs, readOptions } from "../args.ts";
import { readText } from "../read.ts";
import { writeOutput } from "../write.ts";
import { detector } from "./contact-model.ts";

export const cleanCommand = {
  usage: "clean --bvh F... --out F.bvh | DIR/ [--model F] [--method oracle|height|speed|both]",
  run(args: string[]) {
    const o = readOptions(args, { bvh: "many", out: "one", model: "one", method: "one" });
    needed(o, "bvh");
    const files = o.values.get("bvh") ?? [];
    const to = outputs(files, needed(o, "out"), "bvh");
    const detect = detector(one(o, "method") ?? "oracle", one(o, "model"));
    return files.map((f, i) => {
      const text = readText(f);
      const { clip, report } = importBvh(text, f);
      const { file, report: cleaned } = cleanBvh(parseBvh(text, f), clip, detect(clip));
      writeOutput(to[i], rewriteBvh(text, file));
      return { file: f, frames: report.frames, ...cleaned };
    });
  },
};
