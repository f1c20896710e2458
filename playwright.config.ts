import { defineConfig } from "@playwright/test";
import { chromiumFlags, chromiumPath } from "./tests/support/chromium.mjs";

const executablePath = chromiumPath();
const port = process.env.STEPWRIGHT_TEST_PORT ?? "4180";

export default defineConfig({
  testDir: "tests/e2e",
  timeout: 180_000,
  workers: 1,
  reporter: [["list"]],
  outputDir: "artefacts/e2e",
  use: {
    baseURL: `http://localhost:${port}`,
    viewport: { width: 1100, height: 720 },
    launchOptions: { ...(executablePath ? { executablePath } : {}), args: chromiumFlags() },
  },
  webServer: {
    command: `npx vite preview --port ${port} --strictPort`,
    url: `http://localhost:${port}`,
    reuseExistingServer: false,
    timeout: 60_000,
  },
});
