#!/usr/bin/env node
/** The command line's door: builds itself when stale, then runs. */
import { built } from "./build.mjs";

const { main } = await import(await built("src/cli/main.ts", "cli", ["src/cli", "src/core", "src/studio"]));
process.exitCode = await main(process.argv.slice(2));
