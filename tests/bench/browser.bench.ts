/** The production build in a real Chromium: from asking for the page to a character that moves, and from a drag to its answer. */
import { spawn, spawnSync } from "node:child_process";
import { existsSync } from "node:fs";
import { type Browser, chromium, type Page } from "@playwright/test";
import { FIRST_RENDER, type StepwrightScene } from "../../src/embed/element.ts";
import { chromiumFlags, chromiumPath } from "../support/chromium.mjs";
import { figure } from "./measure.ts";
import type { BenchModule } from "./types.ts";

const PORT = 4181;
const URL = `http://localhost:${PORT}/`;

const bench: BenchModule = {
  name: "browser",
  async run(options) {
    const path = chromiumPath();
    if (!path && !existsSync(chromium.executablePath())) {
      options.progress("browser: no Chromium; npm test says how to get one.");
      return [];
    }
    options.progress("browser: production build ...");
    const built = spawnSync("npx", ["vite", "build", "--logLevel", "warn"], { stdio: "ignore" });
    if (built.status !== 0) throw new Error("browser: the production build failed.");
    const server = spawn("npx", ["vite", "preview", "--port", String(PORT), "--strictPort"], {
      stdio: "ignore",
      detached: true,
    });
    try {
      await answers();
      return await measure(path, options.progress);
    } finally {
      if (server.pid !== undefined) process.kill(-server.pid);
    }
  },
};

async function answers(): Promise<void> {
  for (let i = 0; i < 100; i++) {
    try {
      if ((await fetch(URL)).ok) return;
    } catch {
      // Not up yet.
    }
    await new Promise((done) => setTimeout(done, 100));
  }
  throw new Error("browser: the preview server did not come up.");
}

async function measure(path: string | undefined, progress: (text: string) => void) {
  const loads: number[] = [];
  const drags: number[] = [];
  const drawn: number[] = [];
  const browser = await chromium.launch({ ...(path ? { executablePath: path } : {}), args: chromiumFlags() });
  for (let round = 0; round < 3; round++) {
    progress(`browser: load ${round + 1} of 3 ...`);
    const context = await browser.newContext({ viewport: { width: 1100, height: 720 } });
    const page = await context.newPage();
    await page.goto(URL);
    const moved = await page.waitForFunction(
      () => {
        const s = window.stepwright;
        return s && s.state().time > 0 && (s.frames()?.filled ?? 0) > 0 ? performance.now() : null;
      },
      null,
      { timeout: 120_000, polling: 20 },
    );
    loads.push((await moved.jsonValue()) as number);
    await page.waitForFunction(() => window.stepwright?.log().some((e) => e.what === "finished"), null, {
      timeout: 120_000,
    });
    await page.getByRole("button", { name: "Pause" }).click();
    await page.locator('[data-marker="write"]').focus();
    drawn.push(...(await nudges(page)));
    await page.evaluate(() => window.stepwright?.draw(false));
    drags.push(...(await nudges(page)));
    await context.close();
  }
  const embed = await measureEmbed(browser, progress);
  await browser.close();
  return [
    ...embed,
    figure("first load to a moving character", "ms", loads, "<= 3000 ms", (v) => v <= 3000),
    figure("drag to answer, drawing paused", "ms", drags, "<= 50 ms", (v) => v <= 50),
    figure("drag to answer, drawn without a graphics card", "ms", drawn, null, () => true),
  ];
}

/** A task is moved eight times: milliseconds from asking for a plan to having its footsteps, each. */
async function nudges(page: Page): Promise<number[]> {
  const before = await page.evaluate(() => window.stepwright?.log().length ?? 0);
  for (let k = 0; k < 8; k++) {
    await page.keyboard.press(k % 2 ? "ArrowRight" : "ArrowLeft");
    await page.waitForTimeout(1000);
  }
  const log = await page.evaluate((from) => [...(window.stepwright?.log() ?? [])].slice(from), before);
  return log
    .filter((e) => e.what === "asked")
    .flatMap((asked) => {
      const planned = log.find((e) => e.what === "drawn" && e.id === asked.id);
      return planned ? [planned.at - asked.at] : [];
    });
}

/** The embed page: from asking for it to its first picture, to footsteps and to a whole motion. */
async function measureEmbed(browser: Browser, progress: (text: string) => void) {
  const renders: number[] = [];
  const plans: number[] = [];
  for (let round = 0; round < 3; round++) {
    progress(`browser: embed ${round + 1} of 3 ...`);
    const context = await browser.newContext({ viewport: { width: 800, height: 450 } });
    const page = await context.newPage();
    await page.goto(`${URL}embed.html`);
    const render = await page.waitForFunction(
      (name) => performance.getEntriesByName(name)[0]?.startTime,
      FIRST_RENDER,
      { timeout: 60_000, polling: 20 },
    );
    renders.push((await render.jsonValue()) as number);
    const planned = await page.waitForFunction(
      () => (document.querySelector<StepwrightScene>("stepwright-scene")?.plan ? performance.now() : null),
      null,
      { timeout: 60_000, polling: 20 },
    );
    plans.push((await planned.jsonValue()) as number);
    await context.close();
  }
  return [
    figure("embed: first render", "ms", renders, "<= 1500 ms", (v) => v <= 1500),
    figure("embed: first footsteps", "ms", plans, null, () => true),
  ];
}

export default bench;
