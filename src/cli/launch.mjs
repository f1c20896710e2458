#!/usr/bin/env node
/** The command line's door: builds itself when stale, then runs. `bench` is the benchmarks' own program. */
import { built } from "./build.mjs";

const [command, ...rest] = process.argv.slice(2);
const bench = command === "bench";
const { main } = await import(
  bench
    ? await built("tests/bench/main.ts", "bench", [
        "tests/bench",
        "tests/support",
        "src/cli",
        "src/core",
        "src/plots",
        "src/studio",
      ])
    : await built("src/cli/main.ts", "cli", ["src/cli", "src/core", "src/studio"])
);
process.exitCode = await main(bench ? rest : process.argv.slice(2));
