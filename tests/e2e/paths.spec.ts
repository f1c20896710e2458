import { expect, type Page, test } from "@playwright/test";

const finished = (page: Page, id: number) =>
  page.waitForFunction((n) => window.stepwright?.log().some((e) => e.what === "finished" && e.id >= n), id, {
    timeout: 120_000,
  });
const newest = (page: Page) =>
  page.evaluate(() =>
    Math.max(...(window.stepwright?.log() ?? []).filter((e) => e.what === "asked").map((e) => e.id)),
  );

test("a path drawn freehand is followed; styles painted along it; undo takes it away", async ({ page }) => {
  const errors: string[] = [];
  page.on("pageerror", (e) => errors.push(e.message));
  await page.goto("/");
  await finished(page, 1);
  await page.getByRole("button", { name: "Pause" }).click();
  await page.getByRole("button", { name: "Path", exact: true }).click();
  const box = (await page.locator("canvas").first().boundingBox())!;
  const at = (u: number, v: number): [number, number] => [box.x + u * box.width, box.y + v * box.height];
  await page.mouse.move(...at(0.25, 0.72));
  await page.mouse.down();
  for (let k = 1; k <= 12; k++) await page.mouse.move(...at(0.25 + 0.035 * k, 0.72 - 0.06 * Math.sin(k / 2)));
  await page.mouse.up();
  await finished(page, await newest(page));
  const drawn = await page.evaluate(() => {
    const s = window.stepwright?.state();
    return {
      paths: s?.scene.paths.length,
      points: s?.scene.paths[0]?.points.length ?? 0,
      steps: s?.plan?.steps.length ?? 0,
      skate: s?.quality?.skate ?? 99,
    };
  });
  expect(drawn.paths).toBe(1);
  expect(drawn.points).toBeGreaterThan(4);
  expect(drawn.steps).toBeGreaterThan(5);
  expect(drawn.skate).toBeLessThan(4);

  // Three styles: the first one changed, another from the playhead on, a third later.
  await page.getByLabel("Path 1, style from 0 %").selectOption("energetic");
  for (const share of [0.4, 0.7]) {
    await finished(page, await newest(page));
    await page.evaluate((u) => {
      const s = window.stepwright;
      s?.seek(u * (s.state().plan?.duration ?? 0));
    }, share);
    await page.getByRole("button", { name: "Change style here" }).click();
  }
  await finished(page, await newest(page));
  const styles = await page.evaluate(() => window.stepwright?.state().scene.paths[0].styles ?? []);
  expect(styles.map((s) => s.style)[0]).toBe("energetic");
  expect(styles).toHaveLength(3);
  await page.screenshot({ path: "artefacts/path-styles.png" });

  for (let k = 0; k < 4; k++) await page.keyboard.press("Control+z");
  await finished(page, await newest(page));
  expect(await page.evaluate(() => window.stepwright?.state().scene.paths.length)).toBe(0);
  expect(errors).toEqual([]);
});
