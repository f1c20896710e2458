/** Everything that `npm test` checks, one after the other; the last line counts what passed and what failed. */
import { spawnSync } from "node:child_process";
import { mkdirSync, readFileSync } from "node:fs";
import { ensureChromium } from "./support/chromium.mjs";

mkdirSync("artefacts", { recursive: true });
let passed = 0;
let failed = 0;

function check(name, command, args, env = {}) {
  console.log(`\n== ${name}`);
  const begun = Date.now();
  const { status } = spawnSync(command, args, { stdio: "inherit", env: { ...process.env, ...env } });
  console.log(
    `== ${name}: ${status === 0 ? "ok" : "failed"} in ${((Date.now() - begun) / 1000).toFixed(0)} s`,
  );
  return status === 0;
}

function counted(ok) {
  if (ok) passed++;
  else failed++;
  return ok;
}

counted(
  check("lint and format", "npx", [
    "biome",
    "check",
    "src",
    "tests",
    "vite.config.ts",
    "vitest.config.ts",
    "playwright.config.ts",
  ]),
);
counted(check("types", "npx", ["tsc", "--noEmit", "-p", "."]));
counted(check("dead code", "npx", ["knip"]));

const unitOk = check("unit and property tests", "npx", [
  "vitest",
  "run",
  "--reporter=default",
  "--reporter=json",
  "--outputFile.json=artefacts/unit.json",
]);
try {
  const unit = JSON.parse(readFileSync("artefacts/unit.json", "utf8"));
  passed += unit.numPassedTests;
  failed += unit.numFailedTests;
  if (!unitOk && unit.numFailedTests === 0) failed++;
} catch (error) {
  console.error(`The unit tests left no report: ${error}`);
  failed++;
}

if (
  counted(check("production build", "npx", ["vite", "build", "--logLevel", "warn"])) &&
  counted(ensureChromium())
) {
  const e2eOk = check("browser tests", "npx", ["playwright", "test", "--reporter=list,json"], {
    PLAYWRIGHT_JSON_OUTPUT_NAME: "artefacts/e2e.json",
  });
  try {
    const { stats } = JSON.parse(readFileSync("artefacts/e2e.json", "utf8"));
    passed += stats.expected;
    failed += stats.unexpected + stats.flaky;
    if (!e2eOk && stats.unexpected + stats.flaky === 0) failed++;
  } catch (error) {
    console.error(`The browser tests left no report: ${error}`);
    failed++;
  }
}

console.log(`\n${passed} passed, ${failed} failed`);
process.exitCode = failed === 0 ? 0 : 1;
