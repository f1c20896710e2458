/** Builds the benchmarks when stale and runs them. */
import { built } from "../../src/cli/build.mjs";

const { main } = await import(
  await built("tests/bench/main.ts", "bench", [
    "tests/bench",
    "tests/support",
    "src/cli",
    "src/core",
    "src/plots",
    "src/studio",
  ])
);
process.exitCode = await main(process.argv.slice(2));
