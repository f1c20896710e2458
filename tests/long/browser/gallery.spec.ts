/**
 * Pictures of every page at three sizes, light and dark, in artefacts/gallery; each is measured for what is covered or cut off, and
 * judged by axe.
 * STEPWRIGHT_GALLERY names a part of them, by their pictures: "embed", "editor-plan,editor-help", "lesson,studio-390".
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
  [1280, 800],
  [2560, 1440],
  [390, 844],
];
const SMALL = JSON.stringify({
  version: 1,
  start: { position: [0, 0], yaw: 0 },
  tasks: [{ id: "turn", category: "turn", position: [0.4, 0, 1.2], yaw: 1.5 }],
});

async function editor(page: Page): Promise<void> {
  await openEditor(page);
  // The room is drawn once its shaders are made; then not again before its picture is taken.
  await page.waitForFunction(() => window.stepwright!.graphics().geometries > 0);
  await page.evaluate(() => {
    window.stepwright!.draw(false);
    window.stepwright!.seek(3.4);
  });
}

const tool = (page: Page, label: string): Promise<void> =>
  page.locator(`.rail button[aria-label="${label}"]`).first().click();

async function example(page: Page, name: string): Promise<void> {
  await page.locator(".scene-name").click();
  await page.locator(".examples").getByRole("button", { name, exact: true }).click();
  await answered(page);
}

/** Each page by name: what is done to see it, in a window of 1280; it stays while the window changes. */
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
  "editor-more": editor,
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
/** What is done anew in each window, by a part of the page's name. */
const EACH: Record<string, (page: Page) => Promise<unknown>> = {
  "editor-more": async (page) => {
    await page.keyboard.press("Escape");
    const wide = page.getByRole("button", { name: "Export", exact: true });
    if (await wide.isVisible()) await wide.click();
    else await page.getByRole("button", { name: "More", exact: true }).click();
  },
  lesson: async (page) => {
    // Charts are drawn for the window that they come up in.
    await page.reload();
    await page.waitForLoadState("networkidle");
    // Figures come as they are scrolled to.
    for (const figure of await page.locator("[data-figure], stepwright-scene").all()) {
      await figure.scrollIntoViewIfNeeded();
      await page.waitForTimeout(400);
    }
    // Some of them render clips first.
    await expect(page.getByText("Rendering the clips")).toHaveCount(0, { timeout: 120_000 });
    await page.evaluate(() => window.scrollTo(0, 0));
  },
};
for (const file of readdirSync("lessons").filter((f) => f.endsWith(".html")))
  PAGES[`lesson-${file.replace(".html", "")}`] = async (page) => {
    await page.goto(`/lessons/${file}`);
    await page.waitForLoadState("networkidle");
  };

// Where a page does not come to be, the next one is looked at.
test.setTimeout(900_000);
test.use({ contextOptions: { reducedMotion: "reduce" } });
mkdirSync("artefacts/gallery", { recursive: true });
const parts = (process.env.STEPWRIGHT_GALLERY ?? "").split(",");
const wanted = (picture: string): boolean => parts.some((part) => picture.includes(part.trim()));

for (const [name, see] of Object.entries(PAGES)) {
  const sizes = SIZES.filter(([width]) => wanted(`${name}-${width}`));
  if (sizes.length === 0) continue;
  test(`${name} at ${sizes.map(([width]) => width).join(", ")}: nothing covered, nothing cut off`, async ({
    page,
  }) => {
    const errors = pageErrors(page);
    await page.setViewportSize({ width: 1280, height: 800 });
    await see(page);
    const faults = new Set<string>();
    for (const [width, height] of sizes) {
      await page.setViewportSize({ width, height });
      for (const [part, act] of Object.entries(EACH)) if (name.startsWith(part)) await act(page);
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
        await page.evaluate(async () => {
          window.stepwright?.draw(true);
          for (let k = 0; k < 2; k++) await new Promise(requestAnimationFrame);
        });
        const fullPage = name.startsWith("lesson") || name === "studio";
        await page.screenshot({ path: `artefacts/gallery/${name}-${width}-${colorScheme}.png`, fullPage });
        await page.evaluate(() => window.stepwright?.draw(false));
        for (const fault of [...(await pageFaults(page)), ...(await seriousViolations(page))])
          faults.add(`${width} ${colorScheme}: ${fault}`);
      }
    }
    expect.soft([...faults]).toEqual([]);
    expect.soft(errors).toEqual([]);
  });
}
