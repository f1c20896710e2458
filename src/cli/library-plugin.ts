/** Makes `public/generated/library.bin` and the starting oracle `oracle.bin` before the site is served or built, when anything it is made of has changed. */
import { createHash } from "node:crypto";
import { existsSync, mkdirSync, readdirSync, readFileSync, writeFileSync } from "node:fs";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import type { Plugin } from "vite";

const OUT = "public/generated/library.bin";
const ORACLE = "public/generated/oracle.bin";
const NOTE = "public/generated/library.hash";

function digest(folders: readonly string[]): string {
  const hash = createHash("sha256");
  const visit = (folder: string) => {
    for (const e of readdirSync(folder, { withFileTypes: true }).sort((a, b) => (a.name < b.name ? -1 : 1))) {
      const path = join(folder, e.name);
      if (e.isDirectory()) visit(path);
      else if (e.name.endsWith(".ts")) hash.update(path).update(readFileSync(path));
    }
  };
  for (const f of folders) visit(f);
  return hash.digest("hex");
}

/** The library's bytes are made once for each state of the studio and the core. */
export async function ensureLibrary(): Promise<void> {
  const now = digest([
    "src/studio",
    "src/core/capture",
    "src/core/contacts",
    "src/core/steps",
    "src/core/templates",
    "src/core/motion",
    "src/core/ik",
    "src/core/math",
    "src/core/skeleton",
  ]);
  if (existsSync(OUT) && existsSync(ORACLE) && existsSync(NOTE) && readFileSync(NOTE, "utf8") === now) return;
  console.error("stepwright: making the captures and their library ...");
  const { built } = (await import(pathToFileURL(resolve("src/cli/build.mjs")).href)) as {
    built(entry: string, name: string, folders: string[]): Promise<string>;
  };
  const { main } = (await import(
    await built("src/cli/main.ts", "cli", ["src/cli", "src/core", "src/studio"])
  )) as { main(args: string[]): Promise<number> };
  mkdirSync("public/generated", { recursive: true });
  const code = await main(["library", "--out", OUT]);
  if (code !== 0) throw new Error("stepwright: the library could not be made.");
  const trained = await main(["contacts-train", "--onto", "starting", "--out", ORACLE]);
  if (trained !== 0) throw new Error("stepwright: the starting oracle could not be made.");
  writeFileSync(NOTE, now);
}

export function shippedLibrary(): Plugin {
  return {
    name: "stepwright-library",
    async configResolved(config) {
      if (config.build.ssr) return;
      await ensureLibrary();
    },
  };
}
