import { readFileSync } from "node:fs";
import { describe, expect, it } from "vitest";
import { notices, runtimePackages, unnoticed } from "../../src/cli/notices.ts";

/** Licences that let anybody use, change and pass on the product. */
const FREE = [
  "MIT",
  "ISC",
  "0BSD",
  "BSD-2-Clause",
  "BSD-3-Clause",
  "Apache-2.0",
  "OFL-1.1",
  "CC0-1.0",
  "Unlicense",
  // File-level copyleft: used as published, in a file of its own.
  "MPL-2.0",
];

describe("licences", () => {
  const packages = runtimePackages(process.cwd());

  it("every package of the product is free to use, with what it brings along", () => {
    const { dependencies, license } = JSON.parse(readFileSync("package.json", "utf8")) as {
      dependencies: Record<string, string>;
      license: string;
    };
    expect(license).toBe("MIT");
    for (const name of Object.keys(dependencies)) expect(packages.map((p) => p.name)).toContain(name);
    expect(packages.length).toBeGreaterThan(Object.keys(dependencies).length);
    for (const p of packages) expect(FREE, `${p.name}: ${p.licence}`).toContain(p.licence);
  });

  it("the notices carry each one's text; our own licence is there", () => {
    const text = notices(packages);
    for (const p of packages) expect(text).toContain(`${p.name} ${p.version} (${p.licence})`);
    expect(packages.filter((p) => p.text.length > 200).length / packages.length).toBeGreaterThan(0.8);
    expect(readFileSync("LICENSE", "utf8")).toMatch(/^MIT License/);
  });

  it("a package that is built in without a notice is found", () => {
    const modules = [
      "/x/node_modules/three/build/three.module.js",
      "/x/node_modules/@fontsource/stix-two-text/400.css",
      "/x/node_modules/lit/node_modules/stranger/index.js",
      "/x/node_modules/@some/where/index.js?worker",
      "/x/src/editor/main.ts",
      "\0vite/preload-helper.js",
    ];
    expect(unnoticed(modules, packages)).toEqual(["@some/where", "stranger"]);
  });
});
