/**
 * `npm run test:guards`: takes each guard of guards.mjs out of a copy of the project and expects its test to fail.
 *
 * A fault test that passes without its guard tests nothing; a guard whose text is not found has moved, and the list with it.
 * `--only TEXT` tries the guards whose name contains TEXT.
 */
import { spawnSync } from "node:child_process";
import { cpSync, mkdtempSync, readFileSync, rmSync, symlinkSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { GUARDS } from "./guards.mjs";

const only = process.argv.indexOf("--only");
const chosen = only > 0 ? GUARDS.filter((g) => g.name.includes(process.argv[only + 1] ?? "")) : GUARDS;
const copy = mkdtempSync(join(tmpdir(), "stepwright-guards-"));
let passed = 0;
let failed = 0;

function vitest(guard) {
  const args = ["vitest", "run", ...guard.tests.split(",")];
  if (guard.test) args.push("-t", guard.test);
  return spawnSync("npx", args, { cwd: copy, encoding: "utf8", env: { ...process.env, NO_COLOR: "1" } });
}

try {
  for (const part of [
    "src",
    "tests",
    "assets",
    "package.json",
    "tsconfig.json",
    "vitest.config.ts",
    "LICENSE",
  ])
    cpSync(part, join(copy, part), { recursive: true });
  symlinkSync(join(process.cwd(), "node_modules"), join(copy, "node_modules"));
  for (const g of chosen) {
    const path = join(copy, g.file);
    const text = readFileSync(path, "utf8");
    if (text.split(g.guard).length !== 2) {
      console.log(
        `moved      ${g.name}: its text stands ${text.split(g.guard).length - 1} times in ${g.file}.`,
      );
      failed++;
      continue;
    }
    writeFileSync(
      path,
      text.replace(g.guard, () => g.without),
    );
    const { status, stdout } = vitest(g);
    writeFileSync(path, text);
    const noticed = status !== 0 && /Tests .*\d+ failed|Unhandled|heap out of memory/.test(stdout);
    console.log(`${noticed ? "noticed   " : "UNNOTICED "} ${g.name}`);
    if (noticed) passed++;
    else failed++;
  }
} finally {
  rmSync(copy, { recursive: true, force: true });
}
console.log(`\n${passed} passed, ${failed} failed`);
process.exitCode = failed === 0 ? 0 : 1;
