/**
 * The long tests: those in Node, then those in a browser on a fresh build. Names after `--` pick files of either kind: `npm run test:long --
 * paths`, `-- soak`, `-- gallery`.
 */
import { spawnSync } from "node:child_process";
import { readdirSync } from "node:fs";

const names = process.argv.slice(2);
const wanted = (folder, ending) =>
  readdirSync(folder).some(
    (f) => f.endsWith(ending) && (names.length === 0 || names.some((n) => f.includes(n))),
  );
const run = (...args) => spawnSync("npx", args, { stdio: "inherit" }).status === 0;

let ok = true;
if (wanted("tests/long", ".test.ts")) ok = run("vitest", "run", "--config", "vitest.long.config.ts", ...names);
if (wanted("tests/long/browser", ".spec.ts"))
  ok =
    run("vite", "build", "--logLevel", "warn") &&
    run("playwright", "test", "--config", "playwright.long.config.ts", ...names) &&
    ok;
process.exitCode = ok ? 0 : 1;
