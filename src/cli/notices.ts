/** The packages that the product is made with, and their licences. */
import { existsSync, readdirSync, readFileSync } from "node:fs";
import { dirname, join } from "node:path";

export interface RuntimePackage {
  name: string;
  version: string;
  /** SPDX expression of its package.json. */
  licence: string;
  /** Text of its licence file; empty when it has none. */
  text: string;
}

interface Manifest {
  name: string;
  version?: string;
  license?: string;
  dependencies?: Record<string, string>;
  /** Ours: packages that are in the site and not among the library's dependencies. */
  sitePackages?: string[];
}

const manifest = (folder: string): Manifest =>
  JSON.parse(readFileSync(join(folder, "package.json"), "utf8")) as Manifest;

/** Where a package is installed for one that needs it, looking upwards as Node does. */
function folderOf(name: string, from: string): string {
  for (let at = from; ; at = dirname(at)) {
    const folder = join(at, "node_modules", name);
    if (existsSync(join(folder, "package.json"))) return folder;
    if (dirname(at) === at) throw new Error(`${name}: is not installed; run npm ci.`);
  }
}

/** Every package that `dependencies`, and what the site has beside them, bring along, in order of their names. @throws Error when one is not installed. */
export function runtimePackages(root: string): RuntimePackage[] {
  const found = new Map<string, RuntimePackage>();
  const visit = (folder: string): void => {
    const { dependencies = {}, sitePackages = [] } = manifest(folder);
    for (const name of [...Object.keys(dependencies), ...(folder === root ? sitePackages : [])]) {
      const at = folderOf(name, folder);
      const m = manifest(at);
      const key = `${name}@${m.version ?? ""}`;
      if (found.has(key)) continue;
      const file = readdirSync(at).find((f) => /^(licen[cs]e|copying)/i.test(f));
      found.set(key, {
        name,
        version: m.version ?? "",
        licence: m.license ?? "",
        text: file ? readFileSync(join(at, file), "utf8").trim() : "",
      });
      visit(at);
    }
  };
  visit(root);
  return [...found.values()].sort((a, b) => (a.name < b.name ? -1 : a.name > b.name ? 1 : 0));
}

/** Packages that modules come from and that have no notice, in order of their names. */
export function unnoticed(modules: Iterable<string>, packages: readonly RuntimePackage[]): string[] {
  const known = new Set(packages.map((p) => p.name));
  const found = new Set<string>();
  for (const id of modules) {
    // The innermost folder counts: packages bring their own along.
    const [, name] = /.*[\\/]node_modules[\\/]((?:@[^\\/]+[\\/])?[^\\/]+)/.exec(id) ?? [];
    if (name !== undefined && !known.has(name.replace("\\", "/"))) found.add(name);
  }
  return [...found].sort();
}

/** The notices as one text. */
export function notices(packages: readonly RuntimePackage[]): string {
  const parts = packages.map(
    (p) => `${p.name} ${p.version} (${p.licence})\n\n${p.text || `Licence: ${p.licence}`}\n`,
  );
  return `Stepwright is made with these packages.\n\n${parts.join(`\n${"-".repeat(80)}\n\n`)}`;
}
