/**
 * Builds the package that others install: a module and its types for every source file, the captures beside the element. No bundling:
 * those who use it bundle, and see the same files and comments as in the project.
 */
import { spawnSync } from "node:child_process";
import { copyFileSync, existsSync, readdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { root } from "./build.mjs";

const OUT = join(root, "dist", "lib");
const LIBRARY = join(root, "public", "generated", "library.bin");

rmSync(OUT, { recursive: true, force: true });
const { status } = spawnSync(
  process.execPath,
  [join(root, "node_modules", "typescript", "bin", "tsc"), "-p", join(root, "tsconfig.lib.json")],
  { stdio: "inherit", cwd: root },
);
if (status !== 0) process.exit(status ?? 1);

/** Addresses of workers are no imports, and types keep the sources' endings: both are put right here. */
function putRight(folder) {
  for (const entry of readdirSync(folder, { withFileTypes: true })) {
    const path = join(folder, entry.name);
    if (entry.isDirectory()) putRight(path);
    else if (/\.(js|d\.ts)$/.test(entry.name)) {
      const before = readFileSync(path, "utf8");
      const after = before
        .replace(/(new URL\("[^"]+)\.ts"/g, '$1.js"')
        // Bundlers that know this form take the captures along.
        .replace(
          'new URL(/* @vite-ignore */ "library.bin", import.meta.url)',
          'new URL("./library.bin", import.meta.url)',
        )
        .replace(/((?:from|import\()\s*"\.[^"]+)\.ts"/g, '$1.js"');
      if (after !== before) writeFileSync(path, after);
    }
  }
}
putRight(OUT);

if (!existsSync(LIBRARY)) {
  const { ensureLibrary } = await import("./library-plugin.ts").catch(() => ({ ensureLibrary: null }));
  if (!ensureLibrary) {
    console.error("The captures are missing: run npm run build first.");
    process.exit(1);
  }
  await ensureLibrary();
}
copyFileSync(LIBRARY, join(OUT, "embed", "library.bin"));
