/** `import`: what a BVH file holds, and the same motion on our skeleton. */
import { writeBvh } from "../../core/capture/bvh-write.ts";
import { needed, one, outputs, readOptions } from "../args.ts";
import { readCapture } from "../read.ts";
import { writeOutput } from "../write.ts";

export const importCommand = {
  usage: "import --bvh F... [--out F.bvh | DIR/]",
  run(args: string[]) {
    const o = readOptions(args, { bvh: "many", out: "one" });
    needed(o, "bvh");
    const files = o.values.get("bvh") ?? [];
    const out = one(o, "out");
    const to = out === undefined ? null : outputs(files, out, "bvh");
    const reports = files.map((f, i) => {
      const { clip, report } = readCapture(f);
      if (to) writeOutput(to[i], writeBvh(clip));
      return { file: f, ...report };
    });
    return reports.length === 1 ? reports[0] : reports;
  },
};
