import { defineConfig } from "@playwright/test";
import base from "./playwright.config.ts";

/** Long browser tests on the built site: a soak of random editing, and pictures of every page. */
export default defineConfig({
  ...base,
  testDir: "tests/long/browser",
  timeout: 3_600_000,
  outputDir: "artefacts/long",
});
