/** Performances beside their plans: the studio's left-out sequence, and a capture that is dropped. */
import { expect, type Page, test } from "@playwright/test";
import { writeBvh } from "../../src/core/capture/bvh-write.ts";
import { renderScore } from "../../src/studio/render.ts";
import { studioSet } from "../../src/studio/set.ts";

test.use({ contextOptions: { reducedMotion: "reduce" } });

const planOf = (page: Page) => page.evaluate(() => window.stepwright?.state().plan);

/** Metres that the panel tells as the median to the nearest planned footstep. */
async function toldDistance(page: Page): Promise<number> {
  const told = page.locator(".row", { hasText: "To the nearest planned" });
  await expect(told).toContainText("cm", { timeout: 30_000 });
  return Number(/(\d+) cm/.exec((await told.textContent()) ?? "")?.[1]) / 100;
}

test("the left-out sequence stands beside its plan, and leaves with another scene", async ({ page }) => {
  const errors: string[] = [];
  page.on("pageerror", (e) => errors.push(e.message));
  await page.goto("/");
  await page.locator(".scene-name").click();
  await page.getByText("A left-out performance beside its plan").click();
  await page.waitForFunction(() => window.stepwright?.state().plan?.tasks.length === 5, null, {
    timeout: 60_000,
  });
  expect((await planOf(page))?.tasks.map((t) => t.id)).toEqual([1, 2, 3, 4, 5].map((i) => `performed-${i}`));
  expect(await toldDistance(page)).toBeLessThan(0.5);
  await page.evaluate(() => window.stepwright?.seek(6));
  await page.screenshot({ path: "artefacts/compare-left-out.png" });
  await page.getByRole("button", { name: "Show the plan alone" }).click();
  await expect(page.getByText("Performed and planned")).toHaveCount(0);
  expect(errors).toEqual([]);
});

test("a capture that is dropped stands beside the plan of its tasks", async ({ page }) => {
  const errors: string[] = [];
  page.on("pageerror", (e) => errors.push(e.message));
  const turning = studioSet().find((p) => p.name === "walk-and-turn") ?? studioSet()[0];
  const { clip } = renderScore(turning.score);
  await page.goto("/");
  await page.getByRole("button", { name: "Labels", exact: true }).waitFor();
  const data = await page.evaluateHandle((text) => {
    const d = new DataTransfer();
    d.items.add(new File([text], "turning.bvh"));
    return d;
  }, writeBvh(clip));
  await page.dispatchEvent("body", "drop", { dataTransfer: data });
  await expect(page.getByRole("button", { name: "Confirm and next" })).toBeVisible({ timeout: 60_000 });
  await page.getByRole("tab", { name: "Clip" }).click();
  await page.getByRole("button", { name: "Compare with the plan" }).click();
  await expect(page.getByText(/turning: mark what is done in it first/).first()).toBeVisible();
  // The turn is over where the capture ends.
  await page.locator("canvas").first().focus();
  await page.keyboard.press("End");
  await page.getByRole("button", { name: "Turn", exact: true }).click();
  await expect(page.getByText(/^Turn, \d/)).toBeVisible();
  await page.getByRole("button", { name: "Compare with the plan" }).click();
  await page.waitForFunction(() => window.stepwright?.state().plan?.tasks[0]?.id === "performed-1", null, {
    timeout: 60_000,
  });
  expect(await toldDistance(page)).toBeLessThan(0.6);
  await page.screenshot({ path: "artefacts/compare-capture.png" });
  expect(errors).toEqual([]);
});
