/**
 * `npm run test:guards`: takes each guard of guards.mjs out of a copy of the project and expects its test to fail.
 *
 * A fault test that passes without its guard tests nothing; a guard whose text is not found has moved, and the list with it. First the
 * tests pass with every guard in place, or their failing would mean nothing. `--only TEXT` tries the guards whose name contains TEXT.
 */
import { spawnSync } from "node:child_process";
import { cpSync, mkdtempSync, readdirSync, readFileSync, rmSync, symlinkSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { ensureChromium } from "../support/chromium.mjs";
import { GUARDS } from "./guards.mjs";

/** What a copy is made without. */
const LEFT_OUT = new Set(["node_modules", "dist", "artefacts", ".git"]);

const only = process.argv.indexOf("--only");
const chosen = only > 0 ? GUARDS.filter((g) => g.name.includes(process.argv[only + 1] ?? "")) : GUARDS;
const copy = mkdtempSync(join(tmpdir(), "stepwright-guards-"));
let passed = 0;
let failed = 0;

const run = (...args) =>
  spawnSync("npx", args, {
    cwd: copy,
    encoding: "utf8",
    env: { ...process.env, NO_COLOR: "1" },
    maxBuffer: 1 << 28,
  });
const inBrowser = (file) => file.startsWith("tests/e2e/");

/** Runs a test. @returns whether it ran and failed, and what it said. */
function fails(tests, title) {
  const named = title ? [inBrowser(tests) ? "-g" : "-t", title] : [];
  if (inBrowser(tests)) {
    const build = run("vite", "build", "--logLevel", "warn");
    if (build.status !== 0) return { failed: false, said: `${build.stdout}${build.stderr}` };
    const { status, stdout } = run("playwright", "test", tests, ...named);
    return { failed: status !== 0 && /\d+ failed/.test(stdout), said: stdout };
  }
  const { status, stdout } = run("vitest", "run", tests, ...named);
  return {
    failed: status !== 0 && /Tests .*\d+ failed|Unhandled|heap out of memory/.test(stdout),
    said: stdout,
  };
}

/** Whether the tests pass as they are: one run in Node, one in a browser. */
function soundBefore() {
  const files = [...new Set(chosen.map((g) => g.tests))];
  const unit = files.filter((f) => !inBrowser(f));
  const said = [];
  if (unit.length > 0) {
    const { status, stdout, stderr } = run("vitest", "run", ...unit);
    if (status !== 0) said.push(`${stdout}${stderr}`);
  }
  const titles = new Map(chosen.filter((g) => inBrowser(g.tests)).map((g) => [g.test, g.tests]));
  for (const [title, file] of titles) {
    const outcome = fails(file, title);
    if (!/\d+ passed/.test(outcome.said) || outcome.failed) said.push(outcome.said);
  }
  for (const s of said) console.log(s);
  return said.length === 0;
}

try {
  for (const part of readdirSync("."))
    if (!LEFT_OUT.has(part)) cpSync(part, join(copy, part), { recursive: true });
  symlinkSync(join(process.cwd(), "node_modules"), join(copy, "node_modules"));
  if (chosen.some((g) => inBrowser(g.tests))) ensureChromium();
  if (!soundBefore()) {
    console.log("The tests fail with every guard in place: mend them first.");
    failed++;
  } else
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
      const noticed = fails(g.tests, g.test).failed;
      writeFileSync(path, text);
      console.log(`${noticed ? "noticed   " : "UNNOTICED "} ${g.name}`);
      if (noticed) passed++;
      else failed++;
    }
} finally {
  rmSync(copy, { recursive: true, force: true });
}
console.log(`\n${passed} passed, ${failed} failed`);
process.exitCode = failed === 0 ? 0 : 1;
