/** The package as others get it: packed, installed without a network into an empty program and an empty vite app, and used there. */
import { execFileSync } from "node:child_process";
import {
  existsSync,
  mkdirSync,
  mkdtempSync,
  readdirSync,
  readFileSync,
  rmSync,
  symlinkSync,
  writeFileSync,
} from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { afterAll, beforeAll, expect, test } from "vitest";

const ROOT = process.cwd();
const work = mkdtempSync(join(tmpdir(), "stepwright-package-"));
let archive = "";

const run = (command: string, args: string[], cwd: string): string =>
  execFileSync(command, args, { cwd, encoding: "utf8", stdio: ["ignore", "pipe", "pipe"], maxBuffer: 1e8 });

/** Bare names that a package's built files import. */
function imported(folder: string): Set<string> {
  const out = new Set<string>();
  for (const entry of readdirSync(folder, { recursive: true, withFileTypes: true })) {
    if (!entry.isFile() || !entry.name.endsWith(".js")) continue;
    const text = readFileSync(join(entry.parentPath, entry.name), "utf8");
    for (const [, name] of text.matchAll(/^(?:import|export)[^"]*?from "([a-z@][^"]*)";/gm))
      out.add(name.startsWith("@") ? name.split("/").slice(0, 2).join("/") : name.split("/")[0]);
  }
  return out;
}

/** Installs as npm would, from what is on this disk: the archive unpacked, its dependencies linked. */
function install(app: string, extra: readonly string[]): void {
  const modules = join(app, "node_modules");
  mkdirSync(join(modules, "stepwright"), { recursive: true });
  run("tar", ["xzf", archive, "--strip-components=1", "-C", join(modules, "stepwright")], app);
  const { dependencies } = JSON.parse(readFileSync(join(modules, "stepwright/package.json"), "utf8")) as {
    dependencies: Record<string, string>;
  };
  const visit = (name: string): void => {
    const to = join(modules, name);
    if (existsSync(to)) return;
    mkdirSync(dirname(to), { recursive: true });
    symlinkSync(join(ROOT, "node_modules", name), to);
  };
  for (const name of [...Object.keys(dependencies), ...extra]) visit(name);
}

beforeAll(() => {
  run("npm", ["run", "build:lib"], ROOT);
  const [packed] = JSON.parse(run("npm", ["pack", "--json", "--pack-destination", work], ROOT)) as {
    filename: string;
  }[];
  archive = join(work, packed.filename);
}, 600_000);
afterAll(() => rmSync(work, { recursive: true, force: true }));

test("what the built files import is declared: dependencies, or three as the peer", () => {
  const { dependencies, peerDependencies } = JSON.parse(readFileSync("package.json", "utf8")) as Record<
    string,
    Record<string, string>
  >;
  const declared = [...Object.keys(dependencies), ...Object.keys(peerDependencies)].sort();
  expect([...imported("dist/lib")].sort()).toEqual(declared);
});

test("an empty Node program: importing does nothing, a scene is solved", () => {
  const app = join(work, "program");
  mkdirSync(app);
  install(app, ["three"]);
  writeFileSync(join(app, "package.json"), '{ "type": "module" }');
  writeFileSync(
    join(app, "main.mjs"),
    `const before = Object.keys(globalThis).length;
import { readFileSync } from "node:fs";
import { fileURLToPath } from "node:url";
const core = await import("stepwright");
const view = await import("stepwright/view");
const element = await import("stepwright/element");
const library = core.decodeLibrary(new Uint8Array(readFileSync(fileURLToPath(import.meta.resolve("stepwright/library.bin")))));
const solved = core.solveScene(core.parseScene({ version: 1, tasks: [{ id: "turn", category: "turn", position: [0.4, 0, 1.2], yaw: 1 }] }), library);
console.log(JSON.stringify({
  globals: Object.keys(globalThis).length - before,
  steps: solved.plan.steps.length, frames: solved.frames, skate: solved.quality.skate,
  controller: typeof view.CharacterController, element: typeof element.StepwrightScene,
}));`,
  );
  const out = JSON.parse(run("node", ["main.mjs"], app)) as Record<string, unknown>;
  expect(out.globals).toBe(0);
  expect(out.steps).toBeGreaterThan(2);
  expect(out.frames).toBeGreaterThan(60);
  expect(out.skate).toBeLessThan(4);
  expect([out.controller, out.element]).toEqual(["function", "function"]);
});

test("an empty vite app: builds, with workers and captures as files of its own; types hold", () => {
  const app = join(work, "app");
  mkdirSync(app);
  install(app, ["three", "vite", "typescript", "@types/three"]);
  writeFileSync(join(app, "package.json"), '{ "type": "module" }');
  writeFileSync(
    join(app, "index.html"),
    '<!doctype html><stepwright-scene controls></stepwright-scene><script type="module" src="/main.ts"></script>',
  );
  writeFileSync(
    join(app, "main.ts"),
    `import "stepwright/element";
import { parseScene, type Scene } from "stepwright";
import { CharacterController } from "stepwright/view";
import { Group } from "three";
const scene: Scene = parseScene({ version: 1 });
const element = document.querySelector("stepwright-scene");
if (element) element.scene = scene;
export const make = (g: Group): CharacterController => new CharacterController(g, { bones: { hips: "Hips" } });
`,
  );
  writeFileSync(
    join(app, "tsconfig.json"),
    JSON.stringify({
      compilerOptions: {
        target: "ES2022",
        module: "ESNext",
        moduleResolution: "Bundler",
        strict: true,
        noEmit: true,
        lib: ["ES2023", "DOM", "DOM.Iterable"],
        types: [],
        skipLibCheck: false,
      },
      files: ["main.ts"],
    }),
  );
  run("node", [join(ROOT, "node_modules/typescript/bin/tsc"), "-p", "."], app);
  run("node", [join(ROOT, "node_modules/vite/bin/vite.js"), "build"], app);
  const files = readdirSync(join(app, "dist/assets"));
  expect(files.some((f) => /planner-worker.*\.js$/.test(f))).toBe(true);
  expect(files.some((f) => /mesh-worker.*\.js$/.test(f))).toBe(true);
  expect(files.some((f) => /library.*\.bin$/.test(f))).toBe(true);
});

test("publint and are-the-types-wrong find nothing", () => {
  run("npx", ["publint", "--strict", archive], ROOT);
  run(
    "npx",
    [
      "attw",
      archive,
      "--profile",
      "esm-only",
      "--exclude-entrypoints",
      "./library.bin",
      "./planner-worker.js",
      "./mesh-worker.js",
    ],
    ROOT,
  );
});
