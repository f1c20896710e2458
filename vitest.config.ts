import { defineConfig } from "vitest/config";

export default defineConfig({
  test: {
    include: ["tests/unit/**/*.test.ts"],
    testTimeout: 60_000,
    hookTimeout: 60_000,
    pool: "forks",
    // Files of one process share their modules, and with them the studio's captures and library: half the time. What a test
    // changes outside itself it puts back.
    isolate: false,
  },
});
