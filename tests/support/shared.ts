/** Reference material beside the repository: real captures and reference minima. Tests that need it skip where it is absent. */
import { existsSync, readdirSync } from "node:fs";
import { join } from "node:path";

export const SHARED = join(process.cwd(), "..", "shared");
export const hasShared = existsSync(join(SHARED, "bench"));
if (!hasShared)
  console.warn("Reference material is not beside the repository: the tests that need it are skipped.");

/** Every BVH file under a folder of the reference captures. */
export function captures(): string[] {
  const out: string[] = [];
  const visit = (folder: string) => {
    for (const e of readdirSync(folder, { withFileTypes: true })) {
      if (e.isDirectory()) visit(join(folder, e.name));
      else if (e.name.endsWith(".bvh")) out.push(join(folder, e.name));
    }
  };
  visit(join(SHARED, "mocap"));
  return out.sort();
}
