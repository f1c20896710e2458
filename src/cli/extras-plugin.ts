/**
 * What the built site carries for other sites and for pages without an origin: `embed/`, the element as one module with its workers
 * and captures, to be linked to or copied; `offline/`, the embed page and the lessons as one classic script with the captures.
 */
import { copyFileSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { join, resolve } from "node:path";
import { build, type InlineConfig, type Plugin } from "vite";

const LIBRARY = "public/generated/library.bin";

const COMMON: InlineConfig = {
  configFile: false,
  root: process.cwd(),
  base: "./",
  publicDir: false,
  logLevel: "warn",
};

function options(outDir: string): NonNullable<InlineConfig["build"]> {
  return {
    target: "es2022",
    outDir,
    emptyOutDir: false,
    assetsDir: "",
    modulePreload: false,
    chunkSizeWarningLimit: 1200,
    reportCompressedSize: false,
  };
}

/** The element: one module, workers beside it under names that stay. */
async function buildElement(outDir: string): Promise<void> {
  await build({
    ...COMMON,
    worker: { format: "es", rolldownOptions: { output: { entryFileNames: "[name].js" } } },
    build: {
      ...options(outDir),
      rolldownOptions: {
        input: { "stepwright-element": resolve("src/embed/index.ts") },
        preserveEntrySignatures: "strict",
        output: { entryFileNames: "[name].js", chunkFileNames: "parts/[name].js" },
      },
    },
  });
  copyFileSync(LIBRARY, join(outDir, "library.bin"));
}

/** The classic script, and the captures as another that leaves them in a global. */
async function buildOffline(outDir: string): Promise<void> {
  await build({
    ...COMMON,
    // Workers cannot start where this script is used: their addresses need only be such that nothing breaks.
    define: { "import.meta.url": "document.baseURI" },
    worker: { format: "es", rolldownOptions: { output: { entryFileNames: "[name].js" } } },
    build: {
      ...options(outDir),
      rolldownOptions: {
        input: { stepwright: resolve("src/lessons/offline.ts") },
        output: { format: "iife", entryFileNames: "[name].js" },
        onLog(level, log, handle) {
          if (log.code !== "EMPTY_IMPORT_META") handle(level, log);
        },
      },
    },
  });
  for (const worker of ["planner-worker.js", "mesh-worker.js"]) rmSync(join(outDir, worker), { force: true });
  const text = readFileSync(LIBRARY).toString("base64");
  writeFileSync(join(outDir, "library.js"), `globalThis.stepwrightLibrary = "${text}";\n`);
}

export function siteExtras(): Plugin {
  let outDir = "";
  let failed = false;
  return {
    name: "stepwright-extras",
    apply: "build",
    configResolved(config) {
      outDir = resolve(config.root, config.build.outDir);
    },
    buildEnd(error) {
      failed = error !== undefined;
    },
    async closeBundle() {
      if (failed) return;
      await buildElement(join(outDir, "embed"));
      await buildOffline(join(outDir, "offline"));
    },
  };
}
