import { readFile } from "node:fs/promises";
import { expect, test } from "@playwright/test";
import { pageErrors } from "../support/editor-page.ts";

test("the studio walks by its sliders, compares with real walkers, and saves what it shows", async ({
  page,
}) => {
  const errors = pageErrors(page);
  await page.goto("/studio.html");
  const walks = () => page.evaluate(() => window.stepwrightStudio?.walks() ?? 0);
  await expect.poll(walks, { timeout: 60_000 }).toBeGreaterThan(0);
  await page.getByRole("button", { name: "Pause" }).click();
  await expect(page.locator(".joints figure")).toHaveCount(3);
  // The bar that stood there before the script is not drawn twice.
  await expect(page.locator(".top-bar strong")).toHaveCount(1);

  const before = await walks();
  await page.getByLabel("Height", { exact: true }).fill("1.9");
  await page.getByLabel("Manner").selectOption("tired");
  await expect.poll(walks, { timeout: 60_000 }).toBeGreaterThan(before);
  await expect
    .poll(() => page.evaluate(() => window.stepwrightStudio?.state().walk?.height), { timeout: 60_000 })
    .toBe(1.9);
  await page.getByRole("button", { name: "Table" }).click();
  await expect(page.locator(".curves table")).toBeVisible();

  const download = page.waitForEvent("download");
  await page.getByRole("button", { name: "Save BVH" }).click();
  const file = await (await download).path();
  expect(await readFile(file, "utf8")).toContain("HIERARCHY");
  expect(errors).toEqual([]);
});
