/** `steps`: a capture's steps with category, phase, lift and land. */
import { prepareClip } from "../../core/templates/build-library.ts";
import { baseName, needed, one, outputs, readOptions } from "../args.ts";
import { readCapture, readSidecar } from "../read.ts";
import { writeOutput } from "../write.ts";
import { stepDetector } from "./contact-model.ts";

export const stepsCommand = {
  usage: "steps --bvh F... --out F.json | DIR/ [--method oracle|height|speed|both] [--model F]",
  run(args: string[]) {
    const o = readOptions(args, { bvh: "many", out: "one", method: "one", model: "one" });
    needed(o, "bvh");
    const files = o.values.get("bvh") ?? [];
    const to = outputs(files, needed(o, "out"), "json");
    const detect = stepDetector(one(o, "method") ?? "oracle", one(o, "model"));
    return files.map((f, i) => {
      const { clip } = readCapture(f);
      const sidecar = readSidecar(f.replace(/\.bvh$/i, ".json"));
      const prepared = prepareClip({
        name: baseName(f),
        clip,
        tasks: sidecar?.tasks ?? [],
        contacts: detect(clip),
      });
      const steps = prepared.steps.map((s) => ({
        foot: s.foot,
        category: s.category,
        phase: s.phase,
        lift: s.start / clip.rate,
        land: s.end / clip.rate,
        position: [s.to.x, s.to.y, s.to.z],
        yaw: s.to.yaw,
      }));
      writeOutput(to[i], `${JSON.stringify({ version: 1, file: f, steps }, null, 2)}\n`);
      return { file: f, steps: steps.length };
    });
  },
};
