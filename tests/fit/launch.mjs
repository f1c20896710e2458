/** Builds the gait fit when stale and runs it: `npm run fit -- NAME [ROUNDS]`. */
import { built } from "../../src/cli/build.mjs";

const { main } = await import(
  await built("tests/fit/fit-gait.ts", "fit", ["tests/fit", "src/core", "src/studio"])
);
process.exitCode = await main(process.argv.slice(2));
