import { defineConfig } from "@playwright/test";
import { chromiumFlags, chromiumPath } from "./tests/support/chromium.mjs";

const executablePath = chromiumPath();

export default defineConfig({
  testDir: "tests/e2e",
  timeout: 180_000,
  workers: 1,
  reporter: [["list"]],
  outputDir: "artefacts/e2e",
  use: {
    baseURL: "http://localhost:4180",
    viewport: { width: 1100, height: 720 },
    launchOptions: { ...(executablePath ? { executablePath } : {}), args: chromiumFlags() },
  },
  webServer: {
    command: "npx vite preview --port 4180 --strictPort",
    url: "http://localhost:4180",
    reuseExistingServer: false,
    timeout: 60_000,
  },
});
