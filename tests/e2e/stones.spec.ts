import { expect, test } from "@playwright/test";
import { answered, pageErrors } from "../support/editor-page.ts";

test("eight stones are laid over the river with the mouse and stepped on; the keyboard steers", async ({
  page,
}) => {
  const errors = pageErrors(page);
  await page.goto("/");
  await answered(page);
  await page.locator(".scene-name").click();
  await page.getByText("River", { exact: true }).first().click();
  await answered(page);
  // Where the example has its stones; then they are all taken away.
  const places = await page.evaluate(() =>
    [...document.querySelectorAll<HTMLElement>('[data-kind="stone"]')].map((m) => {
      const r = m.getBoundingClientRect();
      return [r.x + r.width / 2, r.y + r.height / 2] as [number, number];
    }),
  );
  expect(places).toHaveLength(8);
  for (let k = 0; k < 8; k++) {
    await page.locator('[data-kind="stone"]').first().focus();
    await page.keyboard.press("Delete");
  }
  expect(await page.evaluate(() => window.stepwright?.state().scene.stones.length)).toBe(0);

  await page.getByRole("button", { name: "Stones", exact: true }).click();
  for (const [x, y] of places) await page.mouse.click(x, y);
  await page.keyboard.press("v");
  await answered(page);
  const laid = await page.evaluate(() => {
    const s = window.stepwright?.state();
    const lands = s?.plan?.steps ?? [];
    return {
      stones: s?.scene.stones.length,
      feet: lands.map((p) => p.foot),
      error: s?.quality?.footstepError?.position ?? 99,
      skate: s?.quality?.skate ?? 99,
      warnings: s?.plan?.warnings ?? [],
      choices: s?.plan?.blend?.choices.length ?? 0,
    };
  });
  expect(laid.stones).toBe(8);
  expect(laid.choices).toBe(8);
  expect(laid.warnings).toEqual([]);
  expect(new Set(laid.feet).size).toBe(2);
  expect(laid.error).toBeLessThan(1);
  expect(laid.skate).toBeLessThan(4);

  // Played from the start: it goes on to the other bank.
  await page.evaluate(() => window.stepwright?.seek(0));
  await page.getByRole("button", { name: "Play" }).click();
  await page.waitForFunction(() => (window.stepwright?.state().time ?? 0) > 1.5);
  await page.getByRole("button", { name: "Pause" }).click();
  await page.evaluate(() => window.stepwright?.seek(3.2));
  await page.getByRole("tab", { name: "Stones" }).click();
  await expect(page.getByText("Clips blended")).toBeVisible();
  await page.screenshot({ path: "artefacts/river.png" });

  // One undo takes the last stone away.
  await page.keyboard.press("Control+z");
  expect(await page.evaluate(() => window.stepwright?.state().scene.stones.length)).toBe(7);

  await page.getByRole("button", { name: "Walk by hand" }).click();
  await page.waitForFunction(() => document.documentElement.dataset.walk !== undefined, null, {
    timeout: 60_000,
  });
  const where = () =>
    page.evaluate(() => (document.documentElement.dataset.walk ?? "0 0 0").split(" ").map(Number));
  await page.waitForFunction(() => document.documentElement.dataset.walk?.includes(" "));
  const before = await where();
  await page.keyboard.down("w");
  await page.waitForFunction(
    ([x, z]) => {
      const p = (document.documentElement.dataset.walk ?? "").split(" ").map(Number);
      return Math.hypot(p[0] - x, p[1] - z) > 0.8;
    },
    before,
    { timeout: 60_000 },
  );
  await page.keyboard.down("a");
  await page.waitForFunction(
    (yaw) => Math.abs(Number((document.documentElement.dataset.walk ?? "").split(" ")[2]) - yaw) > 0.4,
    before[2],
    { timeout: 60_000 },
  );
  await page.screenshot({ path: "artefacts/walk-by-hand.png" });
  await page.keyboard.up("a");
  await page.keyboard.up("w");
  await page.keyboard.press("v");
  expect(errors).toEqual([]);
});
