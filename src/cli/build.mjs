/** Builds the command line (or the benchmarks) with vite when any source is newer than what was built. */
import { existsSync, readdirSync, statSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";

export const root = join(dirname(fileURLToPath(import.meta.url)), "..", "..");

function newest(folder) {
  let latest = 0;
  for (const entry of readdirSync(folder, { withFileTypes: true })) {
    const path = join(folder, entry.name);
    if (entry.isDirectory()) latest = Math.max(latest, newest(path));
    else if (entry.name.endsWith(".ts")) latest = Math.max(latest, statSync(path).mtimeMs);
  }
  return latest;
}

/** The built module's URL; says on standard error when it has to build. */
export async function built(entry, name, folders) {
  const out = join(root, "dist", "cli", `${name}.mjs`);
  const sources = Math.max(
    ...folders.map((f) => newest(join(root, f))),
    statSync(join(root, "package.json")).mtimeMs,
  );
  if (!existsSync(out) || statSync(out).mtimeMs < sources) {
    console.error(`stepwright: building ${name} ...`);
    const { build } = await import("vite");
    await build({
      root,
      configFile: false,
      logLevel: "error",
      publicDir: false,
      ssr: { noExternal: ["fmin"] },
      build: {
        ssr: join(root, entry),
        outDir: join(root, "dist", "cli"),
        emptyOutDir: false,
        target: "node20",
        minify: false,
        rollupOptions: { output: { entryFileNames: `${name}.mjs`, chunkFileNames: `${name}-[name].mjs` } },
      },
    });
  }
  return pathToFileURL(out).href;
}
