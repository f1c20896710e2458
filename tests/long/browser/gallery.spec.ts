/**
 * Pictures of every page at three sizes, light and dark, in artefacts/gallery; each is measured for what is covered or cut off, and
 * judged by axe.
 * STEPWRIGHT_GALLERY names a part of the pages to draw only those.
 */
import { mkdirSync, readdirSync } from "node:fs";
import { expect, type Page, test } from "@playwright/test";
import { writeBvh } from "../../../src/core/capture/bvh-write.ts";
import { renderScore } from "../../../src/studio/render.ts";
import { styleScore } from "../../../src/studio/styles.ts";
import { seriousViolations } from "../../support/accessibility.ts";
import { answered, drop, openEditor, pageErrors } from "../../support/editor-page.ts";
import { pageFaults } from "../../support/page-faults.ts";

const SIZES: readonly [number, number][] = [
  [390, 844],
  [1280, 800],
  [2560, 1440],
];
const SMALL = JSON.stringify({
  version: 1,
  start: { position: [0, 0], yaw: 0 },
  tasks: [{ id: "turn", category: "turn", position: [0.4, 0, 1.2], yaw: 1.5 }],
});

async function editor(page: Page): Promise<void> {
  await openEditor(page);
  // The room is drawn once its shaders are made.
  await page.waitForFunction(() => window.stepwright!.graphics().geometries > 0);
  await page.evaluate(() => window.stepwright!.seek(3.4));
}

/** A tool by its button, or under "More" where the window is narrow. */
async function tool(page: Page, label: string): Promise<void> {
  const button = page.locator(`.rail button[aria-label="${label}"]`).first();
  if (await button.isVisible()) await button.click();
  else {
    await page.getByRole("button", { name: "More", exact: true }).click();
    await page.locator(".menu.more").getByRole("button", { name: label, exact: true }).click();
  }
}

async function example(page: Page, name: string): Promise<void> {
  await page.locator(".scene-name").click();
  await page.locator(".examples").getByRole("button", { name, exact: true }).click();
  await answered(page);
}

/** Each page by name: what is done to see it. */
const PAGES: Record<string, (page: Page) => Promise<unknown>> = {
  "editor-select": editor,
  "editor-task": async (page) => {
    await editor(page);
    await page.locator('[data-marker="write"]').focus();
    await page.keyboard.press("Enter");
  },
  "editor-add-task": async (page) => {
    await editor(page);
    await tool(page, "Task");
  },
  "editor-footstep": async (page) => {
    await editor(page);
    for (let k = 0; k < 5; k++) await page.keyboard.press("]");
  },
  "editor-plan": async (page) => {
    await editor(page);
    await page.getByRole("tab", { name: "Plan", exact: true }).click();
  },
  "editor-path": async (page) => {
    await editor(page);
    await example(page, "One path, four styles");
    await tool(page, "Path");
    await page.evaluate(() => window.stepwright!.seek(6));
  },
  "editor-stones": async (page) => {
    await editor(page);
    await example(page, "River");
    await tool(page, "Stones");
    await page.evaluate(() => window.stepwright!.seek(3));
  },
  "editor-crowd": async (page) => {
    await editor(page);
    await page.locator(".scene-name").click();
    await page.locator(".examples").getByRole("button", { name: "Crowd: doorway", exact: true }).click();
    await page.waitForFunction(() => window.stepwright!.crowd().ready, null, { timeout: 120_000 });
    await tool(page, "Crowd");
  },
  "editor-label": async (page) => {
    await editor(page);
    await tool(page, "Labels");
  },
  "editor-desk": async (page) => {
    await editor(page);
    await drop(page, { name: "walk.bvh", content: writeBvh(renderScore(styleScore("walking")).clip) });
    await page.getByRole("button", { name: "Confirm and next" }).waitFor({ timeout: 60_000 });
  },
  "editor-empty": async (page) => {
    await editor(page);
    await page.locator(".scene-name").click();
    await page.getByRole("menuitem", { name: "New, empty room" }).click();
    await page.waitForFunction(() => window.stepwright!.state().scene.tasks.length === 0);
  },
  "editor-scenes": async (page) => {
    await editor(page);
    await page.locator(".scene-name").click();
  },
  "editor-more": async (page) => {
    await editor(page);
    const wide = page.getByRole("button", { name: "Export", exact: true });
    if (await wide.isVisible()) await wide.click();
    else await page.getByRole("button", { name: "More", exact: true }).click();
  },
  "editor-help": async (page) => {
    await editor(page);
    await page.keyboard.press("?");
  },
  studio: async (page) => {
    await page.goto("/studio.html");
    await page.waitForLoadState("networkidle");
    await page.waitForTimeout(2500);
  },
  embed: async (page) => {
    await page.goto(`/embed.html?panels=steps%20objective&scene=${encodeURIComponent(SMALL)}`);
    await page.waitForFunction(
      () => (document.querySelector("stepwright-scene") as { quality?: unknown } | null)?.quality,
      null,
      { timeout: 120_000 },
    );
  },
};
for (const file of readdirSync("lessons").filter((f) => f.endsWith(".html")))
  PAGES[`lesson-${file.replace(".html", "")}`] = async (page) => {
    await page.goto(`/lessons/${file}`);
    // Figures come as they are scrolled to.
    await page.waitForLoadState("networkidle");
    for (const figure of await page.locator("[data-figure], stepwright-scene").all()) {
      await figure.scrollIntoViewIfNeeded();
      await page.waitForTimeout(400);
    }
    // Some of them render clips first.
    await expect(page.getByText("Rendering the clips")).toHaveCount(0, { timeout: 120_000 });
    await page.evaluate(() => window.scrollTo(0, 0));
  };

// Where a page does not come to be, the next one is looked at.
test.setTimeout(300_000);
test.use({ contextOptions: { reducedMotion: "reduce" } });
mkdirSync("artefacts/gallery", { recursive: true });
const wanted = process.env.STEPWRIGHT_GALLERY ?? "";

for (const [name, see] of Object.entries(PAGES).filter(([n]) => n.includes(wanted)))
  for (const [width, height] of SIZES)
    test(`${name} at ${width}: nothing covered, nothing cut off`, async ({ page }) => {
      const errors = pageErrors(page);
      await page.setViewportSize({ width, height });
      await see(page);
      const faults: string[] = [];
      for (const colorScheme of ["light", "dark"] as const) {
        await page.emulateMedia({ colorScheme });
        await page.evaluate(
          (theme) => {
            const button = document.querySelector<HTMLElement>(`.top-bar [aria-label="${theme} theme"]`);
            if (document.documentElement.dataset.theme && button) button.click();
          },
          colorScheme === "dark" ? "Dark" : "Light",
        );
        await page.waitForTimeout(900);
        const fullPage = name.startsWith("lesson") || name === "studio";
        await page.screenshot({ path: `artefacts/gallery/${name}-${width}-${colorScheme}.png`, fullPage });
        faults.push(...(await pageFaults(page)));
        faults.push(...(await seriousViolations(page)));
      }
      expect.soft([...new Set(faults)]).toEqual([]);
      expect.soft(errors).toEqual([]);
    });
